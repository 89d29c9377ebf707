#pragma once
// The third phase: every patch triangulates its own nodes, its margin and a few nodes of the sample.

#include <algorithm>
#include <cstddef>
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
  Block memory;
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
  /// To be called where hulls have grown.
  void look_for_coincidence() {
    for (const Patch<Int>& patch : of_rank)
      see_coincidence.value = see_coincidence.value || !patch.coincident().empty();
  }
};

/// Frees the nodes of the delivery. Collective. Throws AgreedFailure or HiddenNode.
template <class Int>
Patches<Int> triangulate_patches(Delivery& delivery, const Division& division, Communicator& ranks,
                                 int threads) {
  Patches<Int> patches;
  in_agreement(ranks, [&] {
    delivery.outcome.accept();
    constexpr std::size_t kPage = 4096;
    std::vector<std::size_t> begin{0};
    PatchNumber id = division.patches.first(static_cast<RankNumber>(ranks.rank()));
    for (const PatchNodes& nodes : delivery.of_patch) {
      const Patch<Int>& patch =
          patches.of_rank.emplace_back(id++, *division.partition, division.places, nodes);
      begin.push_back(begin.back() +
                      (patch.workspace_bytes(division.closing.size()) + kPage - 1) / kPage * kPage);
    }
    patches.memory = Block(begin.back(), delivery.nodes.size() * sizeof(SentNode));
    patches.for_each(threads, [&](Patch<Int>& patch, PatchHere k) {
      Workspace part(patches.memory.data() + begin[k], begin[k + 1] - begin[k]);
      patch.set_up(division.closing, part);
    });
    delivery.nodes = {};  // an idle block from here on
    if (patches.memory.gives_back_pages()) free_idle_blocks();
  });
  // Ranks have agreed that no patch has seen a hidden node yet, so none is triangulated for nothing.
  in_agreement(
      ranks,
      [&] {
        patches.for_each(threads, [](Patch<Int>& patch, PatchHere) { patch.triangulate(); });
        patches.look_for_coincidence();
      },
      patches.see_coincidence);
  return patches;
}

}  // namespace pstripack
