#pragma once
// What PSTRIPACK_ORDER asks for.

#include "stripack/random.h"

namespace pstripack {

/// How closely results follow the original.
///   canonical  our own order of the lists; searches draw their random start nodes from seeds 1, 2, 3 in
///              every call
///   original   lists and searches as the original's, to the last bit: the tolerance of Algorithm 772 and of
///              the Fortran 90 text (100 epsilon), random numbers in the working kind, seeds kept from call
///              to call (of each thread)
///   ngmath     the same with the constants of libngmath: 4 epsilon, random numbers in single precision
struct OriginalRules {
  bool follow = false;  ///< TRMESH inserts as the original does, seeds are kept
  int tolerance_in_epsilons = 100;
  bool single_precision_random = false;
};

/// PSTRIPACK_ORDER=canonical (or unset), original, ngmath; read once. Anything else is canonical and says so
/// on stderr.
const OriginalRules& original_rules();

/// The seeds of this thread that are kept from call to call.
template <class Int>
Seeds<Int>& kept_seeds() {
  thread_local Seeds<Int> seeds;
  return seeds;
}

}  // namespace pstripack
