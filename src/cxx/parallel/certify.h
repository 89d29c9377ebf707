#pragma once
// The fourth phase: patches compare lists of the triangles that two of them answer for, until all match.
// docs/internals/parallel.md.

#include <algorithm>
#include <cassert>
#include <utility>
#include <vector>

#include "parallel/coincidence.h"
#include "parallel/divide.h"
#include "parallel/patches.h"

namespace pstripack {

/// Finished patches, in which the star of every own node is the star in the triangulation of all nodes,
/// unless nodes coincide.
template <class Int>
struct Certified {
  Patches<Int> patches;
  CoincidentPairs coincident;  ///< found by any patch; the same on every rank
};

/// The coincident pairs that the patches of all ranks have found.
template <class Int>
CoincidentPairs all_coincident(const Patches<Int>& patches, Communicator& ranks) {
  CoincidentPairs pairs;
  if (!patches.see_coincidence.value) return pairs;
  in_agreement(ranks, [&] {
    for (const Patch<Int>& patch : patches.of_rank)
      pairs.insert(pairs.end(), patch.coincident().begin(), patch.coincident().end());
  });
  const Parcels all = ranks.all_gather(pairs.data(), pairs.size() * sizeof pairs[0]);
  const Items<CoincidentPairs::value_type> of_all(all);
  in_agreement(ranks, [&] { pairs.assign(of_all.begin(), of_all.end()); });
  return pairs;
}

/// Largest number of triangles of a rank that other patches lack. If these are most, one hull of all nodes
/// takes less time: each costs both patches the time of inserting two or three nodes.
template <class Int>
std::size_t most_lacking(const Patches<Int>& patches, const ParallelOptions& options, int ranks) {
  constexpr std::size_t kFew = 1000;
  if (ranks == 1) return options.most_questions;  // the caller knows what one hull costs
  std::size_t own = 0;
  for (const Patch<Int>& patch : patches.of_rank) own += patch.own();
  return std::min(options.most_questions, own / 4 * 3 + kFew);
}

// ---- lists ------------------------------------------------------------------------------------------

/// The lists of all patches here.
template <class Int>
Parcels packed_lists(const Patches<Int>& patches, const PatchRanges& of_ranks) {
  std::vector<std::vector<SentTriangle<Int>>> to_rank(of_ranks.ranks());
  for (const Patch<Int>& patch : patches.of_rank)
    patch.for_each_listed([&](const SentTriangle<Int>& t) { to_rank[of_ranks.rank_of(t.to)].push_back(t); });
  return packed(to_rank);
}

// ---- questions and answers --------------------------------------------------------------------------

/// A node of an answer, on its way to the patch that has asked.
struct Answer {
  SentNode node;
  PatchNumber to;
};

/// The answers to these questions. Patches take in the corners of all questions before they answer any.
template <class Int>
Parcels packed_answers(Patches<Int>& patches, const Parcels& asked, const PatchRanges& of_ranks,
                       int threads) {
  const Items<Question> questions(asked);
  std::vector<std::vector<Answer>> of_patch(patches.of_rank.size());
  patches.for_each(threads, [&](Patch<Int>& patch, PatchHere here) {
    std::vector<SentNode> corners;
    for (const Question& question : questions)
      if (question.to == patch.id()) corners.insert(corners.end(), question.corner, question.corner + 3);
    [[maybe_unused]] const std::size_t before = patch.known();
    patch.take_in(std::move(corners));
    for (const Question& question : questions) {
      if (question.to != patch.id()) continue;
      const std::vector<SentNode> nodes = patch.answer(question);
      // So each round adds nodes to a hull.
      assert(!nodes.empty() || patch.known() > before || !patch.coincident().empty());
      for (const SentNode& node : nodes) of_patch[here].push_back({node, question.from});
    }
  });
  std::vector<std::vector<Answer>> to_rank(of_ranks.ranks());
  for (const std::vector<Answer>& answers : of_patch)
    for (const Answer& answer : answers) to_rank[of_ranks.rank_of(answer.to)].push_back(answer);
  return packed(to_rank);
}

/// The patches here take in the answers.
template <class Int>
void learn(Patches<Int>& patches, const Parcels& answers, int threads) {
  std::vector<std::vector<SentNode>> of_patch(patches.of_rank.size());
  for (const Answer& answer : Items<Answer>(answers))
    of_patch[static_cast<PatchHere>(answer.to - patches.of_rank[0].id())].push_back(answer.node);
  patches.for_each(threads, [&](Patch<Int>& patch, PatchHere k) { patch.take_in(std::move(of_patch[k])); });
  patches.look_for_coincidence();
}

/// `rounds`: how often lists did not match is added to it. Collective. Throws AgreedFailure, HiddenNode or
/// PatchesDoNotPay.
template <class Int>
Certified<Int> certify(Patches<Int> patches, const Division& division, Communicator& ranks,
                       const ParallelOptions& options, int& rounds) {
  constexpr int kMostRounds = 50;
  const int threads = options.threads;
  CoincidentPairs coincident = all_coincident(patches, ranks);
  if (!coincident.empty()) return {std::move(patches), std::move(coincident)};

  const std::size_t most = most_lacking(patches, options, ranks.size());
  Parcels answers;
  for (int round = 0;; ++round, ++rounds) {
    const Parcels lists = exchange_in_agreement(ranks, [&] {
      if (round > 0) learn(patches, answers, threads);
      patches.for_each(threads, [](Patch<Int>& patch, PatchHere) { patch.update_lists(); });
      return packed_lists(patches, division.patches);
    });
    std::vector<std::vector<Question>> questions;  // to each rank
    OnAny exist;
    in_agreement(
        ranks,
        [&] {
          questions.resize(division.patches.ranks());
          const Items<SentTriangle<Int>> of_others(lists);
          std::vector<std::vector<Question>> of_patch(patches.of_rank.size());
          patches.for_each(threads,
                           [&](Patch<Int>& patch, PatchHere k) { of_patch[k] = patch.lacking(of_others); });
          std::size_t count = 0;
          for (const std::vector<Question>& some : of_patch) {
            for (const Question& q : some) questions[division.patches.rank_of(q.to)].push_back(q);
            count += some.size();
          }
          if (count > (round < kMostRounds ? most : 0)) throw PatchesDoNotPay{};
          exist.value = count > 0;
        },
        patches.see_coincidence, exist);
    // Patches may know different pairs of nodes that coincide; the pair that is reported must not depend on
    // them.
    // Nodes in one direction are in the same margins, so patches see them before the first lists.
    if (patches.see_coincidence.value) throw PatchesDoNotPay{};
    if (!exist.value) break;  // every list has matched, and no hull has grown since: the hulls agree
    const Parcels asked = exchange_in_agreement(ranks, [&] { return packed(questions); });
    answers = exchange_in_agreement(
        ranks, [&] { return packed_answers(patches, asked, division.patches, threads); });
  }
  in_agreement(ranks,
               [&] { patches.for_each(threads, [](Patch<Int>& patch, PatchHere) { patch.finish(); }); });
  return {std::move(patches), {}};
}

}  // namespace pstripack
