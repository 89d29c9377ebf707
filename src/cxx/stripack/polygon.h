#pragma once
// INTRSC, INSIDE: arcs that cross, and points in polygons on the sphere.
// For Real = float, double and Int = int32_t, int64_t. The method: Renka, ACM TOMS 23 (1997), Algorithm 772.

#include <algorithm>
#include <cmath>
#include <vector>

#include "capi/pstripack.h"
#include "geometry/predicates.h"
#include "stripack/expressions.h"
#include "stripack/original/original_rules.h"

namespace pstripack {

/// IER of INTRSC. The point is written only if `done`.
enum class IntersectionStatus {
  done = 0,
  parallel = 1,   ///< both ends are equally far from the plane: p1 = p2, a zero normal, or no such point
  antipodal = 2,  ///< the ends are opposite each other
  not_finite = PSTRIPACK_BAD_COORDINATE  ///< NaN or infinity in the arguments
};

/// IER of INSIDE.
enum class PolygonStatus {
  done = 0,
  bad_count = 1,          ///< nv < 3 or nv > lv
  bad_vertex = 2,         ///< an entry of listv outside 1..lv
  self_intersecting = 3,  ///< the crossings contradict each other
  no_reference = 4,       ///< no edge gives a usable point inside: P is zero, or aligned with all such points
  not_finite = PSTRIPACK_BAD_COORDINATE  ///< NaN or infinity in P or in a vertex
};

template <class Real>
Vector<Real> operator/(const Vector<Real>& a, Real divisor) {
  return {a.x / divisor, a.y / divisor, a.z / divisor};
}

template <class Real>
Real length(const Vector<Real>& a) {
  return std::sqrt(dot(a, a));
}

template <class Real>
bool is_zero(const Vector<Real>& a) {
  return a.x == 0 && a.y == 0 && a.z == 0;
}

/// INTRSC for finite arguments.
template <class Real>
IntersectionStatus cross_arc(const Vector<Real>& p1, const Vector<Real>& p2, const Vector<Real>& normal,
                             Vector<Real>& point) {
  const Real height_1 = dot(normal, p1), height_2 = dot(normal, p2);
  if (height_1 == height_2) return IntersectionStatus::parallel;
  const Real t = height_1 / (height_1 - height_2);
  const Vector<Real> on_chord = plus(p1, scaled(t, minus(p2, p1)));
  const Real square = dot(on_chord, on_chord);
  if (square == 0) return IntersectionStatus::antipodal;
  point = on_chord / std::sqrt(square);
  return IntersectionStatus::done;
}

/// A point just left of the middle of the arc from a to b; false if a and b have no arc.
template <class Real>
bool left_of_middle(const Vector<Real>& a, const Vector<Real>& b, Vector<Real>& q) {
  const Vector<Real> normal = cross(a, b);
  const Real size = length(normal);
  if (size == 0) return false;
  const Vector<Real> beside = plus(plus(a, b), scaled(Real(1e-3), normal) / size);
  q = beside / length(beside);
  return true;
}

/// INTRSC: the point, of length 1, where the great circle through p1 and p2 crosses the great circle with the
/// given normal (of any length). Of the two such points it is the one nearer to the arc from p1 to p2.
template <class Real>
IntersectionStatus intersection(const Vector<Real>& p1, const Vector<Real>& p2, const Vector<Real>& normal,
                                Vector<Real>& point) {
  if (!is_finite(p1) || !is_finite(p2) || !is_finite(normal)) return IntersectionStatus::not_finite;
  return cross_arc(p1, p2, normal, point);
}

// Start at a point q just inside an edge and follow the great circle to p: p is inside if the number of edges
// crossed on the way is even. The first and the last crossing must agree with that:
//
//              ^
//     inside   |          The crossing nearest to q leads out: its edge runs to its positive end, where
//         q -->|--> p     positive means left of q->p. If it does not, q is taken at another edge.
//              |          The crossing nearest to p leads in or out, according to the parity. If it does
//                         not, the boundary crosses itself.
//
template <class Vertex, class Real, class Int>
PolygonStatus inside_by_rounding(const Vector<Real>& p, Int nv, const Vertex& vertex, bool& result) {
  Vector<Real> crossing{0, 0, 0};  // keeps its value if an edge joins antipodal points
  for (Int edge = 0; edge < nv; ++edge) {
    Vector<Real> q;
    if (!left_of_middle(vertex(edge), vertex(edge + 1 < nv ? edge + 1 : 0), q)) continue;
    const Vector<Real> normal = cross(q, p);
    if (is_zero(normal)) continue;
    const Vector<Real> before_p = cross(p, normal), after_q = cross(normal, q);

    Int crossings = 0;  // of the whole great circle
    bool even = true;   // parity of the crossings of the arc from q to p
    bool q_inside = true, p_inside = true;
    Real nearest_q = -2, nearest_p = -2;
    Vector<Real> v = vertex(nv - 1);
    bool v_positive = dot(normal, v) > 0;
    for (Int k = 0; k < nv; ++k) {
      const Vector<Real> next = vertex(k);
      const bool next_positive = dot(normal, next) > 0;
      if (next_positive != v_positive) {
        ++crossings;
        cross_arc(v, next, normal, crossing);
        if (dot(crossing, after_q) > 0 && dot(crossing, before_p) > 0) {
          even = !even;
          const Real to_q = dot(crossing, q), to_p = dot(crossing, p);
          if (to_q > nearest_q) {
            nearest_q = to_q;
            q_inside = next_positive;
          }
          if (to_p > nearest_p) {
            nearest_p = to_p;
            p_inside = v_positive;
          }
        }
      }
      v = next;
      v_positive = next_positive;
    }
    if (crossings % 2 != 0 || !q_inside) continue;
    if (p_inside != even) return PolygonStatus::self_intersecting;
    result = even;
    return PolygonStatus::done;
  }
  return PolygonStatus::no_reference;
}

/// A polygon whose edges are arcs, by exact signs. The arc from p to the middle m = a + b of an edge a-b,
/// which is an exact sum here, comes to the edge on p's side of it, and changes from inside to outside at
/// each edge that it crosses:
///
///       p - - | - - | - - m     p is inside if it lies left of a->b and crosses an even number of edges,
///                     a -> b    or right of it and an odd number
template <class Vertex, class Int>
class ExactPolygon {
 public:
  ExactPolygon(const Vertex& vertex, Int nv, const Point& p) : vertex_(vertex), nv_(nv), p_(p) {}

  /// Whether p is inside or on the border. False if no edge will do: there is a vertex on the way to each, or
  /// p is on its great circle.
  bool find(bool& is_inside) const {
    for (Int edge = 0; edge < nv_; ++edge) {
      const Answer answer = ask(edge);
      if (answer == Answer::unknown) continue;
      is_inside = answer != Answer::outside;
      return true;
    }
    return false;
  }

  /// True if no two edges without a common vertex cross or touch. Compares edges whose ranges of x overlap:
  /// an arc lies in the ball of which its chord is a diameter. Memory: 24 bytes a vertex.
  bool is_simple() const {
    std::vector<Range> ranges;
    for (Int k = 0; k < nv_; ++k) {
      const Point a = unit_vector(at(k)).high, b = unit_vector(at(k + 1)).high, chord = minus(b, a);
      const double middle = (a.x + b.x) / 2, radius = std::sqrt(dot(chord, chord)) / 2 + 1e-14;
      ranges.push_back({middle - radius, middle + radius, k});
    }
    std::sort(ranges.begin(), ranges.end(), [](const Range& r, const Range& s) { return r.low < s.low; });
    for (auto r = ranges.begin(); r != ranges.end(); ++r)
      for (auto s = r + 1; s != ranges.end() && s->low <= r->high; ++s)
        if (meet(std::min(r->edge, s->edge), std::max(r->edge, s->edge))) return false;
    return true;
  }

 private:
  enum class Answer { inside, outside, on_border, unknown };
  struct Range {
    double low, high;
    Int edge;
  };

  Point at(Int k) const { return as_point(vertex_(k < nv_ ? k : k - nv_)); }

  static double size(const Point& v) { return std::fabs(v.x) + std::fabs(v.y) + std::fabs(v.z); }

  /// True if edges i < j without a common vertex cross or touch.
  bool meet(Int i, Int j) const {
    if (j == i + 1 || (i == 0 && j == nv_ - 1)) return false;
    const Point a = at(i), b = at(i + 1), c = at(j), d = at(j + 1);
    const int abc = left(a, b, c), abd = left(a, b, d);
    if (abc == abd && abc != 0) return false;
    return is_on(a, c, d) || is_on(b, c, d) || is_on(c, a, b) || is_on(d, a, b) ||
           cross(abc, abd, left(c, d, a), left(c, d, b));
  }

  /// The answer of the arc from p to the middle of an edge.
  Answer ask(Int edge) const {
    const Point a = at(edge), b = at(edge + 1), opposite{-p_.x, -p_.y, -p_.z};
    const int side = left(a, b, p_);
    if (side == 0) return is_on(p_, a, b) ? Answer::on_border : Answer::unknown;
    bool even = true;
    // Eight roundings, of terms that are `least` / 2^-48 at most together.
    const Point normal = pstripack::cross(p_, plus(a, b));
    const double least = 0x1p-48 * size(p_) * (size(a) + size(b));
    const bool are_moderate =
        is_moderate_square(dot(p_, p_)) && is_moderate_square(dot(a, a)) && is_moderate_square(dot(b, b));
    const auto side_of = [&](const Point& v) {
      const double height = dot(normal, v), bound = least * size(v);
      if (are_moderate && is_moderate_square(dot(v, v)) && std::fabs(height) > bound)
        return height > 0 ? 1 : -1;
      return left_of_sum(v, p_, a, b);
    };
    // The side of the arc on which c, and the next vertex, lie; 0 for the place opposite p: the great circles
    // of the arc and of an edge there meet at p and opposite p, not on the arc.
    Point c = b;
    int side_of_c = 0;
    for (Int k = 1; k <= nv_; ++k) {
      const Point d = at(edge + k < nv_ ? edge + k : edge + k - nv_);
      const int side_of_d = k == 1 ? side : k == nv_ ? -side : side_of(d);
      if (side_of_d == 0 && !same_direction(d, opposite))
        return same_direction(d, p_) ? Answer::on_border : Answer::unknown;
      if (k > 1 && side_of_c == -side_of_d && side_of_c != 0) {
        const int p_side = left(c, d, p_);
        if (p_side == 0 && is_on(p_, c, d)) return Answer::on_border;
        const int m_side = p_side == 0 ? 1 : left_of_sum(c, d, a, b);
        if (m_side == 0) return Answer::unknown;
        if (cross(side_of_c, side_of_d, p_side, m_side)) even = !even;
      }
      c = d;
      side_of_c = side_of_d;
    }
    return (side > 0) == even ? Answer::inside : Answer::outside;
  }

  /// True if the arcs a-b and c-d cross inside, from the signs of det(a,b,c), det(a,b,d), det(c,d,a),
  /// det(c,d,b): where a and b lie on different sides of c-d, and c and d of a-b, the arcs cross or are
  /// opposite each other.
  static bool cross(int abc, int abd, int cda, int cdb) {
    return abc != 0 && abc == -abd && abd == cda && abc == cdb;
  }

  static bool is_on(const Point& p, const Point& a, const Point& b) {
    if (same_direction(p, a) || same_direction(p, b)) return true;
    if (left(a, b, p) != 0) return false;
    // The normals of a and b, of a and p, and of p and b are multiples of each other: one component tells.
    for (const Point& axis : {Point{1, 0, 0}, Point{0, 1, 0}, Point{0, 0, 1}})
      if (const int turn = left(axis, a, b); turn != 0)
        return left(axis, a, p) == turn && left(axis, p, b) == turn;
    return false;
  }

  const Vertex& vertex_;
  const Int nv_;
  const Point p_;
};

/// INSIDE: `result` is true if p lies in the region left of the polygon with the vertices listv[0..nv-1],
/// which are indices 1..lv of `vertices`. For a clockwise polygon that region is the outside. `result` is
/// false unless `done`. Within rounding of the boundary either answer is possible.
template <class Real, class Int>
PolygonStatus inside(const Vector<Real>& p, Int lv, const Nodes<Real>& vertices, Int nv, const Int* listv,
                     bool& result) {
  result = false;
  if (nv < 3 || nv > lv) return PolygonStatus::bad_count;
  for (Int k = 0; k < nv; ++k)
    if (listv[k] < 1 || listv[k] > lv) return PolygonStatus::bad_vertex;
  const auto vertex = [&](Int k) { return vertices[listv[k]]; };
  if (!is_finite(p)) return PolygonStatus::not_finite;
  for (Int k = 0; k < nv; ++k)
    if (!is_finite(vertex(k))) return PolygonStatus::not_finite;

  const PolygonStatus status = inside_by_rounding(p, nv, vertex, result);
  if (original_rules().follow || is_zero(p)) return status;
  // The original takes a point 0.001 left of an edge for a point inside, which it is not in small or thin
  // polygons: then its answer is wrong, or it finds no such point, or takes the polygon for one that crosses
  // itself.
  const ExactPolygon polygon(vertex, nv, as_point(p));
  bool is_inside = false;
  if (!polygon.find(is_inside)) return status;
  if (status != PolygonStatus::done && !polygon.is_simple()) return status;
  result = is_inside;
  return PolygonStatus::done;
}

}  // namespace pstripack
