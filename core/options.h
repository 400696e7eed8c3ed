#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace relock {

/// One option of a method. `relock list --verbose` prints these.
struct OptionInfo {
  std::string name;
  std::string default_value;  ///< as it would be typed
  std::string unit;           ///< "px", "s", …; empty for a pure number, a word or a switch
  std::string sentence;
};

/// The options given to a method, checked against those it has, with defaults filled in.
class Options {
 public:
  Options() = default;
  /// `owner` is the method's name, for errors. Throws Error on a name that `known` does not list.
  Options(std::string owner, const std::vector<OptionInfo>& known,
          const std::map<std::string, std::string>& given);

  // Each throws Error naming the option, the value and the legal range.
  double number(std::string_view name, double least, double most) const;
  int whole(std::string_view name, int least, int most) const;
  bool flag(std::string_view name) const;  ///< "true" or "false"
  const std::string& word(std::string_view name) const;
  /// One of `legal`.
  const std::string& word(std::string_view name, const std::vector<std::string>& legal) const;

  /// Every option with its value, defaults too, sorted by name.
  const std::map<std::string, std::string>& values() const { return values_; }

 private:
  [[noreturn]] void refuse(std::string_view name, std::string_view legal) const;

  std::string owner_;
  std::map<std::string, std::string> values_;
};

}  // namespace relock
