#pragma once

#include <stdexcept>
#include <string>
#include <string_view>

namespace relock {

/// The one exception of relock: a fault in what the user gave (a file, an option, a picture), told in one
/// sentence that says where it is and what to do. The program prints it after "relock: " and exits 2.
class Error : public std::runtime_error {
 public:
  explicit Error(const std::string& sentence) : std::runtime_error(sentence) {}

  /// The same fault at a place in a file: "labels.csv:118: frame 4071 does not exist …".
  static Error at(std::string_view file, std::size_t line, std::string_view sentence);
};

}  // namespace relock
