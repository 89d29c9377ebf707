#pragma once

#if defined(__SSE2__)
#include <xmmintrin.h>
#else
#include <cfenv>
#endif

#if defined(__FAST_MATH__) || defined(__ASSOCIATIVE_MATH__) || defined(__RECIPROCAL_MATH__) || \
    defined(__NO_SIGNED_ZEROS__) || (defined(__FINITE_MATH_ONLY__) && __FINITE_MATH_ONLY__)
#error \
    "PSTRIPACK's exact predicates need IEEE arithmetic: compile it without -ffast-math, -Ofast and the like"
#endif
#if defined(__FLT_EVAL_METHOD__) && __FLT_EVAL_METHOD__ != 0
#error \
    "PSTRIPACK's exact predicates need arithmetic without excess precision: compile it with -msse2 -mfpmath=sse"
#endif

namespace pstripack {

/// While an object of this class exists, its thread computes in the default floating-point environment:
/// rounding to nearest, with denormals, without traps. So no result depends on what the host program has set.
/// The destructor restores the program's environment, exception flags included. With SSE only the register
/// MXCSR matters. It is read once and then written unconditionally, because reading it is the slow part.
/// Use in_default_floating_point to compute in this environment.
class DefaultFloatingPoint {
 public:
#if defined(__SSE2__)
  DefaultFloatingPoint() : saved_(_mm_getcsr()) { _mm_setcsr(0x1f80); }  // all masked, to nearest, no flags
  ~DefaultFloatingPoint() { _mm_setcsr(saved_); }
#else
  DefaultFloatingPoint() {
    std::fegetenv(&saved_);
    std::fesetenv(FE_DFL_ENV);
  }
  ~DefaultFloatingPoint() { std::fesetenv(&saved_); }
#endif
  DefaultFloatingPoint(const DefaultFloatingPoint&) = delete;
  DefaultFloatingPoint& operator=(const DefaultFloatingPoint&) = delete;

 private:
#if defined(__SSE2__)
  unsigned saved_;
#else
  std::fenv_t saved_;
#endif
};

/// Returns body(), through a call that the compiler can neither inline nor move.
template <class Body>
[[gnu::noinline]] auto out_of_line(const Body& body) {
  asm volatile("" ::: "memory");  // without it compilers see that body has no side effects, and move the call
  return body();
}

/// Returns body(), computed in the default floating-point environment. body is called out of line, because
/// compilers move arithmetic across changes of the environment.
template <class Body>
auto in_default_floating_point(const Body& body) {
  const DefaultFloatingPoint environment;
  return out_of_line(body);
}

}  // namespace pstripack
