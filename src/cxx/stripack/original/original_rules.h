#pragma once
// The settings of PSTRIPACK_ORDER.

#include <cstdint>
#include <limits>

#include "stripack/random.h"

namespace pstripack {

/// How closely results follow the original.
///   canonical  our own order of the lists; searches draw their random start nodes from seeds 1, 2, 3 in
///              every call
///   original   lists and searches as the original's, to the last bit: the tolerance of Algorithm 772 and of
///              the Fortran 90 text (100 epsilon), random numbers in the working kind, seeds of each thread
///              kept from call to call
///   bitwise    the same; TRMESH follows the original even if its triangulation is not the exact mesh
///   ngmath, bitwise-ngmath  the same as libngmath does: 4 epsilon, random numbers in single precision, AL of
///              NEARND untouched if nothing is found
struct OriginalRules {
  bool follow = false;  ///< TRMESH inserts as the original does, and seeds are kept
  int tolerance_in_epsilons = 100;
  bool single_precision_random = false;
  bool clear_angle = true;  ///< NEARND in REAL*8 sets AL = 0 if nothing is found, as the Fortran 90 text
  bool bitwise = false;     ///< TRMESH returns any triangulation that the original makes, exact or not

  template <class Real>
  Real tolerance() const {
    return static_cast<Real>(tolerance_in_epsilons) * std::numeric_limits<Real>::epsilon();
  }
  /// JRAND's arithmetic. Real: the working kind.
  template <class Real, class Int, class SeedInt>
  Int random(Int n, Seeds<SeedInt>& seeds) const {
    return single_precision_random ? jrand<float>(n, seeds) : jrand<Real>(n, seeds);
  }
};

/// Reads PSTRIPACK_ORDER once; canonical if it is unset. For an unknown name canonical, with a message on
/// stderr.
const OriginalRules& original_rules();

/// This thread's seeds, kept from call to call, shared by all kinds of integers.
inline Seeds<std::int32_t>& seeds_of_thread() {
  thread_local Seeds<std::int32_t> seeds;
  return seeds;
}

}  // namespace pstripack
