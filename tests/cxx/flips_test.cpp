// A mesh whose nodes move must equal the new triangulation bit for bit, or report that it cannot follow.

#include "mesh/flips.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <memory>
#include <optional>
#include <string>

#include "point_sets.h"
#include "support/cases.h"
#include "support/follower.h"
#include "support/lists.h"
#include "support/moves.h"

namespace {

using namespace pstripack;
using point_sets::make;
using point_sets::Random;

struct Outcome {
  int followed = 0, refused = 0;
  std::size_t flips = 0;
};

/// Moves the nodes repeatedly by `move(step)`. If the mesh cannot follow, a new one is made.
template <class Move>
Outcome follow(Nodes& nodes, int steps, const Move& move, Confirm confirm = Confirm::nothing) {
  const Lengths lengths = confirm == Confirm::directions ? Lengths::directions : Lengths::automatic;
  Outcome outcome;
  std::unique_ptr<Follower> follower;
  if (const auto lists = made_anew(nodes, lengths)) follower = std::make_unique<Follower>(nodes, *lists);
  for (int step = 0; step < steps; ++step) {
    move(step);
    const auto right = made_anew(nodes, lengths);
    std::optional<Lists> found;
    if (follower) {
      const std::size_t before = follower->flips;
      found = follower->follow(nodes, confirm);
      outcome.flips += follower->flips - before;
      ++(found ? outcome.followed : outcome.refused);
    }
    if (found) {
      EXPECT_TRUE(right) << "a mesh of nodes that have none, step " << step;
      EXPECT_TRUE(!right || *found == *right) << "another mesh, step " << step;
    }
    if (!found) follower.reset();
    if (!found && right) follower = std::make_unique<Follower>(nodes, *right);
    if (::testing::Test::HasFailure()) break;
  }
  return outcome;
}

TEST(Flips, FollowNodesThatMoveALittle) {
  Random random(1);
  std::size_t flips = 0;
  for (const std::size_t n : {12, 30, 100, 500})
    for (const double fraction : {1e-16, 1e-9, 1e-3, 0.01, 0.03}) {
      Nodes nodes = make("random", n, n);
      const int steps = cases(60);
      const Outcome outcome =
          follow(nodes, steps, [&](int) { move_all(nodes, fraction * spacing(n), random); });
      if (n >= 100 && fraction <= 0.01) {
        EXPECT_GT(outcome.followed, outcome.refused) << n << " " << fraction;
      }
      flips += outcome.flips;
    }
  EXPECT_GT(flips, static_cast<std::size_t>(cases(1000)));
}

TEST(Flips, FollowOrRefuseLargeMoves) {
  Random random(2);
  Outcome all;
  for (const std::size_t n : {8, 20, 60, 300})
    for (const double fraction : {0.1, 0.3, 1.0}) {
      Nodes nodes = make("random", n, n);
      const Outcome outcome =
          follow(nodes, cases(60), [&](int) { move_all(nodes, fraction * spacing(n), random); });
      all.followed += outcome.followed, all.refused += outcome.refused;
    }
  EXPECT_GT(all.followed, 0);
  EXPECT_GT(all.refused, 0);
}

TEST(Flips, FollowOfEveryFamily) {
  Random random(3);
  int followed = 0;
  for (const auto* names : {&point_sets::families(), &point_sets::hard_families()})
    for (const std::string& family : *names)
      for (const double fraction : {1e-15, 1e-4}) {
        Nodes nodes = make(family, 150, 1);
        const Nodes first = nodes;
        SCOPED_TRACE(family);
        // There and back, so that ties reappear.
        followed += follow(nodes, cases(10), [&](int step) {
                      if (step % 2 == 0)
                        move_all(nodes, fraction * spacing(150), random);
                      else
                        nodes = first;
                    }).followed;
      }
  EXPECT_GT(followed, cases(100));
}

/// Nodes of few different coordinates: most arcs are ties, decided by the order of the coordinates.
TEST(Flips, FollowTiesThatAppearAndVanish) {
  Random random(4);
  Outcome all;
  for (int run = 0; run < cases(60); ++run) {
    const auto on_lattice = [&] {
      // Rational points: four integers with a square as the sum of the first three.
      static constexpr double triple[][4] = {{1, 2, 2, 3},  {2, 3, 6, 7},  {1, 4, 8, 9}, {4, 4, 7, 9},
                                             {2, 6, 9, 11}, {6, 6, 7, 11}, {3, 4, 0, 5}, {0, 0, 1, 1},
                                             {0, 3, 4, 5},  {2, 2, 1, 3}};
      const auto& t = triple[random.below(std::size(triple))];
      Point p{t[0] / t[3], t[1] / t[3], t[2] / t[3]};
      if (random.below(2)) std::swap(p.x, p.y);
      if (random.below(2)) std::swap(p.y, p.z);
      if (random.below(2)) std::swap(p.x, p.z);
      for (double* c : {&p.x, &p.y, &p.z})
        if (random.below(2)) *c = -*c;
      return p;
    };
    Nodes nodes;
    while (nodes.size() < 40) {
      const Point p = on_lattice();
      if (std::find(nodes.begin(), nodes.end(), p) == nodes.end()) nodes.push_back(p);
    }
    const Nodes lattice = nodes;
    const Outcome outcome = follow(nodes, 12, [&](int step) {
      if (step % 4 == 0)
        for (Point& p : nodes)
          for (double* c : {&p.x, &p.y, &p.z})
            if (random.below(3) == 0) *c = std::nextafter(*c, random.below(2) ? 2.0 : -2.0);
      if (step % 4 == 1) nodes = lattice;
      if (step % 4 == 2)
        for (Point& p : nodes) p = {-p.y, p.x, p.z};  // other ranks, the same ties
      if (step % 4 == 3) std::swap(nodes[random.below(40)], nodes[random.below(40)]);
    });
    all.followed += outcome.followed, all.refused += outcome.refused, all.flips += outcome.flips;
  }
  EXPECT_GT(all.followed, cases(100));
  EXPECT_GT(all.flips, static_cast<std::size_t>(cases(200)));
  EXPECT_GT(all.refused, 0);
}

/// Stars much smaller than the sphere are first tested in floating point. Each square of this lattice is a
/// tie except for the rounding of its nodes, which changes with every step. For directions the nodes also
/// move by so much that heights as small as the rounding of lengths change their signs.
TEST(Flips, FollowSmallLattices) {
  constexpr int kSide = 16;
  Random random(10);
  for (const Confirm confirm : {Confirm::nothing, Confirm::directions}) {
    Outcome all;
    for (const double h : {0x1p-9, 0x1p-13, 0x1p-20}) {
      Nodes nodes = make("random", 30, 1);
      for (int i = 0; i < kSide; ++i)
        for (int j = 0; j < kSide; ++j) nodes.push_back(point_sets::normalized({h * i, h * j, 1}));
      const Outcome outcome = follow(
          nodes, cases(60),
          [&](int step) {
            rotate(nodes, {0.6, 0, 0.8}, step % 3 == 0 ? 0.3 : 1e-15);
            move_all(nodes, confirm == Confirm::directions ? 0x1p-53 / h : 0, random);
          },
          confirm);
      all.followed += outcome.followed, all.refused += outcome.refused, all.flips += outcome.flips;
    }
    EXPECT_GT(all.followed, (confirm == Confirm::nothing ? 2 : 1) * cases(60));
    if (confirm == Confirm::nothing) {
      EXPECT_GT(all.flips, static_cast<std::size_t>(cases(300)));
    } else {
      EXPECT_GE(all.refused, cases(60));
    }
  }
}

/// Nodes exactly in one plane, x + y + z constant: determinants are zero up to rounding. The nodes are much
/// closer to each other than to other nodes, so floating point is used first.
TEST(Flips, FollowTiesInAPlane) {
  Random random(9);
  constexpr std::size_t kInPlane = 4;  // with more nodes, flips next to a wrong arc would repair it
  const auto on_ring = [](double radius, double angle, bool is_in_plane) {
    const Point u{0x1.6a09e667f3bcdp-1, -0x1.6a09e667f3bcdp-1, 0}, v = point_sets::normalized({1, 1, -2});
    const double c = radius * std::cos(angle), s = radius * std::sin(angle),
                 along = std::sqrt((1 - radius * radius) / 3);
    Point p{along + c * u.x + s * v.x, along + c * u.y + s * v.y, along + c * u.z + s * v.z};
    if (!is_in_plane) return p;
    const auto rounded = [](double value) { return std::ldexp(std::round(std::ldexp(value, 36)), -36); };
    p.x = rounded(p.x), p.y = rounded(p.y), p.z = rounded(3 * along) - p.x - p.y;
    return p;
  };
  Nodes nodes;
  for (const Point& p : make("random", 60, 1))
    if (p.x + p.y + p.z < 1.6) nodes.push_back(p);
  for (int i = 0; i < 24; ++i) nodes.push_back(on_ring(0.03, 0.2618 * (i + 0.2 * random.uniform()), false));
  const std::size_t first = nodes.size();
  nodes.resize(first + kInPlane);
  // The node that the tie rule pushes farthest outwards changes.
  double angle = 0;
  const auto turn = [&] {
    angle += 0.1;
    for (std::size_t i = 0; i < kInPlane; ++i)
      nodes[first + i] =
          on_ring(0.02, angle + 6.283 / kInPlane * (static_cast<double>(i) + 0.3 * random.uniform()), true);
  };
  turn();
  const Outcome outcome = follow(nodes, cases(200), [&](int) { turn(); });
  EXPECT_GT(outcome.followed, cases(150));
  EXPECT_GT(outcome.flips, static_cast<std::size_t>(cases(40)));
}

/// Nodes that are all close to others but for a few steps, on threads or not.
TEST(Flips, FollowManyNodes) {
  Random random(8);
  constexpr std::size_t n = 25000;
  Nodes nodes = make("fibonacci", n);
  Outcome outcome = follow(nodes, cases(4), [&](int) { move_all(nodes, 0.02 * spacing(n), random); });
  EXPECT_EQ(outcome.refused, 0);
  EXPECT_GT(outcome.flips, 10u);
}

/// Pairs of nodes that approach each other: first in the right order, then coincident, then one hidden by the
/// length of the other.
TEST(Flips, RefuseNodesThatCoincideOrHide) {
  Random random(6);
  Outcome coincide, hide;
  for (int run = 0; run < cases(30); ++run) {
    Nodes nodes = make("random", 100, static_cast<std::uint64_t>(run));
    const std::size_t a = random.below(100), b = (a + 1 + random.below(99)) % 100;
    nodes[b] = point_sets::normalized({nodes[a].x + 1e-3, nodes[a].y, nodes[a].z});
    const auto meet = follow(nodes, 2, [&](int step) {
      const Point &p = nodes[a], &q = nodes[b];
      nodes[b] = step == 0 ? point_sets::normalized(plus(p, scaled(1e-3, minus(q, p)))) : p;
    });
    coincide.followed += meet.followed, coincide.refused += meet.refused;

    nodes = make("random", 100, static_cast<std::uint64_t>(run));
    nodes[b] = point_sets::normalized({nodes[a].x + 1e-6, nodes[a].y, nodes[a].z});
    hide.refused += follow(nodes, 1, [&](int) {
                      Point& p = nodes[b];
                      p = scaled(1 - 4e-7, p);
                    }).refused;
  }
  EXPECT_GT(coincide.followed, 0);
  EXPECT_GE(coincide.refused, cases(25));
  EXPECT_GE(hide.refused, cases(25));
}

/// Three nodes on the equator, exactly: the one in the middle becomes too short. A flip would leave a
/// triangle without an area.
TEST(Flips, RefuseANodeThatHidesOnAGreatCircle) {
  for (int run = 0; run < cases(10); ++run) {
    Nodes nodes = make("random", 100, static_cast<std::uint64_t>(run));
    for (const double angle : {0.0, 5e-7, 1e-6}) nodes.push_back({std::cos(angle), std::sin(angle), 0});
    const Outcome outcome = follow(nodes, 1, [&](int) {
      Point& p = nodes[101];
      p = {p.x * (1 - 4e-7), p.y * (1 - 4e-7), 0};
    });
    EXPECT_EQ(outcome.refused, 1);
  }
}

TEST(Flips, RefuseNodesThatLeaveAHemisphere) {
  int followed = 0, refused = 0;
  for (int run = 0; run < cases(10); ++run) {
    Nodes nodes = make("random", 100, static_cast<std::uint64_t>(run));
    const Outcome outcome = follow(nodes, 120, [&](int) {
      for (Point& p : nodes) p = point_sets::normalized({p.x, p.y, p.z + 0.03});
    });
    followed += outcome.followed, refused += outcome.refused;
  }
  EXPECT_GT(followed, 0);
  EXPECT_GE(refused, cases(10));  // at last they surround the centre no more
}

/// Many neighbours, rings that outgrow their places, and lists taken over in between.
TEST(Flips, FollowHubs) {
  Random random(7);
  Outcome all;
  for (const int around : {20, 40, 200}) {
    Nodes nodes{{0, 0, 1}, {0, 0, -1}};
    for (int i = 0; i < around; ++i) {
      const double angle = 6.28318 * (i + 0.3 * random.uniform()) / around;
      nodes.push_back(
          point_sets::normalized({std::cos(angle), std::sin(angle), 0.2 * (random.uniform() - 0.5)}));
    }
    const Outcome outcome = follow(nodes, cases(100), [&](int) { move_all(nodes, 0.2 / around, random); });
    all.followed += outcome.followed, all.flips += outcome.flips;
  }
  EXPECT_GT(all.followed, cases(100));
  EXPECT_GT(all.flips, static_cast<std::size_t>(cases(100)));
}

/// A mesh that covers the sphere twice, around two branch points. All triangles are counterclockwise, all
/// arcs locally Delaunay, and Euler's number is right. Only counting the triangles over one direction shows
/// the defect.
TEST(Flips, RefuseTwoSheets) {
  int meshes = 0;
  for (std::uint64_t seed = 1; meshes < 10; ++seed) {
    // The last meshes have stars so small that most are not tested exactly.
    const std::size_t n = meshes < 8 ? 60 : 20000;
    const Nodes sheet = make("random", n, seed);
    const auto lists = made_anew(sheet);
    ASSERT_TRUE(lists);
    const Rings rings = *rings_of(*lists);
    // The cut from a over v to b.
    const std::int32_t v = 0;
    const auto& ring = rings.neighbours[0];
    const std::int32_t a = ring[0], b = ring[ring.size() / 2];
    const auto& of_a = rings.neighbours[static_cast<std::size_t>(a)];
    if (std::find(of_a.begin(), of_a.end(), b) != of_a.end()) continue;
    ++meshes;
    const auto is_left = [&](std::int32_t c) {  // v,c,next(c) lies left of the cut
      return std::find(ring.begin(), ring.begin() + static_cast<std::ptrdiff_t>(ring.size() / 2), c) !=
             ring.begin() + static_cast<std::ptrdiff_t>(ring.size() / 2);
    };
    Nodes nodes = sheet;
    std::vector<std::int32_t> upper(sheet.size());
    for (std::int32_t k = 0; k < static_cast<std::int32_t>(n); ++k) {
      upper[static_cast<std::size_t>(k)] = k;
      if (k == a || k == b) continue;
      upper[static_cast<std::size_t>(k)] = static_cast<std::int32_t>(nodes.size());
      const Point& p = sheet[static_cast<std::size_t>(k)];
      nodes.push_back(point_sets::normalized({p.x + 1e-9, p.y - 1e-9, p.z + 2e-9}));
    }
    Faces faces;
    for (const auto& face : faces_of(rings))
      for (const bool is_upper : {false, true}) {
        std::array<std::int32_t, 3> copy;
        for (std::size_t i = 0; i < 3; ++i) {
          const std::int32_t k = face[i];
          const bool crosses = k == v && !is_left(face[(i + 1) % 3]);
          copy[i] = is_upper != crosses ? upper[static_cast<std::size_t>(k)] : k;
        }
        faces.push_back(copy);
      }
    const auto twice = rings_of(nodes.size(), faces);
    ASSERT_TRUE(twice);
    const Lists of_both = canonical_lists(*twice);
    MovingMesh mesh(nodes.data(), nodes.size(), of_both.list.data(), of_both.lend.data());
    for (std::size_t k = 0; k < nodes.size(); ++k) mesh.node(k) = nodes[k];
    EXPECT_FALSE(mesh.repair());
  }
}

}  // namespace
