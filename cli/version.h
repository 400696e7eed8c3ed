#pragma once

namespace relock {
/// The program's version, as CMakeLists.txt has it.
inline constexpr const char* kVersion = RELOCK_VERSION;
}  // namespace relock
