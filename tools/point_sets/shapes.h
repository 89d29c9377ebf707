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

/// m >= least such that the number of nodes count(m), which increases, is nearest to n.
template <class Count>
std::size_t nearest(std::size_t n, std::size_t least, Count count) {
  std::size_t m = least;
  while (count(m) < n) ++m;
  return m > least && n - count(m - 1) <= count(m) - n ? m - 1 : m;
}

/// A uniform point in the unit disc: (u, v) with 0 < u^2 + v^2 < 1.
std::pair<double, double> in_disc(Random& random);

/// The centre of a map, and its directions: of unit length, at right angles.
struct Frame {
  Point c, e1, e2;
};
Frame frame(const Point& c);

/// The direction of c + u e1 + v e2.
Point at(const Frame& frame, double u, double v);

/// 10^-x, x >= 0.
double ten_to_minus(double x);

/// `n` results of `draw` without repeats; fewer if it returns only repeats.
Points distinct(std::size_t n, const std::function<Point()>& draw);

/// A circular orbit, and the earth that turns below it.
struct Orbit {
  double inclination;  ///< degrees
  /// At the angle `along` from the ascending node, `across` to its left, when the earth has turned by `turn`:
  /// degrees.
  Point seen_from_earth(double along, double across, double turn) const;
};

/// A uniform point in the cap of the given radius around c. Accurate for the smallest radii.
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
