#pragma once
// Start nodes of TRMESH's searches. The original keeps, for every node i not yet inserted, a node NEAR(i):
// initially the nearest of nodes 1, 2, 3. When a node k is inserted that becomes a neighbour of NEAR(i) and
// is strictly nearer to i, NEAR(i) = k. The search for i begins at NEAR(i), which affects the slots that its
// neighbours get. So NEAR must equal the original's, even if other nodes are nearer.

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "base/workspace.h"
#include "stripack/expressions.h"
#include "stripack/original/insertion_lists.h"

namespace pstripack {

/// Method to find NEAR(i). All give the same values.
enum class StartSearch {
  adaptive,    ///< simulated, until that is clearly slower than it is for random order; then by_location
  simulated,   ///< by the original's bookkeeping
  by_location  ///< by location in the triangulation, for those nodes for which it is safe
};

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
  std::int64_t comparisons() const { return comparisons_; }

  /// To be called after inserting node k, which no longer waits. Waiting nodes of k's neighbours that are
  /// nearer to k move to k. Returns the largest cosine of their distances from k; -2 if there are none.
  Real compare_with(Int k) {
    make_room(k);
    const Vector<Real> p = lists_[k];
    Item* moving = item_.data() + end_;
    Real largest = -2;
    lists_.for_each_neighbour(k, [&](Int j) {
      Range& range = range_[index(j)];
      if (range.begin == range.end) return;
      const Vector<Real> q = lists_[j];
      comparisons_ += static_cast<std::int64_t>(range.end - range.begin);
      Item *item = item_.data() + range.begin, *const last = item_.data() + range.end, *staying = item;
      for (; item != last; ++item) {
        const Real to_k = dot(item->position, p);
        const bool waits = item->node > k, is_nearer = to_k > dot(item->position, q);
        if (is_nearer) near_[index(item->node)] = k;
        largest = is_nearer && to_k > largest ? to_k : largest;
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
    return largest;
  }

  /// Forgets those nodes i at p with NEAR(i) = j for which is_settled(i, p, j).
  template <class IsSettled>
  void forget(Int j, const IsSettled& is_settled) {
    Range& range = range_[index(j)];
    for (std::size_t i = range.begin; i < range.end;) {
      Item& item = item_[i];
      if (is_settled(item.node, item.position, j))
        item = item_[--range.end];
      else
        ++i;
    }
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
  std::int64_t comparisons_ = 0;
};

/// Finds an inserted node near a point: grids from coarse to fine on the faces of a cube hold one node per
/// cell.
template <class Int>
class NodeGrid {
 public:
  explicit NodeGrid(Int n) {
    while ((std::int64_t{6} << (2 * levels_)) < n) ++levels_;
    std::size_t cells = 0;
    for (int level = 0; level < levels_; ++level) cells += begin_[level + 1] = std::size_t{6} << (2 * level);
    for (int level = 0; level < levels_; ++level) begin_[level + 1] += begin_[level];
    node_ = BlockArray<Int>(cells);
    std::fill(node_.begin(), node_.end(), 0);
  }

  template <class Real>
  void insert(Int node, const Vector<Real>& p) {
    const Cell cell = cell_of(p);
    for (int level = 0; level < levels_; ++level) node_[place(cell, level)] = node;
  }
  /// The last node of the smallest non-empty cell around p; node 1 if there is none.
  template <class Real>
  Int near(const Vector<Real>& p) const {
    const Cell cell = cell_of(p);
    for (int level = levels_ - 1; level >= 0; --level)
      if (const Int node = node_[place(cell, level)]) return node;
    return 1;
  }

 private:
  static constexpr int kLevels = 31;
  struct Cell {
    std::size_t face;
    double u, v;  // 0..1
  };

  template <class Real>
  static Cell cell_of(const Vector<Real>& p) {
    const double c[3] = {static_cast<double>(p.x), static_cast<double>(p.y), static_cast<double>(p.z)};
    const std::size_t axis = std::fabs(c[0]) > std::fabs(c[1])   ? (std::fabs(c[0]) > std::fabs(c[2]) ? 0 : 2)
                             : std::fabs(c[1]) > std::fabs(c[2]) ? 1
                                                                 : 2;
    const double height = std::fabs(c[axis]);
    return {2 * axis + (c[axis] < 0 ? 1 : 0), 0.5 + 0.5 * (c[(axis + 1) % 3] / height),
            0.5 + 0.5 * (c[(axis + 2) % 3] / height)};
  }
  std::size_t place(const Cell& cell, int level) const {
    const std::size_t side = std::size_t{1} << level;
    const auto along = [side](double t) {
      return std::min(static_cast<std::size_t>(t * static_cast<double>(side)), side - 1);
    };
    return begin_[level] + (cell.face * side + along(cell.u)) * side + along(cell.v);
  }

  int levels_ = 1;
  std::size_t begin_[kLevels + 1] = {};
  BlockArray<Int> node_;
};

/// Waiting nodes that need no bookkeeping; all nodes have length 1. A node i is settled once NEAR(i) = j is
/// its nearest node and less than 90 degrees away. For if a nearer node k is inserted, k becomes a
/// neighbour of j:
///
///          i          The caps that touch j, with centres between i and j, lie inside the cap around i
///         /  \ .      that touches j, which is empty except for k. The one of them that touches k as well
///        c    k       is therefore empty, and smaller than 90 degrees: k-j is an arc.
///       /  ---
///      j              .
///
/// So NEAR(i) remains the nearest node, whatever is inserted, and can be found by location when i is
/// inserted.
///
/// All this holds up to rounding. If several nodes are equally near up to kTie, the original's comparisons
/// decide between them: these are repeated, from the first of these nodes on. That node was clearly nearer
/// than all before, so NEAR(i) became this node when it was inserted. For a rounding error in an earlier
/// comparison to last until then, a node j' must be nearer than j = NEAR(i) by less than d = 4e-16, and
/// must have hidden a nearer node k from j, so lie in the cap that touches j and k. Let f(p) = <p-j,i>,
/// which is how much nearer p is, and g(p) = 1-<p,j> = |p-j|^2/2: p is in the cap that touches k if
/// f(p)/g(p) > f(k)/g(k). So k, too, is not nearer by more than d g(k)/g(j'). These are two coincidences:
/// nodes in general position do not have them, and in regular grids they are exact ties, for which the
/// argument above holds as it stands.
template <class Real, class Int>
class SettledNodes {
 public:
  using Lists = InsertionLists<Real, Int>;

  SettledNodes(Int n, const Lists& lists)
      : lists_(lists),
        grid_(n),
        settled_(static_cast<std::size_t>(n) + 1),
        last_event_(static_cast<std::size_t>(n) + 1) {
    std::fill(settled_.begin(), settled_.end(), Settled{0, 0});
    std::fill(last_event_.begin(), last_event_.end(), 0);
    events_.push_back({0, 0});
    for (Int k = 1; k <= lists.size(); ++k) grid_.insert(k, lists[k]);
  }

  /// To be called after inserting node k.
  void add(Int k) {
    grid_.insert(k, lists_[k]);
    lists_.for_each_neighbour(k, [&](Int neighbour) {
      Int& last_event = last_event_[index(neighbour)];
      events_.push_back({k, last_event});
      last_event = static_cast<Int>(events_.size() - 1);
    });
  }
  /// True if the events take too much memory, because nodes got far more neighbours than six on average, as
  /// in random order.
  bool is_full() const {
    constexpr auto kMostNumbers = static_cast<std::size_t>(std::numeric_limits<Int>::max() / 2);
    return events_.size() > std::min(kMostEvents * last_event_.size(), kMostNumbers);
  }

  /// True if a node may be settled whose distance from its NEAR has this cosine.
  static bool may_settle(Real cosine) { return cosine > Real(kCloserThan90); }
  /// Settles node i at p if `near`, its NEAR, is its nearest node, that is, if no neighbour of `near` is
  /// nearer.
  bool settle(Int i, const Vector<Real>& p, Int near) {
    const Real cosine = dot(p, lists_[near]);
    if (!may_settle(cosine)) return false;
    bool is_nearest = true;
    lists_.for_each_neighbour(near, [&](Int other) { is_nearest &= !(dot(p, lists_[other]) > cosine); });
    if (is_nearest) settled_[index(i)] = {near, lists_.size()};
    return is_nearest;
  }
  bool is_settled(Int i) const { return settled_[index(i)].near != 0; }

  /// NEAR of the settled node i at p.
  Int near(Int i, const Vector<Real>& p) {
    // Descend to the nearest node. From a start 90 degrees away or more the descent might end elsewhere.
    const Settled settled = settled_[index(i)];
    Int nearest = grid_.near(p);
    if (dot(p, lists_[settled.near]) > dot(p, lists_[nearest])) nearest = settled.near;
    Real cosine = dot(p, lists_[nearest]);
    for (Int node = 0; node != nearest;) {
      node = nearest;
      lists_.for_each_neighbour(node, [&](Int neighbour) {
        const Real other = dot(p, lists_[neighbour]);
        if (other > cosine) {
          cosine = other;
          nearest = neighbour;
        }
      });
    }
    // Collect all equally near nodes: they are connected by arcs between them.
    Int equal[kMostEqual] = {nearest}, first = nearest;
    int count = 1;
    for (int visited = 0; visited < count; ++visited)
      lists_.for_each_neighbour(equal[visited], [&](Int neighbour) {
        if (dot(p, lists_[neighbour]) < cosine - Real(kTie)) return;
        if (count == kMostEqual || std::find(equal, equal + count, neighbour) != equal + count) return;
        equal[count++] = neighbour;
        first = std::min(first, neighbour);
      });
    if (count == kMostEqual || first <= settled.at) return compared(p, settled.near, settled.at);
    return count == 1 ? nearest : compared(p, first, first);
  }

 private:
  static constexpr double kTie = 0x1p-40, kCloserThan90 = 0x1p-20;
  static constexpr int kMostEqual = 32;
  static constexpr std::size_t kMostEvents = 32;  ///< per node, on average
  /// NEAR of a node when it was settled (0: it is not), and the number of nodes inserted by then.
  struct Settled {
    Int near, at;
  };
  /// Node k was inserted and became a neighbour of the node that owns this event.
  struct Event {
    Int k, previous;
  };

  static std::size_t index(Int node) { return static_cast<std::size_t>(node); }

  /// NEAR as the original's comparisons give it, starting from NEAR = `near` after the insertion of node
  /// `since`.
  Int compared(const Vector<Real>& p, Int near, Int since) {
    for (;;) {
      later_.clear();
      for (Int e = last_event_[index(near)]; events_[index(e)].k > since; e = events_[index(e)].previous)
        later_.push_back(events_[index(e)].k);
      const Real distance = -dot(p, lists_[near]);
      const auto nearer =
          std::find_if(later_.rbegin(), later_.rend(), [&](Int k) { return -dot(p, lists_[k]) < distance; });
      if (nearer == later_.rend()) return near;
      near = since = *nearer;
    }
  }

  const Lists& lists_;
  NodeGrid<Int> grid_;
  BlockArray<Settled> settled_;
  BlockArray<Int> last_event_;  ///< by node; 0 = none
  std::vector<Event> events_;
  std::vector<Int> later_;
};

}  // namespace pstripack
