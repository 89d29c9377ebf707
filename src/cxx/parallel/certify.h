#pragma once
// The fourth phase: patches compare lists of the triangles that two of them answer for, until all match.
// docs/internals/parallel.md.

#include "parallel/coincidence.h"
#include "parallel/divide.h"
#include "parallel/patches.h"

namespace pstripack {

/// Finished patches, in which the star of every own node is the star in the triangulation of all nodes,
/// unless nodes coincide.
template <class Int>
struct Certified {
  Patches<Int> patches;
  CoincidentPairs coincident;  ///< found by any patch; the same on every rank
};

/// `rounds`: how often lists did not match is added to it. Collective. Throws AgreedFailure, HiddenNode or
/// PatchesDoNotPay.
template <class Int>
Certified<Int> certify(Patches<Int> patches, const Division& division, Communicator& ranks,
                       const ParallelOptions& options, int& rounds);

}  // namespace pstripack
