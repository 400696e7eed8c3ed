#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace relock {

/// A method as it is asked for: "kcf" or "kcf(detect_thresh=0.3,resize=false)".
struct MethodSpec {
  std::string name;
  std::map<std::string, std::string> options;

  /// As it would be typed, options sorted by name.
  std::string text() const;
};

/// Reads a list of methods, separated by commas. Throws Error that shows the place of a mistake.
std::vector<MethodSpec> parse_methods(std::string_view text);

}  // namespace relock
