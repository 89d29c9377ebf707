// INSIDE: polygons of all sizes and both orientations, against exact signs. For all kinds of numbers.

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include "point_sets.h"
#include "stripack/polygon.h"
#include "support/kinds.h"
#include "support/reference_predicates.h"

using namespace pstripack;

namespace {

template <class Kind>
class Inside : public ::testing::Test {};
TYPED_TEST_SUITE(Inside, AllKinds);

/// A place at x, y of the tangent plane at a tilted place.
template <class Real>
Vector<Real> place(double x, double y) {
  const Point g{0.36, 0.48, 0.8}, e{-0.8, 0.6, 0}, f = cross(g, e);
  const double l = std::sqrt(1 + x * x + y * y);
  return {static_cast<Real>((g.x + x * e.x + y * f.x) / l), static_cast<Real>((g.y + x * e.y + y * f.y) / l),
          static_cast<Real>((g.z + x * e.z + y * f.z) / l)};
}

/// A polygon around the centre of the tangent plane: star-shaped, so that it is the union of the triangles of
/// the centre and its edges.
template <class Kind>
struct Star {
  using Real = typename Kind::Real;
  using Int = typename Kind::Int;

  Star(double width, double ratio, int count) {
    for (int k = 0; k < count; ++k) {
      const double angle = 6.283185307179586 * (k + 0.3) / count, radius = k % 2 == 0 ? width : ratio * width;
      const Vector<Real> v = place<Real>(radius * std::cos(angle), radius * std::sin(angle));
      x.push_back(v.x), y.push_back(v.y), z.push_back(v.z);
      forward.push_back(static_cast<Int>(k + 1));
      backward.insert(backward.begin(), static_cast<Int>(k + 1));
    }
  }
  /// +1 inside, -1 outside, 0 on the border or on an arc from the centre.
  int position(const Vector<Real>& p) const {
    const Point c = as_point(place<Real>(0, 0)), q = as_point(p);
    int inside = -1;
    for (std::size_t k = 0; k < x.size(); ++k) {
      const std::size_t n = (k + 1) % x.size();
      const Point a{x[k], y[k], z[k]}, b{x[n], y[n], z[n]};
      const int ca = ::exact::left(c, a, q), ab = ::exact::left(a, b, q), bc = ::exact::left(b, c, q);
      if (ca > 0 && ab > 0 && bc > 0) inside = 1;
      if (ca >= 0 && ab >= 0 && bc >= 0 && ca * ab * bc == 0) return 0;
    }
    return inside;
  }
  std::pair<PolygonStatus, bool> ask(const Vector<Real>& p, const std::vector<Int>& order) const {
    bool result = false;
    const auto n = static_cast<Int>(x.size());
    const PolygonStatus status =
        inside(p, n, Nodes<Real>{x.data(), y.data(), z.data()}, n, order.data(), result);
    return {status, result};
  }

  std::vector<Real> x, y, z;
  std::vector<Int> forward, backward;
};

}  // namespace

TYPED_TEST(Inside, IsRightForPolygonsOfAllSizes) {
  using Real = typename TypeParam::Real;
  point_sets::Random random(3);
  int asked = 0;
  for (const double width : {10.0, 1.0, 0.1, 1e-2, 1e-3, 1e-4, 1e-6, 1e-8, 1e-12})
    for (const double ratio : {1.0, 0.5, 1e-3})
      for (const int count : {3, 4, 12, 40}) {
        if (width < 100 * std::numeric_limits<Real>::epsilon() / std::min(1.0, 10 * ratio)) continue;
        if (count == 3 && ratio != 1) continue;
        const Star<TypeParam> star(width, ratio, count);
        for (int k = 0; k < 40; ++k) {
          const double scale = k % 4 == 0 ? 1 : width * 1.2;
          Vector<Real> p =
              place<Real>(scale * (2 * random.uniform() - 1), scale * (2 * random.uniform() - 1));
          if (k % 8 == 1) p = scaled(-1, p);
          const int position = star.position(p);
          if (position == 0) continue;
          ++asked;
          const auto forward = star.ask(p, star.forward), backward = star.ask(p, star.backward);
          ASSERT_EQ(forward.first, PolygonStatus::done) << width << ' ' << ratio << ' ' << count;
          ASSERT_EQ(backward.first, PolygonStatus::done) << width << ' ' << ratio << ' ' << count;
          ASSERT_EQ(forward.second, position > 0) << width << ' ' << ratio << ' ' << count << " place " << k;
          ASSERT_EQ(backward.second, position < 0) << width << ' ' << ratio << ' ' << count << " place " << k;
        }
      }
  EXPECT_GT(asked, 1000);
}

TYPED_TEST(Inside, HoldsItsVerticesAndNotTheirOpposites) {
  for (const int count : {3, 12}) {
    const Star<TypeParam> star(1e-3, count == 3 ? 1 : 0.5, count);
    for (std::size_t k = 0; k < star.x.size(); ++k) {
      const auto answer = star.ask({star.x[k], star.y[k], star.z[k]}, star.forward);
      EXPECT_EQ(answer.first, PolygonStatus::done);
      EXPECT_TRUE(answer.second);
      const auto opposite = star.ask({-star.x[k], -star.y[k], -star.z[k]}, star.forward);
      EXPECT_EQ(opposite.first, PolygonStatus::done);
      EXPECT_FALSE(opposite.second);
    }
  }
}

TEST(InsidePolygon, DoesNotDependOnLengths) {
  // A place on the side of an octant, one inside and one outside, with vectors of all lengths.
  const double lengths[] = {0x1p-1000, 0x1p-530, 1, 0x1p135, 0x1p500};
  const std::int32_t order[] = {1, 2, 3};
  for (const double a : lengths)
    for (const double b : lengths)
      for (const double l : lengths) {
        const double x[] = {a, 0, 0}, y[] = {0, b, 0}, z[] = {0, 0, a};
        const auto is_inside = [&](const Vector<double>& p) {
          bool result = false;
          EXPECT_EQ(inside(p, 3, Nodes<double>{x, y, z}, 3, order, result), PolygonStatus::done);
          return result;
        };
        EXPECT_TRUE(is_inside({l, 2 * l, 0})) << a << ' ' << b << ' ' << l;
        EXPECT_TRUE(is_inside({l, 2 * l, l / 4})) << a << ' ' << b << ' ' << l;
        EXPECT_FALSE(is_inside({l, 2 * l, -l / 4})) << a << ' ' << b << ' ' << l;
      }
}

TYPED_TEST(Inside, INTRSCNeedsFiniteCoordinates) {
  using Real = typename TypeParam::Real;
  const Vector<Real> east{0, 1, 0}, up{0, 0, 1};
  Vector<Real> point{};
  ASSERT_EQ(intersection(Vector<Real>{1, 0, 0}, east, Vector<Real>{1, -1, 0}, point),
            IntersectionStatus::done);
  for (const Real bad : {std::numeric_limits<Real>::quiet_NaN(), std::numeric_limits<Real>::infinity()}) {
    const Vector<Real> none{bad, 0, 0};
    EXPECT_EQ(intersection(none, east, up, point), IntersectionStatus::not_finite);
    EXPECT_EQ(intersection(east, none, up, point), IntersectionStatus::not_finite);
    EXPECT_EQ(intersection(east, up, none, point), IntersectionStatus::not_finite);
  }
}
