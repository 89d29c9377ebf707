#include "parallel/relocation.h"

#include <algorithm>
#include <utility>

#include "parallel/agreement.h"
#include "parallel/number_table.h"
#include "parallel/ring_parcels.h"

namespace pstripack {

Relocation::Relocation(const std::int64_t* before, std::size_t had, const LocalNodes& nodes)
    : had_(had), from_(nodes.count), to_(had) {
  constexpr LastNode kNotHere = UINT32_MAX;
  std::fill(from_.begin(), from_.end(), kNotHere);
  std::fill(to_.begin(), to_.end(), kGone);
  const auto are_the_same = [&](std::size_t k, std::size_t i) {
    from_[i] = static_cast<LastNode>(k);
    to_[k] = static_cast<LocalNode>(i);
  };
  // Most nodes are in the order of the last call, with a few more or fewer between them, so each is searched
  // close behind the one before. After 16, 32, 64, ... misses in a row, the next one is searched to the end.
  // Nodes that are left are searched in a table.
  constexpr std::size_t kNear = 16;
  std::size_t next = 0, missed = 0;
  for (std::size_t i = 0; i < nodes.count; ++i) {
    const bool may_be_far = missed >= kNear && (missed & (missed - 1)) == 0;
    const std::size_t end = may_be_far ? had : std::min(had, next + kNear);
    const std::size_t k =
        static_cast<std::size_t>(std::find(before + next, before + end, value_of(nodes.number(i))) - before);
    if (k == end) {
      ++missed;
      continue;
    }
    are_the_same(k, i);
    next = k + 1;
    missed = 0;
  }
  const auto left = static_cast<std::size_t>(std::count(to_.begin(), to_.end(), kGone));
  NumberTable<LastNode> others(left);
  for (std::size_t k = 0; k < had; ++k)
    if (to_[k] == kGone) others.insert(GlobalNumber{before[k]}, static_cast<LastNode>(k));
  for (std::size_t i = 0; i < nodes.count; ++i) {
    if (from_[i] != kNotHere) continue;
    are_positive_ = are_positive_ && value_of(nodes.number(i)) > 0;
    const LastNode* const k = others.find_value(nodes.number(i));
    if (are_positive_ && k != nullptr && to_[*k] == kGone)
      are_the_same(*k, i);
    else
      from_[i] = static_cast<LastNode>(had_ + come_++);
  }
  for (std::size_t k = 0; k < had; ++k)
    if (to_[k] == kGone) gone_.push_back({GlobalNumber{before[k]}, static_cast<LastNode>(k), 0});
}

std::optional<Relocation> Relocation::find(const std::int64_t* before, std::size_t had,
                                           const LocalNodes& nodes, Communicator& ranks) {
  constexpr std::int64_t kFew = 8;  // one node in kFew may come from another rank
  std::int64_t counts[] = {static_cast<std::int64_t>(had), static_cast<std::int64_t>(nodes.count)};
  ranks.all_sum(counts, 2);
  if (counts[0] != counts[1]) return std::nullopt;
  std::optional<Relocation> found;
  OnAll are_positive;
  in_agreement(
      ranks,
      [&] {
        found.emplace(before, had, nodes);
        are_positive.value = found->are_positive_;
      },
      are_positive);
  if (!are_positive.value) return std::nullopt;
  auto gone = static_cast<std::int64_t>(found->gone_.size());
  ranks.all_sum(&gone, 1);  // as many have come
  if (gone > counts[0] / kFew || (gone > 0 && !found->find_ranks(nodes, ranks))) return std::nullopt;
  return found;
}

/// Whether every node that has gone has come elsewhere, and where. The ranks that had it and that bring it
/// now meet at a third.
bool Relocation::find_ranks(const LocalNodes& nodes, Communicator& ranks) {
  const auto size = static_cast<std::size_t>(ranks.size());
  const auto for_each_that_has_come = [&](const auto& visit) {
    for (std::size_t i = 0; i < nodes.count; ++i)
      if (has_come(i)) visit(nodes.number(i));
  };
  const Parcels told = exchange_in_agreement(ranks, [&] {  // numbers; negative: has gone
    ParcelWriter writer(size);
    const auto expect = [&](GlobalNumber number) { writer.expect<std::int64_t>(meeting_rank(number, size)); };
    for_each_that_has_come(expect);
    for (const Gone& g : gone_) expect(g.number);
    writer.make_room();
    for_each_that_has_come(
        [&](GlobalNumber number) { writer.put(meeting_rank(number, size), value_of(number)); });
    for (const Gone& g : gone_) writer.put(meeting_rank(g.number, size), -value_of(g.number));
    return writer.finish();
  });
  OnAll are_the_same;
  Parcels answers;
  std::vector<const RankOfNode*> next;
  in_agreement(
      ranks,
      [&] {
        NumberTable<RankOfNode> now(Items<std::int64_t>(told).size());
        for (RankNumber r = 0; r < size; ++r)
          for (const std::int64_t number : Items<std::int64_t>(told, r))
            if (number > 0) now.insert(GlobalNumber{number}, static_cast<RankOfNode>(r));
        std::vector<std::vector<RankOfNode>> rank_now(size);
        for (RankNumber r = 0; r < size; ++r)
          for (const std::int64_t number : Items<std::int64_t>(told, r)) {
            if (number > 0) continue;
            const RankOfNode* const at = now.find_value(GlobalNumber{-number});
            are_the_same.value = are_the_same.value && at != nullptr;
            rank_now[r].push_back(at != nullptr ? *at : 0);
          }
        answers = packed(rank_now);
        next.resize(size);
      },
      are_the_same);
  if (!are_the_same.value) return false;
  const Parcels answered = ranks.exchange(answers);
  for (RankNumber r = 0; r < size; ++r) next[r] = Items<RankOfNode>(answered, r).begin();
  for (Gone& g : gone_) g.rank = *next[meeting_rank(g.number, size)]++;
  return true;
}

template <class Int>
Stars<Int> Relocation::stars(const Stars<Int>& last, const LocalNodes& nodes, Communicator& ranks) const {
  const Parcels arrived = exchange_in_agreement(ranks, [&] {
    return packed_rings<Int>(static_cast<std::size_t>(ranks.size()), [&](const auto& visit) {
      for (const Gone& g : gone_) visit(g.rank, static_cast<Int>(value_of(g.number)), last.of_node[g.node]);
    });
  });
  Stars<Int> stars;
  in_agreement(ranks, [&] {
    // What the arrived stars name, what the last ones named, and what has gone: of that what is not here.
    std::vector<GlobalNumber> named;
    for (const Record& r : last.outside) named.push_back(r.number);
    for (const Gone& g : gone_) named.push_back(g.number);
    for_each_ring<Int>(arrived, [&](Int, const Ring<Int>& ring) {
      for (std::uint32_t k = 0; k < ring.count; ++k) named.push_back(named_by(ring.begin[k]));
    });
    NumberFilter filter(named.size());
    for (const GlobalNumber number : named) filter.add(number);
    std::vector<std::pair<GlobalNumber, LastNode>> found;
    for (std::size_t i = 0; i < nodes.count; ++i)
      if (const GlobalNumber number = nodes.number(i); has_come(i) || filter.may_have(number))
        found.emplace_back(number, from_[i]);
    NumberTable<LastNode> here(found.size());
    for (const auto& [number, from] : found) here.insert(number, from);
    for (const GlobalNumber number : named)
      if (here.find_value(number) == nullptr) stars.outside.push_back({{}, number});
    keep_one_of_each(stars.outside);

    std::vector<Ring<Int>> come(come_);
    for_each_ring<Int>(arrived, [&](Int number, const Ring<Int>& ring) {
      come[here.at(GlobalNumber{number}) - had_] = ring;
    });
    constexpr std::size_t kAhead = 16;
    auto outside = std::move(stars.outside);
    stars = copied_stars<Int>(nodes.count, [&](std::size_t i) {
      if (i + kAhead < nodes.count && !has_come(i + kAhead)) last.of_node.prefetch(from_[i + kAhead]);
      return has_come(i) ? come[from_[i] - had_] : last.of_node[from_[i]];
    });
    stars.outside = std::move(outside);
  });
  return stars;
}

template Stars<std::int32_t> Relocation::stars(const Stars<std::int32_t>&, const LocalNodes&,
                                               Communicator&) const;
template Stars<std::int64_t> Relocation::stars(const Stars<std::int64_t>&, const LocalNodes&,
                                               Communicator&) const;

}  // namespace pstripack
