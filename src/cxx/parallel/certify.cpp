#include "parallel/certify.h"

#include <algorithm>
#include <utility>
#include <vector>

#include "parallel/questions.h"

namespace pstripack {
namespace {

/// The coincident pairs that the patches of all ranks have found.
template <class Int>
CoincidentPairs all_coincident(const Patches<Int>& patches, Communicator& ranks) {
  CoincidentPairs pairs;
  if (!patches.see_coincidence.value) return pairs;
  in_agreement(ranks, [&] {
    for (const Patch<Int>& patch : patches.of_rank)
      pairs.insert(pairs.end(), patch.coincident().begin(), patch.coincident().end());
  });
  return gather_in_agreement(ranks, pairs);
}

/// Largest number of triangles of a rank that other patches lack. If these are most, one hull of all nodes
/// takes less time: each costs both patches the time of inserting two or three nodes.
template <class Int>
std::size_t most_lacking(const Patches<Int>& patches, const ParallelOptions& options, int ranks) {
  constexpr std::size_t kFew = 1000;
  if (ranks == 1) return options.most_questions;  // the caller knows what one hull costs
  return std::min(options.most_questions, own_nodes(patches) / 4 * 3 + kFew);
}

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
Certified<Int> certify(Patches<Int> patches, const Division& division, Communicator& ranks,
                       const ParallelOptions& options, int& rounds) {
  constexpr int kMostRounds = 50;
  const int threads = options.threads;
  CoincidentPairs coincident = all_coincident(patches, ranks);
  if (!coincident.empty()) return {std::move(patches), std::move(coincident)};

  const auto size = static_cast<std::size_t>(ranks.size());
  const std::size_t most = most_lacking(patches, options, ranks.size());
  Questions questions;
  Parcels answers;
  for (int round = 0;; ++round, ++rounds) {
    const Parcels lists = exchange_in_agreement(ranks, [&] {
      if (round > 0) learn(patches, questions, answers, threads);
      patches.for_each(threads, [](Patch<Int>& patch, PatchHere) { patch.update_lists(); });
      return packed_lists(patches, division, size);
    });
    const std::size_t allowed = round < kMostRounds ? most : 0;
    in_agreement(
        ranks,
        [&] {
          const auto of_others = sorted_lists(lists, patches);
          std::vector<std::vector<Question>> of_patch(patches.of_rank.size());
          patches.for_each(
              threads, [&](Patch<Int>& patch, PatchHere k) { of_patch[k] = patch.lacking(of_others[k]); });
          questions = Questions(of_patch, division.patches);
          if (questions.count > allowed) throw PatchesDoNotPay{};
        },
        patches.see_coincidence, questions.exist);
    // Patches may know different pairs of nodes that coincide; the pair that is reported must not depend on
    // them.
    // untested: nodes in one direction are in the same halos, so patches see them before the first lists
    if (patches.see_coincidence.value) throw PatchesDoNotPay{};
    if (!questions.exist.value)
      break;  // every list has matched, and no hull has grown since: the hulls agree
    answers = answers_to(questions, patches, ranks, threads);
  }
  in_agreement(ranks,
               [&] { patches.for_each(threads, [](Patch<Int>& patch, PatchHere) { patch.finish(); }); });
  return {std::move(patches), {}};
}

template Certified<std::int32_t> certify(Patches<std::int32_t>, const Division&, Communicator&,
                                         const ParallelOptions&, int&);
template Certified<std::int64_t> certify(Patches<std::int64_t>, const Division&, Communicator&,
                                         const ParallelOptions&, int&);

}  // namespace pstripack
