#include "stripack/triangle_list.h"

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <type_traits>
#include <vector>

#include "base/buffer.h"
#include "base/parallel_for.h"
#include "lists/rings.h"
#include "stripack/list_queries.h"

namespace pstripack {
namespace {

// Method. Let a be the smallest corner of triangle (a,b,c):
//
//               c             Its sides, by the corner opposite:
//              / \              a: b->c, the arc before b->a in the ring of b
//             /   \             b: c->a, back from c
//            a-----b            c: a->b
//
// `face` keeps for every arc the triangle on its left and which side of it the arc is, so that the neighbour
// beyond a side is the face of the reversed side. No search through the triangles is needed.
template <class Int>
class TriangleList {
 public:
  TriangleList(const ListsView<Int>& lists, int rows)
      : rows_(static_cast<std::size_t>(rows)),
        threads_(threads_for(lists.n)),
        face_(rows > 3 ? 6 * lists.n - 12 : 0),
        first_(static_cast<std::size_t>(threads_) + 1),
        readable_(rings_.read(lists, threads_)) {}

  TriangleListStatus write(Int& nt, Int* ltri) {
    if (!readable_) return TriangleListStatus::broken_lists;
    // Pieces of the nodes, one per thread: count, sum up, number.
    const std::size_t nodes = static_cast<std::size_t>(rings_.size()) - 2;
    parallel_pieces(nodes, threads_, [this](std::size_t begin, std::size_t end, int piece) {
      Int count = 0;
      rings_.template for_each_triangle<pairs>(begin, end, [&count](Int, Int, Int, Int, Int) { ++count; });
      first_[static_cast<std::size_t>(piece) + 1] = count;
    });
    add_up();
    const Int total = first_.back();
    if (total > 2 * rings_.size() - 4) return TriangleListStatus::broken_lists;  // would overrun LTRI

    std::atomic<bool> complete{true};
    if (rows_ > 3) std::fill(face_.begin(), face_.end(), Face{0});
    parallel_pieces(nodes, threads_, [&](std::size_t begin, std::size_t end, int piece) {
      if (!write_corners(begin, end, first_[static_cast<std::size_t>(piece)], ltri)) complete = false;
    });
    if (!complete) return TriangleListStatus::broken_lists;
    if (rows_ > 3)
      parallel_pieces(static_cast<std::size_t>(total), threads_,
                      [&](std::size_t begin, std::size_t end, int piece) {
                        first_[static_cast<std::size_t>(piece) + 1] = write_neighbours(begin, end, ltri);
                      });
    if (rows_ > 6) {
      add_up();
      parallel_pieces(static_cast<std::size_t>(total), threads_,
                      [&](std::size_t begin, std::size_t end, int piece) {
                        write_arcs(begin, end, first_[static_cast<std::size_t>(piece)], ltri);
                      });
    }
    nt = total;
    return TriangleListStatus::done;
  }

 private:
  static constexpr FirstPair pairs = FirstPair::first_and_second;
  using Face = std::make_unsigned_t<Int>;  // 4 * triangle + side; 0 = none

  /// first_[piece] = the sum of the counts of all pieces before it.
  void add_up() {
    first_[0] = 0;
    for (std::size_t piece = 1; piece < first_.size(); ++piece) first_[piece] += first_[piece - 1];
  }

  /// Rows 1-3 and the faces; t triangles come before. False if the reverse of a side is not in its list.
  bool write_corners(std::size_t begin, std::size_t end, Int t, Int* ltri) {
    bool complete = true;
    rings_.template for_each_triangle<pairs>(begin, end, [&](Int a, Int b, Int c, Int ab, Int ac) {
      Int* column = ltri + static_cast<std::size_t>(t) * rows_;
      ++t;
      column[0] = a;
      column[1] = b;
      column[2] = c;
      const auto ba = rings_.back(a, ab), ca = rings_.back(a, ac);
      if (!ba.exists() || !ca.exists() || rings_.target(ca.next()) != b) {
        complete = false;
        return;
      }
      if (rows_ == 3) return;
      const Face code = 4 * static_cast<Face>(t);
      face(ba.previous()) = code;  // b->c
      face(ca.arc) = code + 1;
      face(ab) = code + 2;
      // Until all faces are known, rows 4-6 hold the reversed sides.
      column[3] = ca.next();  // c->b
      column[4] = ac;
      column[5] = ba.arc;
    });
    return complete;
  }

  /// Rows 4-6, and in rows 7-9 the side of the neighbour that is shared. Returns the number of arcs that
  /// the triangles begin+1..end number.
  Int write_neighbours(std::size_t begin, std::size_t end, Int* ltri) const {
    Int arcs = 0;
    for (std::size_t t = begin; t < end; ++t) {
      Int* column = ltri + t * rows_;
      for (int row = 3; row < 6; ++row) {
        const Int reversed = column[row];
        const Face face = rings_.entry(reversed) < 0 ? Face{0} : face_[static_cast<std::size_t>(reversed)];
        column[row] = static_cast<Int>(face / 4);
        if (rows_ > 6) column[row + 3] = static_cast<Int>(face % 4);
        if (face / 4 <= t) ++arcs;
      }
    }
    return arcs;
  }

  /// Rows 7-9: an arc gets its number from the later of its two triangles, or from its only one.
  void write_arcs(std::size_t begin, std::size_t end, Int arc, Int* ltri) const {
    for (std::size_t t = begin; t < end; ++t) {
      Int* column = ltri + t * 9;
      for (int row = 3; row < 6; ++row) {
        const std::size_t neighbour = static_cast<std::size_t>(column[row]);
        if (neighbour > t) continue;
        ++arc;
        if (neighbour > 0) ltri[(neighbour - 1) * 9 + 6 + static_cast<std::size_t>(column[row + 3])] = arc;
        column[row + 3] = arc;
      }
    }
  }

  Face& face(Int arc) { return face_[static_cast<std::size_t>(arc)]; }

  std::size_t rows_;
  int threads_;
  Rings<Int> rings_;
  Buffer<Face> face_;
  std::vector<Int> first_;  // counts of the pieces, then their sums
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
