#pragma once
// The fourth phase: patches compare lists of the triangles that two of them answer for, until all match.
// Docs/parallel.md.

#include <cstddef>
#include <utility>
#include <vector>

#include "parallel/coincidence.h"
#include "parallel/divide.h"
#include "parallel/patches.h"

namespace pstripack {

/// Patches in which the star of every own node is the star in the triangulation of all nodes, unless nodes
/// coincide or it has given up.
template <class Int>
struct Certified {
  explicit Certified(Patches<Int> p) : patches(std::move(p)) {}
  Patches<Int> patches;
  CoincidentPairs coincident;  ///< found by any patch; the same on every rank
  bool gave_up = false;        ///< it would take longer than one hull; on every rank the same
  int rounds = 0;              ///< in which lists did not match
  bool is_done() const { return coincident.empty() && !gave_up; }
};

/// Collective. Throws AgreedFailure or HiddenNode.
template <class Int>
Certified<Int> certify(Patches<Int> patches, const Division& division, Communicator& ranks,
                       const ParallelOptions& options);

}  // namespace pstripack
