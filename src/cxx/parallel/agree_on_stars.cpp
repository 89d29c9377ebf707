#include "parallel/agree_on_stars.h"

#include <algorithm>
#include <map>
#include <unordered_set>
#include <vector>

#include "parallel/questions.h"

namespace pstripack {
namespace {

using Hubs = std::unordered_set<GlobalNumber>;

/// The hubs at which patches keep triangles, and the number of these, which is exact below kManyTriangles.
template <class Int>
std::map<GlobalNumber, std::size_t> kept_hubs(const Patches<Int>& patches, Communicator& ranks) {
  std::vector<KeptHub> here;
  in_agreement(ranks, [&] {
    for (const Patch<Int>& patch : patches.of_rank)
      for (const KeptHub& hub : patch.kept_hubs()) here.push_back(hub);
  });
  const std::vector<KeptHub> all = gather_in_agreement(ranks, here);
  std::map<GlobalNumber, std::size_t> kept;
  in_agreement(ranks, [&] {
    for (const KeptHub& hub : all) kept[hub.number] += hub.triangles;
  });
  return kept;
}

/// The claims of a patch on another.
struct Claims {
  PatchNumber from, to;
  std::int64_t count;
};

/// Two patches compare their claims on each other: each sends the other the triangles that it keeps. Not
/// where one has many more than the other, as at a hub: these are left for questions. Returns Claims, each
/// followed by its triangles. Collective.
template <class Int>
Parcels exchange_claims(Patches<Int>& patches, const Division& division, Communicator& ranks, int threads) {
  const auto size = static_cast<std::size_t>(ranks.size());
  const Parcels counts = exchange_in_agreement(ranks, [&] {
    std::vector<std::vector<Claims>> to_rank(size);
    for (const Patch<Int>& patch : patches.of_rank)
      for (PatchNumber q = 0; q < division.patches.count(); ++q)
        if (const auto n = static_cast<std::int64_t>(patch.claims_on(q)); n > 0)
          to_rank[division.patches.rank_of(q)].push_back({patch.id(), q, n});
    return packed(to_rank);
  });
  return exchange_in_agreement(ranks, [&] {
    constexpr std::int64_t kTimes = 2, kMore = 64;
    struct List {
      Claims claims;
      std::vector<KeptTriangle> kept;
    };
    std::vector<std::vector<List>> to_rank(size);
    for (RankNumber r = 0; r < size; ++r)
      for (const Claims& theirs : Items<Claims>(counts, r)) {
        const auto k = static_cast<PatchHere>(theirs.to - patches.of_rank[0].id());
        const auto mine = static_cast<std::int64_t>(patches.of_rank[k].claims_on(theirs.from));
        if (mine > 0 && std::max(mine, theirs.count) <= kTimes * std::min(mine, theirs.count) + kMore)
          to_rank[r].push_back({{theirs.to, theirs.from, mine}, {}});
      }
    patches.for_each(threads, [&](Patch<Int>& patch, PatchHere) {
      for (std::vector<List>& lists : to_rank)
        for (List& list : lists)
          if (list.claims.from == patch.id()) list.kept = patch.kept_with(list.claims.to);
    });
    ParcelWriter writer(size);
    const auto for_each_list = [&](const auto& visit) {
      for (RankNumber r = 0; r < size; ++r)
        for (const List& list : to_rank[r]) visit(r, list);
    };
    for_each_list([&](RankNumber r, const List& list) {
      writer.expect<Claims>(r);
      writer.expect<KeptTriangle>(r, list.kept.size());
    });
    writer.make_room();
    for_each_list([&](RankNumber r, const List& list) {
      writer.put(r, list.claims);
      std::copy(list.kept.begin(), list.kept.end(), writer.room<KeptTriangle>(r, list.kept.size()));
    });
    return writer.finish();
  });
}

/// What others keep of the triangles that this patch claims.
std::vector<KeptByOther> kept_by_others(PatchNumber patch, const Parcels& lists) {
  std::vector<KeptByOther> kept;
  for (RankNumber r = 0; r + 1 < lists.begin.size(); ++r)
    for (ParcelReader reader(lists, r); !reader.is_at_end();) {
      const Claims& theirs = reader.next<Claims>();
      const auto count = static_cast<std::size_t>(theirs.count);
      const KeptTriangle* const first = reader.array<KeptTriangle>(count);
      if (theirs.to == patch) kept.push_back({theirs.from, first, count});
    }
  return kept;
}

}  // namespace

template <class Int>
void agree_on_stars(Certified<Int>& certified, const Division& division, const Corners& corners,
                    Communicator& ranks, int threads) {
  constexpr int kMostRounds = 50;
  constexpr std::size_t kFewQuestions = 64, kMoreQuestions = 8;
  Patches<Int>& patches = certified.patches;
  Questions questions;
  Hubs hubs;
  std::vector<GlobalNumber> found;                             // hubs, by any rank in this round
  const std::vector<GlobalNumber>* new_hubs = &division.hubs;  // not told to patches yet: these, or &found
  std::size_t most = kFewQuestions;
  const auto claim = [&] {  // true if patches have compared their claims
    std::vector<Doubts> of_patch(patches.of_rank.size());
    OnAny are_new, are_many;  // claims: to compare many takes less time than to ask about them
    const auto sum_up = [&] {
      questions = Questions(of_patch, division.patches, static_cast<std::size_t>(ranks.size()));
      for (const Doubts& doubts : of_patch) {
        are_new.value |= doubts.has_new_claims;
        are_many.value |= doubts.has_many_claims;
      }
    };
    in_agreement(
        ranks,
        [&] {
          hubs.insert(new_hubs->begin(), new_hubs->end());
          patches.for_each(threads, [&](Patch<Int>& patch, PatchHere k) {
            if (!new_hubs->empty()) patch.set_hubs(hubs);
            of_patch[k] = patch.claim(corners);
            patch.ask_about_claims(most, of_patch[k]);
          });
          sum_up();
        },
        questions.about_triangles, questions.about_arcs, questions.left_out, questions.have_grown, are_new,
        are_many);
    if (!are_new.value || !are_many.value) return false;
    const Parcels lists = exchange_claims(patches, division, ranks, threads);
    in_agreement(
        ranks,
        [&] {
          patches.for_each(threads, [&](Patch<Int>& patch, PatchHere k) {
            patch.settle(kept_by_others(patch.id(), lists));
            patch.ask_about_claims(most, of_patch[k]);
          });
          sum_up();
        },
        questions.about_triangles, questions.about_arcs, questions.left_out, questions.have_grown);
    return true;
  };
  const auto see_coincidence = [&] {
    // Patches may know different pairs of coincident nodes; the pair that is reported must not depend on
    // them.
    certified.gave_up = patches.see_coincidence.value;
    return certified.gave_up;
  };
  if (see_coincidence()) return;
  const bool have_compared = claim();
  // In the last round no question is left out and no patch takes in a node.
  bool is_last = !questions.about_triangles.value && !questions.about_arcs.value;
  certified.rounds += is_last && have_compared;
  while (!is_last) {
    certified.gave_up = ++certified.rounds > kMostRounds;
    if (certified.gave_up) return;
    const Parcels answers = answers_to(questions, patches, ranks, threads);
    found.clear();
    new_hubs = &found;
    OnAny has_found;
    in_agreement(
        ranks,
        [&] {
          learn(patches, questions, answers, threads);
          for (const Patch<Int>& patch : patches.of_rank)
            for (const GlobalNumber hub : patch.look_for_hubs()) found.push_back(hub);
          has_found.value = !found.empty();
        },
        patches.see_coincidence, has_found);
    if (see_coincidence()) return;
    if (has_found.value) found = gather_in_agreement(ranks, found);
    const bool was_complete = !questions.left_out.value;
    most = most > SIZE_MAX / kMoreQuestions ? most : most * kMoreQuestions;
    claim();
    is_last = was_complete && !questions.have_grown.value;
  }
  if (hubs.empty()) return;
  certified.has_hubs = true;
  const auto kept = kept_hubs(patches, ranks);
  // What steps 3 and 4 of the proof need: some patch keeps a triangle at each hub, and some node that all
  // patches know is no hub.
  certified.gave_up =
      kept.size() < hubs.size() || std::all_of(division.closing.begin(), division.closing.end(),
                                               [&](const Record& r) { return hubs.count(r.number) > 0; });
  in_agreement(ranks, [&] {
    for (const auto& [hub, triangles] : kept)
      if (triangles >= kManyTriangles) certified.hubs.push_back(hub);
  });
}

template void agree_on_stars(Certified<std::int32_t>&, const Division&, const Corners&, Communicator&, int);
template void agree_on_stars(Certified<std::int64_t>&, const Division&, const Corners&, Communicator&, int);

}  // namespace pstripack
