#include "stripack/voronoi.h"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <initializer_list>
#include <limits>
#include <optional>
#include <queue>
#include <tuple>
#include <utility>
#include <vector>

#include "base/parallel_for.h"
#include "base/workspace.h"
#include "geometry/measures.h"
#include "lists/rings.h"
#include "lists/triangle_numbers.h"
#include "stripack/list_queries.h"

namespace pstripack {

template <class Real>
bool circumcentre(const Vector<Real>& a, const Vector<Real>& b, const Vector<Real>& c, Vector<Real>& centre) {
  const Vector<Real> normal = cross(minus(b, a), minus(c, a));
  const Real square = dot(normal, normal);
  if (square == 0) return false;
  const Real length = std::sqrt(square);
  centre = {normal.x / length, normal.y / length, normal.z / length};
  return true;
}

namespace {

/// The columns still to be tested, in the order of repeated passes over all columns 1..n, without those
/// that cannot have changed. So the cost is that of the swaps, not of the passes: a smooth boundary of n
/// nodes needs about n/4 passes.
template <class Int>
class Agenda {
 public:
  explicit Agenda(std::size_t n) : due_(n + 1, 0) {
    std::vector<Test> room;
    room.reserve(n);
    tests_ = Heap(std::greater<Test>(), std::move(room));
  }

  void add_all() {
    for (Int g = static_cast<Int>(due_.size()) - 1; g >= 1; --g) add(g);
  }
  void add(Int column) {
    if (std::exchange(due_[static_cast<std::size_t>(column)], 1) == 0)
      tests_.push({column > now_ ? pass_ : pass_ + 1, column});
  }
  /// The next column to test; 0 if there is none.
  Int take() {
    if (tests_.empty()) return now_ = 0;
    std::tie(pass_, now_) = tests_.top();
    tests_.pop();
    due_[static_cast<std::size_t>(now_)] = 0;
    return now_;
  }

 private:
  using Test = std::pair<Int, Int>;                                               // pass, column
  using Heap = std::priority_queue<Test, std::vector<Test>, std::greater<Test>>;  // the first in front

  std::vector<char> due_;
  Heap tests_;
  Int pass_ = 0, now_ = 0;
};

/// The triangles of boundary nodes that cover the far side, in the columns of the caller's LTRI. Column g:
/// corners in rows 1-3, clockwise (counterclockwise seen from the far side); in row 3+i the column of the
/// triangle opposite corner i, or 0. Rows and columns count from 1.
template <class Real, class Int>
class FarSide {
 public:
  FarSide(const ListReader<Int>& lists, const Nodes<Real>& nodes, const Directions* directions, Int ncol,
          Int* ltri)
      : lists_(lists), nodes_(nodes), directions_(directions), ncol_(ncol), ltri_(ltri) {}

  Int count() const { return count_; }
  Int row(int i, Int g) const { return cell(i, g); }

  /// A fan of nb - 2 triangles at the first neighbour of boundary node `start`. Columns beyond ncol are
  /// not written.
  void make_fan(Int start, Int nb) {
    count_ = nb - 2;
    const Int apex = lists_.first_neighbour(start);
    Int u = start;
    for (Int g = 1; g <= std::min(count_, ncol_); ++g) {
      const Int v = lists_.last_neighbour(u);
      const Int column[6] = {u, v, apex, g < count_ ? g + 1 : 0, g - 1, 0};
      std::copy(column, column + 6, &cell(1, g));
      u = v;
    }
  }

  /// Swaps diagonals until every arc passes the Delaunay test seen from the far side, in the order of
  /// repeated passes over all columns.
  ///
  /// Rounded tests of nearly cocircular nodes may cycle. A swap that is right by the exact sign puts a
  /// tetrahedron of positive volume under the surface, so every cycle contains a swap that is wrong by the
  /// exact sign. After 16 wrong swaps per column the exact test takes over, which always ends. (At most 1.4
  /// per column were seen where rounded tests end.)
  void make_delaunay(Agenda<Int>& agenda) {
    std::int64_t wrong_swaps_left = 16 * std::int64_t{count_} + 100;
    const auto rounded = [&](Int a, Int b, Int c, Int d) {
      if (!(height(nodes_[a], nodes_[b], nodes_[c], nodes_[d]) > Real(0))) return false;
      if (!exactly_above(a, b, c, d)) --wrong_swaps_left;
      return true;
    };
    const auto exact = [this](Int a, Int b, Int c, Int d) { return exactly_above(a, b, c, d); };
    if (directions_ == nullptr && swap(agenda, rounded, [&] { return wrong_swaps_left < 0; })) return;
    swap(agenda, exact, [] { return false; });
  }

  /// The first zero in rows 4-6: a side on the boundary.
  void find_open_side(Int& g, int& i) const {
    for (g = 1;; ++g)
      for (i = 1; i <= 3; ++i)
        if (cell(3 + i, g) == 0) return;
  }

  /// The row of corner u in column g; 3 if u is not in rows 1 and 2.
  int row_of(Int u, Int g) const { return cell(1, g) == u ? 1 : cell(2, g) == u ? 2 : 3; }

  static int after(int row) { return row % 3 + 1; }

 private:
  Int& cell(int i, Int g) const {
    return ltri_[6 * static_cast<std::size_t>(g - 1) + static_cast<std::size_t>(i - 1)];
  }

  Point point(Int node) const { return as_point(nodes_[node]); }

  int side_to(Int neighbour, Int g) const {
    return cell(4, g) == neighbour ? 1 : cell(5, g) == neighbour ? 2 : 3;
  }

  bool exactly_above(Int a, Int b, Int c, Int d) const {
    const auto index = [](Int node) { return static_cast<index_t>(node - 1); };
    if (directions_ != nullptr) return directions_->orientation(index(a), index(b), index(c), index(d)) > 0;
    return std::isfinite(height(nodes_[a], nodes_[b], nodes_[c], nodes_[d])) &&
           orientation(point(a), point(b), point(c), point(d)) > 0;
  }

  /// Swaps until `test` requires none; false if `stop` ends it earlier.
  template <class Test, class Stop>
  bool swap(Agenda<Int>& agenda, const Test& test, const Stop& stop) {
    agenda.add_all();
    for (Int g; (g = agenda.take()) != 0;)
      for (int i = 1; i <= 3; ++i) {
        const Int h = cell(3 + i, g);
        if (h <= g) continue;
        //        c               c
        //       /g\             /|\        .
        //      a---b    ->     a | b       the arc a-b of columns g and h
        //       \h/             \|/        becomes the arc c-d
        //        d               d
        const int i1 = after(i), i2 = after(i1);
        const int j = side_to(g, h), j1 = after(j), j2 = after(j1);
        const Int a = cell(i1, g), b = cell(i2, g), c = cell(i, g), d = cell(j, h);
        if (!test(a, b, c, d)) continue;
        if (stop()) return false;
        const Int beyond_bc = cell(3 + i1, g), beyond_ca = cell(3 + i2, g);
        const Int beyond_ad = cell(3 + j1, h), beyond_db = cell(3 + j2, h);
        const Int new_g[6] = {d, c, a, beyond_ca, beyond_ad, h};
        const Int new_h[6] = {c, d, b, beyond_db, beyond_bc, g};
        std::copy(new_g, new_g + 6, &cell(1, g));
        std::copy(new_h, new_h + 6, &cell(1, h));
        if (beyond_bc != 0) cell(3 + side_to(g, beyond_bc), beyond_bc) = h;
        if (beyond_ad != 0) cell(3 + side_to(h, beyond_ad), beyond_ad) = g;
        for (const Int column : {g, h, beyond_bc, beyond_ca, beyond_ad, beyond_db})
          if (column != 0) agenda.add(column);
      }
    return true;
  }

  const ListReader<Int>& lists_;
  const Nodes<Real>& nodes_;
  const Directions* directions_;
  Int ncol_;
  Int* ltri_;
  Int count_ = 0;
};

/// The number of boundary nodes, clockwise from boundary node `start`; 0 if the boundary is not one cycle.
template <class Int>
Int boundary_length(const ListReader<Int>& lists, Int start) {
  Int count = 0, node = start;
  do {
    ++count;
    node = lists.last_neighbour(node);
  } while (node != start && count < lists.size());
  return node == start ? count : 0;
}

template <class Real, class Int>
class Voronoi {
 public:
  /// directions: null, or those of the nodes: then the nodes are not used.
  Voronoi(const ListsView<Int>& lists, const Nodes<Real>& nodes, const Directions* directions,
          const VoronoiArrays<Real, Int>& out)
      : lists_(lists), nodes_(nodes), directions_(directions), out_(out), threads_(threads_for(lists.n)) {}

  VoronoiStatus write() {
    if (lists_.size() < 3) {
      *out_.nb = 0;
      return VoronoiStatus::too_few_nodes;
    }
    if (!read()) return VoronoiStatus::broken_lists;
    *out_.nb = nb_;
    FarSide<Real, Int> far_side(lists_, nodes_, directions_, out_.ncol, out_.ltri);
    if (nb_ > 0) {
      far_side.make_fan(start_, nb_);
      if (out_.ncol < nb_ - 2) return VoronoiStatus::too_few_columns;
      far_side.make_delaunay(agenda_);
      for (Int g = 1; g <= nb_ - 2; ++g)
        if (const unsigned faults =
                write_centre(g, far_side.row(1, g), far_side.row(2, g), far_side.row(3, g)))
          return status_of(faults);
    }
    std::atomic<unsigned> faults{0};
    const bool in_slot_order = rings_.in_slot_order();
    const bool complete = numbers_->write(
        far_triangles(), in_slot_order ? out_.listc : left_.data(),
        [&](std::size_t begin, std::size_t end, Int t) { faults |= write_centres(begin, end, t); });
    if (!complete) return VoronoiStatus::broken_lists;
    if (!in_slot_order)
      for (Int arc = 0; arc < rings_.arcs(); ++arc) listc(rings_.slot(arc)) = left_[index(arc)];
    if (faults != 0) return status_of(faults);
    if (nb_ > 0) enter(far_side);
    return VoronoiStatus::done;
  }

 private:
  static constexpr FirstPair pairs = FirstPair::last_and_first;
  /// Faults of triangles: two corners coincide; a coordinate is not finite.
  static constexpr unsigned coincident = 1, not_finite = 2;
  static VoronoiStatus status_of(unsigned faults) {
    return (faults & not_finite) != 0 ? VoronoiStatus::not_finite : VoronoiStatus::coincident_nodes;
  }

  /// Number of triangles whose centres are computed together, without branches, while positions of the next
  /// are prefetched.
  static constexpr std::size_t together = 64;
  struct Batch {
    std::array<std::array<Int, together>, 3> corner;
    std::size_t size = 0;
  };
  // A node's position in one cache line, in huge pages; the caller's three arrays would take three lines.
  struct Position {
    Vector<Real> of;
    Real fills_the_line;
  };

  /// Allocates all memory. True if the lists have the numbers of arcs and triangles of a triangulation, so
  /// that no array can be overrun.
  bool read() {
    const Int n = lists_.size();
    if (!rings_.read(lists_.view(), threads_)) return false;

    start_ = lists_.first_boundary_node();
    if (start_ != 0) {
      nb_ = boundary_length(lists_, start_);
      if (nb_ < 3) return false;
      agenda_ = Agenda<Int>(static_cast<std::size_t>(nb_ - 2));
    }
    if (rings_.arcs() != (nb_ > 0 ? 6 * n - 6 - 2 * nb_ : 6 * n - 12)) return false;

    numbers_.emplace(rings_, threads_);
    if (numbers_->count() != 2 * n - 4 - far_triangles()) return false;
    if (!rings_.in_slot_order()) left_ = BlockArray<Int>(index(rings_.arcs()));
    if (directions_ != nullptr) return true;
    position_ = BlockArray<Position>(lists_.view().n);
    parallel_for(lists_.view().n, lists_.view().n,
                 [this](std::size_t i) { position_[i].of = nodes_[static_cast<Int>(i) + 1]; });
    return true;
  }

  Int far_triangles() const { return nb_ > 0 ? nb_ - 2 : 0; }

  /// Writes the centres of the triangles of the nodes begin+1..end; t is the number of triangles before them.
  unsigned write_centres(std::size_t begin, std::size_t end, Int t) {
    unsigned faults = 0;
    Batch batch;
    const auto flush = [&] {
      faults |= write_batch(t, batch);
      t += static_cast<Int>(batch.size);
      batch.size = 0;
    };
    rings_.template for_each_triangle<pairs>(begin, end, [&](Int a, Int b, Int c, Int, Int) {
      prefetch(b);
      prefetch(c);
      batch.corner[0][batch.size] = a;
      batch.corner[1][batch.size] = b;
      batch.corner[2][batch.size] = c;
      if (++batch.size == together) flush();
    });
    flush();
    return faults;
  }

  [[gnu::always_inline]] void prefetch(Int node) const {
    if (directions_ == nullptr)
      __builtin_prefetch(&position_[index(node - 1)]);
    else
      directions_->prefetch(static_cast<index_t>(node - 1));
  }

  /// Writes the same values as write_centre, by loops that compilers can vectorise.
  unsigned write_batch(Int t, const Batch& batch) {
    if (directions_ != nullptr) return write_one_by_one(t, batch);
    using Numbers = std::array<Real, together>;
    Numbers ax, ay, az, ex, ey, ez, fx, fy, fz, square, x, y, z, cosine;
    for (std::size_t i = 0; i < batch.size; ++i) {
      const Vector<Real> a = position_[index(batch.corner[0][i] - 1)].of;
      const Vector<Real> b = position_[index(batch.corner[1][i] - 1)].of;
      const Vector<Real> c = position_[index(batch.corner[2][i] - 1)].of;
      ax[i] = a.x, ay[i] = a.y, az[i] = a.z;
      ex[i] = b.x - a.x, ey[i] = b.y - a.y, ez[i] = b.z - a.z;
      fx[i] = c.x - a.x, fy[i] = c.y - a.y, fz[i] = c.z - a.z;
    }
    for (std::size_t i = 0; i < batch.size; ++i) {
      const Vector<Real> normal = cross(Vector<Real>{ex[i], ey[i], ez[i]}, Vector<Real>{fx[i], fy[i], fz[i]});
      square[i] = dot(normal, normal);
      const Real length = std::sqrt(square[i]);
      x[i] = normal.x / length, y[i] = normal.y / length, z[i] = normal.z / length;
      cosine[i] = dot(Vector<Real>{ax[i], ay[i], az[i]}, Vector<Real>{x[i], y[i], z[i]});
    }
    bool usual = true;
    for (std::size_t i = 0; i < batch.size; ++i)
      usual &= (square[i] > 0) & (square[i] <= std::numeric_limits<Real>::max());
    if (!usual) return write_one_by_one(t, batch);
    const std::size_t first = index(t);
    for (std::size_t i = 0; i < batch.size; ++i) {
      out_.xc[first + i] = x[i];
      out_.yc[first + i] = y[i];
      out_.zc[first + i] = z[i];
      out_.rc[first + i] = clamped_acos(cosine[i]);
    }
    return 0;
  }

  /// For directions, and for a batch with nodes that coincide or are not finite.
  unsigned write_one_by_one(Int t, const Batch& batch) {
    unsigned faults = 0;
    for (std::size_t i = 0; i < batch.size; ++i)
      faults |= write_centre(++t, batch.corner[0][i], batch.corner[1][i], batch.corner[2][i]);
    return faults;
  }

  unsigned write_centre(Int t, Int node_a, Int node_b, Int node_c) {
    const std::size_t i = index(t - 1);
    const auto write = [&](const auto& centre) {
      out_.xc[i] = static_cast<Real>(centre.x);
      out_.yc[i] = static_cast<Real>(centre.y);
      out_.zc[i] = static_cast<Real>(centre.z);
    };
    if (directions_ != nullptr) {
      const auto at = [](Int node) { return static_cast<index_t>(node - 1); };
      const Point centre = circumcentre(*directions_, at(node_a), at(node_b), at(node_c));
      write(centre);
      return std::isnan(centre.x) ? coincident : 0;
    }
    const Vector<Real> a = nodes_[node_a], b = nodes_[node_b], c = nodes_[node_c];
    Vector<Real> centre;
    if (!circumcentre(a, b, c, centre)) return coincident;
    write(centre);
    out_.rc[i] = clamped_acos(dot(a, centre));
    const bool finite = !std::isnan(out_.rc[i]) || (is_finite(a) && is_finite(b) && is_finite(c));
    return finite ? 0 : not_finite;
  }

  /// Enters the far side into LISTC and LPTR, node by node counterclockwise around the boundary. At node u
  /// the first column, that at the arc to the last neighbour, gets the slot of that neighbour; the others
  /// get new slots after it.
  void enter(const FarSide<Real, Int>& far_side) {
    Int unused = rings_.arcs() + 1;
    Int g;
    int i;
    far_side.find_open_side(g, i);
    int i1 = far_side.after(i), i2 = far_side.after(i1);
    const Int start = far_side.row(i1, g);
    for (Int u = start;;) {
      Int slot = lists_.last_slot(u);
      const Int first = lptr(slot);
      listc(slot) = g;
      for (Int h; (h = far_side.row(3 + i2, g)) != 0; g = h) {
        lptr(slot) = unused;
        slot = unused++;
        listc(slot) = h;
        i1 = far_side.row_of(u, h);
        i2 = far_side.after(i1);
        i = far_side.after(i2);
      }
      lptr(slot) = first;
      u = far_side.row(i, g);
      if (u == start) break;
      const int turned = i;
      i = i2;
      i2 = i1;
      i1 = turned;
    }
    *out_.lnew = unused;
  }

  static std::size_t index(Int i) { return static_cast<std::size_t>(i); }
  Int& listc(Int slot) const { return out_.listc[slot - 1]; }
  Int& lptr(Int slot) const { return out_.lptr[slot - 1]; }

  ListReader<Int> lists_;
  Nodes<Real> nodes_;
  const Directions* directions_;
  VoronoiArrays<Real, Int> out_;
  int threads_;
  Int start_ = 0, nb_ = 0;  // the first boundary node, the number of boundary nodes
  Rings<Int> rings_;
  std::optional<TriangleNumbers<Int, pairs>> numbers_;
  BlockArray<Int> left_;  // by arc: the triangle on its left; empty if LISTC can hold it
  BlockArray<Position> position_;
  Agenda<Int> agenda_{0};
};

}  // namespace

template <class Real, class Int>
VoronoiStatus voronoi(const ListsView<Int>& lists, const Nodes<Real>& nodes,
                      const VoronoiArrays<Real, Int>& out) {
  return Voronoi<Real, Int>(lists, nodes, nullptr, out).write();
}

VoronoiStatus voronoi_of_directions(const ListsView<std::int32_t>& lists, const Directions& nodes,
                                    const VoronoiArrays<double, std::int32_t>& out) {
  return Voronoi<double, std::int32_t>(lists, {}, &nodes, out).write();
}

namespace {

/// The edges at the back of the hull: after `from`, `to` is the next neighbour of `node` counterclockwise.
struct BackEdge {
  std::int32_t node, from, to;
  bool operator<(const BackEdge& other) const {
    return std::tie(node, from) < std::tie(other.node, other.from);
  }
};

/// Sorted; none where the triangles cover the sphere. False if the boundary is not one cycle.
bool find_back_edges(const ListReader<std::int32_t>& lists, const Directions& nodes,
                     std::vector<BackEdge>& edges) {
  const std::int32_t start = lists.first_boundary_node();
  if (start == 0) return true;
  const std::int32_t count = boundary_length(lists, start);
  if (count < 3) return false;
  std::vector<std::int32_t> columns(6 * static_cast<std::size_t>(count - 2));
  const Nodes<double> none{};
  FarSide<double, std::int32_t> far_side(lists, none, &nodes, count - 2, columns.data());
  far_side.make_fan(start, count);
  Agenda<std::int32_t> agenda(static_cast<std::size_t>(count - 2));
  far_side.make_delaunay(agenda);
  for (std::int32_t g = 1; g <= count - 2; ++g)
    for (int i = 1; i <= 3; ++i) {
      const int next = far_side.after(i);
      edges.push_back({far_side.row(i, g), far_side.row(next, g), far_side.row(far_side.after(next), g)});
    }
  std::sort(edges.begin(), edges.end());
  return true;
}

/// Throws NodesTooClose if a neighbour is so close that the area of a disc between the two is below all
/// doubles: a cell holds one of half the distance to the nearest neighbour.
void refuse_if_too_close(const ListReader<std::int32_t>& reader, const Directions& nodes, std::int32_t node) {
  const auto direction = [&](std::int32_t k) { return direction_of(nodes, static_cast<index_t>(k - 1)); };
  std::int32_t nearest = 0;
  double least = 0x1p-510;
  reader.for_each_neighbour(node, [&](std::int32_t neighbour) {
    const double distance = arc_length(direction(node), direction(neighbour));
    if (distance < least) least = distance, nearest = neighbour;
  });
  if (nearest != 0) throw NodesTooClose(std::min(node, nearest), std::max(node, nearest));
}

}  // namespace

bool cell_areas(const ListsView<std::int32_t>& lists, const Directions& nodes, double* area) {
  constexpr std::int32_t kAhead = 32;  // in canonical lists the slots of the next nodes follow
  const ListReader<std::int32_t> reader(lists);
  std::vector<BackEdge> back_edges;
  if (lists.n < 3 || !find_back_edges(reader, nodes, back_edges)) return false;
  const int threads = threads_for(8 * lists.n);
  ErrorsOfThreads errors(static_cast<std::size_t>(threads));
  std::atomic<bool> good{true};
  parallel_pieces(lists.n, threads, [&](std::size_t first, std::size_t last, int piece) {
    errors.keep(static_cast<std::size_t>(piece), [&] {
      std::vector<Direction> ring;
      for (std::size_t k = first; k < last; ++k) {
        const auto node = static_cast<std::int32_t>(k + 1);
        ring.clear();
        const auto add = [&](std::int32_t neighbour) {
          ring.push_back(direction_of(nodes, static_cast<index_t>(neighbour - 1)));
        };
        const std::int32_t end = reader.last_slot(node), first_neighbour = reader.first_neighbour(node);
        std::int32_t slot = end;
        do {
          slot = reader.next(slot);
          if (slot + kAhead < lists.lnew)
            nodes.prefetch(static_cast<index_t>(std::abs(lists.list[slot + kAhead - 1]) - 1));
          add(reader.neighbour(slot));
        } while (slot != end && ring.size() < lists.n);
        if (reader.on_boundary(node))
          for (std::int32_t from = reader.last_neighbour(node);;) {
            const auto edge = std::lower_bound(back_edges.begin(), back_edges.end(), BackEdge{node, from, 0});
            if (edge == back_edges.end() || edge->node != node || edge->from != from) {
              good = false;
              return;
            }
            from = edge->to;
            if (from == first_neighbour) break;
            add(from);
          }
        area[k] = cell_area(direction_of(nodes, static_cast<index_t>(k)), ring.data(), ring.size());
      }
    });
  });
  errors.rethrow();
  for (std::int32_t node = 1; good && node <= reader.size(); ++node) {
    if (!std::isnan(area[node - 1])) continue;
    refuse_if_too_close(reader, nodes, node);
    area[node - 1] = 0;  // all corners are one point, as where the nodes around lie on a great circle
  }
  return good;
}

#define PSTRIPACK_CIRCUMCENTRE(Real) \
  template bool circumcentre(const Vector<Real>&, const Vector<Real>&, const Vector<Real>&, Vector<Real>&);
PSTRIPACK_CIRCUMCENTRE(float)
PSTRIPACK_CIRCUMCENTRE(double)

#define PSTRIPACK_VORONOI(Real, Int) \
  template VoronoiStatus voronoi(const ListsView<Int>&, const Nodes<Real>&, const VoronoiArrays<Real, Int>&);
PSTRIPACK_VORONOI(float, std::int32_t)
PSTRIPACK_VORONOI(double, std::int32_t)
PSTRIPACK_VORONOI(double, std::int64_t)

}  // namespace pstripack
