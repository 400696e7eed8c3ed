#include "cli/json_text.h"

#include <cmath>

namespace relock {

Json number(const std::optional<double>& value) {
  if (!value) return {};
  if (std::isinf(*value)) return *value > 0 ? "infinite" : "-infinite";
  return *value;
}

Json interval(const std::optional<Interval>& value) {
  return value ? Json::array({number(value->low), number(value->high)}) : Json();
}

std::string json_text(const Json& json) {
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

}  // namespace relock
