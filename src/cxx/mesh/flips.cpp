// Warm start from the mesh of an earlier call:
//   1  test every star in floating point, and exactly if the result is not certain
//   2  flip arcs that are not locally Delaunay, and test the arcs around them again (Lawson 1977)
//
// If every triangle is counterclockwise and one direction lies in one triangle only, the mesh covers the
// sphere once. If then every arc is locally Delaunay, by the exact predicate with its tie rule, it is the
// Delaunay triangulation: proof in docs/internals/design.md, "Warm start".

#include "mesh/flips.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include "base/parallel_for.h"
#include "geometry/insertion_order.h"

namespace pstripack {

MovingMesh::MovingMesh(std::size_t n, std::size_t arcs, std::size_t outside, std::size_t room)
    : n_(n),
      all_(n + outside),
      most_(all_ + room),
      arcs_(arcs),
      slots_(slots(n, arcs_)),
      workspace_(workspace_bytes(n, arcs_, most_)),
      order_(workspace_.for_call<std::uint32_t>(most_)) {}

/// Allocates the arrays other than order_. Initialises is_changed_ and the numbers of nodes outside only.
void MovingMesh::keep_arrays() {
  inside_ = workspace_.for_call<std::uint32_t>(most_);
  nodes_ = workspace_.for_call<Point>(most_);
  stars_ = workspace_.for_call<Star>(n_);
  rings_ = workspace_.for_call<CurveNode>(slots_);
  is_changed_ = workspace_.for_call<std::uint8_t>(n_);
  std::fill_n(is_changed_, n_, std::uint8_t{0});
  for (std::size_t v = n_; v < most_; ++v) order_[v] = inside_[v] = static_cast<CurveNode>(v);
}

MovingMesh::MovingMesh(const Point* p, std::size_t n, const std::int32_t* list, const std::int32_t* lend,
                       std::size_t outside, std::size_t room)
    : MovingMesh(n, n == 0 ? 0 : static_cast<std::size_t>(lend[n - 1]), outside, room) {
  if (n > 0) insertion_order(p, n, order_, workspace_);
  workspace_.next_phase();
  keep_arrays();
  parallel_for(n, n, [&](std::size_t v) {
    inside_[order_[v]] = static_cast<CurveNode>(v);
    nodes_[v] = p[order_[v]];
  });
  std::copy(p + n, p + all_, nodes_ + n);
  const auto slot = [&](std::size_t k) { return static_cast<std::size_t>(k == 0 ? 0 : lend[k - 1]); };
  constexpr std::size_t kAhead = 16;
  lay_rings(
      [&](std::size_t v) {
        if (v + kAhead < n_) __builtin_prefetch(lend + order_[v + kAhead]);
        return slot(order_[v] + std::size_t{1}) - slot(order_[v]);
      },
      [&](std::size_t v, CurveNode* ring) {
        if (v + 2 * kAhead < n_) __builtin_prefetch(lend + order_[v + 2 * kAhead]);
        if (v + kAhead < n_) __builtin_prefetch(list + slot(order_[v + kAhead]));
        std::transform(list + slot(order_[v]), list + lend[order_[v]], ring,
                       [&](std::int32_t k) { return inside_[k - 1]; });
      });
}

/// Nodes that had stars keep their order, so that neighbours stay close in memory; the others follow.
MovingMesh::MovingMesh(const MovingMesh& last, std::size_t n, std::size_t arcs, std::size_t outside,
                       std::size_t room, const MeshNode* to, const MoreStars& more)
    : MovingMesh(n, arcs, outside, room) {
  keep_arrays();
  std::fill_n(nodes_, all_, Point{});
  BlockArray<CurveNode> now(last.all_), from(n);  // new number of a node of `last`, and the inverse
  std::uint32_t stay = 0;
  for (CurveNode v = 0; v < last.n_; ++v) {
    const MeshNode k = to[last.order_[v]];
    now[v] = k;
    if (k >= n) continue;
    order_[stay] = k;
    inside_[k] = stay;
    from[stay] = v;
    now[v] = stay++;
  }
  for (std::size_t i = 0; i < more.node.size(); ++i) {
    order_[stay + i] = more.node[i];
    inside_[more.node[i]] = static_cast<CurveNode>(stay + i);
  }
  for (std::size_t v = last.n_; v < last.all_; ++v) now[v] = to[v] < n ? inside_[to[v]] : to[v];
  lay_rings(
      [&](std::size_t v) {
        return v < stay ? std::size_t{last.stars_[from[v]].count} : more.count(v - stay);
      },
      [&](std::size_t v, CurveNode* ring) {
        if (v < stay) {
          const Star& star = last.stars_[from[v]];
          const CurveNode* const old = last.rings_ + star.begin;
          std::transform(old, old + star.count, ring, [&](CurveNode w) { return now[w]; });
        } else {
          const MeshNode* const end = more.ring.data() + more.end[v - stay];
          std::transform(end - more.count(v - stay), end, ring, [&](MeshNode k) { return inside_[k]; });
        }
      });
}

MovingMesh::Moved MovingMesh::move(const NodeArrays& nodes, Confirm confirm) {
  constexpr std::size_t kAhead = 16;
  std::atomic<bool> all_fit{true}, any_has_moved{false};
  nodes.visit([&](const auto& position) {
    parallel_pieces(n_, threads_for(n_), [&](std::size_t first, std::size_t last, int) {
      bool fit = true, has_moved = false;
      for (std::size_t k = first; k < last; ++k) {
        if (k + kAhead < last) __builtin_prefetch(&node(k + kAhead), 1);
        const Point p = position(k);
        fit = fit & has_length_for(confirm, p);
        has_moved = has_moved | (node(k) != p);
        node(k) = p;
      }
      if (!fit) all_fit = false;
      if (has_moved) any_has_moved = true;
    });
  });
  return {all_fit, any_has_moved};
}

void MovingMesh::forget_changes() {
  for (const CurveNode v : changed_) is_changed_[v] = 0;
  changed_.clear();
  // The rings that one call makes longer need room at the end. If there is little left, lay all anew.
  if (end_ + n_ / 2 <= slots_) return;
  try {
    BlockArray<CurveNode> before(end_);
    BlockArray<Star> stars(n_);
    std::copy_n(rings_, end_, before.data());
    std::copy_n(stars_, n_, stars.data());
    lay_rings([&](std::size_t v) { return std::size_t{stars[v].count}; },
              [&](std::size_t v, CurveNode* ring) {
                std::copy_n(before.data() + stars[v].begin, stars[v].count, ring);
              });
  } catch (const std::bad_alloc&) {
    // No memory: the rings stay where they are.
  }
}

/// Lays out all rings, each with one free slot behind it. write(v, ring) writes the count(v) neighbours of v.
template <class Count, class Write>
void MovingMesh::lay_rings(const Count& count, const Write& write) {
  const int threads = threads_for(n_);
  std::vector<std::size_t> begin(static_cast<std::size_t>(threads) + 1);
  parallel_pieces(n_, threads, [&](std::size_t first, std::size_t last, int piece) {
    std::size_t sum = 0;
    for (std::size_t v = first; v < last; ++v) sum += count(v) + 1;
    begin[static_cast<std::size_t>(piece) + 1] = sum;
  });
  for (std::size_t t = 1; t < begin.size(); ++t) begin[t] += begin[t - 1];
  parallel_pieces(n_, threads, [&](std::size_t first, std::size_t last, int piece) {
    std::size_t at = begin[static_cast<std::size_t>(piece)];
    for (std::size_t v = first; v < last; ++v) {
      stars_[v] = {static_cast<std::uint32_t>(at), static_cast<std::uint32_t>(count(v))};
      write(v, rings_ + at);
      at += stars_[v].count;
      rings_[at++] = kFree;
    }
  });
  end_ = begin.back();
  rings_[end_++] = kTaken;
}

// ---- 1: the tests ---------------------------------------------------------------------------------------

namespace {

/// Stars with more neighbours are tested exactly.
constexpr std::uint32_t kMost = 28;

using Two = double __attribute__((vector_size(16)));
using TwoMasks = decltype(Two{} > Two{});

Two two_at(const double* from) {
  Two two;
  std::memcpy(&two, from, sizeof two);
  return two;
}

/// Most by which the volume det(b-a, c-a, d-a) of four nodes changes if they move to their directions, where
/// no component of the three differences is more than R in magnitude, R^2 = square, and no length differs
/// from 1 by more than 2^-49.9: to first order that difference times the sum of the four determinants of
/// three nodes, each at most the cross product of two edges: |b-a||c-a| <= 3 R^2, and three of them for that
/// of b, c, d: 18 R^2.
double volume_of_lengths(double square) { return 0x1p-45 * square; }

/// The neighbours of a node relative to it, counterclockwise, with the first three repeated at the end, so
/// that two neighbours can be tested at a time.
struct Spokes {
  double x[kMost + 4], y[kMost + 4], z[kMost + 4];
  double reach;  ///< the largest absolute value of a component

  void look(const Point* nodes, const Point& p, const CurveNode* ring, std::uint32_t count) {
    double most_x = 0, most_y = 0, most_z = 0;
    for (std::uint32_t i = 0; i < count; ++i) {
      const Point d = minus(nodes[ring[i]], p);
      x[i] = d.x, y[i] = d.y, z[i] = d.z;
      most_x = std::max(most_x, std::fabs(d.x));
      most_y = std::max(most_y, std::fabs(d.y));
      most_z = std::max(most_z, std::fabs(d.z));
    }
    for (std::uint32_t i = 0; i < 3; ++i) x[count + i] = x[i], y[count + i] = y[i], z[count + i] = z[i];
    reach = std::max(most_x, std::max(most_y, most_z));
  }

  /// True if all triangles of the star are certainly counterclockwise and all its arcs are certainly locally
  /// Delaunay. With e, f, g three consecutive spokes of the node at p:
  ///
  ///        g    f           (e x f).p > 0: the triangle p, p+e, p+f is counterclockwise
  ///         \   |   e       (e x f).g < 0: g is below its plane
  ///          \  |  /
  ///            p
  ///
  /// Every product of three components is at most R^3, or 1.001 R^2 where p is one of the factors, and six of
  /// them make a determinant, which carries 8 roundings (predicates.cpp, kFactor): its error is less than 9u
  /// 6.01 R^3 < 64u R^3, u = 2^-53, which covers the rounding of the two products below. What underflows is
  /// less than 1e-250.
  ///
  /// Under Confirm::directions the signs must also be those of the directions, to which nodes move by less
  /// than 2^-49.9 along themselves: see volume_of_lengths().
  bool are_certain(const Point& p, std::uint32_t count, Confirm confirm) const {
    const double square = reach * reach, low = 0x1p-47 * square + 1e-250,
                 high = 0x1p-47 * (square * reach) + 1e-250 +
                        (confirm == Confirm::directions ? volume_of_lengths(square) : 0);
    TwoMasks certain = Two{} == Two{};
    for (std::uint32_t i = 0; i < count; i += 2) {
      const Two ex = two_at(x + i), ey = two_at(y + i), ez = two_at(z + i);
      const Two fx = two_at(x + i + 1), fy = two_at(y + i + 1), fz = two_at(z + i + 1);
      const Two gx = two_at(x + i + 2), gy = two_at(y + i + 2), gz = two_at(z + i + 2);
      const Two nx = ey * fz - ez * fy, ny = ez * fx - ex * fz, nz = ex * fy - ey * fx;
      certain &= (nx * p.x + ny * p.y + nz * p.z > low) & (nx * gx + ny * gy + nz * gz < -high);
    }
    return (certain[0] & certain[1]) != 0;
  }
};

}  // namespace

/// Tries the centroids of a few triangles: the direction must be strictly inside, by exact signs.
bool MovingMesh::choose_mark(Mark& mark) const {
  constexpr std::uint32_t kTries = 16;
  for (CurveNode v = 0; v < std::min<std::size_t>(n_, kTries); ++v) {
    const CurveNode* const ring = rings_ + stars_[v].begin;
    mark = {{order_[v], order_[ring[0]], order_[ring[1]]}, {}};
    const Point &a = nodes_[v], &b = nodes_[ring[0]], &c = nodes_[ring[1]];
    const Point sum{a.x + b.x + c.x, a.y + b.y + c.y, a.z + b.z + c.z};
    const double length = std::sqrt(dot(sum, sum));
    const Point& g = mark.towards = {sum.x / length, sum.y / length, sum.z / length};
    if (has_direction(g) && left(a, b, g) > 0 && left(b, c, g) > 0 && left(c, a, g) > 0) return true;
  }
  return false;
}

/// Tests the stars first..last-1 and appends arcs that are not locally Delaunay to `suspects`; each arc is
/// tested at one of its ends at least. Returns false if a triangle is not counterclockwise, or if one other
/// than the mark's contains the direction g of the mark.
///
/// Only triangles near g can contain it. Let R be the reach of a star; |g| and the lengths of nodes are 1
/// within 1e-6. The ray towards g meets a triangle v,a,b in a point q, |q-v| <= max(|a-v|, |b-v|) <= 1.74 R.
/// From |q|^2 = sum of l_i |p_i|^2 - sum of l_i l_j |p_i-p_j|^2, l the barycentric coordinates of q, follows
/// 1 - |q| <= 4 R^2 + 3e-6, so |g-v| <= 2 R + 4e-6 where R <= 1/16.
bool MovingMesh::test(std::size_t first, std::size_t last, const Mark& mark, const std::atomic<bool>& stopped,
                      std::vector<Arc>& suspects) const {
  Spokes spokes;
  const Point g = mark.towards;
  for (std::size_t v = first; v < last; ++v) {
    const Star star = stars_[v];
    const Point p = nodes_[v];
    bool is_certain = false;
    if (star.count <= kMost) {
      spokes.look(nodes_, p, rings_ + star.begin, star.count);
      const double reach = spokes.reach, near = 2 * reach + 4e-6;
      const bool is_far =
          std::fabs(p.x - g.x) > near || std::fabs(p.y - g.y) > near || std::fabs(p.z - g.z) > near;
      is_certain = is_far && reach <= 0x1p-4 && spokes.are_certain(p, star.count, confirm_);
    }
    if (is_certain) continue;
    if (stopped.load(std::memory_order_relaxed) || !examine(static_cast<CurveNode>(v), mark, suspects))
      return false;
  }
  return true;
}

/// The same for one star, exactly. It tests each triangle at its lowest corner and each arc at its lower end,
/// unless the star of that node was certain.
bool MovingMesh::examine(CurveNode v, const Mark& mark, std::vector<Arc>& suspects) const {
  const Coordinates predicates(nodes_, all_);
  const auto id = [](CurveNode w) { return static_cast<index_t>(w); };
  const auto is_corner_of_mark = [&](CurveNode w) {
    return w == mark.corner[0] || w == mark.corner[1] || w == mark.corner[2];
  };
  const Star star = stars_[v];
  const CurveNode* const ring = rings_ + star.begin;
  CurveNode c = ring[star.count - 1];
  for (std::uint32_t i = 0; i < star.count; ++i) {
    const CurveNode b = ring[i], d = ring[i + 1 < star.count ? i + 1 : 0];
    if (v < c && v < b) {
      if (predicates.left(id(v), id(c), id(b)) <= 0) return false;
      const Point &p = nodes_[v], &q = nodes_[c], &r = nodes_[b], &g = mark.towards;
      if (!(is_corner_of_mark(v) && is_corner_of_mark(c) && is_corner_of_mark(b)) && left(p, q, g) >= 0 &&
          left(q, r, g) >= 0 && left(r, p, g) >= 0)
        return false;
    }
    bool differs = false;
    if (v < b && is_above(v, c, b, d, differs)) suspects.push_back({v, b});
    if (differs) return false;
    c = b;
  }
  return true;
}

/// Whether d is above the triangle a,b,c. Sets `differs` under Confirm::directions if the directions decide
/// otherwise.
bool MovingMesh::is_above(CurveNode a, CurveNode b, CurveNode c, CurveNode d, bool& differs) const {
  const auto id = [](CurveNode w) { return static_cast<index_t>(w); };
  const bool above = Coordinates(nodes_, all_).above(id(a), id(b), id(c), id(d));
  if (confirm_ == Confirm::nothing) return above;
  const Point &p = nodes_[a], e = minus(nodes_[b], p), f = minus(nodes_[c], p), g = minus(nodes_[d], p);
  double reach = 0;
  for (const Point& s : {e, f, g}) reach = std::max({reach, std::fabs(s.x), std::fabs(s.y), std::fabs(s.z)});
  const double square = reach * reach;
  const bool is_certain =
      std::fabs(dot(cross(e, f), g)) > 0x1p-47 * (square * reach) + 1e-250 + volume_of_lengths(square);
  if (!is_certain && above != above_of_directions(p, nodes_[b], nodes_[c], nodes_[d])) differs = true;
  return above;
}

bool MovingMesh::repair(Confirm confirm) {
  Mark mark;
  std::vector<Quadrangle> across;
  begin(confirm);
  return choose_mark(mark) && test(mark) && flip_inside(across) && !differs_;
}

bool MovingMesh::test(const Mark& given) {
  flips_ = 0;
  work_ = 8 * n_ + 1000;  // with more work a new triangulation is faster
  Mark mark = given;
  for (CurveNode& corner : mark.corner) corner = inside(corner);
  const int threads = threads_for(n_);
  std::atomic<bool> stopped{false};
  std::vector<std::vector<Arc>> suspects(static_cast<std::size_t>(threads));
  ErrorsOfThreads errors(suspects.size());
  parallel_pieces(n_, threads, [&](std::size_t first, std::size_t last, int piece) {
    const auto t = static_cast<std::size_t>(piece);
    errors.keep(t, [&] {
      if (!test(first, last, mark, stopped, suspects[t])) stopped = true;
    });
  });
  errors.rethrow();
  if (stopped) return false;
  suspects_.clear();
  across_.clear();
  for (const auto& some : suspects) suspects_.insert(suspects_.end(), some.begin(), some.end());
  return true;
}

// ---- 2: flips -------------------------------------------------------------------------------------------

/// The loop ends, because every flip moves the surface outwards. Returns false if the work is too much, or
/// an arc cannot be flipped.
bool MovingMesh::flip_inside(std::vector<Quadrangle>& across) {
  Quadrangle q;
  while (!suspects_.empty()) {
    const Arc arc = suspects_.back();
    suspects_.pop_back();
    if (!find(arc, q)) continue;
    if (is_outside(q.b) || is_outside(q.c) || is_outside(q.d))
      across_.push_back(arc);
    else if (!is_convex_inside(q) || !flip_here(q))
      return false;
  }
  // Remove duplicates. Later flips may have changed the triangle inside, so each arc is tested again; the
  // triangle outside is unchanged.
  for (Arc& arc : across_)
    if (arc.b < arc.a) std::swap(arc.a, arc.b);  // nodes outside come behind the others
  std::sort(across_.begin(), across_.end(),
            [](const Arc& s, const Arc& t) { return s.a != t.a ? s.a < t.a : s.b < t.b; });
  across_.erase(std::unique(across_.begin(), across_.end(),
                            [](const Arc& s, const Arc& t) { return s.a == t.a && s.b == t.b; }),
                across_.end());
  for (const Arc& arc : across_)
    if (find(arc, q)) across.push_back({order_[q.a], order_[q.b], order_[q.c], order_[q.d]});
  across_.clear();
  return true;
}

/// Returns false if the arc no longer exists or is locally Delaunay.
bool MovingMesh::find(const Arc& arc, Quadrangle& q) {
  const Star star = stars_[arc.a];
  const CurveNode* const ring = rings_ + star.begin;
  const std::uint32_t at = place_of(arc.b, star);
  if (at == star.count) return false;
  q = {arc.a, arc.b, ring[at == 0 ? star.count - 1 : at - 1], ring[at + 1 == star.count ? 0 : at + 1]};
  return is_above(q.a, q.c, q.b, q.d, differs_);
}

bool MovingMesh::is_convex_inside(const Quadrangle& q) const {
  const Point &a = nodes_[q.a], &b = nodes_[q.b], &c = nodes_[q.c], &d = nodes_[q.d];
  return left(a, c, d) > 0 && left(b, d, c) > 0;
}

bool MovingMesh::is_convex(const Quadrangle& q) const {
  return is_convex_inside({inside(q.a), inside(q.b), inside(q.c), inside(q.d)});
}

bool MovingMesh::flip(const Quadrangle& q) {
  return flip_here({inside(q.a), inside(q.b), inside(q.c), inside(q.d)});
}

///          b                   b
///        / | \               /   \        The arc a-b is replaced by c-d if d is above the triangle a,c,b.
///      d   |   c    ->     d ----- c      The triangles a,c,d and b,d,c must be counterclockwise: then they
///        \ | /               \   /        cover the quadrangle once, as before.
///          a                   a
bool MovingMesh::flip_here(const Quadrangle& q) {
  const auto [a, b, c, d] = q;
  const auto has_star = [&](CurveNode v) { return !is_outside(v); };
  std::size_t cost = 8;
  for (const CurveNode v : {a, b, c, d}) cost += has_star(v) ? stars_[v].count : 0;
  if (cost > work_) return false;
  work_ -= cost;
  if (has_star(a)) remove(a, place_of(b, stars_[a]));
  if (has_star(b)) remove(b, place_of(a, stars_[b]));
  if (has_star(c) && !insert(c, place_of(a, stars_[c]), d)) return false;
  if (has_star(d) && !insert(d, place_of(b, stars_[d]), c)) return false;
  for (const CurveNode v : {a, b, c, d})
    if (has_star(v)) note_change(v);
  for (const Arc& arc : {Arc{a, c}, Arc{c, b}, Arc{b, d}, Arc{d, a}}) suspect_inside(arc.a, arc.b);
  ++flips_;
  return true;
}

void MovingMesh::suspect_inside(CurveNode a, CurveNode b) {
  if (is_outside(a)) std::swap(a, b);
  if (!is_outside(a)) suspects_.push_back({a, b});
}

void MovingMesh::suspect(MeshNode a, MeshNode b) { suspect_inside(inside(a), inside(b)); }

MeshNode MovingMesh::add_outside(const Point& p) {
  if (all_ == most_) return kNobody;
  nodes_[all_] = p;
  return static_cast<MeshNode>(all_++);
}

std::uint32_t MovingMesh::place_of(CurveNode b, const Star& star) const {
  const CurveNode* const ring = rings_ + star.begin;
  return static_cast<std::uint32_t>(std::find(ring, ring + star.count, b) - ring);
}

/// Inserts a neighbour of v before the one at `place`. Returns false if there is no room.
bool MovingMesh::insert(CurveNode v, std::uint32_t place, CurveNode neighbour) {
  Star& star = stars_[v];
  if (rings_[star.begin + star.count] != kFree) {
    const std::size_t room = 2 * std::size_t{star.count};
    if (end_ + room + 1 > slots_) return false;
    std::copy_n(rings_ + star.begin, star.count, rings_ + end_);
    std::fill_n(rings_ + end_ + star.count, room - star.count, kFree);
    star.begin = static_cast<std::uint32_t>(end_);
    end_ += room;
    rings_[end_++] = kTaken;
  }
  CurveNode* const ring = rings_ + star.begin;
  std::copy_backward(ring + place, ring + star.count, ring + star.count + 1);
  ring[place] = neighbour;
  ++star.count;
  return true;
}

void MovingMesh::remove(CurveNode v, std::uint32_t place) {
  Star& star = stars_[v];
  CurveNode* const ring = rings_ + star.begin;
  std::copy(ring + place + 1, ring + star.count, ring + place);
  ring[--star.count] = kFree;
}

void MovingMesh::note_change(CurveNode v) {
  if (is_changed_[v] != 0) return;
  changed_.push_back(v);
  is_changed_[v] = 1;
}

// ---- changed rings --------------------------------------------------------------------------------------

std::vector<MovingMesh::Change> MovingMesh::changes() const {
  std::vector<Change> all(changed_.size());
  for (std::size_t i = 0; i < all.size(); ++i) all[i] = {order_[changed_[i]], stars_[changed_[i]].count};
  std::sort(all.begin(), all.end(), [](const Change& a, const Change& b) { return a.node < b.node; });
  return all;
}

void MovingMesh::write_ring(std::size_t k, std::int32_t* list) const {
  const Star star = stars_[inside_[k]];
  std::transform(rings_ + star.begin, rings_ + star.begin + star.count, list,
                 [&](CurveNode v) { return static_cast<std::int32_t>(order_[v]) + 1; });
  std::rotate(list, std::min_element(list, list + star.count), list + star.count);
}

}  // namespace pstripack
