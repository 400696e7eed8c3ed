#pragma once

#include <cstddef>

namespace relock {

/// How often malloc() was called so far, by this thread; nothing changes where that cannot be told (another C
/// library, a sanitizer).
std::size_t allocations();
bool allocations_are_counted();

}  // namespace relock
