#include "small_pools.h"

#include <cmath>
#include <iterator>
#include <limits>

#include "point_sets.h"

namespace {

using point_sets::normalized;
using point_sets::Random;
using pstripack::Point;

/// The nonzero integer vectors with components up to +-`largest` for which keep(p) is true.
template <class Keep>
Nodes lattice(int largest, const Keep& keep) {
  Nodes nodes;
  for (int x = -largest; x <= largest; ++x)
    for (int y = -largest; y <= largest; ++y)
      for (int z = -largest; z <= largest; ++z) {
        const Point p{double(x), double(y), double(z)};
        if (p != Point{0, 0, 0} && keep(p)) nodes.push_back(p);
      }
  return nodes;
}

Nodes lattice(int largest) {
  return lattice(largest, [](const Point&) { return true; });
}

/// At most `count` different nodes of those given.
Nodes some(Nodes nodes, std::size_t count, Random& random) {
  point_sets::shuffle(nodes, random.bits());
  if (nodes.size() > count) nodes.resize(count);
  return nodes;
}

/// The nodes, and nodes of the lattice up to 2 until the pool is full.
Nodes filled(Nodes nodes, Random& random) {
  for (const Point& p : some(lattice(2), kPoolSize - nodes.size(), random)) nodes.push_back(p);
  return nodes;
}

template <class Change>
Nodes changed(Nodes nodes, const Change& change) {
  for (Point& p : nodes) p = change(p);
  return nodes;
}

Nodes rounded(Nodes nodes) { return changed(std::move(nodes), normalized); }

Nodes integers_to_1(Random& random) { return some(lattice(1), kPoolSize, random); }
Nodes integers_to_2(Random& random) { return some(lattice(2), kPoolSize, random); }
Nodes unit_of_1(Random& random) { return rounded(integers_to_1(random)); }
Nodes unit_of_2(Random& random) { return rounded(integers_to_2(random)); }

/// A few places with several nodes each, whose components differ by some ulps; near 0 by ulps of 1 or, in few
/// pools, by the smallest denormals.
Nodes ulps_apart(Random& random) {
  const Nodes places = rounded(some(lattice(random.below(2) == 0 ? 1 : 2), 3 + random.below(4), random));
  const double beside_zero = random.below(32) == 0 ? 0x1p-1074 : 0x1p-53;
  const auto moved = [&](double v) {
    const int steps = static_cast<int>(random.below(5)) - 2;
    if (v == 0) return steps * beside_zero;
    for (int i = 0; i < std::abs(steps); ++i) v = std::nextafter(v, steps > 0 ? 2. : -2.);
    return v;
  };
  Nodes nodes;
  for (int i = 0; i < kPoolSize; ++i) {
    const Point& p = places[random.below(places.size())];
    nodes.push_back({moved(p.x), moved(p.y), moved(p.z)});
  }
  return nodes;
}

/// Most nodes on the great circle of one lattice plane.
Nodes great_circle(Random& random) {
  const Nodes normals = lattice(1);
  const Point normal = normals[random.below(normals.size())];
  return filled(some(lattice(2, [&](const Point& p) { return dot(p, normal) == 0; }), 13, random), random);
}
Nodes rounded_great_circle(Random& random) { return rounded(great_circle(random)); }

/// The same directions at several lengths: multiples by powers of two and small integers are exact.
Nodes radial_multiples(Random& random) {
  const Nodes directions = some(lattice(1), 10, random);
  const double lengths[] = {1, 1, 2, 3, 0.5, 0x1p-1074, 0x1p-600, 0x1p1000};
  Nodes nodes;
  for (int i = 0; i < kPoolSize; ++i) {
    const double length = lengths[random.below(std::size(lengths))];
    nodes.push_back(scaled(length, directions[random.below(directions.size())]));
  }
  return nodes;
}

Nodes antipodes(Random& random) {
  Nodes nodes = rounded(some(lattice(2), kPoolSize / 2, random));
  for (int i = 0; i < kPoolSize / 2; ++i) nodes.push_back(scaled(-1, nodes[i]));
  return nodes;
}

/// A closed hemisphere, with half of the nodes on its rim.
Nodes hemisphere(Random& random) {
  Nodes nodes = some(lattice(2, [](const Point& p) { return p.z == 0; }), kPoolSize / 2, random);
  for (const Point& p : some(lattice(2, [](const Point& p) { return p.z > 0; }), kPoolSize / 2, random))
    nodes.push_back(p);
  return random.below(4) == 0 ? nodes : rounded(nodes);
}

/// A lattice in a cap so small that its nodes lie nearly in one plane.
Nodes small_cap(Random& random) {
  const double steps[] = {0x1p-8, 0x1p-20, 0x1p-26, 0x1p-27, 0x1p-40, 0x1p-52};
  const double step = steps[random.below(std::size(steps))];
  const Nodes places = some(lattice(2, [](const Point& p) { return p.z == 1; }), kPoolSize, random);
  return changed(places, [&](const Point& p) { return normalized({1, p.x * step, p.y * step}); });
}

/// Lengths so near 1 that they are taken as given, so that nodes hide others; two lengths differ by more.
Nodes lengths_near_1(Random& random) {
  const Nodes places = rounded(some(lattice(2), 6 + random.below(10), random));
  Nodes nodes;
  for (int i = 0; i < kPoolSize; ++i) {
    const double step = i < 2 ? 0x1p-19 : (static_cast<double>(random.below(9)) - 4) * 0x1p-22;
    nodes.push_back(scaled(1 + step, places[random.below(places.size())]));
  }
  return nodes;
}

/// Components of very different magnitude.
Nodes exponents_apart(Random& random) {
  const double magnitudes[] = {0, 1, 1, 0x1p-30, 0x1p-60, 0x1p-200};
  const auto component = [&] {
    const double v = magnitudes[random.below(std::size(magnitudes))];
    return random.below(2) == 0 ? v : -v;
  };
  Nodes nodes;
  while (nodes.size() < kPoolSize)
    if (const Point p{component(), component(), component()}; p != Point{0, 0, 0}) nodes.push_back(p);
  return nodes;
}

/// A pool with one vector that has no direction.
Nodes one_without_direction(Random& random) {
  Nodes nodes = unit_of_2(random);
  const double inf = std::numeric_limits<double>::infinity(), nan = std::numeric_limits<double>::quiet_NaN();
  const Point bad[] = {{0, 0, 0}, {-0., 0, -0.}, {nan, 0, 1}, {0, inf, 0}, {1, 0, -inf}, {nan, nan, nan}};
  nodes[random.below(kPoolSize)] = bad[random.below(std::size(bad))];
  return nodes;
}

struct Family {
  const char* name;
  Nodes (*make)(Random&);
};

constexpr Family families[kPoolFamilies] = {{"integers up to 1", integers_to_1},
                                            {"integers up to 2", integers_to_2},
                                            {"unit vectors of integers up to 1", unit_of_1},
                                            {"unit vectors of integers up to 2", unit_of_2},
                                            {"ulps apart", ulps_apart},
                                            {"great circle", great_circle},
                                            {"rounded great circle", rounded_great_circle},
                                            {"radial multiples", radial_multiples},
                                            {"antipodes", antipodes},
                                            {"hemisphere", hemisphere},
                                            {"small cap", small_cap},
                                            {"lengths near 1", lengths_near_1},
                                            {"exponents apart", exponents_apart},
                                            {"one without direction", one_without_direction}};

}  // namespace

const char* pool_family(std::uint64_t number) { return families[number % kPoolFamilies].name; }

Nodes make_pool(std::uint64_t number) {
  Random random(number);
  return families[number % kPoolFamilies].make(random);
}
