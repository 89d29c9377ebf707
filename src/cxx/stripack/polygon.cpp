#include "stripack/polygon.h"

#include <cmath>
#include <cstdint>

#include "geometry/predicates.h"
#include "stripack/original/original_rules.h"

namespace pstripack {
namespace {

template <class Real>
Vector<Real> operator+(const Vector<Real>& a, const Vector<Real>& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}

template <class Real>
Vector<Real> operator*(Real factor, const Vector<Real>& a) {
  return {factor * a.x, factor * a.y, factor * a.z};
}

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
  const Vector<Real> chord{p2.x - p1.x, p2.y - p1.y, p2.z - p1.z};
  const Vector<Real> on_chord = p1 + t * chord;
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
  const Vector<Real> beside = (a + b) + (Real(1e-3) * normal) / size;
  q = beside / length(beside);
  return true;
}

}  // namespace

template <class Real>
IntersectionStatus intersection(const Vector<Real>& p1, const Vector<Real>& p2, const Vector<Real>& normal,
                                Vector<Real>& point) {
  if (!is_finite(p1) || !is_finite(p2) || !is_finite(normal)) return IntersectionStatus::not_finite;
  return cross_arc(p1, p2, normal, point);
}

namespace {

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
  ExactPolygon(const Vertex& vertex, Int nv) : vertex_(vertex), nv_(nv) {}

  /// Whether p is inside or on the border. False if no edge will do: there is a vertex on the way to each, or
  /// p is on its great circle.
  bool find(const Point& p, bool& is_inside) const {
    for (Int k = 0; k < nv_; ++k)
      if (is_on(p, at(k), at(k + 1))) return is_inside = true;
    for (Int edge = 0; edge < nv_; ++edge) {
      const Point a = at(edge), b = at(edge + 1);
      const int side = left(a, b, p);
      bool even = true, is_certain = side != 0;
      for (Int k = 0; k < nv_ && is_certain; ++k)
        is_certain = k == edge || count_crossing(p, a, b, at(k), at(k + 1), even);
      if (!is_certain) continue;
      is_inside = (side > 0) == even;
      return true;
    }
    return false;
  }

  /// True if no two edges without a common vertex cross or touch.
  bool is_simple() const {
    for (Int i = 0; i < nv_; ++i)
      for (Int j = i + 2; j < nv_; ++j) {
        if (i == 0 && j == nv_ - 1) continue;
        const Point a = at(i), b = at(i + 1), c = at(j), d = at(j + 1);
        if (is_on(a, c, d) || is_on(b, c, d) || is_on(c, a, b) || is_on(d, a, b)) return false;
        if (cross(left(a, b, c), left(a, b, d), left(c, d, a), left(c, d, b))) return false;
      }
    return true;
  }

 private:
  Point at(Int k) const { return as_point(vertex_(k < nv_ ? k : k - nv_)); }

  /// True if the arcs a-b and c-d cross inside, from the signs of det(a,b,c), det(a,b,d), det(c,d,a),
  /// det(c,d,b): where a and b lie on different sides of c-d, and c and d of a-b, the arcs cross or are
  /// opposite each other.
  static bool cross(int abc, int abd, int cda, int cdb) {
    return abc != 0 && abc == -abd && abd == cda && abc == cdb;
  }

  static bool is_on(const Point& p, const Point& a, const Point& b) {
    if (same_direction(p, a) || same_direction(p, b)) return true;
    if (left(a, b, p) != 0) return false;
    const Point normal =
        pstripack::cross(a, minus(b, a));  // rounded: which way the arc turns is all that counts
    return left(normal, a, p) > 0 && left(normal, p, b) > 0;
  }

  /// Changes `even` if the arc from p to a + b crosses c-d. False if c or d is on the way, or a + b on c-d.
  static bool count_crossing(const Point& p, const Point& a, const Point& b, const Point& c, const Point& d,
                             bool& even) {
    const Point opposite{-p.x, -p.y,
                         -p.z};  // there and at p the great circles of an edge at it and of the arc meet
    if (same_direction(c, d) || same_direction(c, opposite) || same_direction(d, opposite)) return true;
    const int pmc = left_of_sum(c, p, a, b), pmd = left_of_sum(d, p, a, b);  // with m = a + b
    if (pmc == 0 || pmd == 0) return false;
    if (pmc == pmd) return true;
    const int cdp = left(c, d, p), cdm = left_of_sum(c, d, a, b);
    if (cdp == 0) return true;  // p is not on c-d: the great circles meet at p and opposite p
    if (cdm == 0) return false;
    if (cross(pmc, pmd, cdp, cdm)) even = !even;
    return true;
  }

  const Vertex& vertex_;
  const Int nv_;
};

}  // namespace

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
  // polygons. Where it is right, and in polygons that cross themselves, its answer stays.
  const ExactPolygon polygon(vertex, nv);
  bool is_inside = false;
  if (!polygon.find(as_point(p), is_inside)) return status;
  if ((status == PolygonStatus::done && is_inside == result) || !polygon.is_simple()) return status;
  result = is_inside;
  return PolygonStatus::done;
}

#define PSTRIPACK_INSIDE(Real, Int) \
  template PolygonStatus inside(const Vector<Real>&, Int, const Nodes<Real>&, Int, const Int*, bool&);
PSTRIPACK_INSIDE(float, std::int32_t)
PSTRIPACK_INSIDE(double, std::int32_t)
PSTRIPACK_INSIDE(double, std::int64_t)
template IntersectionStatus intersection(const Vector<float>&, const Vector<float>&, const Vector<float>&,
                                         Vector<float>&);
template IntersectionStatus intersection(const Vector<double>&, const Vector<double>&, const Vector<double>&,
                                         Vector<double>&);

}  // namespace pstripack
