#pragma once
// Start nodes of TRMESH's searches. The original keeps, for every node i not yet inserted, a node NEAR(i):
// initially the nearest of nodes 1, 2, 3. When a node k is inserted that becomes a neighbour of NEAR(i) and
// is strictly nearer to i, NEAR(i) = k. The search for i begins at NEAR(i), which affects the slots that its
// neighbours get. So NEAR must equal the original's, even if other nodes are nearer.

#include <cstddef>

#include "base/workspace.h"
#include "stripack/expressions.h"
#include "stripack/original/insertion_lists.h"

namespace pstripack {

/// The nodes that wait for insertion, grouped by NEAR, with their coordinates: comparing them with new nodes
/// takes most of the time.
///
///     | of 1 |   | of 2 | | of 3 |  ...  | of k |         free         |
///
/// Nodes that move to a new NEAR are copied to the end; gaps are closed when the free part is used up, about
/// a dozen times in random order.
template <class Real, class Int>
class WaitingNodes {
 public:
  using Lists = InsertionLists<Real, Int>;

  /// For nodes 4..n, which are stored in `lists`; 1, 2 and 3 are inserted.
  WaitingNodes(Int n, const Lists& lists)
      : lists_(lists), item_(2 * index(n)), range_(index(n) + 1), near_(index(n) + 1) {
    std::size_t counts[4] = {};
    for (Int i = 4; i <= n; ++i) {
      const Vector<Real>& p = lists[i];
      const Real d1 = -dot(p, lists[1]), d2 = -dot(p, lists[2]), d3 = -dot(p, lists[3]);
      near_[index(i)] = d1 <= d2 && d1 <= d3 ? 1 : d2 <= d1 && d2 <= d3 ? 2 : 3;
      ++counts[near_[index(i)]];
    }
    for (std::size_t j = 1; j <= 3; ++j) {
      range_[j] = {end_, end_};
      end_ += counts[j];
    }
    for (Int i = 4; i <= n; ++i) item_[range_[index(near_[index(i)])].end++] = {lists[i], i};
  }

  Int near(Int i) const { return near_[index(i)]; }
  [[gnu::always_inline]] void prefetch(Int i) const {
    __builtin_prefetch(item_.data() + range_[index(near(i))].begin);
  }

  /// To be called after inserting node k, which no longer waits. Waiting nodes of k's neighbours that are
  /// nearer to k move to k.
  void compare_with(Int k) {
    make_room(k);
    const Vector<Real> p = lists_[k];
    Item* moving = item_.data() + end_;
    lists_.for_each_neighbour(k, [&](Int j) {
      Range& range = range_[index(j)];
      if (range.begin == range.end) return;
      const Vector<Real> q = lists_[j];
      Item *item = item_.data() + range.begin, *const last = item_.data() + range.end, *staying = item;
      for (; item != last; ++item) {
        const bool waits = item->node > k, is_nearer = dot(item->position, p) > dot(item->position, q);
        if (is_nearer) near_[index(item->node)] = k;
        // The destination of an item is unpredictable: write it to both places, without a branch.
        *moving = *item;
        moving += (waits & is_nearer) ? 1 : 0;
        *staying = *item;
        staying += (waits & !is_nearer) ? 1 : 0;
      }
      range.end = static_cast<std::size_t>(staying - item_.data());
    });
    const auto end = static_cast<std::size_t>(moving - item_.data());
    range_[index(k)] = {end_, end};
    end_ = end;
  }

 private:
  struct Item {
    Vector<Real> position;
    Int node;
  };
  struct Range {
    std::size_t begin, end;
  };

  static std::size_t index(Int node) { return static_cast<std::size_t>(node); }

  /// Room for all nodes that may move to k, plus one that is written but not counted.
  void make_room(Int k) {
    std::size_t most = 1;
    lists_.for_each_neighbour(k, [&](Int j) { most += range_[index(j)].end - range_[index(j)].begin; });
    if (end_ + most <= item_.size()) return;
    end_ = 0;
    for (Int j = 1; j < k; ++j) {
      Range& range = range_[index(j)];
      const std::size_t begin = end_;
      for (std::size_t i = range.begin; i < range.end; ++i)
        if (item_[i].node > k) item_[end_++] = item_[i];
      range = {begin, end_};
    }
  }

  const Lists& lists_;
  BlockArray<Item> item_;
  BlockArray<Range> range_;
  BlockArray<Int> near_;
  std::size_t end_ = 0;
};

}  // namespace pstripack
