#pragma once
// Sums of doubles that have the same bits in any order of the terms, so for any number of threads and ranks.

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>

namespace pstripack::scvt {

/// The exact sum of up to 2^42 doubles. A finite double is an integer of 53 bits times 2^(p-1074) with
/// 0 <= p < 2046; that integer, shifted by p mod 32, is added to the part p/32, an integer of 128 bits.
class ExactSum {
 public:
  void add(double x) noexcept {
    std::uint64_t bits = 0;
    std::memcpy(&bits, &x, sizeof bits);
    const unsigned exponent = static_cast<unsigned>(bits >> 52) & 0x7ff;
    if (exponent == 0x7ff) {
      ++not_finite_;
      return;
    }
    const std::uint64_t fraction = bits & ((std::uint64_t{1} << 52) - 1);
    const auto integer =
        static_cast<std::int64_t>(exponent == 0 ? fraction : fraction | std::uint64_t{1} << 52);
    const unsigned p = exponent == 0 ? 0 : exponent - 1;
    const auto sign = static_cast<std::int64_t>(bits) >> 63;  // 0 or -1
    const auto signed_integer = static_cast<Unsigned>(static_cast<Wide>((integer ^ sign) - sign));
    part_[p / 32] += static_cast<Wide>(signed_integer << p % 32);
  }

  ExactSum& operator+=(const ExactSum& other) noexcept {
    for (std::size_t i = 0; i < kParts; ++i) part_[i] += other.part_[i];
    not_finite_ += other.not_finite_;
    return *this;
  }

  /// The nearest double; NaN if a term was not finite.
  double value() const noexcept {
    if (not_finite_ != 0) return std::numeric_limits<double>::quiet_NaN();
    Words w = words();
    const bool negative = w[kDigits - 1] < 0;
    if (negative) {
      for (std::size_t i = 0; i < kDigits; ++i) w[i] = -w[i];
      carry(w);
    }
    std::size_t top = kDigits - 1;  // the digits above are 0
    while (top > 2 && w[top] == 0) --top;
    Unsigned leading = 0;  // 96 bits, of which at least 65 are significant, unless the sum has no more
    for (std::size_t i = top; i + 3 > top; --i) leading = leading << 32 | static_cast<std::uint64_t>(w[i]);
    for (std::size_t i = 0; i + 2 < top; ++i) leading |= w[i] != 0;
    const double size = std::ldexp(static_cast<double>(leading), 32 * (static_cast<int>(top) - 2) - 1074);
    return negative ? -size : size;
  }

  /// The sum as words for messages. Adding the words of several ranks, each as a 64-bit integer, gives
  /// words of the sum over the ranks, for up to 2^30 ranks.
  static constexpr std::size_t kDigits = 67;
  using Words = std::array<std::int64_t, kDigits + 1>;
  Words words() const noexcept {
    Words w{};
    Wide rest = 0;
    for (std::size_t i = 0; i < kDigits; ++i) {
      if (i < kParts) rest += part_[i];
      w[i] = i + 1 < kDigits ? static_cast<std::int64_t>(rest & 0xffffffff) : static_cast<std::int64_t>(rest);
      rest >>= 32;
    }
    w[kDigits] = not_finite_;
    return w;
  }
  static ExactSum of(const Words& words) noexcept {
    ExactSum sum;
    for (std::size_t i = 0; i < kDigits; ++i) {
      const std::size_t part = i < kParts ? i : kParts - 1;
      sum.part_[part] += static_cast<Wide>(words[i]) * (Wide{1} << 32 * (i - part));
    }
    sum.not_finite_ = words[kDigits];
    return sum;
  }

 private:
  using Wide = __int128;
  using Unsigned = unsigned __int128;
  static constexpr std::size_t kParts = 64;

  static void carry(Words& w) noexcept {
    for (std::size_t i = 0; i + 1 < kDigits; ++i) {
      w[i + 1] += w[i] >> 32;
      w[i] &= 0xffffffff;
    }
  }

  Wide part_[kParts] = {};
  std::int64_t not_finite_ = 0;
};

}  // namespace pstripack::scvt
