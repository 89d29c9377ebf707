#include "stripack/polygon.h"

#include <cmath>
#include <cstdint>

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

// Start at a point q just inside an edge and follow the great circle to p: p is inside if the number of edges
// crossed on the way is even. The first and the last crossing must agree with that:
//
//              ^
//     inside   |          The crossing nearest to q leads out: its edge runs to its positive end, where
//         q -->|--> p     positive means left of q->p. If it does not, q is taken at another edge.
//              |          The crossing nearest to p leads in or out, according to the parity. If it does
//                         not, the boundary crosses itself.
//
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
