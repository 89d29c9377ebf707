#include "stripack/triangle_list.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

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
  TriangleList(const Rings<Int>& rings, int rows, const Int* left, Int* beyond, Int* ltri)
      : rings_(rings), rows_(rows), left_(left), beyond_(beyond), ltri_(ltri) {}

  /// Writes rows 1-3, 5 and 6 of the triangles t+1, t+2, ... whose smallest corners are the nodes
  /// first+1..last, and row 4 of those whose middle corner is one of these nodes.
  void write(std::size_t first, std::size_t last, Int t) const {
    Int* column = column_of(t + 1);
    rings_.template for_each_triangle<pairs>(first, last, [&](Int a, Int b, Int c, Int p, Int q) {
      column[0] = a, column[1] = b, column[2] = c;
      if (rows_ > 3) column[4] = left_[q], column[5] = left_[rings_.before(a, p)];
      column += rows_;
    });
    for (Int v = static_cast<Int>(first) + 1; rows_ > 3 && v <= static_cast<Int>(last); ++v) {
      const Int begin = rings_.begin(v), end = rings_.end(v);
      if (rings_.is_small(v)) {
        const unsigned greater = rings_.arcs_of(v).greater, last_arc = static_cast<unsigned>(end - begin) - 1;
        // Of arcs to a greater w, those with x < v, and those with y < v.
        unsigned on_left = greater & ~(greater >> 1 | (greater & 1) << last_arc);
        unsigned on_right = greater & ~(greater << 1 | greater >> last_arc);
        for (; on_left != 0; on_left &= on_left - 1) beyond_left(v, begin + __builtin_ctz(on_left));
        for (; on_right != 0; on_right &= on_right - 1) beyond_right(v, begin + __builtin_ctz(on_right));
      } else {
        for (Int arc = begin; arc < end; ++arc) {
          if (rings_.target(arc) < v) continue;
          if (rings_.target(rings_.after(v, arc)) < v) beyond_left(v, arc);
          if (rings_.target(rings_.before(v, arc)) < v) beyond_right(v, arc);
        }
      }
    }
  }

  /// Writes row 4 of the `count` triangles, after all of write(), and rows 7-9: an arc is numbered with the
  /// later of its two triangles, or with its only one. `arcs`: zeros, one for each thread and another one.
  void complete(Int count, int threads, std::vector<Int>& arcs) const {
    const auto in_pieces = [&](const auto& work) {
      parallel_pieces(static_cast<std::size_t>(count), threads,
                      [&](std::size_t first, std::size_t last, int piece) {
                        work(static_cast<Int>(first) + 1, static_cast<Int>(last), piece);
                      });
    };
    if (rows_ == 6 || threads > 1)
      in_pieces([&](Int first, Int last, int piece) {
        for (Int t = first; t <= last; ++t) {
          column_of(t)[3] = beyond_[t - 1];
          for (int side = 0; side < 3; ++side) arcs[piece + 1] += column_of(t)[3 + side] < t;
        }
      });
    if (rows_ == 6) return;
    // Now those before the triangles of each thread.
    for (int piece = 0; piece < threads; ++piece) arcs[piece + 1] += arcs[piece];
    // Without branches, which would be unpredictable: what is no new arc is written to `nowhere`.
    in_pieces([&](Int first, Int last, int piece) {
      std::array<Int, 9> nowhere{};
      Int arc = arcs[piece];
      for (Int t = first; t <= last; ++t) {
        const Int soon = std::min(t + 24, last);
        for (const Int later : {beyond_[soon - 1], column_of(soon)[4], column_of(soon)[5]}) {
          const Int* const far = column_of(std::max<Int>(later, 1));
          __builtin_prefetch(far, 1);
          __builtin_prefetch(far + 8, 1);
        }
        Int* const column = column_of(t);
        column[3] = beyond_[t - 1];
        for (int side = 0; side < 3; ++side) {
          const Int beyond = column[3 + side];
          const bool is_new = beyond < t;
          arc += is_new;
          Int* const own = is_new ? column : nowhere.data();
          own[6 + side] = arc;
          number_side((is_new & (beyond != 0)) ? column_of(beyond) : nowhere.data(), column[(side + 1) % 3],
                      column[(side + 2) % 3], arc);
        }
      }
    });
  }

  static constexpr FirstPair pairs = FirstPair::first_and_second;

 private:
  Int* column_of(Int t) const {
    return ltri_ + static_cast<std::size_t>(t - 1) * static_cast<std::size_t>(rows_);
  }

  /// Writes row 4 of the triangle left of an arc of v, if there is one.
  void beyond_left(Int v, Int arc) const {
    if (left_[arc] != 0) beyond_[left_[arc] - 1] = left_[rings_.before(v, arc)];
  }
  /// The same of the triangle right of it.
  void beyond_right(Int v, Int arc) const {
    if (const Int t = left_[rings_.before(v, arc)]; t != 0) beyond_[t - 1] = left_[arc];
  }

  /// Writes the number of the arc b-c of a triangle in the row of the corner opposite.
  static void number_side(Int* column, Int b, Int c, Int arc) {
    const bool first = (column[0] == b) | (column[0] == c), second = (column[1] == b) | (column[1] == c);
    column[6 + first * (1 + second)] = arc;
  }

  const Rings<Int>& rings_;
  const int rows_;
  const Int* const left_;  ///< by arc: the triangle on its left
  Int* const beyond_;      ///< row 4
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
  BlockArray<Int> left(static_cast<std::size_t>(rings.arcs())),
      beyond(static_cast<std::size_t>(rows > 3 ? numbers.count() : 0));
  std::vector<Int> arcs(static_cast<std::size_t>(threads) + 1);  // here: what fails leaves LTRI as it was
  const TriangleList<Int> columns(rings, rows, left.data(), beyond.data(), ltri);
  const auto write = [&](std::size_t first, std::size_t last, Int t) { columns.write(first, last, t); };
  if (!numbers.write(0, left.data(), write)) return TriangleListStatus::broken_lists;
  if (rows > 3) columns.complete(numbers.count(), threads, arcs);
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
