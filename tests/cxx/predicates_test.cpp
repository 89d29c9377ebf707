// Compares the predicates with tests/support/reference_predicates.h, which uses neither filters nor floating
// point.

#include "geometry/predicates.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <boost/multiprecision/cpp_bin_float.hpp>
#include <cmath>
#include <functional>
#include <limits>
#include <vector>

#include "geometry/exact_signs.h"
#include "point_sets.h"
#include "support/cases.h"
#include "support/reference_predicates.h"

namespace {

using point_sets::normalized;
using point_sets::Random;
using pstripack::Coordinates;
using pstripack::Directions;
using pstripack::Point;
using Four = std::array<Point, 4>;

constexpr int permutations[24][5] = {  // of 0 1 2 3, with their sign
    {0, 1, 2, 3, 1},  {0, 1, 3, 2, -1}, {0, 2, 1, 3, -1}, {0, 2, 3, 1, 1},  {0, 3, 1, 2, 1},
    {0, 3, 2, 1, -1}, {1, 0, 2, 3, -1}, {1, 0, 3, 2, 1},  {1, 2, 0, 3, 1},  {1, 2, 3, 0, -1},
    {1, 3, 0, 2, -1}, {1, 3, 2, 0, 1},  {2, 0, 1, 3, 1},  {2, 0, 3, 1, -1}, {2, 1, 0, 3, -1},
    {2, 1, 3, 0, 1},  {2, 3, 0, 1, 1},  {2, 3, 1, 0, -1}, {3, 0, 1, 2, -1}, {3, 0, 2, 1, 1},
    {3, 1, 0, 2, 1},  {3, 1, 2, 0, -1}, {3, 2, 0, 1, -1}, {3, 2, 1, 0, 1}};

Point plus(const Point& a, double s, const Point& b) { return plus(a, scaled(s, b)); }

Point nudged(Point p, Random& random, int ulps) {
  for (double* v : {&p.x, &p.y, &p.z})
    for (std::size_t k = random.below(static_cast<std::size_t>(ulps) + 1); k > 0; --k)
      *v = std::nextafter(*v, random.below(2) == 0 ? -2 : 2);
  return p;
}

bool different(const Four& f) {
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < i; ++j)
      if (exact::same_direction(f[i], f[j])) return false;
  return true;
}

// ---- Four nodes of unit length, from harmless to exactly degenerate, of a size from 1 down to 1e-15 ----

Four anywhere(Random& random, double size) {
  const Point c = random.direction();
  Four f;
  for (Point& p : f) p = normalized(plus(c, size, random.direction()));
  return f;
}

/// d on the circle through a, b, c, up to rounding and a few ulps.
Four nearly_cocircular(Random& random, double size) {
  const Point axis = random.direction(), e1 = normalized(plus(random.direction(), 0.1, axis));
  const double along = e1.x * axis.x + e1.y * axis.y + e1.z * axis.z;
  const Point u = normalized(plus(e1, -along, axis));
  const Point v = {axis.y * u.z - axis.z * u.y, axis.z * u.x - axis.x * u.z, axis.x * u.y - axis.y * u.x};
  Four f;
  for (Point& p : f) {
    const double angle = random.uniform(0, 360);
    p = plus(plus(axis, size * point_sets::cos_degrees(angle), u), size * point_sets::sin_degrees(angle), v);
    p = nudged(normalized(p), random, 2);
  }
  return f;
}

/// c (and every other time d) on the great circle through a and b, up to rounding and a few ulps.
Four nearly_on_great_circle(Random& random, double size) {
  Four f = anywhere(random, size);
  for (int i = 2; i < 3 + static_cast<int>(random.below(2)); ++i) {
    const double t = random.uniform(-2, 3);
    f[i] = {f[0].x + t * (f[1].x - f[0].x), f[0].y + t * (f[1].y - f[0].y), f[0].z + t * (f[1].z - f[0].z)};
    f[i] = nudged(normalized(f[i]), random, 2);
  }
  return f;
}

/// Signed permutations of one vector: planes and great circles through many of them, exactly.
Four symmetric(Random& random, double) {
  const Point p = random.direction();
  const double v[3] = {p.x, p.y, random.below(4) == 0 ? p.y : p.z};
  Four f;
  for (Point& q : f) {
    const std::size_t first = random.below(3), second = (first + 1 + random.below(2)) % 3;
    const auto sign = [&random] { return random.below(2) == 0 ? 1.0 : -1.0; };
    q = {sign() * v[first], sign() * v[second], sign() * v[3 - first - second]};
  }
  return f;
}

/// A lattice in the plane x = 1 or next to it, with many coplanar and collinear fours.
Four lattice(Random& random, double size) {
  const double step = std::exp2(std::floor(std::log2(size)) - 13);
  const double next = random.below(2) == 0 ? 0 : 0x1p-52;
  Four f;
  for (Point& p : f) {
    const auto cell = [&random] { return static_cast<double>(random.below(7)) - 3; };
    p = {1 + next * static_cast<double>(random.below(2)), step * cell(), step * cell()};
    if (size < 0.5) continue;  // another great plane, and opposite nodes
    if (random.below(8) == 0) p = scaled(-1, p);
  }
  return f;
}

/// Nodes that are exactly or nearly opposite each other.
Four antipodal(Random& random, double size) {
  Four f = anywhere(random, size);
  f[1] = nudged(scaled(-1, f[0]), random, 1);
  if (random.below(2) == 0) f[3] = nudged(scaled(-1, f[2]), random, 1);
  return f;
}

struct Generator {
  const char* name;
  Four (*make)(Random&, double size);
  int count;  // per size
};

void PrintTo(const Generator& g, std::ostream* out) { *out << g.name; }

const Generator generators[] = {{"anywhere", anywhere, 40000},
                                {"nearly_cocircular", nearly_cocircular, 40000},
                                {"nearly_on_great_circle", nearly_on_great_circle, 40000},
                                {"symmetric", symmetric, 15000},
                                {"lattice", lattice, 25000},
                                {"antipodal", antipodal, 15000}};

/// Calls check(four) for the generator's fours of all sizes; nodes pairwise different in direction.
template <class Check>
void for_each_four(const Generator& g, double share, Check check) {
  Random random(1);
  for (int exponent = 0; exponent <= 15; ++exponent)
    for (int i = 0; i < cases(share * g.count); ++i) {
      const Four f = g.make(random, std::pow(10.0, -exponent));
      if (different(f)) check(f);
      if (::testing::Test::HasFailure()) return;
    }
}

std::string text(const Four& f) {
  char line[400];
  std::string all;
  for (const Point& p : f) {
    std::snprintf(line, sizeof line, "\n  %a %a %a", p.x, p.y, p.z);
    all += line;
  }
  return all;
}

class Predicates : public ::testing::TestWithParam<Generator> {};

TEST_P(Predicates, LeftIsTheExactSignAndAntisymmetric) {
  for_each_four(GetParam(), 1, [&](const Four& f) {
    const int sign = exact::left(f[0], f[1], f[2]);
    const Coordinates on(f.data(), 4);
    for (const auto& p : permutations) {
      if (p[3] != 3) continue;
      ASSERT_EQ(pstripack::left(f[p[0]], f[p[1]], f[p[2]]), p[4] * sign) << text(f);
      ASSERT_EQ(on.left(p[0], p[1], p[2]), p[4] * sign) << text(f);
    }
  });
}

TEST_P(Predicates, OrientationIsTheExactSignAndAntisymmetric) {
  for_each_four(GetParam(), 1, [&](const Four& f) {
    const int sign = exact::orientation(exact::On::coordinates, f[0], f[1], f[2], f[3]);
    for (const auto& p : permutations)
      ASSERT_EQ(pstripack::orientation(f[p[0]], f[p[1]], f[p[2]], f[p[3]]), p[4] * sign) << text(f);
  });
}

TEST_P(Predicates, AboveOnCoordinatesIsTheExactSignWithTheTieRule) {
  for_each_four(GetParam(), 1, [&](const Four& f) {
    const int sign = exact::above(exact::On::coordinates, f[0], f[1], f[2], f[3]);
    const Coordinates on(f.data(), 4);
    for (const auto& p : permutations)
      ASSERT_EQ(on.above(p[0], p[1], p[2], p[3]), p[4] * sign > 0) << text(f);
  });
}

TEST_P(Predicates, AboveOnDirectionsIsTheExactSignWithTheTieRule) {
  Random random(2);
  for_each_four(GetParam(), 0.2, [&](Four f) {
    // Different lengths. Powers of two keep the direction exactly, so ties stay ties.
    const bool any_length = random.below(2) == 0;
    for (Point& p : f) {
      const double s =
          any_length ? random.uniform(0.5, 2) : std::exp2(static_cast<double>(random.below(9)) - 4);
      p = scaled(s, p);
    }
    if (!different(f)) return;
    const int sign = exact::above(exact::On::directions, f[0], f[1], f[2], f[3]);
    const int plain = exact::orientation(exact::On::directions, f[0], f[1], f[2], f[3]);
    ASSERT_EQ(pstripack::orientation_of_directions(f[0], f[1], f[2], f[3]), plain) << text(f);
    const Directions on(f.data(), 4);
    for (const auto& p : permutations) {
      ASSERT_EQ(on.above(p[0], p[1], p[2], p[3]), p[4] * sign > 0) << text(f);
      if (p[3] == 3) {
        ASSERT_EQ(on.left(p[0], p[1], p[2]), p[4] * exact::left(f[0], f[1], f[2])) << text(f);
      }
    }
  });
}

INSTANTIATE_TEST_SUITE_P(On, Predicates, ::testing::ValuesIn(generators),
                         [](const auto& info) { return std::string(info.param.name); });

// ---- The judge itself ----

template <class Number>
Number determinant(const Number (&a)[3], const Number (&b)[3], const Number (&c)[3]) {
  return a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) +
         a[2] * (b[0] * c[1] - b[1] * c[0]);
}

/// The determinant of the others minus v[0].
template <class Number>
Number volume(Number (&v)[4][3]) {
  for (int k = 1; k < 4; ++k)
    for (int j = 0; j < 3; ++j) v[k][j] -= v[0][j];
  return determinant(v[1], v[2], v[3]);
}

TEST(Exact, RootSumsAgreeWithTwoHundredDigits) {
  using Real = boost::multiprecision::number<boost::multiprecision::cpp_bin_float<200>>;
  Random random(3);
  int zeros = 0;
  for (int i = 0; i < 20000; ++i) {
    exact::Integer c[4], q[4];
    Real sum = 0;
    for (int k = 0; k < 4; ++k) {
      c[k] = static_cast<int>(random.below(9)) - 4;
      const int square = static_cast<int>(random.below(4)) + 1;
      q[k] = square * square * static_cast<int>(random.below(4));
      sum += Real(c[k]) * sqrt(Real(q[k]));
    }
    const int sign = abs(sum) < Real("1e-150") ? 0 : sum.sign();
    zeros += sign == 0;
    ASSERT_EQ(exact::sign_of_root_sum(c, q), sign);
  }
  EXPECT_GT(zeros, 100);
}

TEST(Exact, OrientationsAgreeWithRationals) {
  Random random(4);
  for (const Generator& g : generators)
    for (int i = 0; i < 500; ++i) {
      const Four f = g.make(random, std::pow(10.0, -(i % 16)));
      exact::Rational v[4][3];
      for (int k = 0; k < 4; ++k) v[k][0] = f[k].x, v[k][1] = f[k].y, v[k][2] = f[k].z;
      ASSERT_EQ(exact::left(f[0], f[1], f[2]), determinant(v[0], v[1], v[2]).sign());
      ASSERT_EQ(exact::orientation(exact::On::coordinates, f[0], f[1], f[2], f[3]), volume(v).sign());
    }
}

TEST(Exact, DirectionsAgreeWithUnitVectorsOfTwoHundredDigits) {
  using Real = boost::multiprecision::number<boost::multiprecision::cpp_bin_float<200>>;
  Random random(14);
  int zeros = 0;
  for (int i = 0; i < 6000; ++i) {
    Four f = generators[i % 6].make(random, std::pow(10.0, -(i % 16)));
    for (Point& p : f) {
      const double s =
          i % 2 == 0 ? random.uniform(0.1, 10) : std::exp2(static_cast<double>(random.below(9)) - 4);
      p = scaled(s, p);
    }
    Real v[4][3];
    for (int k = 0; k < 4; ++k) {
      v[k][0] = f[k].x, v[k][1] = f[k].y, v[k][2] = f[k].z;
      const Real length = sqrt(Real(v[k][0] * v[k][0] + v[k][1] * v[k][1] + v[k][2] * v[k][2]));
      for (Real& component : v[k]) component /= length;
    }
    const Real inside = volume(v);
    const int sign = exact::orientation(exact::On::directions, f[0], f[1], f[2], f[3]);
    zeros += sign == 0;
    ASSERT_EQ(sign, abs(inside) < Real("1e-180") ? 0 : inside.sign()) << text(f);
  }
  EXPECT_GT(zeros, 100);
}

// ---- The tie rule against nodes that are really pushed outwards ----

/// The sign of the volume when the node of rank r among the four is pushed to 1/(1 - e) of its length,
/// e = 2^-64 for the highest rank, and 2^-64 times smaller for each lower one.
int pushed(exact::On on, const Four& f) {
  exact::Rational stretch[4];
  for (int i = 0; i < 4; ++i) {
    int higher = 0;
    for (int j = 0; j < 4; ++j) higher += exact::lower_rank(f[i], f[j]);
    stretch[i] = 1 - exact::Rational(1, exact::Integer(1) << (64 * (higher + 1)));  // t = 1/length
  }
  const exact::Integer unit = exact::Integer(1) << 256;
  if (on == exact::On::directions) {
    // t_a |a| [bcd] - ..., for lattice vectors: everything is whole after the factor 2^256.
    exact::Integer v[4][3], squared[4], c[4], q[4];
    for (int k = 0; k < 4; ++k) {
      v[k][0] = static_cast<int>(f[k].x), v[k][1] = static_cast<int>(f[k].y),
      v[k][2] = static_cast<int>(f[k].z);
      squared[k] = v[k][0] * v[k][0] + v[k][1] * v[k][1] + v[k][2] * v[k][2];
    }
    for (int k = 0; k < 4; ++k) {
      const int o[3] = {k == 0 ? 1 : 0, k <= 1 ? 2 : 1, k <= 2 ? 3 : 2};
      const exact::Integer bracket = determinant(v[o[0]], v[o[1]], v[o[2]]);
      const exact::Rational t = stretch[k] * unit;
      c[k] = (k % 2 == 0 ? 1 : -1) * bracket * numerator(t) / denominator(t);
      q[k] = squared[k];
    }
    return exact::sign_of_root_sum(c, q);
  }
  exact::Rational v[4][3];
  for (int k = 0; k < 4; ++k) {
    v[k][0] = exact::Rational(f[k].x) / stretch[k];
    v[k][1] = exact::Rational(f[k].y) / stretch[k];
    v[k][2] = exact::Rational(f[k].z) / stretch[k];
  }
  return volume(v).sign();
}

bool on_one_great_circle(const Four& f) {
  return exact::left(f[0], f[1], f[2]) == 0 && exact::left(f[0], f[1], f[3]) == 0 &&
         exact::left(f[0], f[2], f[3]) == 0 && exact::left(f[1], f[2], f[3]) == 0;
}

TEST(TieRule, OnCoordinatesIsARadialPushByRank) {
  Random random(5);
  int ties = 0, flat = 0;
  for (int i = 0; i < cases(40000); ++i) {
    const Four f = i % 2 == 0 ? symmetric(random, 1) : lattice(random, 1);
    if (!different(f)) continue;
    const bool tie = exact::orientation(exact::On::coordinates, f[0], f[1], f[2], f[3]) == 0;
    ties += tie;
    flat += on_one_great_circle(f);
    ASSERT_EQ(
        Coordinates(f.data(), 4).above(0, 1, 2, 3),
        tie ? pushed(exact::On::coordinates, f) > 0 : pstripack::orientation(f[0], f[1], f[2], f[3]) > 0)
        << text(f);
    if (tie && on_one_great_circle(f)) {
      ASSERT_EQ(pushed(exact::On::coordinates, f), 0) << text(f);
    }
  }
  EXPECT_GE(ties, cases(5000));
  EXPECT_GE(flat, cases(50));
}

TEST(TieRule, OnDirectionsIsARadialPushByRank) {
  Random random(6);
  int ties = 0, flat = 0;
  for (int i = 0; i < cases(60000); ++i) {
    Four f;
    for (Point& p : f) {
      const auto cell = [&random] { return static_cast<double>(random.below(5)) - 2; };
      do p = {cell(), cell(), cell()};
      while (p == Point{0, 0, 0});
    }
    if (!different(f)) continue;
    const int plain = exact::orientation(exact::On::directions, f[0], f[1], f[2], f[3]);
    ties += plain == 0;
    flat += on_one_great_circle(f);
    const int expected = plain == 0 ? pushed(exact::On::directions, f) : plain;
    ASSERT_EQ(Directions(f.data(), 4).above(0, 1, 2, 3), expected > 0) << text(f);
    ASSERT_EQ(pstripack::orientation_of_directions(f[0], f[1], f[2], f[3]), plain) << text(f);
  }
  EXPECT_GE(ties, cases(500));
  EXPECT_GE(flat, cases(50));
}

TEST(TieRule, DoesNotDependOnTheNumbering) {
  Random random(7);
  for (int i = 0; i < cases(20000); ++i) {
    const Four f = symmetric(random, 1);
    if (!different(f)) continue;
    const bool above = Coordinates(f.data(), 4).above(0, 1, 2, 3);
    for (const auto& p : permutations) {
      Four g;  // node p[k] of g is node k of f
      for (int k = 0; k < 4; ++k) g[p[k]] = f[k];
      ASSERT_EQ(Coordinates(g.data(), 4).above(p[0], p[1], p[2], p[3]), above) << text(f);
    }
  }
}

TEST(TieRule, TakesMinusZeroForZero) {
  const Four f = {{{1, 0.0, 0}, {0, 1, 0}, {-1, 0.0, 0}, {0, -1, 0}}};
  for (int signs = 0; signs < 256; ++signs) {
    Four g = f;
    for (int k = 0; k < 4; ++k) {
      for (double* v : {&g[k].x, &g[k].y})
        if (*v == 0 && (signs >> k) % 2 != 0) *v = -0.0;
      if ((signs >> (4 + k)) % 2 != 0) g[k].z = -0.0;
    }
    EXPECT_FALSE(Coordinates(g.data(), 4).above(0, 1, 2, 3));
    EXPECT_EQ(pstripack::left(g[0], g[1], g[2]), 0);
  }
  const Point signed_zero{-0.0, 1, -0.0}, zero{0, 1, 0};
  EXPECT_TRUE(pstripack::same_direction(signed_zero, zero));
}

// ---- Any finite double ----

double any_double(Random& random, int low, int high) {
  const int exponent = low + static_cast<int>(random.below(static_cast<std::size_t>(high - low)));
  return random.below(12) == 0 ? 0 : std::ldexp(random.uniform(-1, 1), exponent);
}

/// Exponents of all sizes, near the ends of the range, or differing by about as much as integers of 512 bits
/// can hold; every other time degenerate.
Four wild(Random& random) {
  const int ranges[6][2] = {{-1080, 1025}, {-1080, -1000}, {1000, 1025}, {-30, 30}, {-60, 60}, {-90, 90}};
  const auto& range = ranges[random.below(6)];
  Four f;
  for (Point& p : f) {
    do
      p = {any_double(random, range[0], range[1]), any_double(random, range[0], range[1]),
           any_double(random, range[0], range[1])};
    while (p == Point{0, 0, 0});
  }
  const std::size_t kind = random.below(6);
  if (kind == 0) f[2] = {f[0].x / 2 + f[1].x / 2, f[0].y / 2 + f[1].y / 2, f[0].z / 2 + f[1].z / 2};
  if (kind == 1) f[3] = scaled(-1, f[0]);
  if (kind == 2)
    for (Point& p : f) p.z = f[0].z;
  return f;
}

TEST(AnyFiniteDouble, LeftAndOrientationAreExact) {
  Random random(8);
  for (int i = 0; i < cases(200000); ++i) {
    const Four f = wild(random);
    if (f[2] == Point{0, 0, 0} || f[3] == Point{0, 0, 0}) continue;
    ASSERT_EQ(pstripack::left(f[0], f[1], f[2]), exact::left(f[0], f[1], f[2])) << text(f);
    ASSERT_EQ(pstripack::orientation(f[0], f[1], f[2], f[3]),
              exact::orientation(exact::On::coordinates, f[0], f[1], f[2], f[3]))
        << text(f);
  }
}

TEST(AnyFiniteDouble, DirectionsAreExact) {
  Random random(9);
  for (int i = 0; i < cases(100000); ++i) {
    const Four f = wild(random);
    if (f[2] == Point{0, 0, 0} || f[3] == Point{0, 0, 0} || !different(f)) continue;
    const Directions on(f.data(), 4);
    ASSERT_EQ(on.left(0, 1, 2), exact::left(f[0], f[1], f[2])) << text(f);
    ASSERT_EQ(pstripack::orientation_of_directions(f[0], f[1], f[2], f[3]),
              exact::orientation(exact::On::directions, f[0], f[1], f[2], f[3]))
        << text(f);
    ASSERT_EQ(on.above(0, 1, 2, 3), exact::above(exact::On::directions, f[0], f[1], f[2], f[3]) > 0)
        << text(f);
  }
}

TEST(AnyFiniteDouble, SameDirectionIsExact) {
  Random random(10);
  int same = 0;
  for (int i = 0; i < cases(300000); ++i) {
    Four f = wild(random);
    Point &a = f[0], &b = f[1];
    if (i % 3 == 0) b = {a.x / 8, a.y / 8, a.z / 8};  // the same, or opposite, unless it rounds
    if (i % 3 == 1) a = {std::floor(a.x), std::floor(a.y), std::floor(a.z)}, b = scaled(3, a);
    if (i % 5 == 0) b = scaled(-1, b);
    const auto usable = [](const Point& p) { return std::isfinite(p.x + p.y + p.z) && p != Point{0, 0, 0}; };
    if (!usable(a) || !usable(b)) continue;
    same += exact::same_direction(a, b);
    ASSERT_EQ(pstripack::same_direction(a, b), exact::same_direction(a, b)) << text(f);
    const Directions on(f.data(), 2);
    ASSERT_EQ(on.coincide(0, 1), exact::same_direction(a, b)) << text(f);
  }
  EXPECT_GE(same, cases(10000));
}

// Two decisions that compare products of many lengths, against arithmetic that does not round: no product
// below needs more than 6000 bits.
TEST(AnyFiniteDouble, LeftOfSumAndIsNearerAreExact) {
  using Exact = boost::multiprecision::number<
      boost::multiprecision::cpp_bin_float<6000, boost::multiprecision::digit_base_2>>;
  struct Vector {
    Exact x, y, z;
    explicit Vector(const Point& p) : x(p.x), y(p.y), z(p.z) {}
    Exact dot(const Vector& o) const { return x * o.x + y * o.y + z * o.z; }
    Exact det(const Vector& b, const Vector& c) const {
      return (y * b.z - z * b.y) * c.x + (z * b.x - x * b.z) * c.y + (x * b.y - y * b.x) * c.z;
    }
  };
  Random random(11);
  const auto length = [&](Point& p) {
    static constexpr int exponents[] = {-1020, -530, -400, -130, 0, 135, 300, 500};
    const int e = exponents[random.below(8)];
    p = {std::ldexp(p.x, e), std::ldexp(p.y, e), std::ldexp(p.z, e)};
  };
  for (int i = 0; i < cases(4000); ++i) {
    Point a = random.direction(), b = random.direction(), c = random.direction(), d;
    const Point s = plus(plus({0, 0, 0}, random.uniform(-1, 1), a), random.uniform(-1, 1), b);
    d = i % 4 == 0 ? random.direction() : minus(s, c);  // mostly, c + d lies near the plane of a and b
    length(a), length(b);
    const Point given = c;
    length(c);
    const double by = given.x != 0 ? c.x / given.x : 1;
    d = scaled(by, d);
    const Exact sum = Vector(a).det(Vector(b), Vector(c)) + Vector(a).det(Vector(b), Vector(d));
    ASSERT_EQ(pstripack::left_of_sum(a, b, c, d), sum.sign()) << text({a, b, c, d});

    Point p = random.direction();
    const Point q = random.direction();
    a = plus({0, 0, 0}, 0.5, q);
    b = nudged(plus(plus({0, 0, 0}, -1, a), 2 * (a.x * p.x + a.y * p.y + a.z * p.z), p), random, 2);
    if (i % 2 == 0) b = random.direction();  // else a's mirror image at p, as near to p up to rounding
    length(a), length(b), length(p);
    const Vector vp(p), va(a), vb(b);
    const Exact to_a = va.dot(vp), to_b = vb.dot(vp),
                nearer = to_a * abs(to_a) * vb.dot(vb) - to_b * abs(to_b) * va.dot(va);
    ASSERT_EQ(pstripack::is_nearer(p, a, b), nearer > 0) << text({p, a, b, b});
  }
}

/// The integers have room for the node whose components differ most in size.
TEST(IsNearer, LooksAtComponentsOfAllSizes) {
  const Point p = {1, 0, 0}, a = {0.8, 0.6, 2e-300}, b = {std::nextafter(0.8, 0.0), -0.6, 1e-300};
  EXPECT_TRUE(pstripack::is_nearer(p, a, b));
  EXPECT_FALSE(pstripack::is_nearer(p, b, a));
}

TEST(SameDirection, LooksAtEveryComponent) {
  std::vector<Point> vectors;
  for (const double x : {-2., -1., 0., 1., 2.})
    for (const double y : {-2., -1., 0., 1., 2.})
      for (const double z : {-2., -1., 0., 1., 2.})
        if (Point{x, y, z} != Point{0, 0, 0}) vectors.push_back({x, y, z});
  for (const Point& a : vectors)
    for (const Point& b : vectors)
      ASSERT_EQ(pstripack::same_direction(a, b), exact::same_direction(a, b)) << text({a, b, a, b});
}

TEST(Above, StrictlyIsTheSignOfTheVolume) {
  const Four f{Point{1, 0, 0}, Point{0, 1, 0}, Point{0, 0, 1}, Point{0.6, 0.8, 0}};
  const Coordinates given(f.data(), 4);
  const Directions unit(f.data(), 4);
  EXPECT_TRUE(given.strictly_above(0, 1, 2, 3) && unit.strictly_above(0, 1, 2, 3));
  EXPECT_FALSE(given.strictly_above(1, 0, 2, 3) || unit.strictly_above(1, 0, 2, 3));
  EXPECT_FALSE(given.strictly_above(0, 1, 3, 3) || unit.strictly_above(0, 1, 3, 3));
}

TEST(Coordinates, CoincideWhereAllAreEqual) {
  const std::vector<Point> p{{1, 2, 3}, {1, 2, 3}, {1, 2, 4}, {1, 3, 3}, {2, 2, 3}, {2, 4, 6}};
  const Coordinates on(p.data(), p.size());
  EXPECT_TRUE(on.coincide(0, 1));
  for (const int other : {2, 3, 4, 5}) EXPECT_FALSE(on.coincide(0, other)) << other;
}

TEST(Above, IsFalseWhereTwoNodesCoincide) {
  const Four different_ones = {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {-1, 1, 1}}};
  for (std::size_t i = 0; i < 4; ++i)
    for (std::size_t j = 0; j < 4; ++j) {
      if (i == j) continue;
      Four f = different_ones;
      f[i] = f[j];
      const Coordinates on(f.data(), 4);
      EXPECT_FALSE(on.above(0, 1, 2, 3)) << i << j;
      Coordinates::View view(on);
      view.from(3);
      if (i == 3 || j == 3) {
        EXPECT_FALSE(view.above(0, 1, 2)) << i << j;
      }
      f[i] = scaled(2, f[j]);
      EXPECT_FALSE(Directions(f.data(), 4).above(0, 1, 2, 3)) << i << j;
    }
}

TEST(Extended, PredicatesAreThoseOfAllNodes) {
  auto nodes = point_sets::make("random", 40);
  for (std::size_t k = 10; k < nodes.size(); k += 2) nodes[k] = scaled(3, nodes[k]);  // no unit vectors
  std::vector<Point> places[2] = {{nodes.begin(), nodes.begin() + 4}, {}};
  Coordinates coordinates(places[0].data(), 4);
  Directions directions(places[0].data(), 4);
  for (std::size_t n = 5; n <= nodes.size(); ++n) {
    std::vector<Point>& elsewhere = places[n % 2];
    elsewhere.assign(nodes.begin(), nodes.begin() + static_cast<std::ptrdiff_t>(n));
    coordinates.extend(elsewhere.data(), n);
    directions.extend(elsewhere.data(), n);
    for (Point& before : places[(n + 1) % 2]) before = {0, 0, 0};
    const Directions anew(elsewhere.data(), n);
    ASSERT_EQ(coordinates.size(), n);
    ASSERT_EQ(directions.size(), n);
    for (pstripack::index_t i = 0; i < static_cast<pstripack::index_t>(n); ++i) {
      ASSERT_EQ(coordinates.given(i), nodes[static_cast<std::size_t>(i)]);
      ASSERT_EQ(directions.given(i), nodes[static_cast<std::size_t>(i)]);
      ASSERT_EQ(directions.position(i), anew.position(i));
      ASSERT_EQ(directions.difference(i, 0), anew.difference(i, 0));
    }
  }
}

TEST(RootSums, AreExact) {
  Random random(16);
  int zeros = 0;
  for (int i = 0; i < cases(40000); ++i) {
    exact::Integer c[4], q[4];
    for (int k = 0; k < 4; ++k) {
      c[k] = static_cast<int>(random.below(9)) - 4;
      q[k] = static_cast<int>(random.below(4)) + 1;
    }
    const int sign = exact::sign_of_root_sum(c, q);
    zeros += sign == 0;
    ASSERT_EQ(pstripack::exact::sign_of_sum<pstripack::exact::Integer>({c[0], c[1], c[2], c[3]},
                                                                       {q[0], q[1], q[2], q[3]}),
              sign);
  }
  EXPECT_GT(zeros, 0);
  // 3 + 1 against two times sqrt(3): the products of the terms are the same.
  EXPECT_EQ(pstripack::exact::sign_of_sum<pstripack::exact::Integer>({3, 1, -1, -1}, {1, 1, 3, 3}), 1);
}

// ---- Near the bounds ----

TEST(Length, CountsAsOneWithinAMillionthOfIt) {
  Random random(15);
  for (int i = 0; i < 1000; ++i) {
    const Point p = random.direction();
    const auto is_one = [&p](double l) { return pstripack::length_is_one(scaled(l, p)); };
    for (const double sign : {-1., 1.}) {
      ASSERT_TRUE(is_one(1 + sign * 1e-6 * (1 - 1e-8)));
      ASSERT_FALSE(is_one(1 + sign * 1e-6 * (1 + 1e-8)));
    }
  }
  const double inf = std::numeric_limits<double>::infinity();
  for (const double bad : {inf, -inf, inf - inf, 1e300}) EXPECT_FALSE(pstripack::length_is_one({bad, 0, 1}));
}

// Determinants, found by hill climbing, whose computed value has the wrong sign although it is as large as
// the given multiple of u times the permanent: only a larger bound rejects it.
TEST(Filter, GivesUpWhereRoundingTellsTheWrongSign) {
  const Four orientation = {{{-0x1.fe5d5b1d5d464p-2, 0x1.4aeb534d1a5fbp-1, 0x1.27d5cbf981a3ap-1},  // 3.1
                             {-0x1.62dc385b64351p-1, -0x1.8ddd74e2f0dddp-2, 0x1.36e053dbf959bp-1},
                             {0x1.21d88b654192bp-1, 0x1.d43298533031dp-3, -0x1.9580ce55eca35p-1},
                             {0x1.453b56087bf1cp+0, 0x1.6d1feda783cafp-2, -0x1.9e2c5c29ba148p+0}}};
  const Four left = {{{0x1.b5fea1a3e81c8p-7, -0x1.6b57c60daf2a8p-1, 0x1.68aa32e3a7efep-1},  // 3.1
                      {-0x1.abd7dd8994b1ep-5, -0x1.9b5135fe27c9fp-1, 0x1.2fb8d9cc65496p-1},
                      {-0x1.942d9e396d26dp-6, 0x1.522830216b085p+0, -0x1.4f803903825fcp+0}}};
  const Four of_directions = {{{-0x1.0889c5ea542edp-3, 0x1.07eba220b9473p+0, 0x1.e60c94887fe26p-1},  // 3.6
                               {0x1.3dcbda7e99574p+0, 0x1.81fe9f27755cp-2, -0x1.26181dd5678ep-3},
                               {0x1.d3f721bcfd8fdp-4, 0x1.3c7700c4572cbp+1, 0x1.311b985380174p-1},
                               {0x1.50bd2f0f89949p+0, 0x1.d74ee84457c65p+0, -0x1.f7c02bb70d555p-2}}};
  const Four left_of_directions = {
      {{-0x1.b6b3cc6b5e376p-1, 0x1.c6a84f39a9831p-6, 0x1.07985a230d006p-1},  // 3.0
       {0x1.70bc740b4c318p-3, -0x1.79ee32ef2c8dp-1, 0x1.4ce36c4186255p-1},
       {-0x1.ed8b2fe70a9f8p+0, 0x1.70366760296c2p+0, -0x1.10d3414f9c918p-2}}};
  EXPECT_EQ(pstripack::orientation(orientation[0], orientation[1], orientation[2], orientation[3]),
            exact::orientation(exact::On::coordinates, orientation[0], orientation[1], orientation[2],
                               orientation[3]));
  EXPECT_EQ(pstripack::left(left[0], left[1], left[2]), exact::left(left[0], left[1], left[2]));
  EXPECT_EQ(Directions(of_directions.data(), 4).strictly_above(0, 1, 2, 3),
            exact::orientation(exact::On::directions, of_directions[0], of_directions[1], of_directions[2],
                               of_directions[3]) > 0);
  EXPECT_EQ(Directions(left_of_directions.data(), 3).left(0, 1, 2),
            exact::left(left_of_directions[0], left_of_directions[1], left_of_directions[2]));
  // Two products underflow to the same denormal, and what is left of the determinant is positive.
  const Point zero{0, 0, 0}, e{0, 0.6 * 0x1p-537, 0.9 * 0x1p-537}, f{0x1p-500, 0x1p-537, 0x1p-537},
      g{0x1p20, 0x1p-23, 0};
  EXPECT_EQ(pstripack::orientation(zero, e, f, g), -1);
  EXPECT_EQ(exact::orientation(exact::On::coordinates, zero, e, f, g), -1);
}

/// Vectors much longer than 1 and nearly along one axis; the last one is off the plane of the others by
/// rounding. Only the products with the large component make the bound large enough.
TEST(Filter, GivesUpWhereOneComponentIsLargeAndRoundingDecides) {
  Random random(23);
  double Point::*const axis[] = {&Point::x, &Point::y, &Point::z};
  for (int i = 0; i < cases(30000); ++i) {
    const auto any = [&] {
      Point p{random.uniform(-1e4, 1e4), random.uniform(-1e4, 1e4), random.uniform(-1e4, 1e4)};
      p.*axis[i % 3] += 1e8;
      return p;
    };
    const double s = random.uniform(-1, 2), t = random.uniform(-1, 2);
    const Point a = any(), b = any(), c = any(), zero{0, 0, 0};
    const Point in_plane = plus(plus(zero, 1 - s, a), s, b),
                level = plus(plus(plus(zero, 1 - s - t, a), s, b), t, c);
    ASSERT_EQ(pstripack::left(a, b, in_plane), exact::left(a, b, in_plane)) << text({a, b, in_plane, c});
    ASSERT_EQ(pstripack::orientation(a, b, c, level),
              exact::orientation(exact::On::coordinates, a, b, c, level))
        << text({a, b, c, level});
  }
}

/// Coplanar, since three lie on one line; seen from the first, one is far away along an axis, and only
/// products with that component make the bound of double-double arithmetic larger than its rounding.
TEST(Filter, GivesUpWhereOneDifferenceIsLargeAndDoubleDoubleRounds) {
  Random random(24);
  double Point::*const axis[] = {&Point::x, &Point::y, &Point::z};
  const auto any = [&random](double most) {
    const auto whole = [&] { return std::floor(random.uniform(-most, most)); };
    return Point{whole(), whole(), whole()};
  };
  for (int i = 0; i < cases(3000); ++i) {
    const Point a = any(0x1p20), f = any(0x1p50);
    Point p[] = {plus(a, 1, f), plus(a, 3, f), plus(a, 1, any(0x1p30))};
    p[2].*axis[i % 3] += std::floor(random.uniform(0x1p51, 0x1p52));
    std::swap(p[2], p[i / 3 % 3]);
    ASSERT_EQ(pstripack::orientation(a, p[0], p[1], p[2]), 0) << text({a, p[0], p[1], p[2]});
  }
}

/// Four nodes near the equator and four near a circle of latitude, off by t and by about t^2, for t down to
/// the least double: volumes down to 1e-647.
TEST(VanishingVolumes, AreToldFromZero) {
  for (double t = 0.5; t > 0; t /= 1024) {
    const Four equator = {{{1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, t}}};  // the last is above
    const Four circle = {{{1, 0, 1}, {0, 1, 1}, {-1, 0, 1}, {t, -1, 1}}};   // the last is below
    ASSERT_EQ(pstripack::left({1, 0, 0}, {0, 1, 0}, {1, 1, t}), 1) << t;
    for (const auto& p : permutations) {
      ASSERT_EQ(pstripack::orientation(equator[p[0]], equator[p[1]], equator[p[2]], equator[p[3]]), p[4])
          << t;
      for (const double scale : {1.0, 3.0, 0x1p-40}) {
        Four f = circle;
        f[1] = scaled(scale, f[1]);
        ASSERT_EQ(pstripack::orientation_of_directions(f[p[0]], f[p[1]], f[p[2]], f[p[3]]), -p[4]) << t;
        ASSERT_EQ(Directions(f.data(), 4).above(p[0], p[1], p[2], p[3]), p[4] < 0) << t;
      }
    }
  }
}

// ---- Around the grid of exact_signs.h ----

/// Integers of three bits at scales around 1, at the edge of the grid. The last node is collinear or coplanar
/// with the others up to last bits: the filter does not decide, and nothing may overflow. Every other time
/// slightly outside the grid.
TEST(Grid, IsLeftOutBeforeAnythingOverflows) {
  Random random(22);
  for (int i = 0; i < cases(40000); ++i) {
    const double scale = std::ldexp(1, static_cast<int>(random.below(6)) - 3);
    const auto multiple = [&] { return scale * (static_cast<double>(random.below(7)) - 3); };
    const auto two_or_three = [&] {
      return (random.below(2) == 0 ? 1 : -1) * (2 + static_cast<double>(random.below(2)));
    };
    const auto any = [&] {
      return i % 2 == 0 ? Point{multiple(), multiple(), multiple()}
                        : Point{two_or_three(), two_or_three(), two_or_three()};
    };
    const auto nudged = [&](const Point& p) {
      const auto nudge = [&](double v) {
        return v * (1 + 0x1p-52 * (static_cast<double>(random.below(3)) - 1));
      };
      return Point{nudge(p.x), nudge(p.y), nudge(p.z)};
    };
    const double s = static_cast<double>(random.below(3)) - 1,
                 t = i % 2 == 0 ? static_cast<double>(random.below(3)) - 1 : -s;
    const Point a = any(), b = any(), c = any();
    // Off the plane of the others by a last bit, or in it: undecided in floating point.
    const Four f{a, b, c, nudged(plus(plus(plus(Point{0, 0, 0}, 1 - s - t, a), s, b), t, c))};
    const Point in_plane = nudged(plus(plus(Point{0, 0, 0}, s, a), t, b));
    ASSERT_EQ(pstripack::orientation(f[0], f[1], f[2], f[3]),
              exact::orientation(exact::On::coordinates, f[0], f[1], f[2], f[3]))
        << text(f);
    ASSERT_EQ(pstripack::left(a, b, in_plane), exact::left(a, b, in_plane)) << text({a, b, in_plane, c});
  }
}

// ---- Directions as close as doubles can have them ----

/// Neighbouring quotients of Fibonacci numbers differ by 2^-100 or less; their rounded difference is
/// arbitrary.
TEST(Directions, ThatDifferLeastOfAllAreToldApart) {
  Random random(21);
  for (int i = 0; i < 3000; ++i) {
    double f = 1, g = 1;
    for (int k = static_cast<int>(random.below(8)) + 69; k > 0; --k) f = std::exchange(g, f + g);
    const Point a{f, g, 0}, b{g - f, f, 0};
    Four four{a, b, random.direction(), random.direction()};
    const std::size_t turn = random.below(3), first = random.below(4);
    for (Point& p : four) p = turn == 0 ? p : turn == 1 ? Point{p.y, p.z, p.x} : Point{p.z, p.x, p.y};
    std::rotate(four.begin(), four.begin() + static_cast<std::ptrdiff_t>(first), four.end());
    const Directions on(four.data(), 4);
    for (const auto& n : {std::array<int, 3>{0, 1, 2}, {1, 2, 3}, {2, 3, 0}, {3, 0, 1}})
      ASSERT_EQ(on.left(n[0], n[1], n[2]),
                exact::left(four[static_cast<std::size_t>(n[0])], four[static_cast<std::size_t>(n[1])],
                            four[static_cast<std::size_t>(n[2])]))
          << text(four);
    ASSERT_EQ(on.above(0, 1, 2, 3),
              exact::above(exact::On::directions, four[0], four[1], four[2], four[3]) > 0)
        << text(four);
  }
}

// ---- What the kernel builds its filter on ----

using Wide = boost::multiprecision::cpp_bin_float_100;

TEST(Directions, PositionsAndDifferencesAreAsAccurateAsPromised) {
  Random random(11);
  for (int i = 0; i < cases(20000); ++i) {
    const double size = std::pow(10.0, -(i % 16));
    Four f = anywhere(random, size);
    for (Point& p : f) {
      const double s = std::exp(random.uniform(-20, 20));
      p = i % 4 == 3 ? point_sets::normalized(p) : scaled(s, p);
      // All of it, or one component, almost as large or as small as there is.
      const int exponent = random.below(2) == 0 ? 990 : -990;
      if (i % 4 == 1) p = {std::ldexp(p.x, exponent), std::ldexp(p.y, exponent), std::ldexp(p.z, exponent)};
      double Point::*const one[3] = {&Point::x, &Point::y, &Point::z};
      if (double& c = p.*one[random.below(3)]; i % 4 == 2) c = std::ldexp(c, exponent);
    }
    const Directions on(f.data(), 4);
    Wide unit[2][3];
    for (int k = 0; k < 2; ++k) {
      const Wide x = f[k].x, y = f[k].y, z = f[k].z, length = sqrt(x * x + y * y + z * z);
      unit[k][0] = x / length, unit[k][1] = y / length, unit[k][2] = z / length;
    }
    const Point p = on.position(0), d = on.difference(0, 1);
    const double position[3] = {p.x, p.y, p.z}, difference[3] = {d.x, d.y, d.z};
    const auto [high, low] = pstripack::unit_vector(f[0]);
    const Wide both[3] = {Wide(high.x) + low.x, Wide(high.y) + low.y, Wide(high.z) + low.z};
    for (int j = 0; j < 3; ++j) {
      ASSERT_LE(abs(both[j] - unit[0][j]), abs(unit[0][j]) * 0x1p-100 + Wide(0x1p-1070)) << text(f);
      // A vector whose length is 1 up to rounding stays as it is.
      ASSERT_LE(abs(Wide(position[j]) - unit[0][j]), Wide(i % 4 == 3 ? 0x1.1p-52 : 0x1p-53)) << text(f);
      const Wide true_difference = unit[0][j] - unit[1][j];
      ASSERT_LE(abs(Wide(difference[j]) - true_difference),
                abs(true_difference) * 2.01 * 0x1p-53 + Wide(0x1p-99))
          << text(f);
    }
  }
}

// ---- From 1 down to denormals: the predicates on directions, and as a node that is inserted sees them ----

/// Nodes around (1,0,0), where doubles are fine: each at its own scale, some a few ulps from another, some on
/// the circle through the others up to rounding; with different lengths.
Four nested(Random& random) {
  const double decades[] = {1, 10, 75, 150, 290, 304, 322};
  const double deepest = decades[random.below(7)];
  const auto scale = [&] { return std::pow(10, -deepest * random.uniform()); };
  const double common = scale();
  const bool has_one_scale = random.below(2) == 0;
  Four f;
  for (Point& p : f) {
    const double s = has_one_scale ? common : scale(), angle = 360 * random.uniform();
    p = {1, s * point_sets::cos_degrees(angle), s * point_sets::sin_degrees(angle)};
  }
  if (random.below(3) == 0) {
    f[3] = f[0];
    f[3].y = std::nextafter(f[3].y, 2.0 * static_cast<double>(random.below(2)));
  }
  for (Point& p : f) {
    const double length = random.below(2) == 0 ? 1 : std::exp2(static_cast<double>(random.below(8)));
    p = scaled(length, p);
  }
  const std::size_t turn = random.below(3);
  for (Point& p : f) p = turn == 0 ? p : turn == 1 ? Point{p.z, -p.x, p.y} : Point{p.y, p.z, -p.x};
  return f;
}

void expect_directions_exact(const Four& f) {
  const Directions on(f.data(), 4);
  Directions::View view(on);
  for (int d = 0; d < 4; ++d) {
    const int a = (d + 1) % 4, b = (d + 2) % 4, c = (d + 3) % 4;
    const bool above = exact::above(exact::On::directions, f[a], f[b], f[c], f[d]) > 0;
    ASSERT_EQ(on.above(a, b, c, d), above) << text(f);
    view.from(d);
    for (int again = 0; again < 2; ++again) {
      ASSERT_EQ(view.above(a, b, c), above) << text(f);
      ASSERT_EQ(view.tied(), exact::orientation(exact::On::directions, f[a], f[b], f[c], f[d]) == 0)
          << text(f);
      ASSERT_EQ(view.left(a, b), exact::left(f[a], f[b], f[d])) << text(f);
      ASSERT_EQ(on.left(a, b, d), exact::left(f[a], f[b], f[d])) << text(f);
    }
  }
}

TEST(Directions, AreExactAtEveryScale) {
  Random random(31);
  for (int i = 0; i < cases(20000); ++i) {
    const Four f = nested(random);
    if (!different(f)) continue;
    ASSERT_NO_FATAL_FAILURE(expect_directions_exact(f));
    ASSERT_EQ(pstripack::above_of_directions(f[0], f[1], f[2], f[3]),
              Directions(f.data(), 4).above(0, 1, 2, 3));
  }
}

/// What decided nodes that doubles do not decide, unit vectors times a length.
pstripack::PredicateCounts decide_hard_cases(double length, std::uint64_t& sets) {
  Random random(32);
  pstripack::take_predicate_counts();
  for (int i = 0; i < cases(6000); ++i) {
    const double size = std::pow(10, -15 * random.uniform());
    for (Four f : {nearly_cocircular(random, size), nearly_on_great_circle(random, size)}) {
      for (Point& p : f) p = scaled(length, p);
      if (!different(f)) continue;
      expect_directions_exact(f);
      if (testing::Test::HasFatalFailure()) break;
      ++sets;
    }
  }
  return pstripack::take_predicate_counts();
}

TEST(Directions, AreExactWhereDoubleDoubleHasToDecide) {
  std::uint64_t sets = 0;
  const auto counts = decide_hard_cases(3, sets);
  EXPECT_GT(counts.double_double, sets);  // else this tests nothing
  EXPECT_LE(counts.integers, sets / 100);
  if (sets > 5000) {
    EXPECT_GT(counts.integers, 0u);  // rare
  }
}

/// How small the nodes and their distances are does not matter to the filter.
TEST(Directions, AreMostlyDecidedInDoublesAtEveryScale) {
  Random random(34);
  const auto scale = [&] { return std::pow(10, -150 * random.uniform()); };
  constexpr int sets = 2000;
  for (const bool have_one_scale : {true, false}) {
    pstripack::take_predicate_counts();
    for (int i = 0; i < sets; ++i) {
      const double common = scale();
      Four f;
      for (Point& p : f) {
        const double s = (have_one_scale ? common : scale()) * random.uniform(0.1, 1),
                     angle = 360 * random.uniform();
        p = {1, s * point_sets::cos_degrees(angle), s * point_sets::sin_degrees(angle)};
      }
      pstripack::orientation_of_directions(f[0], f[1], f[2], f[3]);
    }
    EXPECT_LE(pstripack::take_predicate_counts().double_double, sets / 100u);
  }
}

/// Where two nodes are close to each other, one of them is the apex.
TEST(Directions, AreMostlyDecidedInDoublesForClosePairs) {
  Random random(35);
  constexpr int sets = 2000;
  pstripack::take_predicate_counts();
  for (int i = 0; i < sets; ++i) {
    const auto close = [&] { return Point{3, 1e-20 * random.uniform(), 1e-20 * random.uniform()}; };
    const Four f = {random.direction(), random.direction(), close(), close()};
    pstripack::orientation_of_directions(f[0], f[1], f[2], f[3]);
  }
  EXPECT_LE(pstripack::take_predicate_counts().double_double, sets / 100u);
}

TEST(Directions, AreExactWhereTheLengthsOfUnitVectorsDecide) {
  std::uint64_t sets = 0;
  const auto counts = decide_hard_cases(1, sets);
  EXPECT_LT(counts.double_double, sets - sets / (sets > 1000 ? 4 : 5));  // few sets: chance
}

/// Two nodes are opposite to each other, the two others nearly: doubles with 53 bits, and a determinant of 1.
TEST(Directions, AreExactForNodesNearlyOppositeToEachOther) {
  const double f78 = 8944394323791464, f77 = 5527939700884757, f76 = 3416454622906707;  // Fibonacci's numbers
  const Four f = {{{f78, f77, 0}, {0, 0, 1}, {-f77, -f76, 0}, {0, 0, -1}}};
  ASSERT_NE(exact::orientation(exact::On::directions, f[0], f[1], f[2], f[3]), 0);
  expect_directions_exact(f);
}

TEST(Directions, AreExactForTies) {
  Random random(33);
  for (int i = 0; i < cases(3000); ++i)
    for (const Four& f : {symmetric(random, 1), lattice(random, std::pow(10, -8 * random.uniform()))}) {
      if (!different(f)) continue;
      ASSERT_NO_FATAL_FAILURE(expect_directions_exact(f));
    }
}

// Two nodes and their mirror images are the corners of a trapezoid, so they lie on one circle. Around an axis
// the components along it are equal except for some last bits.
TEST(Directions, AreExactForMirrorImages) {
  Random random(35);
  for (int i = 0; i < cases(20000); ++i) {
    const double size = std::pow(2, -40 * random.uniform());
    const auto component = [&] { return size * random.uniform(-1, 1); };
    const double a = component(), b = component(), c = component(), d = component();
    Four f{Point{1, a, b}, {1, b, a}, {1, c, d}, {1, d, c}};
    if (!different(f)) continue;
    std::rotate(f.begin(), f.begin() + i % 4, f.end());
    for (Point& p : f) p = i % 3 == 0 ? p : i % 3 == 1 ? Point{p.z, p.x, p.y} : Point{-p.y, p.z, -p.x};
    ASSERT_EQ(pstripack::orientation_of_directions(f[0], f[1], f[2], f[3]), 0) << text(f);
    ASSERT_NO_FATAL_FAILURE(expect_directions_exact(f));
  }
}

TEST(Coordinates, AreSeenFromANodeAsFromOutside) {
  Random random(34);
  for (int i = 0; i < cases(20000); ++i) {
    const double size = std::pow(10, -15 * random.uniform());
    for (const Four& f : {anywhere(random, size), nearly_cocircular(random, size), symmetric(random, size),
                          lattice(random, size)}) {
      if (!different(f)) continue;
      const Coordinates on(f.data(), 4);
      Coordinates::View view(on);
      view.from(3);
      for (int again = 0; again < 2; ++again) {
        ASSERT_EQ(view.above(0, 1, 2), on.above(0, 1, 2, 3)) << text(f);
        ASSERT_EQ(view.left(0, 1), on.left(0, 1, 3)) << text(f);
      }
      view.from(0);
      ASSERT_EQ(view.above(1, 3, 2), on.above(1, 3, 2, 0)) << text(f);
    }
  }
}

/// Ties of nodes in one plane of constant z, some so large or small that products overflow or underflow.
TEST(Coordinates, DecideTiesOfAnySize) {
  Random random(36);
  for (int i = 0; i < cases(2000); ++i) {
    Four f;
    const double z = random.below(2) == 0 ? 1 : 0x1p-530;
    const auto any = [&] {
      static constexpr double sizes[] = {1, 1, 0x1p500, 0x1p-530, 0x1p-545};
      return random.uniform(-1, 1) * sizes[random.below(5)];
    };
    for (Point& p : f) p = {any(), any(), z};
    const Coordinates on(f.data(), 4);
    Coordinates::View view(on);
    view.from(3);
    const bool above = exact::above(exact::On::coordinates, f[0], f[1], f[2], f[3]) > 0;
    ASSERT_EQ(view.above(0, 1, 2), above) << text(f);
    ASSERT_EQ(on.above(0, 1, 2, 3), above) << text(f);
  }
}

TEST(Left, SeesWhatLiesBelowTheSmallestDouble) {
  // The z of a, 2^-758 beside 2^338, is less than any double once a has length 1, and decides.
  const Point a{-0x1.e35cdf666b99ap-14, -0x1.206e94e5e615p+338, -0x1.ce9f60b9770bp-758},
      b{-0x1.0ede618f7a3e8p+597, 0, -0x1.bfe8f08d004aep-838},
      c{0x1.464f3a7eba5p-727, -0x1.96493c725827p+75, -0x0.1e03fd7ed6728p-1022};
  EXPECT_EQ(pstripack::left(a, b, c), exact::left(a, b, c));
  const Point p[] = {a, b, c};
  EXPECT_EQ(Directions(p, 3).left(0, 1, 2), exact::left(a, b, c));
}

// ---- How often the filter gives up ----

struct Share {
  double exact, symbolic;  ///< not decided by doubles; ties
};

Share shares(const std::vector<Point>& p) {
  Random random(12);
  const Coordinates on(p.data(), p.size());
  pstripack::take_predicate_counts();
  int calls = 0;
  for (; calls < 200000; ++calls) {
    const auto i = static_cast<pstripack::index_t>(random.below(p.size() - 3));
    (void)on.above(i, i + 1, i + 2, i + 3);
  }
  const auto counts = pstripack::take_predicate_counts();
  return {static_cast<double>(counts.double_double + counts.integers) / calls,
          static_cast<double>(counts.symbolic) / calls};
}

TEST(Filter, HardlyEverGivesUpOnRandomNodes) {
  EXPECT_LT(shares(point_sets::make("random", 10000)).exact, 1e-4);
}

TEST(Filter, IsLeftOutWhereLargeComponentsMakeUpForProductsThatUnderflow) {
  // det(e,f,g) = 1e-170 * 1e-170 * 1e200 - 1e-170 * 1 * 1e-30: the first product underflows to zero.
  const Point o{0, 0, 0}, e{0, 1e-170, 0}, f{1, 0, 1e-170}, g{1e200, 0, 1e-30};
  EXPECT_EQ(pstripack::orientation(o, e, f, g), 1);
  EXPECT_EQ(pstripack::orientation(o, f, g, e), 1);
  EXPECT_EQ(pstripack::orientation(o, g, e, f), 1);
  // det(a,b,c) = 0.4 * 2^-537 * (1e200 * 2^-537 - 1e-152 * ulp(1e200)): seen from a, the first product
  // underflows.
  const double t = 0x1p-537;
  const Point a{1e200, 1e-152, 0}, b{std::nextafter(1e200, 1e300), 1e-152 + t, 0}, c{1e200, 1e-152, 0.4 * t};
  EXPECT_EQ(pstripack::left(a, b, c), 1);
  EXPECT_EQ(pstripack::left(a, b, c), exact::left(a, b, c));
  EXPECT_EQ(pstripack::left(b, c, a), exact::left(a, b, c));
  EXPECT_EQ(pstripack::left(c, a, b), exact::left(a, b, c));
}

TEST(Stages, AreCountedWhereTheyAreEntered) {
  using Counts = std::array<std::uint64_t, 6>;  // as in PredicateCounts
  const auto counts_of = [](const auto& call) {
    pstripack::take_predicate_counts();
    call();
    const auto c = pstripack::take_predicate_counts();
    return Counts{c.above, c.left, c.double_double, c.integers, c.big_integers, c.symbolic};
  };
  const double h = std::sqrt(0.5);
  struct Row {
    Four nodes;
    Counts as_given, of_directions;  // of the volume, without the tie rule
  };
  const Row rows[] = {
      // Decided by doubles.
      {{Point{1, 0, 0}, Point{0, 1, 0}, Point{0, 0, 1}, Point{h, h, 0}}, {}, {}},
      // The equator: no arithmetic for coordinates; for directions after double-double is undecided.
      {{Point{0.6, 0.8, 0}, Point{-0.6, 0.8, 0}, Point{-0.8, -0.6, 0}, Point{0.6, -0.8, 0}}, {}, {0, 0, 1}},
      // A parallel: a tie of directions takes the integers of a bracket and of the volume.
      {{Point{0.6, 0, 0.8}, Point{0, 0.6, 0.8}, Point{-0.6, 0, 0.8}, Point{0, -0.6, 0.8}}, {}, {0, 0, 1, 2}},
      // A tie of coordinates, on the grid of small integers; of directions doubles see more.
      {{Point{1, 0, 0}, Point{0, 1, 0}, Point{0, 0, 1}, Point{1, 1, -1}}, {0, 0, 0, 1}, {}},
      // The same beside the grid.
      {{Point{0x1p-80, 0, 0}, Point{0, 0x1p-80, 0}, Point{0, 0, 0x1p-80}, Point{0x1p-80, 0x1p-80, -0x1p-80}},
       {0, 0, 1, 1},
       {}},
  };
  for (const Row& row : rows) {
    const auto& [a, b, c, d] = row.nodes;
    EXPECT_EQ(counts_of([&, &a = a, &b = b, &c = c, &d = d] { pstripack::orientation(a, b, c, d); }),
              row.as_given);
    EXPECT_EQ(
        counts_of([&, &a = a, &b = b, &c = c, &d = d] { pstripack::orientation_of_directions(a, b, c, d); }),
        row.of_directions);
    const long tie = exact::orientation(exact::On::coordinates, a, b, c, d) == 0,
               unit_tie = exact::orientation(exact::On::directions, a, b, c, d) == 0;
    const Coordinates given(row.nodes.data(), 4);
    const Directions unit(row.nodes.data(), 4);
    EXPECT_EQ(counts_of([&] { (void)given.above(0, 1, 2, 3); })[0], 1);
    EXPECT_EQ(counts_of([&] { (void)given.above(0, 1, 2, 3); })[5], tie);
    EXPECT_EQ(counts_of([&] { (void)unit.above(0, 1, 2, 3); })[5], unit_tie);
  }
  const Four& clear = rows[0].nodes;
  EXPECT_EQ(counts_of([&] { pstripack::left(clear[0], clear[1], clear[2]); }), (Counts{0, 1}));
  EXPECT_EQ(counts_of([&] { pstripack::left(clear[0], clear[1], clear[3]); }), (Counts{0, 1}));
  EXPECT_EQ(counts_of([&] { pstripack::left({1, 0, 1}, {0, 1, 1}, {1, 1, 2}); }), (Counts{0, 1, 1, 1}));
  // Coordinates of 2^-300 and of 1 in one vector: too many bits for a fixed size.
  EXPECT_EQ(counts_of([&] {
              pstripack::left({1, 0x1p-300, 1}, {0x1p-300, 1, 1}, {1, 1 + 0x1p-300, 2});
            })[4],
            1);
}

TEST(Filter, CountsTheTieRuleOnTies) {
  const auto ring = point_sets::make("ring", 1000);  // all but the last on one circle
  EXPECT_GT(shares(ring).symbolic, 0.9);
}

}  // namespace
