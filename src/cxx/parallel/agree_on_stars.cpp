#include "parallel/agree_on_stars.h"

#include <algorithm>
#include <unordered_set>
#include <vector>

#include "parallel/questions.h"

namespace pstripack {
namespace {

using Hubs = std::unordered_set<GlobalNumber>;

void append(std::vector<GlobalNumber>& numbers, const std::vector<GlobalNumber>& more) {
  numbers.insert(numbers.end(), more.begin(), more.end());
}

/// The numbers that all ranks have found.
Hubs all_of(const std::vector<GlobalNumber>& found, Communicator& ranks) {
  const Parcels all = ranks.all_gather(found.data(), found.size() * sizeof found[0]);
  Hubs numbers;
  in_agreement(ranks, [&] {
    const Items<GlobalNumber> items(all);
    numbers.insert(items.begin(), items.end());
  });
  return numbers;
}

/// True if a node that all patches know is no hub, and somebody keeps a triangle at each hub: steps 3 and 4
/// of the proof.
template <class Int>
bool are_few_and_kept(const Hubs& hubs, const Patches<Int>& patches, const Division& division,
                      Communicator& ranks) {
  std::vector<GlobalNumber> kept;
  in_agreement(ranks, [&] {
    for (const Patch<Int>& patch : patches.of_rank) append(kept, patch.kept_hubs());
  });
  return all_of(kept, ranks).size() == hubs.size() &&
         std::any_of(division.closing.begin(), division.closing.end(),
                     [&](const Record& r) { return hubs.count(r.number) == 0; });
}

}  // namespace

template <class Int>
void agree_on_stars(Certified<Int>& certified, const Division& division, const Corners& corners,
                    Communicator& ranks, int threads) {
  constexpr int kMostRounds = 50;
  constexpr std::size_t kFewQuestions = 8, kMoreQuestions = 8;
  Patches<Int>& patches = certified.patches;
  Questions questions;
  Hubs hubs;
  std::size_t most = kFewQuestions;
  const auto claim = [&] {
    std::vector<Doubts> of_patch(patches.of_rank.size());
    patches.for_each(threads,
                     [&](Patch<Int>& patch, std::size_t k) { of_patch[k] = patch.claim(corners, most); });
    questions = Questions(of_patch, division.patches, static_cast<std::size_t>(ranks.size()));
  };
  const auto see_coincidence = [&] {
    // Other patches may know other pairs: which is reported must not depend on patches.
    certified.gave_up = patches.see_coincidence.value;
    return certified.gave_up;
  };
  if (see_coincidence()) return;
  in_agreement(ranks, claim, questions.about_triangles, questions.about_arcs, questions.left_out);
  // The last round: nothing was left out, and nobody has learnt from it.
  for (bool is_last = !questions.about_triangles.value && !questions.about_arcs.value; !is_last;) {
    certified.gave_up = ++certified.rounds > kMostRounds;
    if (certified.gave_up) return;
    const Parcels answers = answers_to(questions, patches, ranks, threads);
    std::vector<GlobalNumber> found;
    OnAny has_found;
    in_agreement(
        ranks,
        [&] {
          learn(patches, questions, answers, threads);
          for (const Patch<Int>& patch : patches.of_rank) append(found, patch.look_for_hubs());
          has_found.value = !found.empty();
        },
        patches.see_coincidence, has_found);
    if (see_coincidence()) return;
    if (has_found.value) {
      const Hubs more = all_of(found, ranks);
      in_agreement(ranks, [&] {
        hubs.insert(more.begin(), more.end());
        for (Patch<Int>& patch : patches.of_rank) patch.set_hubs(hubs);
      });
    }
    const bool was_complete = !questions.left_out.value;
    most = most > SIZE_MAX / kMoreQuestions ? most : most * kMoreQuestions;
    in_agreement(ranks, claim, questions.have_grown, questions.left_out);
    is_last = was_complete && !questions.have_grown.value;
  }
  certified.has_hubs = !hubs.empty();
  certified.gave_up = certified.has_hubs && !are_few_and_kept(hubs, patches, division, ranks);
}

template void agree_on_stars(Certified<std::int32_t>&, const Division&, const Corners&, Communicator&, int);
template void agree_on_stars(Certified<std::int64_t>&, const Division&, const Corners&, Communicator&, int);

}  // namespace pstripack
