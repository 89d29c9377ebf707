#include "parallel/relocation.h"

#include <algorithm>
#include <numeric>

#include "parallel/agreement.h"
#include "parallel/halo.h"
#include "parallel/ring_parcels.h"

namespace pstripack {

Relocation::Relocation(const std::int64_t* before, const NodeRanges& last, const NodeRanges& now,
                       RankNumber me, const LocalNodes& nodes)
    : last_(last), now_(now), me_(me), had_(last.count(me)), from_(nodes.count), to_(had_) {
  constexpr LastNode kNotHere = UINT32_MAX;
  const std::size_t had = had_;
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
    // A table has no key 0. A number that is not positive was not here.
    const LastNode* const k = value_of(nodes.number(i)) > 0 ? others.find(nodes.number(i)) : nullptr;
    if (k != nullptr && to_[*k] == kGone)
      are_the_same(*k, i);
    else
      from_[i] = static_cast<LastNode>(had_ + come_++);
  }
  for (std::size_t k = 0; k < had; ++k)
    if (to_[k] == kGone) gone_.push_back({GlobalNumber{before[k]}, static_cast<LastNode>(k), kNoNumber});
}

std::optional<Relocation> Relocation::find(const std::int64_t* before, const NodeRanges& ranges,
                                           const LocalNodes& nodes, Communicator& ranks) {
  constexpr std::int64_t kFew = 8;  // one node in kFew may come from another rank
  const auto size = static_cast<std::size_t>(ranks.size());
  const std::int64_t* const counts = ranks.all_gather_one(static_cast<std::int64_t>(nodes.count));
  if (std::accumulate(counts, counts + size, std::int64_t{0}) != ranges.nodes()) return std::nullopt;
  std::optional<Relocation> found;
  in_agreement(ranks, [&] {
    found.emplace(before, ranges, NodeRanges(counts, size), static_cast<RankNumber>(ranks.rank()), nodes);
  });
  auto gone = static_cast<std::int64_t>(found->gone_.size());
  ranks.all_sum(&gone, 1);  // as many have come
  if (gone > ranges.nodes() / kFew || (gone > 0 && !found->find_addresses(nodes, ranks))) return std::nullopt;
  return found;
}

/// Whether every node that has gone has come elsewhere, and where. The ranks that had it and that bring it
/// now meet at a third.
bool Relocation::find_addresses(const LocalNodes& nodes, Communicator& ranks) {
  struct Said {
    GlobalNumber number, now;  // now: counted where it has come; kNoNumber where it has gone
  };
  const auto size = static_cast<std::size_t>(ranks.size());
  const Parcels told = exchange_in_agreement(ranks, [&] {
    std::vector<std::vector<Said>> to(size);
    const auto tell = [&](const Said& said) { to[meeting_rank(said.number, size)].push_back(said); };
    for (std::size_t i = 0; i < nodes.count; ++i)
      if (has_come(i))
        tell({nodes.number(i), now_.number({static_cast<RankOfNode>(me_), static_cast<LocalNode>(i)})});
    for (const Gone& g : gone_) tell({g.number, kNoNumber});
    return packed(to);
  });
  OnAll are_the_same;
  Parcels answers;
  std::vector<const GlobalNumber*> next;
  in_agreement(
      ranks,
      [&] {
        const Items<Said> all(told);
        NumberTable<GlobalNumber> come(all.size());
        for (const Said& said : all)
          if (said.now != kNoNumber) come.insert(said.number, said.now);
        std::vector<std::vector<GlobalNumber>> now(size);
        for (RankNumber r = 0; r < size; ++r)
          for (const Said& said : Items<Said>(told, r)) {
            if (said.now != kNoNumber) continue;
            const GlobalNumber* const at = come.find(said.number);
            are_the_same.value = are_the_same.value && at != nullptr;
            now[r].push_back(at != nullptr ? *at : kNoNumber);
          }
        answers = packed(now);
        next.resize(size);
      },
      are_the_same);
  if (!are_the_same.value) return false;
  const Parcels answered = ranks.exchange(answers);
  for (RankNumber r = 0; r < size; ++r) next[r] = Items<GlobalNumber>(answered, r).begin();
  for (Gone& g : gone_) g.now = *next[meeting_rank(g.number, size)]++;
  return true;
}

GlobalNumber Relocation::now(LastNode k) const {
  if (to_[k] != kGone) return now_.number({static_cast<RankOfNode>(me_), to_[k]});
  return std::lower_bound(gone_.begin(), gone_.end(), k,
                          [](const Gone& g, LastNode node) { return g.node < node; })
      ->now;
}

GlobalNumber Relocation::now(GlobalNumber counted) const {
  if (last_.is_of(me_, counted)) return now(static_cast<LastNode>(value_of(counted) - last_.first(me_)));
  const GlobalNumber* const found = outside_now_.find(counted);
  return found != nullptr ? *found : kNoNumber;
}

template <class Int>
Stars<Int> Relocation::stars(const Stars<Int>& last, const LocalNodes& nodes, Communicator& ranks) {
  in_agreement(ranks, [&] { outside_now_ = NumberTable<GlobalNumber>(last.outside.size()); });
  last.halo.template fetch<GlobalNumber>(
      ranks, [&](LocalNode k) { return now(LastNode{k}); },
      [&](OutsideNode j, GlobalNumber now) { outside_now_.insert(last.outside[index_of(j)].counted, now); });
  const auto renamed = [&](Int entry) {
    const auto number = static_cast<Int>(now(named_by(entry)));
    return entry < 0 ? -number : number;
  };
  const Parcels arrived = exchange_in_agreement(ranks, [&] {
    return packed_rings<Int>(static_cast<std::size_t>(ranks.size()), [&](const auto& visit) {
      for (const Gone& g : gone_) {
        const Ring<Int> ring = last.of_node[g.node];
        visit(now_.address(g.now).rank, value_of(g.now), ring.count,
              [&](Int* to) { std::transform(ring.begin, ring.begin + ring.count, to, renamed); });
      }
    });
  });
  Stars<Int> stars;
  in_agreement(ranks, [&] {
    std::vector<Ring<Int>> come(come_);
    for_each_ring<Int>(arrived, [&](Int number, const Ring<Int>& ring) {
      come[from_[now_.address(GlobalNumber{number}).node] - had_] = ring;
    });
    NamedOutside<Int> outside(GlobalNumber{now_.first(me_)}, nodes.count);
    constexpr std::size_t kAhead = 16;
    stars = copied_stars<Int>(
        nodes.count,
        [&](std::size_t i) {
          if (i + kAhead < nodes.count && !has_come(i + kAhead)) last.of_node.prefetch(from_[i + kAhead]);
          return has_come(i) ? come[from_[i] - had_] : last.of_node[from_[i]];
        },
        [&](std::size_t i, Int entry) {
          const Int now = has_come(i) ? entry : renamed(entry);
          outside.add(now);
          return now;
        });
    stars.outside = outside.nodes();
  });
  stars.halo = fetch_halo(stars.outside, nodes, now_, ranks);
  return stars;
}

template Stars<std::int32_t> Relocation::stars(const Stars<std::int32_t>&, const LocalNodes&, Communicator&);
template Stars<std::int64_t> Relocation::stars(const Stars<std::int64_t>&, const LocalNodes&, Communicator&);

}  // namespace pstripack
