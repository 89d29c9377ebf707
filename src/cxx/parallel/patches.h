#pragma once
// The third phase: every patch triangulates its own nodes, its halo and a few nodes of the sample.

#include <algorithm>
#include <cstddef>
#include <memory>
#include <vector>

#include "base/parallel_for.h"
#include "parallel/agreement.h"
#include "parallel/deliver.h"
#include "parallel/divide.h"
#include "parallel/patch.h"

namespace pstripack {

/// The triangulations of this rank's patches.
template <class Int>
struct Patches {
  std::vector<Patch<Int>> of_rank;
  std::unique_ptr<Workspace> memory;
  OnAny see_coincidence;  ///< a patch of any rank has found nodes that coincide

  /// Calls body(patch, k) for every patch of this rank, on `threads` threads. Throws what a body threw.
  template <class Body>
  void for_each(int threads, const Body& body) {
    ErrorsOfThreads errors(of_rank.size());
    const int most = std::min(threads, static_cast<int>(of_rank.size()));
    parallel_pieces(of_rank.size(), most, [&](std::size_t first, std::size_t last, int) {
      for (std::size_t k = first; k < last; ++k) errors.keep(k, [&] { body(of_rank[k], PatchHere{k}); });
    });
    errors.rethrow();
  }
};

template <class Int>
std::size_t own_nodes(const Patches<Int>& patches) {
  std::size_t own = 0;
  for (const Patch<Int>& patch : patches.of_rank) own += patch.own();
  return own;
}

/// Collective. Throws AgreedFailure or HiddenNode.
template <class Int>
Patches<Int> triangulate_patches(const Delivery& delivery, const Division& division, Communicator& ranks,
                                 int threads);

}  // namespace pstripack
