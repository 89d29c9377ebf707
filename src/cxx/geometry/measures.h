#pragma once
// Lengths, circumcentres and areas of directions p/|p|, each right relative to its own size.
//
// Where nodes are close, two roundings spoil the usual formulas: that of the difference of two vectors, and
// that of their lengths, which tilts the plane of three nodes by 1e-16 over its size. So all is made of
// differences of exact directions, and each step has a bound. Where doubles do not meet it, double-doubles
// follow, and then floating-point numbers of 256, 1280 and 9216 bits.
//
// For finite vectors with different directions, from 1e-300 rad apart to opposite ones, with u = 2^-53:
//   length           8u of itself
//   radius           80u of itself; beyond 60 degrees 64u rad
//   circumcentre     192u of the radius, beyond 30 degrees 384u, and the rounding of its three coordinates
//   area             64u of itself and 2^-1074; that of a cell 128u of itself, NaN below 2^-1022
// These are bounds of the analysis in measures.cpp; tests/README.md has the errors seen.

#include <cmath>
#include <cstddef>

#include "geometry/predicates.h"

namespace pstripack {

/// The direction of a vector, and the vector, which arithmetics with more bits need.
struct Direction : UnitVector {
  Point given;
};
inline Direction direction_of(const Point& p) { return {unit_vector(p), p}; }
inline Direction direction_of(const Directions& nodes, index_t i) { return {nodes.unit(i), nodes.given(i)}; }

/// b - a, right up to 4u of its length.
Point difference_of_any_size(const Direction& b, const Direction& a);
inline Point accurate_difference(const Direction& b, const Direction& a) {
  const Point d = difference(b, a);
  return dot(d, d) >= 0x1p-90 ? d : difference_of_any_size(b, a);
}

/// The angle between two directions, in radians.
double arc_length(const Direction& a, const Direction& b);

/// The circumcentre of three counterclockwise directions, if doubles suffice: if the triangle is neither
/// large nor very small, and its angle at `a` is between 8 and 172 degrees. See measures.cpp.
inline bool find_ordinary_centre(const UnitVector& a, const UnitVector& b, const UnitVector& c,
                                 Point& centre) {
  const Point e = difference(b, a), f = difference(c, a), g = minus(f, e), n = cross(e, f);
  const double ee = dot(e, e), ff = dot(f, f), nn = dot(n, n),
               sine = ee * ff * dot(g, g) / (4 * nn);  // squared
  const bool is_ordinary =
      (nn >= 0x1p-6 * (ee * ff)) & (ee >= 0x1p-90) & (ff >= 0x1p-90) & (sine <= 0.75) & (dot(n, a.high) > 0);
  if (__builtin_expect(!is_ordinary, false)) return false;
  const double cosine = std::sqrt(1 - sine), inverse = 1 / (nn * cosine * (1 + cosine));
  const double in_plane = 0.5 * (1 + cosine) * inverse, upwards = sine * nn * inverse;
  const Point m = cross(n, {ff * e.x - ee * f.x, ff * e.y - ee * f.y, ff * e.z - ee * f.z});
  centre = {a.high.x + (a.low.x + (in_plane * m.x + upwards * a.high.x)),
            a.high.y + (a.low.y + (in_plane * m.y + upwards * a.high.y)),
            a.high.z + (a.low.z + (in_plane * m.z + upwards * a.high.z))};
  return true;
}

/// The area of a counterclockwise triangle, if doubles suffice: if its sides at `a` are below 18 degrees and
/// not very small, and it is neither flat at `a` nor nearly in a plane with the centre. See measures.cpp.
inline bool find_ordinary_area(const UnitVector& a, const UnitVector& b, const UnitVector& c, double& area) {
  const Point e = difference(b, a), f = difference(c, a), g = minus(f, e), n = cross(e, f);
  const double ee = dot(e, e), ff = dot(f, f), det = dot(n, a.high);
  const bool is_ordinary = (det * det >= 0x1p-6 * (ee * ff)) & (ee >= 0x1p-90) & (ff >= 0x1p-90) &
                           (ee <= 0.1) & (ff <= 0.1) & (det > 0);
  if (__builtin_expect(!is_ordinary, false)) return false;
  const double tangent = det / (4 - 0.5 * (ee + ff + dot(g, g))),
               square = tangent * tangent;  // of half the area
  if (square > 0x1p-20)
    area = 2 * std::atan(tangent);
  else  // the next term is below 2^-62
    area = 2 * tangent * (1 - square * (1.0 / 3 - square * (1.0 / 5)));
  return true;
}

/// The circle through three different directions. `centre` is the unit vector from whose side they are
/// counterclockwise; `radius` is in radians, 0 to pi: beyond pi/2 if they are clockwise seen from outside the
/// sphere.
struct Circumcircle {
  Point centre;
  double radius;
};
Circumcircle circumcircle(const Direction& a, const Direction& b, const Direction& c);
/// Those of three nodes.
inline Point circumcentre(const Directions& nodes, index_t a, index_t b, index_t c) {
  Point centre;
  if (find_ordinary_centre(nodes.unit(a), nodes.unit(b), nodes.unit(c), centre)) return centre;
  return circumcircle(direction_of(nodes, a), direction_of(nodes, b), direction_of(nodes, c)).centre;
}

/// The angles of the plane triangle, in radians, each right up to 64u of itself, or of what it lacks to pi.
struct Angles {
  double at[3];
  bool are_acute;  ///< exactly: all are below pi/2, so that the triangle has its circumcentre inside
};
Angles angles_of(const Direction& a, const Direction& b, const Direction& c);

/// Area of the spherical triangle in steradians, 0 to 2 pi; negative if clockwise.
double triangle_area(const Direction& a, const Direction& b, const Direction& c);
inline double triangle_area(const Directions& nodes, index_t a, index_t b, index_t c) {
  double area;
  if (find_ordinary_area(nodes.unit(a), nodes.unit(b), nodes.unit(c), area)) return area;
  return triangle_area(direction_of(nodes, a), direction_of(nodes, b), direction_of(nodes, c));
}

/// Area of the Voronoi cell of the direction v in steradians. ring[0..count-1]: the other ends of all edges
/// at v in the convex hull of the directions, counterclockwise seen from outside the hull.
double cell_area(const Direction& v, const Direction* ring, std::size_t count);

}  // namespace pstripack
