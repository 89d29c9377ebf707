#pragma once

namespace pstripack {

/// JRAND's three seeds (Wichmann and Hill, Applied Statistics 31, 1982).
template <class Int>
struct Seeds {
  Int x = 1, y = 2, z = 3;
};

/// JRAND: a random integer in 1..n. The arithmetic is in the working kind; where N*u+1 rounds up to
/// n+1, which is what the original returns about once in 10^7 draws in single precision, n comes out.
template <class Real, class Int>
Int jrand(Int n, Seeds<Int>& seeds) {
  seeds.x = 171 * seeds.x % 30269;
  seeds.y = 172 * seeds.y % 30307;
  seeds.z = 170 * seeds.z % 30323;
  const Real sum = static_cast<Real>(seeds.x) / Real(30269) + static_cast<Real>(seeds.y) / Real(30307) +
                   static_cast<Real>(seeds.z) / Real(30323);
  const Real fraction = sum - static_cast<Real>(static_cast<Int>(sum));
  const Int drawn = static_cast<Int>(static_cast<Real>(n) * fraction + Real(1));
  return drawn > n ? n : drawn;
}

}  // namespace pstripack
