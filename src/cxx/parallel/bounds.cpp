#include "parallel/bounds.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace pstripack {
namespace {

constexpr double u = 0x1p-53;

/// Computes the component of e along the axis on which |a| is largest from the two others: (2a + e).e = 0,
/// because |a| = |a + e| = 1. For a short e it is then as accurate as the others, however the directions were
/// rounded.
void follow_others(const Point& a, Point& e) {
  double Point::*const axis[] = {&Point::x, &Point::y, &Point::z};
  const auto size = [&](int k) { return std::fabs(a.*axis[k]); };
  const int k = size(0) >= size(1) ? (size(0) >= size(2) ? 0 : 2) : (size(1) >= size(2) ? 1 : 2);
  const auto x = axis[k], y = axis[(k + 1) % 3], z = axis[(k + 2) % 3];
  e.*x = -(e.*y * (a.*y + 0.5 * e.*y) + e.*z * (a.*z + 0.5 * e.*z)) / (a.*x + 0.5 * e.*x);
}

}  // namespace

double stretch_of(const Plane& p, double farthest) {
  const double w = p.w - 4;
  return w > 0 ? farthest * std::sqrt(p.x * p.x + p.y * p.y + p.z * p.z) / w
               : std::numeric_limits<double>::infinity();
}

double stretch_of(const Point& a, const Point& b, const Point& c, double deviation) {
  const Point e = minus(b, a), f = minus(c, a), g = minus(c, b);
  const double lowest = 1 - deviation - 0.5 * std::max({dot(e, e), dot(f, f), dot(g, g)}) - 4 * u;
  return lowest > 0 ? (1 + deviation) / lowest : std::numeric_limits<double>::infinity();
}

Ball ball_beyond(const Point& normal, double height, double error, double deviation) {
  const double square = 2 * (1 - height) + 3 * deviation + 2 * error + 16 * u;
  return {normal, std::sqrt(std::max(square, 0.0)) + error + 1e-12};
}

Ball ball_around(const Point& a, Point e, Point f) {
  // An edge as far as it is known: its components to 2.1u and 2^-98 of those of its ends. If it is short,
  // that along the axis follows from the others, to 45u of the edge and 2^-96 of the others of a.
  const double longest = std::max(
      {std::fabs(e.x), std::fabs(e.y), std::fabs(e.z), std::fabs(f.x), std::fabs(f.y), std::fabs(f.z)});
  if (!(longest > 0x1p-900)) return kEverywhere;
  double relative = 8 * u, absolute = 0x1p-95;
  if (longest < 0x1p-40) {
    follow_others(a, e);
    follow_others(a, f);
    relative = 48 * u;
    const double across = std::fabs(a.x) + std::fabs(a.y) + std::fabs(a.z) -
                          std::max({std::fabs(a.x), std::fabs(a.y), std::fabs(a.z)});
    absolute *= across + longest;
  }
  int exponent;
  std::frexp(longest, &exponent);
  const auto scaled = [](const Point& p, int by) {
    return Point{std::ldexp(p.x, by), std::ldexp(p.y, by), std::ldexp(p.z, by)};
  };
  e = scaled(e, -exponent), f = scaled(f, -exponent);
  absolute = std::ldexp(absolute, -exponent);
  const Point n = cross(e, f), g = minus(f, e);
  const double ee = dot(e, e), ff = dot(f, f), nn = dot(n, n), edges = std::sqrt(ee * ff);
  const double length = std::sqrt(nn);
  // Of n, relative: that of the factors, and 4u |e||f| of the product.
  const double error =
      ((2 * relative + 4 * u) * edges + 2 * absolute * (std::sqrt(ee) + std::sqrt(ff))) / length;
  if (!(error < 0.01 && nn > 0x1p-900)) return kEverywhere;
  // From a to the centre of the circle: (|e|^2 f - |f|^2 e) x n / (2 |n|^2). The first factor is |e||f||g|
  // long and known to 6 errors of its terms, no longer than 2 of that; n and |n|^2 to 3.
  const Point v{ee * f.x - ff * e.x, ee * f.y - ff * e.y, ee * f.z - ff * e.z};
  const Point to_centre = cross(v, n);
  const double half = 0.5 / nn;
  const double radius = edges * std::sqrt(dot(g, g)) / (2 * length) * (1 + 32 * error);
  const Point c = scaled({to_centre.x * half, to_centre.y * half, to_centre.z * half}, exponent);
  return {{a.x + c.x, a.y + c.y, a.z + c.z}, std::ldexp(radius, exponent)};
}

}  // namespace pstripack
