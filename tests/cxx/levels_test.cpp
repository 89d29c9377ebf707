// Patches that are slices of the mesh of a sample: for nodes along lines and in nests.

#include "parallel/levels.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <string>
#include <vector>

#include "mesh/delaunay.h"
#include "parallel/divide.h"
#include "parallel/sample.h"
#include "point_sets.h"

namespace {

using namespace pstripack;
using Nodes = std::vector<Point>;

constexpr int kPatches = 16;
constexpr std::size_t kNodes = 20000;
const char* const kAlongLinesAndNested[] = {"crossing", "crossing:1e-3", "nest:150", "mirrored-nest", "rays"};

/// A division of the nodes by one process.
struct Divided {
  explicit Divided(const std::string& family) : nodes(point_sets::make(family, kNodes, 1)) {
    for (std::uint64_t seed = 1; left(nodes[0], nodes[1], nodes[2]) == 0; ++seed)
      point_sets::shuffle(nodes, seed);
    const LocalNodes local{nodes.data(), nodes.size()};
    const Look look = look_at(local.points, local.count);
    const Places of(look.lengths_are_one.value ? Lengths::as_given : Lengths::directions,
                    look.deviation.value);
    SingleProcess process;
    ParallelOptions options;
    options.patches = kPatches;
    try {
      division = std::make_unique<Division>(divide(local, corners(), of, process, options));
    } catch (const HiddenNode&) {
      division = std::make_unique<Division>(
          divide(local, corners(), Places(Lengths::directions, 0), process, options));
    }
    for (const Point& p : nodes) places.push_back(division->places(p));
  }
  Corners corners() const {
    return {Record{nodes[0], GlobalNumber{1}}, Record{nodes[1], GlobalNumber{2}},
            Record{nodes[2], GlobalNumber{3}}};
  }
  const Partition& partition() const { return *division->partition; }

  Nodes nodes, places;
  std::unique_ptr<Division> division;
};

/// The number of triangles with corners in different patches: at each patch, and in all.
struct Mixed {
  Mixed(const Nodes& nodes, const std::vector<std::uint32_t>& owner) : of_patch(kPatches) {
    Workspace workspace(workspace_bytes(nodes.size()) + 48 * nodes.size());
    const Hull hull = delaunay(nodes.data(), nodes.size(), workspace);
    for (std::size_t t = 0; t < hull.face_count; ++t) {
      if (!hull.front(t)) continue;
      std::set<std::uint32_t> patches;
      for (int i = 0; i < 3; ++i) patches.insert(owner[hull.order[hull.faces[t].vertex[i]]]);
      if (patches.size() == 1) continue;
      ++all;
      for (const std::uint32_t q : patches) ++of_patch[q];
    }
  }
  std::size_t all = 0;
  std::vector<std::size_t> of_patch;
};

std::vector<std::uint32_t> owners(const Partition& partition, const Nodes& places) {
  std::vector<std::uint32_t> owner;
  for (const Point& x : places) owner.push_back(static_cast<std::uint32_t>(partition.owner(x)));
  return owner;
}

TEST(Levels, HaveShortBordersWhereBoxesFail) {
  for (const char* family : kAlongLinesAndNested) {
    const Divided set(family);
    ASSERT_FALSE(set.partition().has_convex_patches()) << family;
    const std::vector<std::uint32_t> owner = owners(set.partition(), set.places);
    std::vector<std::size_t> own(kPatches);
    for (const std::uint32_t q : owner) ++own[q];
    EXPECT_LT(*std::max_element(own.begin(), own.end()), kNodes / kPatches * 11 / 10) << family;

    const Mixed in_slices(set.nodes, owner);
    const Mixed in_boxes(
        set.nodes, owners(partition_over_ranks(PartitionKind::bisection, kPatches, set.places), set.places));
    EXPECT_LT(2 * in_slices.all, in_boxes.all) << family;
    EXPECT_LT(in_slices.all, 4000u) << family;
    EXPECT_LT(*std::max_element(in_slices.of_patch.begin(), in_slices.of_patch.end()), 1000u) << family;
  }
}

TEST(Levels, EachPatchKnowsItsNodesAndItsHalo) {
  for (const char* family : kAlongLinesAndNested) {
    const Divided set(family);
    const Partition& partition = set.partition();
    const Nodes& x = set.places;
    std::vector<std::uint32_t> owner(kNodes), not_deep(kNodes);
    std::vector<double> nearest_plane(kNodes);
    partition.owners(x.data(), x.size(), owner.data(), nearest_plane.data());
    EXPECT_EQ(owner, owners(partition, x)) << family;
    std::vector<std::set<int>> knowing(kNodes);
    std::vector<std::size_t> halo(kPatches);
    partition.for_each_halo(x.data(), x.size(), owner.data(), nearest_plane.data(),
                            [&](std::size_t i, int q) {
                              EXPECT_NE(q, static_cast<int>(owner[i])) << family;
                              EXPECT_TRUE(knowing[i].insert(q).second) << family << ": twice";
                              ++halo[static_cast<std::size_t>(q)];
                            });
    EXPECT_LT(*std::max_element(halo.begin(), halo.end()), kNodes / kPatches) << family;
    EXPECT_EQ(partition.not_deep(0, x.data(), x.size(), not_deep.data()), x.size()) << family;
    for (std::size_t i = 0; i < x.size(); i += 7) {
      knowing[i].insert(static_cast<int>(owner[i]));
      for (int q = 0; q < kPatches; ++q)
        ASSERT_EQ(partition.knows(q, x[i]), knowing[i].count(q) == 1) << family;
    }
  }
}

TEST(Levels, OnlyWhereBoxesCutMostTriangles) {
  for (const char* family :
       {"random", "latlon", "variable:1e6", "hemisphere", "strip:1e-15", "comb:1e-9", "ulp-groups:8",
        "coast:0.3", "small-circle:1", "two-curves", "clusters:1e-7", "axis-cap:1e-150"}) {
    const Divided set(family);
    EXPECT_TRUE(set.partition().has_convex_patches()) << family;
  }
}

/// A hub is a neighbour of all nodes: only triangles without it show whether borders are short.
TEST(Levels, NotWhereAHubIsAllThatIsWrong) {
  const Divided set("moment:6");
  EXPECT_TRUE(set.partition().has_convex_patches());
  const CoarseMesh mesh(Nodes(set.nodes.begin(), set.nodes.begin() + 2000));
  EXPECT_GE(mesh.hubs().size(), 1u);
  EXPECT_GT(mesh.triangles_at_hubs(), 9 * mesh.triangles().size());
}

TEST(Levels, OfNodesOnOneGreatCircleGiveEachCellToAPatch) {
  Nodes nodes;
  for (int k = 1; k < 100; ++k) nodes.push_back({1.0 / k, 1, 0});
  const CoarseMesh mesh(nodes);
  EXPECT_TRUE(mesh.triangles().empty());
  Partition cells(nodes);
  const Levels levels(mesh, nodes, cells);
  std::vector<std::int64_t> weight(cells.cells());
  for (const std::uint32_t c : levels.cell_of()) ++weight[c];
  cells.give_cells(kPatches, levels.slices(kPatches, weight), levels.begin(), levels.beside());
  std::vector<int> own(kPatches);
  for (const Point& p : nodes) ++own[static_cast<std::size_t>(cells.owner(p))];
  EXPECT_LE(*std::max_element(own.begin(), own.end()), 8);
  EXPECT_GE(*std::min_element(own.begin(), own.end()), 5);
}

}  // namespace
