// Canonical form and fingerprint of sets of triangles; the planes of a hull.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <set>

#include "mesh/delaunay.h"
#include "mesh/triangulation.h"
#include "point_sets.h"

namespace {

using point_sets::Random;
using pstripack::Triangle;
using pstripack::Triangles;

Triangles some_triangles(Random& random, std::size_t count) {
  std::set<Triangle> distinct;
  while (distinct.size() < count) {
    Triangle t;
    for (auto& k : t) k = static_cast<std::int32_t>(random.below(1000));
    if (t[0] < t[1] && t[0] < t[2] && t[1] != t[2]) distinct.insert(t);
  }
  return {distinct.begin(), distinct.end()};
}

void scramble(Triangles& triangles, Random& random) {
  for (std::size_t i = triangles.size(); i > 1; --i) std::swap(triangles[i - 1], triangles[random.below(i)]);
  for (Triangle& t : triangles)
    std::rotate(t.begin(), t.begin() + static_cast<std::ptrdiff_t>(random.below(3)), t.end());
}

TEST(CanonicalForm, UndoesAnyOrder) {
  Random random(1);
  for (const std::size_t count : {0, 1, 2, 100, 5000}) {
    const Triangles canonical = some_triangles(random, count);
    Triangles scrambled = canonical;
    scramble(scrambled, random);
    pstripack::make_canonical(scrambled);
    EXPECT_EQ(scrambled, canonical);
  }
}

TEST(Fingerprint, DoesNotDependOnTheOrder) {
  Random random(2);
  for (const std::size_t count : {1, 2, 100, 5000}) {
    Triangles triangles = some_triangles(random, count);
    const std::uint64_t print = pstripack::fingerprint(triangles);
    scramble(triangles, random);
    EXPECT_EQ(pstripack::fingerprint(triangles), print);
  }
}

TEST(Fingerprint, ChangesWithAnyChange) {
  Random random(3);
  const Triangles triangles = some_triangles(random, 200);
  std::set<std::uint64_t> prints{pstripack::fingerprint(triangles)};
  std::size_t changes = 0;
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    Triangles t = triangles;
    std::swap(t[i][1], t[i][2]);  // the other orientation
    prints.insert(pstripack::fingerprint(t));
    t = triangles;
    t.erase(t.begin() + static_cast<std::ptrdiff_t>(i));
    prints.insert(pstripack::fingerprint(t));
    t = triangles;
    t.push_back(t[i]);  // once more
    prints.insert(pstripack::fingerprint(t));
    for (int corner = 0; corner < 3; ++corner) {
      t = triangles;
      t[i][corner] += 1000;
      prints.insert(pstripack::fingerprint(t));
    }
    changes += 6;
  }
  for (std::size_t i = 1; i < triangles.size(); ++i) {  // corners exchanged between two triangles
    Triangles t = triangles;
    if (t[i][1] == t[i - 1][1]) continue;
    std::swap(t[i][1], t[i - 1][1]);
    prints.insert(pstripack::fingerprint(t));
    ++changes;
  }
  EXPECT_EQ(prints.size(), changes + 1);
}

// ---- The plane of a face: see mesh/delaunay.cpp ----

struct Planes {
  std::size_t faces = 0, decide = 0;  ///< all faces; faces whose plane is certain about the centre
};

/// If a plane is certain about a node or the centre, it must agree with the predicates.
Planes expect_right_planes(const char* family, pstripack::Lengths lengths) {
  constexpr std::size_t n = 120;
  std::vector<pstripack::Point> nodes = point_sets::make(family, n);
  std::vector<pstripack::Face> faces(2 * n);
  std::vector<pstripack::Plane> planes(2 * n);
  std::vector<std::uint32_t> corner(n);
  const auto hull =
      pstripack::GrowingHull::make({n, nodes.data(), faces.data(), planes.data(), corner.data()}, n, lengths);
  try {
    hull->build(0);
  } catch (const pstripack::HiddenNode&) {
    return {};
  }
  Planes all;
  for (std::size_t t = 0; t < hull->face_count(); ++t) {
    const pstripack::Plane& p = planes[t];
    const auto& v = faces[t].vertex;
    const int side = (p.w > 1) - (p.w < -1);
    ++all.faces, all.decide += side != 0;
    if (side != 0) {
      EXPECT_EQ(hull->left(v[0], v[1], v[2]), side) << family << ", face " << t;
    }
    for (std::uint32_t d = 0; d < n; ++d) {
      const double height = p.x * nodes[d].x + p.y * nodes[d].y + (p.z * nodes[d].z - p.w);
      const bool above = hull->above(v[0], v[1], v[2], d);
      const bool unit = lengths == pstripack::Lengths::as_given;  // else `nodes` are not what is triangulated
      if (unit && std::fabs(height) > 1) {
        EXPECT_EQ(height > 0, above) << family << ", face " << t << ", " << d;
      }
      for (int k = 0; k < 3; ++k) {
        const pstripack::Point g = hull->difference(v[k], d);
        const double drop = p.x * g.x + p.y * g.y + p.z * g.z;
        if (std::fabs(drop) > 0.5 * (std::fabs(g.x) + std::fabs(g.y) + std::fabs(g.z)) + 0x1p-45) {
          EXPECT_EQ(drop < 0, above) << family << ", face " << t << ", " << d;
        }
      }
    }
  }
  return all;
}

TEST(Planes, AreRightWhereTheyAreCertain) {
  for (const auto lengths : {pstripack::Lengths::as_given, pstripack::Lengths::directions})
    for (const char* family :
         {"random", "latlon", "small-circle:1", "small-circle:1e-3", "two-curves:1e-9", "crossing:1e-3",
          "strip:1e-15", "cap:1e-6", "cap:1e-10", "cap:1e-12", "cap:1e-14", "pairs:1e-10", "ulp-groups:2",
          "ulp-groups:8", "falling:14", "nest:30", "rays:40", "axis-cap:1e-20", "axis-cap:1e-150"})
      expect_right_planes(family, lengths);
}

TEST(Planes, AreCertainOfTheCentreWhereEdgesAreFarShorterThanOthers) {
  for (const char* family : {"ulp-groups:8", "pairs:1e-10", "cap:1e-11"}) {
    const Planes planes = expect_right_planes(family, pstripack::Lengths::directions);
    EXPECT_GT(planes.faces, 200) << family;
    EXPECT_GT(planes.decide, planes.faces * 4 / 5) << family;
  }
}

}  // namespace
