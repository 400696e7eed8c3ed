#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

#include "cli/conformance/scene.h"

namespace relock {

/// How the pixels of a GuardedPicture lie in memory.
enum class Guard : std::uint8_t {
  writing,  ///< they can be read only; around them there is room
  before,   ///< the first one borders on memory that cannot be touched
  behind,   ///< the last one does
  later,    ///< there is room around them, and they may be written; see take_away
};

/// A picture in memory of its own in which a wrong touch ends the process. For child processes only.
class GuardedPicture {
 public:
  /// Rows are longer than the picture is wide; `between` is what the bytes after a row's pixels hold. Throws
  /// Error when there is no memory.
  GuardedPicture(const Picture& picture, Guard guard, std::uint8_t between = 0);
  ~GuardedPicture();
  GuardedPicture(const GuardedPicture&) = delete;
  GuardedPicture& operator=(const GuardedPicture&) = delete;

  Image image() const { return image_; }
  /// From here on a touch of the pixels ends the process: they have lived.
  void take_away();

 private:
  std::uint8_t* memory_ = nullptr;
  std::size_t bytes_ = 0, slot_ = 0;
  Image image_;
};

/// From here on this process says on stderr which wrong touch of a GuardedPicture ends it.
void tell_wrong_touches();
/// What was said: "writes into the picture it is given"; empty when it was something else.
std::string wrong_touch(std::string_view said);

}  // namespace relock
