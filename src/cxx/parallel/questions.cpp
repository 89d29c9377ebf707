#include "parallel/questions.h"

#include <algorithm>
#include <cassert>
#include <utility>

namespace pstripack {
namespace {

/// The answers to the questions of each rank, in their order: a count, then nodes.
template <class Int>
Parcels packed_answers(Patches<Int>& patches, const Parcels& incoming, int threads) {
  const Items<Question> questions(incoming);
  std::vector<std::vector<Record>> answer(questions.size());
  patches.for_each(threads, [&](Patch<Int>& patch, PatchHere) {
    std::vector<Record> corners;
    for (const Question& question : questions)
      if (question.to == patch.id()) corners.insert(corners.end(), question.corner, question.corner + 3);
    [[maybe_unused]] const std::size_t before = patch.known();
    patch.take_in(std::move(corners));
    std::size_t k = 0;
    for (const Question& question : questions) {
      if (question.to == patch.id()) {
        answer[k] = patch.answer(question);
        // So each round adds nodes to a hull.
        assert(!answer[k].empty() || patch.known() > before || !patch.coincident().empty());
      }
      ++k;
    }
  });
  const std::size_t ranks = incoming.begin.size() - 1;
  const auto for_each_answer = [&](const auto& visit) {
    std::size_t k = 0;
    for (RankNumber r = 0; r < ranks; ++r)
      for (std::size_t n = Items<Question>(incoming, r).size(); n > 0; --n) visit(r, answer[k++]);
  };
  ParcelWriter writer(ranks);
  for_each_answer([&](RankNumber r, const std::vector<Record>& nodes) {
    writer.expect<std::int64_t>(r);
    writer.expect<Record>(r, nodes.size());
  });
  writer.make_room();
  for_each_answer([&](RankNumber r, const std::vector<Record>& nodes) {
    writer.put(r, static_cast<std::int64_t>(nodes.size()));
    std::copy(nodes.begin(), nodes.end(), writer.room<Record>(r, nodes.size()));
  });
  return writer.finish();
}

}  // namespace

Questions::Questions(const std::vector<std::vector<Question>>& of_patches, const PatchRanges& patches)
    : to_rank(patches.ranks()) {
  for (const std::vector<Question>& questions : of_patches) {
    for (const Question& q : questions) to_rank[patches.rank_of(q.to)].push_back(q);
    count += questions.size();
  }
  exist.value = count > 0;
}

template <class Int>
Parcels answers_to(const Questions& questions, Patches<Int>& patches, Communicator& ranks, int threads) {
  const Parcels incoming = exchange_in_agreement(ranks, [&] { return packed(questions.to_rank); });
  return exchange_in_agreement(ranks, [&] { return packed_answers(patches, incoming, threads); });
}

template <class Int>
void learn(Patches<Int>& patches, const Questions& questions, const Parcels& answers, int threads) {
  std::vector<std::vector<Record>> of_patch(patches.of_rank.size());
  for (RankNumber r = 0; r < questions.to_rank.size(); ++r) {
    ParcelReader reader(answers, r);
    for (const Question& q : questions.to_rank[r]) {
      const auto n = static_cast<std::size_t>(reader.next<std::int64_t>());
      const Record* const nodes = reader.array<Record>(n);
      std::vector<Record>& all = of_patch[static_cast<PatchHere>(q.from - patches.of_rank[0].id())];
      all.insert(all.end(), nodes, nodes + n);
    }
  }
  patches.for_each(threads, [&](Patch<Int>& patch, PatchHere k) { patch.take_in(std::move(of_patch[k])); });
  for (const Patch<Int>& patch : patches.of_rank)
    if (!patch.coincident().empty()) patches.see_coincidence.value = true;
}

template Parcels answers_to(const Questions&, Patches<std::int32_t>&, Communicator&, int);
template Parcels answers_to(const Questions&, Patches<std::int64_t>&, Communicator&, int);
template void learn(Patches<std::int32_t>&, const Questions&, const Parcels&, int);
template void learn(Patches<std::int64_t>&, const Questions&, const Parcels&, int);

}  // namespace pstripack
