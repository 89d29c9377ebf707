#include "parallel/agree.h"

#include <utility>
#include <vector>

#include "parallel/questions.h"

namespace pstripack {
namespace {

/// The lists of all patches here: for each list a head {from, to, count}, then its triangles.
template <class Int>
Parcels packed_lists(const Patches<Int>& patches, const Division& division, std::size_t ranks) {
  const auto for_each_list = [&](const auto& visit) {
    for (const Patch<Int>& patch : patches.of_rank) {
      const std::vector<std::size_t>& counts = patch.lists().counts();
      for (std::size_t q = 0; q < counts.size(); ++q)
        if (counts[q] > 0) visit(patch, static_cast<PatchNumber>(q), counts[q]);
    }
  };
  ParcelWriter writer(ranks);
  for_each_list([&](const Patch<Int>&, PatchNumber q, std::size_t count) {
    writer.expect<Listed<Int>>(division.patches.rank_of(q), 1 + count);
  });
  writer.make_room();
  std::vector<Listed<Int>*> next(static_cast<std::size_t>(division.patches.count()));
  for (const Patch<Int>& patch : patches.of_rank) {
    const std::vector<std::size_t>& counts = patch.lists().counts();
    for (std::size_t q = 0; q < counts.size(); ++q) {
      if (counts[q] == 0) continue;
      next[q] =
          writer.room<Listed<Int>>(division.patches.rank_of(static_cast<PatchNumber>(q)), 1 + counts[q]);
      *next[q]++ = {patch.id(), static_cast<Int>(q), static_cast<Int>(counts[q])};
    }
    patch.lists().for_each(
        [&](PatchNumber q, const Listed<Int>& triangle) { *next[static_cast<std::size_t>(q)]++ = triangle; });
  }
  return writer.finish();
}

/// The lists that have come for each patch here.
template <class Int>
std::vector<std::vector<ListOfOther<Int>>> sorted_lists(const Parcels& lists, const Patches<Int>& patches) {
  std::vector<std::vector<ListOfOther<Int>>> of_patch(patches.of_rank.size());
  const Items<Listed<Int>> items(lists);
  for (const Listed<Int>* head = items.begin(); head < items.end();) {
    const auto count = static_cast<std::size_t>((*head)[2]);
    of_patch[static_cast<PatchHere>((*head)[1] - patches.of_rank[0].id())].push_back(
        {static_cast<PatchNumber>((*head)[0]), head + 1, count});
    head += 1 + count;
  }
  return of_patch;
}

}  // namespace

template <class Int>
void agree_on_lists(Certified<Int>& certified, const Division& division, Communicator& ranks, int threads,
                    std::size_t most) {
  constexpr int kMostRounds = 50;
  const auto size = static_cast<std::size_t>(ranks.size());
  Patches<Int>& patches = certified.patches;
  Questions questions;
  Parcels answers;
  for (;;) {
    const Parcels lists = exchange_in_agreement(ranks, [&] {
      if (certified.rounds > 0) learn(patches, questions, answers, threads);
      patches.for_each(threads, [](Patch<Int>& patch, PatchHere) { patch.update_lists(); });
      return packed_lists(patches, division, size);
    });
    OnAny too_many;
    in_agreement(
        ranks,
        [&] {
          const auto of_others = sorted_lists(lists, patches);
          std::vector<Doubts> of_patch(patches.of_rank.size());
          patches.for_each(threads, [&](Patch<Int>& patch, PatchHere k) {
            of_patch[k].questions = patch.lacking(of_others[k]);
          });
          questions = Questions(of_patch, division.patches, size);
          too_many.value = questions.count > most;
        },
        patches.see_coincidence, questions.about_triangles, too_many);
    // Every list matched, and no hull has grown since: the hulls agree.
    if (!questions.about_triangles.value && !patches.see_coincidence.value) return;
    // Patches may know different pairs of coincident nodes; the pair that is reported must not depend on
    // them.
    certified.gave_up = patches.see_coincidence.value || too_many.value || ++certified.rounds > kMostRounds;
    if (certified.gave_up) return;
    answers = answers_to(questions, patches, ranks, threads);
  }
}

template void agree_on_lists(Certified<std::int32_t>&, const Division&, Communicator&, int, std::size_t);
template void agree_on_lists(Certified<std::int64_t>&, const Division&, Communicator&, int, std::size_t);

}  // namespace pstripack
