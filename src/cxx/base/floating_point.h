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

/// While it lives, this thread computes in the default floating-point environment: to nearest, with
/// denormals, without traps. No answer may depend on what the host program has set; its environment,
/// exception flags included, comes back afterwards. Where doubles are SSE's, only SSE's register counts; it
/// is read once and written without a look, since reading is what costs. To compute in that environment call
/// in_default_floating_point.
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

/// body(), as a call that compilers can neither see through nor move.
template <class Body>
[[gnu::noinline]] auto out_of_line(const Body& body) {
  asm volatile("" ::: "memory");
  return body();
}

/// body(), computed in the default floating-point environment. Compilers know nothing of that environment and
/// move arithmetic across changes of it, so body stays out of line.
template <class Body>
auto in_default_floating_point(const Body& body) {
  const DefaultFloatingPoint environment;
  return out_of_line(body);
}

}  // namespace pstripack
