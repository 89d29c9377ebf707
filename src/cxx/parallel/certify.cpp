#include "parallel/certify.h"

#include <utility>
#include <vector>

#include "parallel/agree.h"
#include "parallel/agree_on_stars.h"
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

/// Largest number of questions of a rank that are worth while. A question costs both ranks the time of
/// inserting one or two nodes, and the patch that answers takes in its corners.
template <class Int>
std::size_t most_of_a_rank(const Patches<Int>& patches, const Division& division) {
  constexpr std::size_t kMostInAPatch = std::size_t{1} << 28, kFew = 1000;
  if (division.nodes > kMostInAPatch) return SIZE_MAX;
  std::size_t own = 0;
  for (const Patch<Int>& patch : patches.of_rank) own += patch.own();
  return 4 * own + kFew;
}

}  // namespace

template <class Int>
Certified<Int> certify(Patches<Int> found, const Division& division, const Corners& corners,
                       Communicator& ranks, const ParallelOptions& options) {
  Certified<Int> certified(std::move(found));
  Patches<Int>& patches = certified.patches;
  const std::size_t most = ranks.size() == 1
                               ? options.most_questions
                               : std::min(options.most_questions, most_of_a_rank(patches, division));
  if (division.by_agreement && ranks.size() > 1 && !options.by_lists) {
    agree_on_stars(certified, division, corners, ranks, options.threads);
    return certified;
  }
  certified.coincident = all_coincident(patches, ranks);
  if (!certified.coincident.empty()) return certified;
  if (options.by_lists) {
    std::size_t own = 0;
    for (const Patch<Int>& patch : patches.of_rank) own += patch.own();
    constexpr std::size_t kFew = 1000;
    agree_on_lists(certified, division, ranks, options.threads,
                   std::min(options.most_questions, own / 4 * 3 + kFew));
    return certified;
  }

  Questions questions;
  OnAny too_many;  // one hull of all nodes, or agreement, would take less time
  const auto ask = [&] {
    std::vector<Doubts> of_patch(patches.of_rank.size());
    patches.for_each(options.threads, [&](Patch<Int>& patch, PatchHere k) {
      of_patch[k] = patch.ask(corners, division.most_stretch, most);
    });
    questions = Questions(of_patch, division.patches, static_cast<std::size_t>(ranks.size()));
    too_many.value = questions.count > most;
  };
  in_agreement(ranks, ask, questions.about_triangles, questions.about_arcs, questions.have_grown, too_many);
  // All stars are final when there is no question about triangles and, if there are questions about arcs, no
  // patch has grown in the last round.
  while (!too_many.value && certified.coincident.empty() &&
         (questions.about_triangles.value || (questions.about_arcs.value && questions.have_grown.value))) {
    ++certified.rounds;
    const Parcels answers = answers_to(questions, patches, ranks, options.threads);
    in_agreement(
        ranks,
        [&] {
          learn(patches, questions, answers, options.threads);
          questions = {};
          // A patch that has found coincident nodes asks no more questions.
          if (!patches.see_coincidence.value) ask();
        },
        patches.see_coincidence, questions.about_triangles, questions.about_arcs, questions.have_grown,
        too_many);
    certified.coincident = all_coincident(patches, ranks);
  }
  if (too_many.value && ranks.size() > 1)
    agree_on_stars(certified, division, corners, ranks, options.threads);
  else
    certified.gave_up = too_many.value;
  return certified;
}

template Certified<std::int32_t> certify(Patches<std::int32_t>, const Division&, const Corners&,
                                         Communicator&, const ParallelOptions&);
template Certified<std::int64_t> certify(Patches<std::int64_t>, const Division&, const Corners&,
                                         Communicator&, const ParallelOptions&);

}  // namespace pstripack
