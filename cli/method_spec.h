#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace relock {

/// A method as it is asked for: "kcf", "kcf(detect_thresh=0.3,resize=false)", or a combination of methods,
/// "hybrid(ring,kcf,doubt=0.3)", which may be nested: "guarded(gap-aware(kcf),ring)".
struct MethodSpec {
  std::string name;
  std::map<std::string, std::string> options = {};
  std::vector<MethodSpec> parts = {};  ///< the methods that a combination is made of, in order

  /// As it would be typed: parts first, then options, these sorted by name.
  std::string text() const;
  friend bool operator==(const MethodSpec&, const MethodSpec&) = default;
};

/// Names of the combinations, which take methods within their parentheses: detect, track, hybrid, …
const std::vector<std::string>& combination_names();
bool is_combination(std::string_view name);

/// Reads a list of methods, separated by commas. Throws Error that shows the place of a mistake.
std::vector<MethodSpec> parse_methods(std::string_view text);

}  // namespace relock
