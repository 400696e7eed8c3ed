#pragma once

#include <nlohmann/json.hpp>
#include <optional>
#include <string>

#include "eval/statistics/interval.h"

namespace relock {

/// JSON as relock writes it: keys stand in the order in which they were given.
using Json = nlohmann::ordered_json;

/// A number; null for n/a. JSON knows no infinity, so that is a word: "infinite", or "-infinite".
Json number(const std::optional<double>& value);

/// [low, high], ends as of number(); null for n/a.
Json interval(const std::optional<Interval>& value);

/// The text of a file, or of what `--json` prints: indented by 2, with a newline at the end. Whatever is not UTF-8
/// (in the words of a library, in a file's name) is replaced by U+FFFD.
std::string json_text(const Json& json);

}  // namespace relock
