#include "mesh/validate.h"

#include <algorithm>
#include <numeric>
#include <utility>
#include <vector>

#include "base/parallel_for.h"

namespace pstripack {
namespace {

constexpr index_t kNone = -1;

Verdict defect(Defect d, const std::string& what, std::initializer_list<index_t> nodes) {
  Verdict v;
  v.defect = d;
  v.message = what + ":";
  std::copy(nodes.begin(), nodes.end(), v.node.begin());
  for (const index_t node : nodes) v.message += " " + std::to_string(static_cast<long long>(node) + 1);
  return v;
}

/// The star of every node: for each triangle (v,b,c) at v the pair b -> c, sorted by b.
class CornersOfNodes {
 public:
  struct Pair {
    index_t b, c;
  };

  CornersOfNodes(std::size_t n, const Triangle* triangles, std::size_t count)
      : begin_(n + 1, 0), pairs_(3 * count) {
    for (std::size_t t = 0; t < count; ++t)
      for (const index_t v : triangles[t]) ++begin_[static_cast<std::size_t>(v) + 1];
    std::partial_sum(begin_.begin(), begin_.end(), begin_.begin());
    std::vector<std::size_t> next(begin_.begin(), begin_.end() - 1);
    for (std::size_t t = 0; t < count; ++t) {
      const auto [a, b, c] = triangles[t];
      pairs_[next[static_cast<std::size_t>(a)]++] = {b, c};
      pairs_[next[static_cast<std::size_t>(b)]++] = {c, a};
      pairs_[next[static_cast<std::size_t>(c)]++] = {a, b};
    }
    for (std::size_t v = 0; v < n; ++v)
      std::sort(begin(v), end(v), [](const Pair& s, const Pair& t) { return s.b < t.b; });
  }

  Pair* begin(std::size_t v) { return pairs_.data() + begin_[v]; }
  Pair* end(std::size_t v) { return pairs_.data() + begin_[v + 1]; }
  std::size_t degree(std::size_t v) const { return begin_[v + 1] - begin_[v]; }

  /// The third corner of the triangle left of v -> b, kNone if there is none.
  index_t beyond(index_t v, index_t b) {
    Pair* const last = end(static_cast<std::size_t>(v));
    Pair* const p = std::lower_bound(begin(static_cast<std::size_t>(v)), last, b,
                                     [](const Pair& s, index_t value) { return s.b < value; });
    return p != last && p->b == b ? p->c : kNone;
  }

 private:
  std::vector<std::size_t> begin_;
  std::vector<Pair> pairs_;
};

/// The neighbours of v counterclockwise into `ring`; `closed` if the star has no gap. False if the star is
/// not one cycle or one fan.
bool ring_of(CornersOfNodes& stars, index_t v, std::vector<index_t>& ring, bool& closed) {
  const auto s = static_cast<std::size_t>(v);
  // A fan starts at the neighbour that no triangle of the star ends at.
  std::vector<index_t>& ends = ring;
  ends.clear();
  for (const auto* p = stars.begin(s); p != stars.end(s); ++p) ends.push_back(p->c);
  std::sort(ends.begin(), ends.end());
  index_t start = kNone;
  std::size_t starts = 0;
  for (const auto* p = stars.begin(s); p != stars.end(s); ++p)
    if (!std::binary_search(ends.begin(), ends.end(), p->b)) start = p->b, ++starts;
  if (starts > 1) return false;
  closed = starts == 0;
  if (closed) start = stars.begin(s)->b;
  ring.clear();
  index_t b = start;
  do {
    ring.push_back(b);
    b = stars.beyond(v, b);
  } while (b != kNone && b != start && ring.size() <= stars.degree(s));
  return closed ? ring.size() == stars.degree(s) : b == kNone && ring.size() == stars.degree(s) + 1;
}

class Star {
 public:
  Star(const StarTable& stars, index_t v)
      : begin_(stars.to.data() + stars.begin[static_cast<std::size_t>(v)]),
        size_(stars.begin[static_cast<std::size_t>(v) + 1] - stars.begin[static_cast<std::size_t>(v)]),
        is_fan_(begin_[size_ - 1] < 0) {}
  std::size_t size() const { return size_; }
  std::size_t triangles() const { return is_fan_ ? size_ - 1 : size_; }
  bool is_fan() const { return is_fan_; }
  index_t operator[](std::size_t i) const { return begin_[i] < 0 ? ~begin_[i] : begin_[i]; }
  index_t after(std::size_t i) const { return (*this)[i + 1 == size_ ? 0 : i + 1]; }
  index_t before(std::size_t i) const { return (*this)[i == 0 ? size_ - 1 : i - 1]; }
  /// True if there are triangles on both sides of the arc to neighbour i.
  bool has_both_sides(std::size_t i) const { return !is_fan_ || (i > 0 && i + 1 < size_); }

 private:
  const index_t* begin_;
  std::size_t size_;
  bool is_fan_;
};

template <class Predicates>
Verdict check_triangles(const Predicates& predicates, index_t v, const Star& star) {
  for (std::size_t i = 0; i < star.triangles(); ++i) {
    const index_t b = star[i], c = star.after(i);
    if (v > b || v > c) continue;  // each triangle once
    for (const auto& [d, e] : {std::pair{v, b}, {b, c}, {c, v}})
      if (predicates.coincide(d, e))
        return defect(Defect::coincident_nodes, "nodes of one triangle coincide", {d, e});
    if (predicates.left(v, b, c) <= 0)
      return defect(Defect::orientation, "triangle is not strictly counterclockwise", {v, b, c});
  }
  return {};
}

/// All triangles are counterclockwise, so each has an angle of less than 180 degrees at v. So the side of
/// the arc from v to its first neighbour on which each other neighbour lies shows how often the star winds.
/// A star winds once if these sides are: left, at most one exactly opposite, then right, and never left
/// again.
template <class Predicates>
Verdict check_winding(const Predicates& predicates, index_t v, const Star& star) {
  bool on_the_right = false;
  for (std::size_t i = 1; i < star.size(); ++i) {
    const int side = predicates.left(v, star[0], star[i]);
    if (star.is_fan() && (side < 0 || (side == 0 && i + 1 < star.size())))
      return defect(Defect::not_convex, "boundary is not convex at node", {v, star[0], star.before(0)});
    if (on_the_right && side >= 0)
      return defect(Defect::not_covered_once, "triangles wind more than once around node", {v});
    on_the_right = on_the_right || side <= 0;
  }
  return {};
}

template <class Predicates>
Verdict check_arcs(const Predicates& predicates, index_t v, const Star& star, Ties ties) {
  for (std::size_t i = 0; i < star.size(); ++i) {
    const index_t b = star[i];
    if (v > b || !star.has_both_sides(i)) continue;  // each arc once
    const index_t c = star.after(i), d = star.before(i);
    if (ties == Ties::by_rule ? predicates.above(v, b, c, d) : predicates.strictly_above(v, b, c, d))
      return defect(Defect::not_delaunay, "arc is not locally Delaunay (arc, opposite nodes)", {v, b, c, d});
  }
  return {};
}

/// All tests that use the predicates. If several fail, the defect of the first test is reported, because
/// later tests are meaningful only if earlier ones pass.
template <class Predicates>
Verdict check_geometry(const Predicates& predicates, const StarTable& stars, Ties ties) {
  constexpr std::size_t kTests = 3, kAhead = 8;
  const int threads = threads_for(10 * stars.size());
  std::vector<Verdict> found(kTests * static_cast<std::size_t>(threads));
  ErrorsOfThreads errors(static_cast<std::size_t>(threads));
  parallel_pieces(stars.size(), threads, [&](std::size_t first, std::size_t last, int piece) {
    errors.keep(static_cast<std::size_t>(piece), [&] {
      Verdict* const verdicts = found.data() + kTests * static_cast<std::size_t>(piece);
      std::size_t tests = kTests;  // tests still to be made
      for (std::size_t v = first; v < last; ++v) {
        if (v + kAhead < last)
          for (std::size_t i = stars.begin[v + kAhead]; i < stars.begin[v + kAhead + 1]; ++i)
            __builtin_prefetch(&predicates.position(stars.to[i] < 0 ? ~stars.to[i] : stars.to[i]));
        const auto node = static_cast<index_t>(v);
        const Star star(stars, node);
        for (std::size_t test = 0; test < tests; ++test) {
          Verdict verdict = test == 0   ? check_triangles(predicates, node, star)
                            : test == 1 ? check_winding(predicates, node, star)
                                        : check_arcs(predicates, node, star, ties);
          if (verdict) continue;
          verdicts[test] = std::move(verdict);
          tests = test;
        }
      }
    });
  });
  errors.rethrow();
  for (std::size_t test = 0; test < kTests; ++test)
    for (std::size_t piece = 0; piece < static_cast<std::size_t>(threads); ++piece)
      if (const Verdict& v = found[kTests * piece + test]; !v) return v;
  return {};
}

/// Writes the star of every node to `stars`. A defect if the triangles at a node are not one cycle or one
/// fan.
Verdict find_stars(CornersOfNodes& corners, StarTable& stars) {
  std::vector<index_t> ring;
  std::size_t end = 0;
  stars.begin[0] = 0;
  for (std::size_t s = 0; s < stars.size(); ++s) {
    const auto v = static_cast<index_t>(s);
    if (corners.degree(s) == 0) return defect(Defect::missing_node, "node is in no triangle", {v});
    for (auto* p = corners.begin(s); p + 1 < corners.end(s); ++p)
      if (p[0].b == p[1].b)
        return defect(Defect::not_manifold, "arc has two triangles on one side (arc, opposite nodes)",
                      {v, p[0].b, p[0].c, p[1].c});
    bool closed = false;
    if (!ring_of(corners, v, ring, closed))
      return defect(Defect::not_manifold, "triangles around node are not one cycle or one fan", {v});
    if (!closed) ring.back() = ~ring.back();
    std::copy(ring.begin(), ring.end(), stars.to.begin() + end);
    end += ring.size();
    stars.begin[s + 1] = static_cast<std::uint32_t>(end);
  }
  return {};
}

Verdict check_directions(const Point* p, std::size_t n) {
  const Point* const bad = std::find_if_not(p, p + n, has_direction);
  return bad == p + n ? Verdict{}
                      : defect(Defect::malformed, "node has no direction", {static_cast<index_t>(bad - p)});
}

}  // namespace

Verdict check_surface(const StarTable& stars) {
  const std::size_t n = stars.size();
  std::size_t boundary_arcs = 0, components = n;
  std::vector<index_t> root(n);
  std::iota(root.begin(), root.end(), 0);
  const auto find = [&](index_t v) {
    while (root[static_cast<std::size_t>(v)] != v)
      v = root[static_cast<std::size_t>(v)] =
          root[static_cast<std::size_t>(root[static_cast<std::size_t>(v)])];
    return v;
  };
  for (std::size_t v = 0; v < n; ++v) {
    const Star star(stars, static_cast<index_t>(v));
    boundary_arcs += star.is_fan() ? 1 : 0;  // a boundary node starts exactly one
    for (std::size_t i = 0; i < star.size(); ++i) {
      if (star[i] > static_cast<index_t>(v)) continue;  // each arc once
      const index_t a = find(static_cast<index_t>(v)), b = find(star[i]);
      if (a != b) root[static_cast<std::size_t>(a)] = b, --components;
    }
  }
  // V - E + F with 2 E = 3 F + boundary arcs; a node has as many triangles as neighbours, at the boundary one
  // fewer.
  const std::size_t triangles = (stars.begin[n] - boundary_arcs) / 3;
  const auto euler2 = 2 * static_cast<std::ptrdiff_t>(n) - static_cast<std::ptrdiff_t>(triangles) -
                      static_cast<std::ptrdiff_t>(boundary_arcs);
  if (components != 1 || euler2 != (boundary_arcs == 0 ? 4 : 2)) {
    Verdict v = defect(Defect::not_covered_once, "", {});
    v.message = "the surface is not one sphere or one disc: " + std::to_string(components) +
                " component(s), 2(V-E+F) = " + std::to_string(euler2) + ", " + std::to_string(boundary_arcs) +
                " boundary arcs";
    return v;
  }
  return {};
}

Verdict is_valid(const Point* p, const StarTable& stars, Lengths lengths, Ties ties) {
  const std::size_t n = stars.size();
  if (Verdict v = check_directions(p, n); !v) return v;
  if (Verdict v = check_surface(stars); !v) return v;

  Verdict as_given;
  if (lengths != Lengths::directions &&
      (lengths == Lengths::as_given || std::all_of(p, p + n, length_is_one))) {
    as_given = check_geometry(Coordinates(p, n), stars, ties);
    if (as_given || lengths == Lengths::as_given) return as_given;
  }
  Verdict directions = check_geometry(Directions(p, n), stars, ties);
  directions.lengths = Lengths::directions;
  // Invalid with both sets of predicates: report the defect found with Coordinates if they were used.
  return directions || as_given ? directions : as_given;
}

Verdict is_valid(const Point* p, std::size_t n, const Triangle* triangles, std::size_t count, Lengths lengths,
                 Ties ties) {
  if (n < 3) return defect(Defect::malformed, "fewer than three nodes", {});
  for (std::size_t t = 0; t < count; ++t) {
    const auto [a, b, c] = triangles[t];
    for (const index_t v : {a, b, c})
      if (v < 0 || static_cast<std::size_t>(v) >= n)
        return defect(Defect::malformed, "triangle with a node out of range", {a, b, c});
    if (a == b || b == c || c == a)
      return defect(Defect::malformed, "triangle with one node twice", {a, b, c});
  }
  CornersOfNodes corners(n, triangles, count);
  StarTable stars(n, 6 * count);  // per triangle three neighbours, and at most three that end a fan
  if (Verdict v = find_stars(corners, stars); !v) return v;
  return is_valid(p, stars, lengths, ties);
}

const char* name(Defect defect) {
  switch (defect) {
    case Defect::none:
      return "none";
    case Defect::malformed:
      return "malformed";
    case Defect::not_manifold:
      return "not manifold";
    case Defect::missing_node:
      return "missing node";
    case Defect::coincident_nodes:
      return "coincident nodes";
    case Defect::orientation:
      return "orientation";
    case Defect::not_delaunay:
      return "not Delaunay";
    case Defect::not_covered_once:
      return "not covered once";
    case Defect::not_convex:
      return "not convex";
  }
  return "unknown";
}

}  // namespace pstripack
