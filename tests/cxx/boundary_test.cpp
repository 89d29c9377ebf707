// The boundary of the triangulation, found by patches that know only their own nodes, their halos and three
// common nodes. The sets have most nodes on the boundary, also in exact ties. Rings and boundary nodes must
// be the serial ones.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <limits>
#include <memory>
#include <numeric>
#include <random>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "base/workspace.h"
#include "mesh/delaunay.h"
#include "mesh/ring_table.h"
#include "parallel/partition.h"
#include "parallel/patch.h"
#include "parallel/places.h"
#include "support/lists.h"

namespace {

using namespace pstripack;
using IntPatch = Patch<std::int32_t>;
using Ints = std::vector<std::int64_t>;

/// The neighbours of each node as in LIST.
using StarsOfAll = std::vector<Ints>;

struct Set {
  std::string name;
  Nodes nodes;  ///< the first three not on one great circle
};

struct Serial {
  StarsOfAll stars;
  Lengths lengths = Lengths::as_given;
  std::size_t on_boundary = 0;
};

Serial serial(const Nodes& nodes) {
  Workspace workspace(workspace_bytes(nodes.size()));
  const Hull hull = delaunay(nodes.data(), nodes.size(), workspace);
  EXPECT_TRUE(hull.coincident.empty());
  Faces faces;
  for (std::size_t t = 0; t < hull.face_count; ++t) {
    const auto& v = hull.faces[t].vertex;
    const auto node = [&](int i) { return static_cast<std::int32_t>(hull.order[v[i]]); };
    if (hull.front(t)) faces.push_back({node(0), node(1), node(2)});
  }
  const Rings rings = *rings_of(nodes.size(), faces);
  Serial result;
  result.lengths = hull.lengths;
  for (std::size_t k = 0; k < nodes.size(); ++k) {
    Ints& star = result.stars.emplace_back();
    for (const std::int32_t b : rings.neighbours[k]) star.push_back(b + 1);
    if (rings.boundary[k]) star.back() = -star.back(), ++result.on_boundary;
  }
  return result;
}

/// Patches of one process, and what they know.
class Patches {
 public:
  Patches(const Nodes& nodes, Lengths lengths, const Partition& partition)
      : nodes_(nodes.size()), places_(lengths, deviation(nodes)), partition_(partition) {
    for (std::size_t k = 0; k < 3; ++k)
      corners_[k] = {nodes[k], GlobalNumber{static_cast<std::int64_t>(k) + 1}};
    const auto count = static_cast<std::size_t>(partition.patches());
    records_.resize(count);
    patches_.reserve(count);
    for (std::size_t q = 0; q < count; ++q) {
      const int id = static_cast<int>(q);
      const auto add = [&](bool own) {
        for (std::size_t k = 0; k < nodes.size(); ++k) {
          const Point place = places_(nodes[k]);
          if ((partition.owner(place) == id) == own && partition.knows(id, place))
            records_[q].push_back({nodes[k], GlobalNumber{static_cast<std::int64_t>(k) + 1}});
        }
      };
      add(true);
      const std::size_t own = records_[q].size();
      add(false);
      const PatchNodes known{records_[q].data(), own, records_[q].size() - own};
      patches_.emplace_back(id, partition_, places_, known);
      memory_.push_back(std::make_unique<Workspace>(patches_[q].workspace_bytes(3)));
      patches_[q].set_up({corners_.begin(), corners_.end()}, *memory_[q]);
      patches_[q].triangulate();
    }
  }

  IntPatch& operator[](std::size_t q) { return patches_[q]; }
  Doubts doubts(std::size_t q) {
    return patches_[q].ask(corners_, std::numeric_limits<double>::infinity(), SIZE_MAX);
  }

  /// Exchanges questions and answers until no question is left, only about arcs unless triangles_matter.
  /// Returns the number of rounds.
  int ask_and_learn(bool triangles_matter = true) {
    for (int round = 0;; ++round) {
      std::vector<Question> questions;
      std::size_t arcs = 0;
      bool has_grown = false;
      for (std::size_t q = 0; q < patches_.size(); ++q) {
        const Doubts d = doubts(q);
        for (const Question& question : d.questions)
          if (triangles_matter || question.is_about_arc()) questions.push_back(question);
        arcs += d.arcs;
        has_grown = has_grown || d.has_grown;
      }
      if (questions.size() == arcs && (arcs == 0 || !has_grown)) return round;
      std::vector<std::vector<Record>> answers(questions.size());
      for (std::size_t k = 0; k < questions.size(); ++k)
        answers[k] = patches_[static_cast<std::size_t>(questions[k].to)].answer(questions[k]);
      for (std::size_t k = 0; k < questions.size(); ++k)
        patches_[static_cast<std::size_t>(questions[k].from)].take_in(answers[k]);
    }
  }

  StarsOfAll stars() {
    StarsOfAll stars(nodes_);
    for (std::size_t q = 0; q < patches_.size(); ++q) {
      std::vector<std::int32_t> entries(patches_[q].finish() + 2 * kBlock);
      patches_[q].write_rings(
          entries.data(),
          [&](std::size_t i, const std::int32_t* place, std::uint32_t) {
            const Ring<std::int32_t> ring = ring_at(place);
            stars[static_cast<std::size_t>(value_of(records_[q][i].number)) - 1].assign(
                ring.begin, ring.begin + ring.count);
          },
          [](std::size_t) {});
    }
    return stars;
  }

 private:
  static double deviation(const Nodes& nodes) {
    double most = 0x1p-50;
    for (const Point& p : nodes) most = std::max(most, std::fabs(std::sqrt(dot(p, p)) - 1) + 0x1p-50);
    return most;
  }

  std::size_t nodes_;
  std::array<Record, 3> corners_;
  Places places_;
  const Partition& partition_;
  std::vector<std::vector<Record>> records_;
  std::vector<std::unique_ptr<Workspace>> memory_;
  std::vector<IntPatch> patches_;
};

// ---- the sets ---------------------------------------------------------------------------------------

Point unit(double x, double y, double z) {
  const double r = std::sqrt(x * x + y * y + z * z);
  return {x / r, y / r, z / r};
}

/// Integer vectors, each direction once.
class Lattice {
 public:
  void add(int x, int y, int z) {
    const int g = std::gcd(std::gcd(x, y), z);
    if (g != 0 && seen_.insert({x / g, y / g, z / g}).second)
      nodes.push_back({double(x), double(y), double(z)});
  }
  Nodes nodes;

 private:
  std::set<std::array<int, 3>> seen_;
};

/// Shuffled until the first three are not on one great circle.
Set set_of(std::string name, Nodes nodes, std::mt19937_64& random) {
  do std::shuffle(nodes.begin(), nodes.end(), random);
  while (left(nodes[0], nodes[1], nodes[2]) == 0);
  return {std::move(name), std::move(nodes)};
}

std::vector<Set> sets(std::uint64_t seed) {
  std::mt19937_64 random(seed);
  const auto uniform = [&](double low, double high) {
    return std::uniform_real_distribution<double>(low, high)(random);
  };
  const auto integer = [&](int low, int high) {
    return std::uniform_int_distribution<int>(low, high)(random);
  };
  std::vector<Set> sets;
  const auto add = [&](const char* name, Nodes nodes) {
    sets.push_back(set_of(name, std::move(nodes), random));
  };
  constexpr int n = 300;
  {
    Lattice closed_hemisphere, half_of_it, lune, square;
    for (int k = 0; k < n; ++k) {
      const int x = integer(-40, 40), y = integer(-40, 40), z = integer(1, 40);
      closed_hemisphere.add(x, y, k % 3 == 0 ? z : 0);
      half_of_it.add(x, y, k % 3 == 0 ? z : 0);
      if (k % 9 == 0) closed_hemisphere.add(-x, -y, 0);  // antipodes of nodes on the rim, or near it
      const int w = std::abs(x) + 1, h = integer(-60, 60);
      lune.add(w, 0, h);
      lune.add(w, w, h);
      lune.add(w + z, z % (w + 1), h);
      square.add(integer(-9, 9), integer(0, 1) == 0 ? 9 : -9, 16);
      square.add(integer(0, 1) == 0 ? 9 : -9, integer(-9, 9), 16);
      square.add(integer(-8, 8), integer(-8, 8), 16);
    }
    for (Point& p : half_of_it.nodes) p.y = std::fabs(p.y);
    Lattice once;
    for (const Point& p : half_of_it.nodes)
      once.add(static_cast<int>(p.x), static_cast<int>(p.y), static_cast<int>(p.z));
    lune.add(0, 0, 1);
    lune.add(0, 0, -1);
    add("closed hemisphere", closed_hemisphere.nodes);
    add("quarter of the sphere", once.nodes);
    add("lune with its tips", lune.nodes);
    add("square with collinear sides", square.nodes);
  }
  {
    Nodes circle, different_lengths, ellipse, wavy, arc;
    for (int k = 0; k < n; ++k) {
      const double phi = uniform(0, 6.2831853), c = std::cos(phi), s = std::sin(phi), r = uniform(0, 1);
      circle.push_back(unit(0.7 * c, 0.7 * s, 0.7));
      const Point p = unit(c, s, 0.5);
      different_lengths.push_back({p.x * (1 + r), p.y * (1 + r), p.z * (1 + r)});
      ellipse.push_back(unit(c, 0.01 * s, 0.3));
      wavy.push_back(unit(c * (1 + 1e-7 * r), s * (1 + 1e-7 * r), 0.2));
      arc.push_back(unit(r, r * r, 1));
    }
    add("small circle", circle);
    add("small circle of different lengths", different_lengths);
    add("narrow ellipse", ellipse);
    add("band along a circle", wavy);
    add("arc that bends left", arc);
  }
  {
    Nodes inner, around, beyond, clusters;
    for (int k = 0; k < n; ++k) {
      const Point p = unit(1, uniform(-0.1, 0.1), uniform(-0.1, 0.1));
      inner.push_back(p), beyond.push_back(p);
      const double phi = uniform(0, 6.2831853);
      if (k % 3 == 0) around.push_back(unit(0.3, std::cos(phi), std::sin(phi)));
      clusters.push_back(unit(1, (k % 5 - 2) + uniform(-0.01, 0.01), (k % 3 - 1) + uniform(-0.01, 0.01)));
    }
    around.insert(around.end(), inner.begin(), inner.end());
    for (const double z : {-1.0, 0.1, 1.0}) beyond.push_back(unit(-0.5, z * z - 0.5, z));
    beyond.push_back(unit(-0.5, -1, 0));
    add("cap within a circle", around);
    add("cap and few around the centre", beyond);
    add("clusters", clusters);
  }
  return sets;
}

// ---- tests ------------------------------------------------------------------------------------------

/// A partition with halos as narrow as if there were 10^8 times as many nodes.
Partition partition_of(PartitionKind kind, int patches, const Nodes& nodes, Lengths lengths) {
  const Places places(lengths, 1e-6);
  std::vector<Point> sample;
  for (const Point& p : nodes) sample.push_back(places(p));
  return {kind, patches, std::move(sample), 100000000 * nodes.size()};
}

/// The neighbours of each node on the boundary; none of the others.
StarsOfAll boundary_of(const StarsOfAll& stars) {
  StarsOfAll result;
  for (const Ints& star : stars) {
    Ints& beside = result.emplace_back();
    if (star.back() < 0) beside = {star.front(), -star.back()};
  }
  return result;
}

/// body(set, serial, partition) for many sets and partitions.
template <class Body>
void for_each_division(const Body& body) {
  std::size_t on_boundary = 0;
  for (std::uint64_t seed = 1; seed <= 4; ++seed)
    for (const Set& set : sets(seed)) {
      const Serial expected = serial(set.nodes);
      on_boundary += expected.on_boundary;
      for (const NamedPartition& partition : kPartitions)
        for (const int patches : {2, 3, 7, 16}) {
          SCOPED_TRACE(set.name + ", seed " + std::to_string(seed) + ", " + std::to_string(patches) +
                       " patches, partition " + partition.name);
          body(set, expected, partition_of(partition.kind, patches, set.nodes, expected.lengths));
          if (::testing::Test::HasFailure()) return;
        }
    }
  EXPECT_GT(on_boundary, 4u * 1000u);
}

TEST(Boundary, OfPatchesThatKnowLittleIsThatOfAllNodes) {
  for_each_division([](const Set& set, const Serial& expected, const Partition& partition) {
    Patches patches(set.nodes, expected.lengths, partition);
    EXPECT_LT(patches.ask_and_learn(), 12);
    EXPECT_EQ(patches.stars(), expected.stars);
  });
}

TEST(Boundary, IsFoundByQuestionsAboutArcsAlone) {
  for_each_division([](const Set& set, const Serial& expected, const Partition& partition) {
    Patches patches(set.nodes, expected.lengths, partition);
    EXPECT_LT(patches.ask_and_learn(false), 12);
    EXPECT_EQ(boundary_of(patches.stars()), boundary_of(expected.stars));
  });
}

/// One of two patches surrounds the other, and neither knows the other's nodes. The inner patch takes a curve
/// of its own nodes for the boundary; only the arc that it asks all patches about shows the error.
TEST(Boundary, OneArcOfACurveOfOwnNodesIsAskedOfAll) {
  Nodes nodes;
  std::vector<Point> sample;
  const auto add_circle = [&](double x, double radius, int count) {
    for (int k = 0; k < count; ++k) {
      const double phi = 6.2831853 * k / count;
      nodes.push_back(unit(x, radius * std::cos(phi), radius * std::sin(phi)));
    }
  };
  add_circle(1, 0.01, 3);
  add_circle(1, 0.1, 400);
  add_circle(1, 2, 400);
  for (int k = 0; k < 64; ++k) sample.push_back({k % 2 == 0 ? 0.95 : 0.85, 1e-3 * k, 0});
  const Partition partition(PartitionKind::bisection, 2, sample, 8 * sample.size());
  const int inner = partition.owner(nodes[0]);
  ASSERT_NE(partition.owner(nodes.back()), inner);
  ASSERT_FALSE(partition.knows(inner, nodes.back()));
  Patches patches(nodes, Lengths::as_given, partition);
  const auto q = static_cast<std::size_t>(inner);
  ASSERT_EQ(patches[q].halo(), 0u);
  const Doubts doubts = patches.doubts(q);
  ASSERT_EQ(doubts.arcs, 1u);
  for (const Question& question : doubts.questions) {
    if (!question.is_about_arc()) continue;
    const std::vector<Record> answer = patches[1 - q].answer(question);
    ASSERT_FALSE(answer.empty());
    for (const Record& r : answer)
      EXPECT_LT(left(question.corner[0].point, question.corner[1].point, r.point), 0);
  }
}

}  // namespace
