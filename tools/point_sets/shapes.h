#pragma once
// Parts that several families share.

#include <cstddef>
#include <functional>
#include <utility>

#include "families.h"

namespace point_sets {

using pstripack::Point;

inline constexpr double degrees_per_radian = 57.295779513082320876798154814105;

inline Point operator+(const Point& a, const Point& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
inline Point operator*(double s, const Point& a) { return {s * a.x, s * a.y, s * a.z}; }

/// The m >= least for which count(m), an increasing function, is nearest to n.
template <class Count>
std::size_t nearest(std::size_t n, std::size_t least, Count count) {
  std::size_t m = least;
  while (count(m) < n) ++m;
  return m > least && n - count(m - 1) <= count(m) - n ? m - 1 : m;
}

/// A uniform point (u, v) in the unit disc without its centre.
std::pair<double, double> in_disc(Random& random);

/// A tangent plane: its centre and two directions, perpendicular unit vectors.
struct Frame {
  Point c, e1, e2;
};
Frame frame(const Point& c);

/// The direction of c + u e1 + v e2.
Point at(const Frame& frame, double u, double v);

/// 10^-x, x >= 0.
double ten_to_minus(double x);

/// `n` different results of `draw`; fewer if it returns only repeats.
Points distinct(std::size_t n, const std::function<Point()>& draw);

/// A family of nodes that are drawn one after the other: draw() makes the i-th, from 0. Repeats are left out.
Family drawn(const char* name, const char* parameter, const char* what,
             Point (*draw)(double parameter, Random& random, std::size_t i));

/// A circular orbit above the rotating earth.
struct Orbit {
  double inclination;  ///< degrees
  /// The direction of a point as seen from the earth, in degrees: `along` the orbit from the ascending node,
  /// `across` to its left, after the earth has turned by `turn`.
  Point seen_from_earth(double along, double across, double turn) const;
};

/// A uniform point in the cap of this radius around c; accurate for the smallest radii.
Point in_cap(Random& random, const Point& c, double radius);

/// Centre of the caps: an arbitrary direction.
Point centre();

/// n nodes uniform on the sphere.
Points uniform(std::size_t n, Random& random);

/// n nodes in caps around the given centres in turn.
Points caps(std::size_t n, const Points& centres, double radius, Random& random);

/// Every other node uniform, the others in caps around the given centres in turn.
Points half_in_caps(std::size_t n, const Points& centres, double radius, Random& random);

}  // namespace point_sets
