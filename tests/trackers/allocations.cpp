#include "tests/trackers/allocations.h"

#include <cstdlib>

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__) || !defined(__GLIBC__)
#define RELOCK_COUNTS_ALLOCATIONS 0
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
#define RELOCK_COUNTS_ALLOCATIONS 0
#endif
#endif
#ifndef RELOCK_COUNTS_ALLOCATIONS
#define RELOCK_COUNTS_ALLOCATIONS 1
#endif

namespace {
thread_local std::size_t count = 0;
}

#if RELOCK_COUNTS_ALLOCATIONS
extern "C" void* __libc_malloc(std::size_t size);

// In place of the C library's, for the whole program.
extern "C" void* malloc(std::size_t size) {
  ++count;
  return __libc_malloc(size);
}
#endif

namespace relock {

std::size_t allocations() { return count; }
bool allocations_are_counted() { return RELOCK_COUNTS_ALLOCATIONS; }

}  // namespace relock
