#include "parallel/patches.h"

namespace pstripack {

template <class Int>
Patches<Int> triangulate_patches(const Delivery& delivery, const Division& division, Communicator& ranks,
                                 int threads) {
  Patches<Int> patches;
  in_agreement(ranks, [&] {
    delivery.outcome.accept();
    constexpr std::size_t kPage = 4096;
    std::vector<std::size_t> begin{0};
    PatchNumber id = division.patches.first(static_cast<RankNumber>(ranks.rank()));
    for (const auto& nodes : delivery.of_patch) {
      const Patch<Int>& patch =
          patches.of_rank.emplace_back(id++, *division.partition, division.places, nodes);
      begin.push_back(begin.back() +
                      (patch.workspace_bytes(division.closing.size()) + kPage - 1) / kPage * kPage);
    }
    patches.memory = std::make_unique<Workspace>(begin.back());
    unsigned char* const memory = patches.memory->template for_call<unsigned char>(begin.back());
    patches.for_each(threads, [&](Patch<Int>& patch, PatchHere k) {
      Workspace part(memory + begin[k], begin[k + 1] - begin[k]);
      patch.set_up(division.closing, part);
    });
  });
  // Ranks have agreed that no patch has seen a hidden node yet, so none is triangulated for nothing.
  in_agreement(
      ranks,
      [&] {
        patches.for_each(threads, [](Patch<Int>& patch, PatchHere) { patch.triangulate(); });
        for (const Patch<Int>& patch : patches.of_rank)
          if (!patch.coincident().empty()) patches.see_coincidence.value = true;
      },
      patches.see_coincidence);
  return patches;
}

template Patches<std::int32_t> triangulate_patches(const Delivery&, const Division&, Communicator&, int);
template Patches<std::int64_t> triangulate_patches(const Delivery&, const Division&, Communicator&, int);

}  // namespace pstripack
