#include "core/error.h"

#include <fmt/format.h>

namespace relock {

Error Error::at(std::string_view file, std::size_t line, std::string_view sentence) {
  return Error(fmt::format("{}:{}: {}", file, line, sentence));
}

}  // namespace relock
