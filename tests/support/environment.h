#pragma once
// The floating-point environment of a thread: changing it as programs do, and reading it.

#include <fenv.h>
#if defined(__SSE2__)
#include <xmmintrin.h>
#endif

/// Control and status word of SSE, and all of the x87 environment that C knows.
struct Environment {
#if defined(__SSE2__)
  unsigned mxcsr = _mm_getcsr();
#endif
  int rounding = fegetround(), flags = fetestexcept(FE_ALL_EXCEPT), traps = fegetexcept();
};
inline bool operator==(const Environment& a, const Environment& b) {
#if defined(__SSE2__)
  if (a.mxcsr != b.mxcsr) return false;
#endif
  return a.rounding == b.rounding && a.flags == b.flags && a.traps == b.traps;
}

/// Sets flush-to-zero and denormals-are-zero; nothing without SSE.
inline void flush_denormals(bool results, bool operands) {
#if defined(__SSE2__)
  _mm_setcsr(_mm_getcsr() | (results ? 0x8000u : 0u) | (operands ? 0x0040u : 0u));
#else
  static_cast<void>(results), static_cast<void>(operands);
#endif
}

inline void trap_all() {
  feclearexcept(FE_ALL_EXCEPT);
  feenableexcept(FE_ALL_EXCEPT);
}

/// Upward, no denormals, all traps.
inline void enter_strange_environment() {
  fesetround(FE_UPWARD);
  flush_denormals(true, true);
  trap_all();
}

/// Sets that environment while it lives.
class StrangeEnvironment {
 public:
  StrangeEnvironment() {
    fegetenv(&usual_);
    enter_strange_environment();
  }
  ~StrangeEnvironment() { fesetenv(&usual_); }
  StrangeEnvironment(const StrangeEnvironment&) = delete;
  StrangeEnvironment& operator=(const StrangeEnvironment&) = delete;

 private:
  fenv_t usual_;
};
