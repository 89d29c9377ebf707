#pragma once

#include <cstdint>
#include <cstring>
#include <limits>
#include <type_traits>

#include "base/floating_point.h"

namespace pstripack {

// The same operations for float and double, which follow the floating-point environment.
template <class Real>
bool is_larger(Real a, Real b) {
  return a > b;
}
/// a if a > b, else b; so b if one of them is a NaN.
template <class Real>
Real larger(Real a, Real b) {
  return a > b ? a : b;
}

/// A float or double whose sums and products are rounded to nearest and raise no exception flag, whatever
/// floating-point environment the caller has set: the AVX-512 instructions contain the rounding mode
/// ("embedded rounding", Intel's manual, volume 1, 15.6.4). Meant for computations shorter than setting and
/// restoring the environment. If !is_available(), compute with Real in_default_floating_point instead.
template <class Real>
class StaticallyRounded {
 public:
  StaticallyRounded(Real value) : value_(value) {}  // NOLINT: implicit on purpose
  explicit operator Real() const { return value_; }

#if defined(__x86_64__)
  /// True if the processor has AVX-512 and does not treat denormals as 0. The instructions cannot override
  /// that setting of the caller, so it is tested.
  static bool is_available() {
    if (!__builtin_cpu_supports("avx512f")) return false;
    Real denormal = std::numeric_limits<Real>::denorm_min();
    asm volatile("" : "+x"(denormal));
    // Compared as bits, because a floating-point comparison could treat denormals as 0, too.
    const Real sum = Real(StaticallyRounded(denormal) + denormal);
    Bits bits;
    std::memcpy(&bits, &sum, sizeof bits);
    return bits == 2;
  }

#define PSTRIPACK_ROUNDED(name, instruction, mode)                                            \
  friend StaticallyRounded name(StaticallyRounded a, StaticallyRounded b) {                   \
    Real c;                                                                                   \
    if constexpr (sizeof(Real) == sizeof(double))                                             \
      asm(instruction "d %{" mode "%}, %2, %1, %0" : "=x"(c) : "x"(a.value_), "x"(b.value_)); \
    else                                                                                      \
      asm(instruction "s %{" mode "%}, %2, %1, %0" : "=x"(c) : "x"(a.value_), "x"(b.value_)); \
    return c;                                                                                 \
  }
  PSTRIPACK_ROUNDED(operator+, "vadds", "rn-sae")
  PSTRIPACK_ROUNDED(operator*, "vmuls", "rn-sae")
  PSTRIPACK_ROUNDED(larger, "vmaxs", "sae")
#undef PSTRIPACK_ROUNDED

  friend bool is_larger(StaticallyRounded a, StaticallyRounded b) {
    bool result;
    if constexpr (sizeof(Real) == sizeof(double))
      asm("vcomisd %{sae%}, %2, %1" : "=@cca"(result) : "x"(a.value_), "x"(b.value_));
    else
      asm("vcomiss %{sae%}, %2, %1" : "=@cca"(result) : "x"(a.value_), "x"(b.value_));
    return result;
  }

 private:
  using Bits = std::conditional_t<sizeof(Real) == sizeof(double), std::uint64_t, std::uint32_t>;
#else
  static constexpr bool is_available() { return false; }
  friend StaticallyRounded operator+(StaticallyRounded a, StaticallyRounded b) { return a.value_ + b.value_; }
  friend StaticallyRounded operator*(StaticallyRounded a, StaticallyRounded b) { return a.value_ * b.value_; }
  friend StaticallyRounded larger(StaticallyRounded a, StaticallyRounded b) {
    return larger(a.value_, b.value_);
  }
  friend bool is_larger(StaticallyRounded a, StaticallyRounded b) { return is_larger(a.value_, b.value_); }

 private:
#endif
  Real value_;
};

/// Returns body(), whose arithmetic is in Number. Sets the default floating-point environment, unless
/// Number is a StaticallyRounded and does not need it.
template <class Number, class Body>
[[gnu::always_inline]] inline auto in_environment_of(const Body& body) {
  if constexpr (std::is_floating_point_v<Number>)
    return in_default_floating_point(body);
  else
    return body();
}

}  // namespace pstripack
