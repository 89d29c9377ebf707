#include "shapes.h"

#include <cmath>
#include <cstring>
#include <unordered_set>

#include "base/splitmix64.h"

namespace point_sets {

std::uint64_t Random::bits() { return pstripack::splitmix64(state_ += 0x9e3779b97f4a7c15); }

Point Random::direction() {
  const auto [u, v] = in_disc(*this);
  const double s = u * u + v * v, r = 2 * std::sqrt(1 - s);  // Marsaglia 1972
  return {r * u, r * v, 1 - 2 * s};
}

std::pair<double, double> in_disc(Random& random) {
  for (;;) {
    const double u = random.uniform(-1, 1), v = random.uniform(-1, 1), s = u * u + v * v;
    if (s > 0 && s < 1) return {u, v};
  }
}

Frame frame(const Point& c) {
  const Point axis = std::fabs(c.x) < 0.6 ? Point{1, 0, 0} : Point{0, 1, 0};
  const Point e1 = normalized(cross(c, axis)), e2 = cross(c, e1);
  return {c, e1, e2};
}

Point at(const Frame& frame, double u, double v) { return normalized(frame.c + u * frame.e1 + v * frame.e2); }

// 10^x = 10^whole * e^z, 0 <= z < ln 10, by the power series of e^z.
double ten_to_minus(double x) {
  double whole = std::floor(x);
  const double z = (x - whole) * 2.3025850929940456840179914546844;
  double e = 1;
  for (int k = 30; k > 0; --k) e = 1 + z * e / k;
  double power = 1 / e;
  for (; whole >= 22; whole -= 22) power /= 1e22;  // 10^22 is the largest power of ten that is a double
  for (; whole >= 1; whole -= 1) power /= 10;
  return power;
}

Points distinct(std::size_t n, const std::function<Point()>& draw) {
  constexpr int most_repeats = 10000;
  const auto hash = [](const Point& p) {
    std::uint64_t h = 0;
    for (const double v : {p.x, p.y, p.z}) {
      std::uint64_t bits;
      std::memcpy(&bits, &v, sizeof bits);
      h = Random(h ^ bits).bits();
    }
    return static_cast<std::size_t>(h);
  };
  std::unordered_set<Point, decltype(hash)> seen(2 * n, hash);
  Points p;
  for (int repeats = 0; p.size() < n && repeats < most_repeats; ++repeats) {
    const Point q = Point{0, 0, 0} + draw();  // turns -0 into 0: equal points have equal bits
    if (seen.insert(q).second) p.push_back(q), repeats = 0;
  }
  return p;
}

Family drawn(const char* name, const char* parameter, const char* what,
             Point (*draw)(double, Random&, std::size_t)) {
  return {name, parameter, "n", what, [draw](std::size_t n, double value, Random& random) {
            std::size_t i = 0;
            return distinct(n, [&] { return draw(value, random, i++); });
          }};
}

Point Orbit::seen_from_earth(double along, double across, double turn) const {
  // Seen along the motion, the pole of the orbit is to the left.
  const Point below{cos_degrees(along), sin_degrees(along) * cos_degrees(inclination),
                    sin_degrees(along) * sin_degrees(inclination)};
  const Point pole{0, -sin_degrees(inclination), cos_degrees(inclination)};
  const Point p = cos_degrees(across) * below + sin_degrees(across) * pole;
  return normalized({cos_degrees(turn) * p.x + sin_degrees(turn) * p.y,
                     cos_degrees(turn) * p.y - sin_degrees(turn) * p.x, p.z});
}

Point in_cap(Random& random, const Point& c, double radius) {
  const auto [centre, e1, e2] = frame(c);
  const double half = sin_degrees(0.5 * radius * degrees_per_radian);
  const auto [u, v] = in_disc(random);
  const double s = u * u + v * v;
  const double drop = s * 2 * half * half;  // 1 - cosine of the distance from c
  const double r = std::sqrt(drop * (2 - drop) / s);
  return normalized((1 - drop) * centre + (r * u) * e1 + (r * v) * e2);
}

Point centre() { return normalized({0.3, -0.5, 0.8}); }

Points uniform(std::size_t n, Random& random) {
  Points p(n);
  for (Point& q : p) q = random.direction();
  return p;
}

Points caps(std::size_t n, const Points& centres, double radius, Random& random) {
  Points p;
  for (std::size_t i = 0; i < n; ++i) p.push_back(in_cap(random, centres[i % centres.size()], radius));
  return p;
}

Points half_in_caps(std::size_t n, const Points& centres, double radius, Random& random) {
  Points p;
  for (std::size_t i = 0; i < n; ++i)
    p.push_back(i % 2 == 0 ? random.direction() : in_cap(random, centres[i / 2 % centres.size()], radius));
  return p;
}

}  // namespace point_sets
