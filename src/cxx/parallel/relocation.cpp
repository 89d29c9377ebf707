#include "parallel/relocation.h"

#include <algorithm>
#include <cstdlib>

#include "parallel/agreement.h"
#include "parallel/ring_parcels.h"

namespace pstripack {

Relocation::Relocation(const std::int64_t* before, std::size_t had, const LocalNodes& nodes)
    : had_(had), here_(nodes.count), from_(nodes.count), to_(had) {
  constexpr std::size_t kAhead = 16;
  for (std::size_t i = 0; i < nodes.count && are_distinct_; ++i) {
    if (i + kAhead < nodes.count) here_.prefetch(nodes.number(i + kAhead));
    const std::int64_t number = nodes.number(i);
    are_distinct_ = number > 0 && here_.insert(number, static_cast<std::uint32_t>(i)).second;
  }
  if (!are_distinct_) return;
  constexpr std::uint32_t kNotHere = UINT32_MAX;
  std::fill(from_.begin(), from_.end(), kNotHere);
  for (std::size_t k = 0; k < had; ++k) {
    if (k + kAhead < had) here_.prefetch(before[k + kAhead]);
    const std::uint32_t* const i = here_.find_value(before[k]);
    to_[k] = i != nullptr ? *i : SampleOfStars::kGone;
    if (i != nullptr)
      from_[*i] = static_cast<std::uint32_t>(k);
    else
      gone_.push_back({before[k], static_cast<std::uint32_t>(k), 0});
  }
  for (std::uint32_t& k : from_)
    if (k == kNotHere) k = static_cast<std::uint32_t>(had_ + come_++);
}

std::optional<Relocation> Relocation::find(const std::int64_t* before, std::size_t had,
                                           const LocalNodes& nodes, Communicator& ranks) {
  constexpr std::int64_t kFew = 8;  // one node of so many
  std::int64_t counts[] = {static_cast<std::int64_t>(had), static_cast<std::int64_t>(nodes.count)};
  ranks.all_sum(counts, 2);
  if (counts[0] != counts[1]) return std::nullopt;
  std::optional<Relocation> found;
  OnAll are_distinct;
  in_agreement(
      ranks,
      [&] {
        found.emplace(before, had, nodes);
        are_distinct.value = found->are_distinct_;
      },
      are_distinct);
  if (!are_distinct.value) return std::nullopt;
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
      if (from_[i] >= had_) visit(nodes.number(i));
  };
  const Parcels told = exchange_in_agreement(ranks, [&] {  // numbers; negative: has gone
    ParcelWriter writer(size);
    const auto expect = [&](std::int64_t number) { writer.expect<std::int64_t>(meeting_rank(number, size)); };
    for_each_that_has_come(expect);
    for (const Gone& g : gone_) expect(g.number);
    writer.make_room();
    for_each_that_has_come([&](std::int64_t number) { writer.put(meeting_rank(number, size), number); });
    for (const Gone& g : gone_) writer.put(meeting_rank(g.number, size), -g.number);
    return writer.finish();
  });
  OnAll are_the_same;
  Parcels answers;
  std::vector<const std::uint32_t*> next;
  in_agreement(
      ranks,
      [&] {
        NumberTable<std::uint32_t> now(Items<std::int64_t>(told).size());
        for (std::size_t r = 0; r < size; ++r)
          for (const std::int64_t number : Items<std::int64_t>(told, r))
            if (number > 0 && !now.insert(number, static_cast<std::uint32_t>(r)).second)
              are_the_same.value = false;
        std::vector<std::vector<std::uint32_t>> rank_now(size);
        for (std::size_t r = 0; r < size; ++r)
          for (const std::int64_t number : Items<std::int64_t>(told, r)) {
            if (number > 0) continue;
            const std::uint32_t* const at = now.find_value(-number);
            are_the_same.value = are_the_same.value && at != nullptr;
            rank_now[r].push_back(at != nullptr ? *at : 0);
          }
        answers = packed(rank_now);
        next.resize(size);
      },
      are_the_same);
  if (!are_the_same.value) return false;
  const Parcels answered = ranks.exchange(answers);
  for (std::size_t r = 0; r < size; ++r) next[r] = Items<std::uint32_t>(answered, r).begin();
  for (Gone& g : gone_) g.rank = *next[meeting_rank(g.number, size)]++;
  return true;
}

template <class Int>
Stars<Int> Relocation::stars(const Stars<Int>& last, Communicator& ranks) const {
  const Parcels arrived = exchange_in_agreement(ranks, [&] {
    return packed_rings<Int>(static_cast<std::size_t>(ranks.size()), [&](const auto& visit) {
      for (const Gone& g : gone_) visit(g.rank, static_cast<Int>(g.number), last.of_node[g.node]);
    });
  });
  Stars<Int> stars;
  in_agreement(ranks, [&] {
    std::vector<Ring<Int>> come(come_);
    // What these name, what the last stars named, and what has gone: of that the nodes that are not here.
    std::vector<Record> outside;
    const auto add = [&](std::int64_t number) {
      if (here_.find_value(number) == nullptr) outside.push_back({{}, number});
    };
    for (const Record& r : last.outside) add(r.number);
    for (const Gone& g : gone_) add(g.number);
    for_each_ring<Int>(arrived, [&](Int number, const Ring<Int>& ring) {
      come[from_[here_.at(number)] - had_] = ring;
      for (std::uint32_t k = 0; k < ring.count; ++k) add(std::abs(ring.begin[k]));
    });
    keep_one_of_each(outside);
    constexpr std::size_t kAhead = 16;
    stars = copied_stars<Int>(from_.size(), [&](std::size_t i) {
      if (i + kAhead < from_.size() && from_[i + kAhead] < had_) last.of_node.prefetch(from_[i + kAhead]);
      return from_[i] < had_ ? last.of_node[from_[i]] : come[from_[i] - had_];
    });
    stars.outside = std::move(outside);
  });
  return stars;
}

template Stars<std::int32_t> Relocation::stars(const Stars<std::int32_t>&, Communicator&) const;
template Stars<std::int64_t> Relocation::stars(const Stars<std::int64_t>&, Communicator&) const;

}  // namespace pstripack
