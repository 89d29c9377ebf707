// Canonical form and fingerprint of sets of triangles.

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

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

TEST(Fingerprint, HasNoCollisionAmongAMillionTriangles) {
  std::vector<std::uint64_t> prints;
  for (std::int32_t a = 0; a < 100; ++a)
    for (std::int32_t b = a + 1; b < 150; ++b)
      for (std::int32_t c = a + 1; c < 150; ++c) {
        const Triangle t{a, b, c};
        if (b != c) prints.push_back(pstripack::fingerprint(&t, 1));
      }
  const std::size_t count = prints.size();
  std::sort(prints.begin(), prints.end());
  EXPECT_EQ(static_cast<std::size_t>(std::unique(prints.begin(), prints.end()) - prints.begin()), count);
}

}  // namespace
