#pragma once

#include <limits>
#include <type_traits>

namespace pstripack {

/// JRAND's three seeds (Wichmann and Hill, Applied Statistics 31, 1982).
template <class Int>
struct Seeds {
  Int x = 1, y = 2, z = 3;
};

/// factor * seed modulo `modulus`. A product that overflows wraps, as in compiled Fortran.
template <class Int>
Int next_seed(Int factor, Int seed, Int modulus) {
  using Bits = std::make_unsigned_t<Int>;
  return static_cast<Int>(static_cast<Bits>(factor) * static_cast<Bits>(seed)) % modulus;
}

/// JRAND: a random integer in 1..n, computed in Real arithmetic. About once in 10^7 draws in single precision
/// the sum n*u+1 is rounded up to n+1, which is then the result: check it before using it as an index.
template <class Real, class Int, class SeedInt>
Int jrand(Int n, Seeds<SeedInt>& seeds) {
  seeds.x = next_seed<SeedInt>(171, seeds.x, 30269);
  seeds.y = next_seed<SeedInt>(172, seeds.y, 30307);
  seeds.z = next_seed<SeedInt>(170, seeds.z, 30323);
  const Real sum = static_cast<Real>(seeds.x) / Real(30269) + static_cast<Real>(seeds.y) / Real(30307) +
                   static_cast<Real>(seeds.z) / Real(30323);
  const Real fraction = sum - static_cast<Real>(static_cast<Int>(sum));
  const Real drawn = static_cast<Real>(n) * fraction + Real(1);
  // The largest Int may round up to a Real that does not fit Int.
  return drawn < static_cast<Real>(std::numeric_limits<Int>::max()) ? static_cast<Int>(drawn) : n;
}

}  // namespace pstripack
