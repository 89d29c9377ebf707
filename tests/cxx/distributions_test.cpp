// Counts how often a distribution's triangulation enters each stage of the predicates, and tests bounds on
// the counts. A stage that decides too little would otherwise only cost time.

#include "distributions.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <map>
#include <string>
#include <vector>

#include "geometry/predicates.h"
#include "mesh/delaunay.h"
#include "point_sets.h"
#include "support/names.h"

namespace {

/// How often each stage of the predicates is entered in the kernel's triangulation of the nodes.
pstripack::PredicateCounts stage_counts(const std::vector<pstripack::Point>& nodes) {
  pstripack::Workspace workspace(pstripack::workspace_bytes(nodes.size()));
  pstripack::take_predicate_counts();
  pstripack::delaunay(nodes.data(), nodes.size(), workspace);
  return pstripack::take_predicate_counts();
}

/// Largest number of entries into a stage, per node.
constexpr double kUsual = 0.02;
struct Bound {
  double double_double = kUsual, integers = kUsual, tie_rule = kUsual;
};

/// Of the distributions that need more than usual.
const std::map<std::string, Bound> kBounds{
    {"latlon", {0.02, 2.4, 0.09}},
    {"earth", {2.5, 0.05, 0.05}},
    {"rotated-pole:0.7", {0.02, 2.3, 0.02}},
    {"reduced-gaussian", {0.02, 0.19, 0.18}},
    {"healpix", {0.02, 0.31, 0.10}},
    {"cubed-sphere", {0.02, 0.38, 0.28}},
    {"icosahedral", {0.02, 0.05, 0.02}},
    {"tripolar", {0.02, 2.5, 0.18}},
    {"refined:20", {0.02, 0.26, 0.10}},
    {"swaths:200", {0.03, 0.18, 0.02}},
    {"ring", {0.02, 0.02, 6.8}},
    {"small-circle:1", {0.26, 19.1, 0.02}},
    {"small-circle:1e-3", {0.02, 4.6, 0.02}},
    {"ellipse:1e-9", {0.02, 7.4, 0.02}},
    {"strip:1e-15", {0.42, 20.1, 0.02}},
    {"two-curves:1e-3", {6.2, 0.17, 0.02}},
    {"two-curves:1e-9", {6.0, 0.02, 0.02}},
    {"falling-tee:6", {0.02, 0.14, 0.02}},
    {"moment:6", {0.24, 0.02, 0.02}},
    {"hemisphere-rim", {0.02, 0.99, 1.00}},
    {"clusters:1e-7", {0.02, 0.03, 0.02}},
    {"axis-cap:1e-150", {0.08, 0.02, 0.06}},
    {"pairs:1e-10", {0.02, 0.57, 0.02}},
    {"ulp-groups:2", {8.1, 1.0, 0.02}},
    {"ulp-groups:8", {10.3, 4.2, 0.02}},
    {"rays:100", {2.7, 0.02, 0.02}},
    {"nest:150", {3.0, 0.02, 0.02}},
};

class Distribution : public ::testing::TestWithParam<std::string> {};

TEST_P(Distribution, EntersNoStageMoreOftenThanItMay) {
  const auto known = kBounds.find(GetParam());
  const Bound bound = known != kBounds.end() ? known->second : Bound();
  const auto nodes = point_sets::make(GetParam(), 3000);
  const pstripack::PredicateCounts counts = stage_counts(nodes);
  const auto a_node = [&](std::uint64_t count) {
    return static_cast<double>(count) / static_cast<double>(nodes.size());
  };
  std::printf(
      "%-18s %6zu nodes; a node: %8.4f asked, %8.4f double-double, %8.4f integers, %8.4f big, %8.4f ties\n",
      GetParam().c_str(), nodes.size(), a_node(counts.above), a_node(counts.double_double),
      a_node(counts.integers), a_node(counts.big_integers), a_node(counts.symbolic));
  // A search with too many steps makes too many calls, as in nests before these were sorted by exponent.
  EXPECT_LE(a_node(counts.above), 20);
  EXPECT_LE(a_node(counts.double_double), bound.double_double);
  EXPECT_LE(a_node(counts.integers), bound.integers);
  EXPECT_LE(a_node(counts.big_integers), kUsual);
  EXPECT_LE(a_node(counts.symbolic), bound.tie_rule);
}

// Products of such coordinates underflow; big integers take hundreds of times as long.
TEST(NodesNearUnderflow, HardlyEverTakeBigIntegers) {
  for (const char* cap : {"axis-cap:1e-200", "axis-cap:1e-300"}) {
    const auto nodes = point_sets::make(cap, 3000);
    EXPECT_LE(stage_counts(nodes).big_integers, nodes.size() / 50) << cap;
  }
}

std::vector<std::string> names() {
  std::vector<std::string> all;
  for (const point_sets::Distribution& d : point_sets::distributions()) all.push_back(d.name);
  return all;
}

INSTANTIATE_TEST_SUITE_P(Of, Distribution, ::testing::ValuesIn(names()), name_of_case);

}  // namespace
