#pragma once
// The fourth phase: every patch asks the others about what it cannot know, until nothing is left to ask.

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
  CoincidentPairs coincident;      ///< found by any patch; the same on every rank
  bool gave_up = false;            ///< more questions than are worth while; on every rank the same
  bool has_hubs = false;           ///< nodes whose stars lie on several ranks; on every rank the same
  std::vector<GlobalNumber> hubs;  ///< those with many neighbours, in order; on every rank the same
  int rounds = 0;                  ///< exchanges of questions that were needed
  bool is_done() const { return coincident.empty() && !gave_up; }
};

/// Collective. Throws AgreedFailure or HiddenNode.
template <class Int>
Certified<Int> certify(Patches<Int> patches, const Division& division, const Corners& corners,
                       Communicator& ranks, const ParallelOptions& options);

}  // namespace pstripack
