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

/// What the patches here want to know.
struct Questions {
  std::vector<std::vector<Question>> to_rank;
  std::size_t count = 0;
  // Here, or on any rank once these have agreed:
  OnAny about_triangles, about_arcs;
  OnAny have_grown;  ///< patches have taken in nodes since they asked last
  OnAny too_many;    ///< one hull of all nodes would take less time

  /// If not, every star is final; questions about arcs alone end where nobody learns from them.
  bool must_be_asked() const { return about_triangles.value || (about_arcs.value && have_grown.value); }
};

template <class Int>
Questions ask(Patches<Int>& patches, const Corners& corners, const Division& division, std::size_t ranks,
              std::size_t most, int threads) {
  Questions questions;
  questions.to_rank.resize(ranks);
  std::vector<Doubts> of_patch(patches.of_rank.size());
  patches.for_each(threads, [&](Patch<Int>& patch, std::size_t k) {
    of_patch[k] = patch.ask(corners, division.most_stretch, most);
  });
  for (const Doubts& doubts : of_patch) {
    for (const Question& q : doubts.questions) questions.to_rank[division.patches.rank_of(q.to)].push_back(q);
    questions.count += doubts.questions.size();
    questions.about_triangles.value |= doubts.questions.size() > doubts.arcs;
    questions.about_arcs.value |= doubts.arcs > 0;
    questions.have_grown.value |= doubts.has_grown;
  }
  questions.too_many.value = questions.count > most;
  return questions;
}

/// A question takes both ranks as long as a node or two in a hull, and those who answer take in its corners.
template <class Int>
std::size_t most_of_a_rank(const Patches<Int>& patches, const Division& division) {
  constexpr std::size_t kMostInAPatch = std::size_t{1} << 28, kFew = 1000;
  if (division.nodes > kMostInAPatch) return SIZE_MAX;
  std::size_t own = 0;
  for (const Patch<Int>& patch : patches.of_rank) own += patch.own();
  return 4 * own + kFew;
}

/// The answers to the questions of each rank, in their order: a count, then nodes.
template <class Int>
Parcels answers(Patches<Int>& patches, const Parcels& incoming, int threads) {
  const Items<Question> questions(incoming);
  std::vector<std::vector<Record>> answer(questions.size());
  patches.for_each(threads, [&](Patch<Int>& patch, std::size_t) {
    std::size_t k = 0;
    for (const Question& question : questions) {
      if (question.to == patch.id()) answer[k] = patch.answer(question);
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
  const std::size_t most = ranks.size() == 1 ? options.most_questions : most_of_a_rank(patches, division);
  certified.coincident = all_coincident(patches, ranks);
  if (!certified.coincident.empty()) return certified;

  Questions questions;
  const auto ask_all = [&] {
    questions =
        ask(patches, corners, division, static_cast<std::size_t>(ranks.size()), most, options.threads);
  };
  in_agreement(ranks, ask_all, questions.about_triangles, questions.about_arcs, questions.have_grown,
               questions.too_many);
  certified.gave_up = questions.too_many.value;
  while (certified.is_done() && questions.must_be_asked()) {
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
        patches.see_coincidence, questions.about_triangles, questions.about_arcs, questions.have_grown,
        questions.too_many);
    certified.gave_up = questions.too_many.value;
    certified.coincident = all_coincident(patches, ranks);
  }
  return certified;
}

template Certified<std::int32_t> certify(Patches<std::int32_t>, const Division&, const Corners&,
                                         Communicator&, const ParallelOptions&);
template Certified<std::int64_t> certify(Patches<std::int64_t>, const Division&, const Corners&,
                                         Communicator&, const ParallelOptions&);

}  // namespace pstripack
