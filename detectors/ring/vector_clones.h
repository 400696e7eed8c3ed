#pragma once

/// Before a function of plain loops over arrays: compiled twice, once for processors with AVX2, and the right one
/// chosen when the program starts. Both give the same bits: no operation is reordered or fused.
///
/// Sanitizers cannot instrument the choice; other processors and libraries get the plain version only.
#if defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer)
#define RELOCK_SANITIZED
#endif
#endif
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
#define RELOCK_SANITIZED
#endif

#if defined(__x86_64__) && defined(__gnu_linux__) && !defined(RELOCK_SANITIZED)
#define RELOCK_VECTOR_CLONES __attribute__((target_clones("avx2", "default")))
#else
#define RELOCK_VECTOR_CLONES
#endif

/// Before a loop whose rounds do not need each other: no array written in it is read under another name.
#if defined(__clang__)
#define RELOCK_INDEPENDENT _Pragma("clang loop vectorize(assume_safety)")
#else
#define RELOCK_INDEPENDENT _Pragma("GCC ivdep")
#endif
