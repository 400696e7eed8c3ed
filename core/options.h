#pragma once

#include <algorithm>
#include <charconv>
#include <cmath>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "core/error.h"

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
  /// All options with their values, checked already: what a plug-in is handed.
  Options(std::string owner, std::map<std::string, std::string> values)
      : owner_(std::move(owner)), values_(std::move(values)) {}

  // Each throws Error naming the option, the value and the legal range. They are in this header so that a
  // plug-in has them without linking relock.
  double number(std::string_view name, double least, double most) const {
    double value = 0;
    if (!parse(word(name), value) || !std::isfinite(value) || value < least || value > most)
      refuse(name, "a number from " + text_of(least) + " to " + text_of(most));
    return value;
  }
  int whole(std::string_view name, int least, int most) const {
    int value = 0;
    if (!parse(word(name), value) || value < least || value > most)
      refuse(name, "a whole number from " + std::to_string(least) + " to " + std::to_string(most));
    return value;
  }
  /// "true" or "false"
  bool flag(std::string_view name) const { return word(name, {"false", "true"}) == "true"; }
  const std::string& word(std::string_view name) const {
    const auto place = values_.find(std::string(name));
    if (place == values_.end())
      throw Error(owner_ + " asks for an option \"" + std::string(name) + "\" that it does not list");
    return place->second;
  }
  /// One of `legal`.
  const std::string& word(std::string_view name, const std::vector<std::string>& legal) const {
    const std::string& value = word(name);
    std::string all;
    for (const std::string& one : legal) all += (all.empty() ? "" : ", ") + one;
    if (std::find(legal.begin(), legal.end(), value) == legal.end()) refuse(name, "one of " + all);
    return value;
  }

  /// Every option with its value, defaults too, sorted by name.
  const std::map<std::string, std::string>& values() const { return values_; }

 private:
  template <class Number>
  static bool parse(const std::string& text, Number& value) {
    const auto [end, fault] = std::from_chars(text.data(), text.data() + text.size(), value);
    return fault == std::errc{} && end == text.data() + text.size();
  }

  static std::string text_of(double value) {
    char text[32];
    const bool whole = value == std::floor(value) && std::abs(value) < 1e15;  // 100000, not 1e+05
    const auto end = whole ? std::to_chars(text, text + sizeof text, value, std::chars_format::fixed)
                           : std::to_chars(text, text + sizeof text, value);
    return {text, end.ptr};
  }

  [[noreturn]] void refuse(std::string_view name, const std::string& legal) const {
    throw Error(owner_ + ": option " + std::string(name) + " is \"" + word(name) + "\"; it must be " + legal);
  }

  std::string owner_;
  std::map<std::string, std::string> values_;
};

}  // namespace relock
