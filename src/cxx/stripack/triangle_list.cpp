#include "stripack/triangle_list.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>

#include "base/parallel_for.h"
#include "base/workspace.h"
#include "lists/rings.h"
#include "lists/triangle_numbers.h"
#include "stripack/list_queries.h"

namespace pstripack {
namespace {

// Method. TriangleNumbers has the triangle on the left of every arc. The columns of a triangle are written in
// the ring of its smallest corner, but for row 4: the triangle beyond the side opposite that corner. It is
// written in the ring of the middle corner v, where that side goes to the largest corner w:
//
//          w           the triangle left of v-w has its smallest corner x if x < v: then the triangle on the
//        / | \         right is its row 4;
//       x  |  y        the triangle right of v-w has its smallest corner y if y < v: then the triangle on the
//        \ | /         left is its row 4
//          v
template <class Int>
class TriangleList {
 public:
  TriangleList(const Rings<Int>& rings, int rows, const Int* left, Int* ltri)
      : rings_(rings), rows_(rows), left_(left), ltri_(ltri) {}

  /// Writes rows 1-3, 5 and 6 of the triangles t+1, t+2, ... whose smallest corners are the nodes
  /// first+1..last, and row 4 of those whose middle corner is one of these nodes.
  void write(std::size_t first, std::size_t last, Int t) const {
    Int* column = column_of(t + 1);
    rings_.template for_each_triangle<pairs>(first, last, [&](Int a, Int b, Int c, Int p, Int q) {
      column[0] = a, column[1] = b, column[2] = c;
      if (rows_ > 3) column[4] = left_[q], column[5] = left_[rings_.before(a, p)];
      column += rows_;
    });
    for (Int v = static_cast<Int>(first) + 1; rows_ > 3 && v <= static_cast<Int>(last); ++v)
      for (Int arc = rings_.begin(v); arc < rings_.end(v); ++arc) {
        if (rings_.target(arc) < v) continue;
        const Int before = rings_.before(v, arc), on_left = left_[arc], on_right = left_[before];
        if (on_left != 0 && rings_.target(rings_.after(v, arc)) < v) column_of(on_left)[3] = on_right;
        if (on_right != 0 && rings_.target(before) < v) column_of(on_right)[3] = on_left;
      }
  }

  /// Writes rows 7-9 of the `count` triangles, after the others: an arc is numbered with the later of its two
  /// triangles, or with its only one.
  void number_arcs(Int count) const {
    constexpr Int kAhead = 24;
    Int arc = 0;
    for (Int t = 1; t <= count; ++t) {
      for (int side = 3; side < 6 && t + kAhead <= count; ++side)
        __builtin_prefetch(column_of(std::max<Int>(column_of(t + kAhead)[side], 1)) + 6, 1);
      Int* const column = column_of(t);
      for (int side = 0; side < 3; ++side) {
        const Int beyond = column[3 + side];
        if (beyond > t) continue;
        column[6 + side] = ++arc;
        if (beyond == 0) continue;
        Int* const other = column_of(beyond);
        for (int row = 0; row < 3; ++row)
          if (other[row] != column[(side + 1) % 3] && other[row] != column[(side + 2) % 3])
            other[6 + row] = arc;
      }
    }
  }

  static constexpr FirstPair pairs = FirstPair::first_and_second;

 private:
  Int* column_of(Int t) const {
    return ltri_ + static_cast<std::size_t>(t - 1) * static_cast<std::size_t>(rows_);
  }

  const Rings<Int>& rings_;
  const int rows_;
  const Int* const left_;  ///< by arc: the triangle on its left
  Int* const ltri_;
};

}  // namespace

template <class Int>
TriangleListStatus triangle_list(const ListsView<Int>& lists, int rows, Int& nt, Int* ltri) {
  nt = 0;
  const auto n = static_cast<Int>(lists.n);
  if (n < 3 || (rows != 3 && rows != 6 && rows != 9)) return TriangleListStatus::bad_argument;
  const int threads = threads_for(lists.n);
  Rings<Int> rings;
  if (!rings.read(lists, threads)) return TriangleListStatus::broken_lists;
  TriangleNumbers<Int, TriangleList<Int>::pairs> numbers(rings, threads);
  if (numbers.count() > 2 * n - 4) return TriangleListStatus::broken_lists;  // LTRI would be overrun
  BlockArray<Int> left(static_cast<std::size_t>(rings.arcs()));
  const TriangleList<Int> columns(rings, rows, left.data(), ltri);
  const auto write = [&](std::size_t first, std::size_t last, Int t) { columns.write(first, last, t); };
  if (!numbers.write(0, left.data(), write)) return TriangleListStatus::broken_lists;
  if (rows > 6) columns.number_arcs(numbers.count());
  nt = numbers.count();
  return TriangleListStatus::done;
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
