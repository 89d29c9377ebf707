#include "parallel/certify.h"

#include <utility>

namespace pstripack {
namespace {

/// Of all patches.
template <class Int>
CoincidentPairs all_coincident(const Patches<Int>& patches, Communicator& ranks) {
  CoincidentPairs pairs;
  if (!patches.see_coincidence.value) return pairs;
  in_agreement(ranks, [&] {
    for (const Patch<Int>& patch : patches.of_rank)
      pairs.insert(pairs.end(), patch.coincident().begin(), patch.coincident().end());
  });
  const Parcels all = ranks.all_gather(pairs.data(), pairs.size() * sizeof(pairs[0]));
  in_agreement(ranks, [&] {
    const Items<CoincidentPairs::value_type> items(all);
    pairs.assign(items.begin(), items.end());
  });
  return pairs;
}

/// The boundary of all nodes, if any patch has own nodes on what it takes for it. A patch that surrounds the
/// centre shows that there is none; if no patch does, all nodes lie inside what the patches see.
template <class Int>
Boundary find_boundary(Patches<Int>& patches, const Division& division, const Corners& corners,
                       Communicator& ranks) {
  Boundary boundary;
  std::vector<Record> nodes = std::move(patches.outline);
  if (!patches.have_own_on_outline.value) return boundary;
  const bool there_is_none = patches.surrounding.exists();
  in_agreement(ranks, [&] {
    if (!there_is_none) return;
    nodes.clear();
    for (const Patch<Int>& patch : patches.of_rank)
      if (patch.id() == patches.surrounding.value) nodes = patch.nodes_around_centre();
  });
  const Parcels all = ranks.all_gather(nodes.data(), nodes.size() * sizeof(Record));
  in_agreement(ranks, [&] {
    const Items<Record> items(all);
    nodes.assign(items.begin(), items.end());
    nodes.insert(nodes.end(), corners.begin(), corners.end());
    keep_one_of_each(nodes);
    boundary = there_is_none ? Boundary::none(std::move(nodes))
                             : Boundary(std::move(nodes), division.places.lengths());
  });
  return boundary;
}

/// What the patches here want to know.
struct Questions {
  std::vector<std::vector<Question>> to_rank;
  std::size_t count = 0;
  OnAny exist;  ///< here, or on all ranks once these have agreed
};

template <class Int>
Questions ask(Patches<Int>& patches, const Boundary& boundary, const Division& division, std::size_t ranks,
              int threads) {
  Questions questions;
  questions.to_rank.resize(ranks);
  std::vector<std::vector<Question>> of_patch(patches.of_rank.size());
  patches.for_each(threads, [&](Patch<Int>& patch, std::size_t k) {
    patch.ask(boundary, division.most_stretch, of_patch[k]);
  });
  for (const auto& list : of_patch)
    for (const Question& q : list) {
      questions.to_rank[division.patches.rank_of(q.to)].push_back(q);
      ++questions.count;
    }
  questions.exist.value = questions.count > 0;
  return questions;
}

/// The answers to the questions of each rank, in their order: a count, then nodes.
template <class Int>
Parcels answers(Patches<Int>& patches, const Parcels& incoming, int threads) {
  const Items<Question> questions(incoming);
  std::vector<std::vector<Record>> answer(questions.size());
  patches.for_each(threads, [&](Patch<Int>& patch, std::size_t) {
    std::size_t k = 0;
    for (const Question& question : questions) {
      if (question.to == patch.id()) patch.answer(question, answer[k]);
      ++k;
    }
  });
  const std::size_t ranks = incoming.begin.size() - 1;
  const auto for_each_answer = [&](const auto& visit) {
    std::size_t k = 0;
    for (std::size_t r = 0; r < ranks; ++r)
      for (std::size_t n = Items<Question>(incoming, r).size(); n > 0; --n) visit(r, answer[k++]);
  };
  ParcelWriter writer(ranks);
  for_each_answer([&](std::size_t r, const std::vector<Record>& nodes) {
    writer.expect<std::int64_t>(r);
    writer.expect<Record>(r, nodes.size());
  });
  writer.make_room();
  for_each_answer([&](std::size_t r, const std::vector<Record>& nodes) {
    writer.put(r, static_cast<std::int64_t>(nodes.size()));
    std::copy(nodes.begin(), nodes.end(), writer.room<Record>(r, nodes.size()));
  });
  return writer.finish();
}

template <class Int>
void learn(Patches<Int>& patches, const Questions& questions, const Parcels& replies, int threads) {
  struct Answer {
    const Record* nodes;
    std::size_t count;
  };
  std::vector<std::vector<Answer>> of_patch(patches.of_rank.size());
  for (std::size_t r = 0; r < questions.to_rank.size(); ++r) {
    ParcelReader reader(replies, r);
    for (const Question& q : questions.to_rank[r]) {
      const auto n = static_cast<std::size_t>(reader.next<std::int64_t>());
      of_patch[static_cast<std::size_t>(q.from - patches.of_rank[0].id())].push_back(
          {reader.array<Record>(n), n});
    }
  }
  patches.for_each(threads, [&](Patch<Int>& patch, std::size_t k) {
    for (const Answer& a : of_patch[k]) patch.learn(a.nodes, a.count);
  });
  for (const Patch<Int>& patch : patches.of_rank)
    if (!patch.coincident().empty()) patches.see_coincidence.value = true;
}

}  // namespace

template <class Int>
Certified<Int> certify(Patches<Int> found, const Division& division, const Corners& corners,
                       Communicator& ranks, const ParallelOptions& options) {
  Certified<Int> certified(std::move(found));
  Patches<Int>& patches = certified.patches;
  const bool is_single = ranks.size() == 1;
  certified.coincident = all_coincident(patches, ranks);
  if (!certified.coincident.empty()) return certified;
  certified.gave_up = is_single && patches.outline.size() > options.most_questions;
  if (certified.gave_up) return certified;

  const Boundary boundary = find_boundary(patches, division, corners, ranks);
  Questions questions;
  const auto ask_all = [&] {
    questions = ask(patches, boundary, division, static_cast<std::size_t>(ranks.size()), options.threads);
    certified.gave_up = is_single && questions.count > options.most_questions;
  };
  in_agreement(ranks, ask_all, questions.exist);
  while (certified.is_done() && questions.exist.value) {
    ++certified.rounds;
    const Parcels incoming = exchange_in_agreement(ranks, [&] { return packed(questions.to_rank); });
    const Parcels replies =
        exchange_in_agreement(ranks, [&] { return answers(patches, incoming, options.threads); });
    in_agreement(
        ranks,
        [&] {
          learn(patches, questions, replies, options.threads);
          questions = {};
          // Patches that came upon nodes which coincide have no more questions.
          if (!patches.see_coincidence.value) ask_all();
        },
        patches.see_coincidence, questions.exist);
    certified.coincident = all_coincident(patches, ranks);
  }
  return certified;
}

template Certified<std::int32_t> certify(Patches<std::int32_t>, const Division&, const Corners&,
                                         Communicator&, const ParallelOptions&);
template Certified<std::int64_t> certify(Patches<std::int64_t>, const Division&, const Corners&,
                                         Communicator&, const ParallelOptions&);

}  // namespace pstripack
