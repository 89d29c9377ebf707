#include "stripack/triangle_list.h"

#include <algorithm>
#include <cstdint>
#include <type_traits>

#include "base/parallel_for.h"
#include "base/workspace.h"
#include "lists/rings.h"
#include "lists/triangle_numbers.h"
#include "stripack/list_queries.h"

namespace pstripack {
namespace {

// Method. Let a be the smallest corner of triangle t = (a,b,c), and p and q the arcs from a to b and to c:
//
//               c             Its sides, by the corner opposite, and the triangles beyond them:
//              / \              a: b-c, left of the arc before b->c in the ring of b
//           q /   \             b: c-a, left of q
//            a-----b            c: a-b, left of the arc before p
//               p
//
// The ring of a knows the last two. The first is noted when the numbers in the ring of b are known.
template <class Int>
class TriangleList {
 public:
  TriangleList(const ListsView<Int>& lists, int rows)
      : rows_(rows), threads_(threads_for(lists.n)), readable_(rings_.read(lists, threads_)) {}

  TriangleListStatus write(Int& nt, Int* ltri) {
    if (!readable_) return TriangleListStatus::broken_lists;
    TriangleNumbers<Int, pairs> numbers(rings_, threads_);
    const Int total = numbers.count();
    if (total > 2 * rings_.size() - 4) return TriangleListStatus::broken_lists;  // would overrun LTRI
    left_ = BlockArray<Int>(index(rings_.arcs()));
    beyond_ = BlockArray<Side>(index(total) + 1);
    std::fill(beyond_.begin(), beyond_.end(), Side{0});
    if (rows_ == 9) arcs_ = BlockArray<Number>(index(total) + 1);

    const bool complete = numbers.write(0, left_.data(), [&](std::size_t begin, std::size_t end, Int t) {
      if (rows_ > 3) note_beyond(begin, end);
      if (rows_ == 3) write_corners<3>(begin, end, t, ltri);
      if (rows_ == 6) write_corners<6>(begin, end, t, ltri);
      if (rows_ == 9) write_corners<9>(begin, end, t, ltri);
    });
    if (!complete) return TriangleListStatus::broken_lists;
    if (rows_ == 9) count_arcs(total);
    parallel_pieces(index(total), threads_, [&](std::size_t begin, std::size_t end, int) {
      if (rows_ == 6)
        for (std::size_t t = begin; t < end; ++t) ltri[6 * t + 3] = triangle(beyond_[t + 1]);
      if (rows_ == 9) write_arcs(begin, end, ltri);
    });
    nt = total;
    return TriangleListStatus::done;
  }

 private:
  static constexpr FirstPair pairs = FirstPair::first_and_second;
  using Number = std::make_unsigned_t<Int>;
  /// A side of a triangle: 4 * triangle + 0, 1 or 2; 0 = none.
  using Side = Number;
  static Int triangle(Side side) { return static_cast<Int>(side / 4); }

  /// For every triangle (a,b,c), b = first+1..last, the side b-c as one of the triangle beyond it.
  void note_beyond(std::size_t first, std::size_t last) {
    const Int* const left = left_.data();
    for (Int b = static_cast<Int>(first) + 1; b <= static_cast<Int>(last); ++b) {
      const auto note = [&](Int to_a) {
        // In the ring of b: d, c, a. Beyond the side is (b,d,c), smallest corner first.
        const Int to_c = rings_.before(b, to_a), to_d = rings_.before(b, to_c);
        const Int c = rings_.target(to_c), d = rings_.target(to_d);
        const Side opposite_d = (b < d) & (b < c) ? 1 : d < c ? 0 : 2;
        const Int t = left[to_c], beyond = left[to_d];
        if (t != 0) beyond_[index(t)] = 4 * static_cast<Side>(beyond) + opposite_d;
      };
      if (rings_.is_small(b)) {
        for (unsigned arcs = rings_.arcs_to_smallest(b); arcs != 0; arcs &= arcs - 1)
          note(rings_.begin(b) + __builtin_ctz(arcs));
      } else {
        for (Int arc = rings_.begin(b); arc < rings_.end(b); ++arc)
          if (rings_.leads_to_smallest(b, arc)) note(arc);
      }
    }
  }

  /// Rows 1-3, 5 and 6 of the triangles of nodes first+1..last, t before them. For count_arcs: in arcs_ a bit
  /// for each of rows 5 and 6 whose triangle comes earlier.
  template <int rows>
  void write_corners(std::size_t first, std::size_t last, Int t, Int* ltri) {
    const Int* const left = left_.data();
    Number* const arcs = arcs_.data();
    Int* column = ltri + index(t) * rows;
    rings_.template for_each_triangle<pairs>(first, last, [&](Int a, Int b, Int c, Int p, Int q) {
      ++t;
      column[0] = a;
      column[1] = b;
      column[2] = c;
      if (rows > 3) {
        const Int opposite_b = left[q], opposite_c = left[rings_.before(a, p)];
        column[4] = opposite_b;
        column[5] = opposite_c;
        if (rows > 6) arcs[t] = Number{opposite_b < t} + 2 * Number{opposite_c < t};
      }
      column += rows;
    });
  }

  /// An arc gets its number from the later of its two triangles, or from its only one. arcs_[t] = 4 * the
  /// number of arcs before those of triangle t, and a bit for each of its sides 0 and 1 whose arc is among
  /// those.
  void count_arcs(Int triangles) {
    Number arcs = 0;
    for (Number t = 1; t <= static_cast<Number>(triangles); ++t) {
      const Number others = arcs_[t], first = beyond_[t] / 4 < t;
      arcs_[t] = 4 * arcs + first + 2 * (others & 1);
      arcs += first + (others & 1) + (others >> 1);
    }
  }

  /// Rows 4 and 7-9 of the triangles begin+1..end.
  void write_arcs(std::size_t begin, std::size_t end, Int* ltri) const {
    for (std::size_t i = begin; i < end; ++i) {
      constexpr std::size_t ahead = 16;
      __builtin_prefetch(&arcs_[beyond_[std::min(i + ahead, end)] / 4]);
      const Int t = static_cast<Int>(i) + 1;
      Int* const column = ltri + i * 9;
      const Side beyond = beyond_[i + 1];
      column[3] = triangle(beyond);
      column[6] = arc_number(t, 0, column[3], beyond % 4);
      column[7] =
          arc_number(t, 1, column[4], 2);  // that triangle is later only if its smallest corner is a, too
      column[8] = arc_number(t, 2, column[5], 1);
    }
  }

  /// The number of the arc at a side of triangle t that is side `other` of the triangle `beyond`.
  Int arc_number(Int t, Number side, Int beyond, Number other) const {
    const bool later = beyond > t;
    const Number arcs = arcs_[index(later ? beyond : t)], s = later ? other : side;
    return static_cast<Int>(arcs / 4 + 1 + (s > 0 ? arcs & 1 : 0) + (s > 1 ? arcs >> 1 & 1 : 0));
  }

  static std::size_t index(Int i) { return static_cast<std::size_t>(i); }

  int rows_;
  int threads_;
  Rings<Int> rings_;
  BlockArray<Int> left_;     // by arc: the triangle left of it
  BlockArray<Side> beyond_;  // by triangle (a,b,c): what is beyond b-c
  BlockArray<Number> arcs_;  // by triangle: see count_arcs; if rows = 9
  bool readable_;
};

}  // namespace

template <class Int>
TriangleListStatus triangle_list(const ListsView<Int>& lists, int rows, Int& nt, Int* ltri) {
  nt = 0;
  if (static_cast<Int>(lists.n) < 3 || (rows != 3 && rows != 6 && rows != 9))
    return TriangleListStatus::bad_argument;
  return TriangleList<Int>(lists, rows).write(nt, ltri);
}

template <class Int>
BoundaryCounts<Int> boundary_nodes(const ListsView<Int>& lists, Int* nodes) {
  const ListReader<Int> reader(lists);
  const Int n = reader.size();
  const Int start = reader.first_boundary_node();
  if (start == 0) return {0, 3 * n - 6, 2 * n - 4};
  Int count = 0, node = start;
  do {
    nodes[count++] = node;
    node = reader.first_neighbour(node);
  } while (node != start && count < n);
  const Int triangles = 2 * n - count - 2;
  return {count, triangles + n - 1, triangles};
}

#define PSTRIPACK_TRIANGLE_LIST(Int)                                                 \
  template TriangleListStatus triangle_list(const ListsView<Int>&, int, Int&, Int*); \
  template BoundaryCounts<Int> boundary_nodes(const ListsView<Int>&, Int*);
PSTRIPACK_TRIANGLE_LIST(std::int32_t)
PSTRIPACK_TRIANGLE_LIST(std::int64_t)

}  // namespace pstripack
