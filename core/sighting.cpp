#include "core/sighting.h"

#include <fmt/format.h>

#include "core/error.h"

namespace relock {

std::string to_string(const Code& code) { return code.family + ":" + code.value; }

Code parse_code(std::string_view text) {
  const std::size_t colon = text.find(':');
  const bool one_line = text.find_first_of("\r\n") == std::string_view::npos;
  if (colon == std::string_view::npos || colon == 0 || colon + 1 == text.size() || !one_line)
    throw Error(fmt::format("\"{}\" is no code; write FAMILY:VALUE, for instance aruco6x6_250:23", text));
  return {std::string(text.substr(0, colon)), std::string(text.substr(colon + 1))};
}

std::string_view to_string(CentreKind kind) {
  return kind == CentreKind::projected ? "projected" : "outline";
}

CentreKind parse_centre_kind(std::string_view text) {
  if (text == "projected") return CentreKind::projected;
  if (text == "outline") return CentreKind::outline;
  throw Error(fmt::format("\"{}\" is no kind of centre; write projected or outline", text));
}

}  // namespace relock
