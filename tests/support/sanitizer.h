#pragma once
// Whether the test is built with a sanitizer: GCC defines macros, Clang 14 answers __has_feature.

#if defined(__SANITIZE_ADDRESS__)
#define PSTRIPACK_ADDRESS_SANITIZER 1
#elif defined(__has_feature)
#if __has_feature(address_sanitizer)
#define PSTRIPACK_ADDRESS_SANITIZER 1
#elif __has_feature(thread_sanitizer)
#define PSTRIPACK_THREAD_SANITIZER 1
#endif
#endif

#ifdef PSTRIPACK_ADDRESS_SANITIZER
constexpr bool kAddressSanitizer = true;
#else
constexpr bool kAddressSanitizer = false;
#endif
#if defined(PSTRIPACK_THREAD_SANITIZER) || defined(__SANITIZE_THREAD__)
constexpr bool kThreadSanitizer = true;
#else
constexpr bool kThreadSanitizer = false;
#endif
