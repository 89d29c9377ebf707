// Counts how often a distribution's triangulation enters each stage of the predicates, and tests bounds on
// the counts. A stage that decides too little would otherwise only cost time.

#include "distributions.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>

#include "point_sets.h"
#include "support/stage_counts.h"

namespace {

/// Largest number of entries into a stage, per node.
struct Bound {
  const char* distribution;
  std::size_t n;
  double double_double, integers, big_integers, tie_rule;
};

const std::vector<Bound> kBounds{
    {"latlon", 3000, 0.02, 2.4, 0.02, 0.09},
    {"earth", 3000, 2.5, 0.05, 0.02, 0.05},
    {"rotated-pole:0.7", 3000, 0.02, 2.3, 0.02, 0.02},
    {"reduced-gaussian", 3000, 0.02, 0.19, 0.02, 0.18},
    {"healpix", 3000, 0.02, 0.31, 0.02, 0.10},
    {"cubed-sphere", 3000, 0.02, 0.38, 0.02, 0.28},
    {"icosahedral", 3000, 0.02, 0.05, 0.02, 0.02},
    {"tripolar", 3000, 0.02, 2.5, 0.02, 0.18},
    {"refined:20", 3000, 0.02, 0.26, 0.02, 0.10},
    {"fibonacci", 3000, 0.02, 0.02, 0.02, 0.02},
    {"lattice", 3000, 0.02, 0.02, 0.02, 0.02},
    {"single", 3000, 0.02, 0.02, 0.02, 0.02},
    {"rounded:3", 3000, 0.02, 0.02, 0.02, 0.02},
    {"rounded:5", 3000, 0.02, 0.02, 0.02, 0.02},
    {"rounded:7", 3000, 0.02, 0.02, 0.02, 0.02},
    {"satellite:98.2", 3000, 0.02, 0.02, 0.02, 0.02},
    {"swaths:200", 3000, 0.03, 0.18, 0.02, 0.02},
    {"tracks:50", 3000, 0.02, 0.02, 0.02, 0.02},
    {"rivers:1e-4", 3000, 0.02, 0.02, 0.02, 0.02},
    {"coast:0.3", 3000, 0.02, 0.02, 0.02, 0.02},
    {"earthquakes:1e-4", 3000, 0.02, 0.02, 0.02, 0.02},
    {"ring", 3000, 0.02, 0.02, 0.02, 6.8},
    {"small-circle:1", 3000, 0.26, 19.1, 0.02, 0.02},
    {"small-circle:1e-3", 3000, 0.02, 4.6, 0.02, 0.02},
    {"ellipse:1e-9", 3000, 0.02, 7.4, 0.02, 0.02},
    {"spiral:20", 3000, 0.02, 0.02, 0.02, 0.02},
    {"strip:1e-9", 3000, 0.02, 0.02, 0.02, 0.02},
    {"strip:1e-15", 3000, 0.42, 20.1, 0.02, 0.02},
    {"two-curves:1e-3", 3000, 6.2, 0.17, 0.02, 0.02},
    {"two-curves:1e-9", 3000, 6.0, 0.02, 0.02, 0.02},
    {"crossing:1e-3", 3000, 0.02, 0.02, 0.02, 0.02},
    {"comb:1e-9", 3000, 0.02, 0.02, 0.02, 0.02},
    {"tee:1e-8", 3000, 0.02, 0.02, 0.02, 0.02},
    {"falling-tee:6", 3000, 0.02, 0.14, 0.02, 0.02},
    {"moment:6", 3000, 0.24, 0.02, 0.02, 0.02},
    {"hemisphere-rim", 3000, 0.02, 0.99, 0.02, 1.00},
    {"variable:1e6", 3000, 0.02, 0.02, 0.02, 0.02},
    {"clusters:1e-7", 3000, 0.02, 0.03, 0.02, 0.02},
    {"dense-cap:1e-7", 3000, 0.02, 0.02, 0.02, 0.02},
    {"antipodal:1e-6", 3000, 0.02, 0.02, 0.02, 0.02},
    {"cap:1e-6", 3000, 0.02, 0.02, 0.02, 0.02},
    {"cap:1e-10", 3000, 0.02, 0.02, 0.02, 0.02},
    {"cap:1e-11", 3000, 0.02, 0.02, 0.02, 0.02},
    {"cap:1e-12", 3000, 0.02, 0.02, 0.02, 0.02},
    {"axis-cap:1e-150", 3000, 0.08, 0.02, 0.02, 0.06},
    {"pairs:1e-10", 3000, 0.02, 0.57, 0.02, 0.02},
    {"ulp-groups:2", 3000, 8.1, 1.0, 0.02, 0.02},
    {"ulp-groups:8", 3000, 10.3, 4.2, 0.02, 0.02},
    {"falling:14", 3000, 0.02, 0.02, 0.02, 0.02},
    {"rays:12", 3000, 0.02, 0.02, 0.02, 0.02},
    {"rays:100", 3000, 2.7, 0.02, 0.02, 0.02},
    {"nest:150", 3000, 3.0, 0.02, 0.02, 0.02},
};

const Bound* bound_of(const std::string& name) {
  const auto bound =
      std::find_if(kBounds.begin(), kBounds.end(), [&](const Bound& b) { return name == b.distribution; });
  return bound == kBounds.end() ? nullptr : &*bound;
}

class Distribution : public ::testing::TestWithParam<std::string> {};

TEST_P(Distribution, EntersNoStageMoreOftenThanItMay) {
  const Bound* const bound = bound_of(GetParam());
  ASSERT_NE(bound, nullptr) << "no bound for " << GetParam();
  const auto nodes = point_sets::make(GetParam(), bound->n);
  const StageCounts counts = stage_counts(nodes);
  const auto a_node = [&](std::uint64_t count) {
    return static_cast<double>(count) / static_cast<double>(nodes.size());
  };
  std::printf(
      "%-18s %6zu nodes; a node: %8.4f asked, %8.4f double-double, %8.4f integers, %8.4f big, %8.4f ties\n",
      GetParam().c_str(), nodes.size(), a_node(counts.asked), a_node(counts.double_double),
      a_node(counts.integers), a_node(counts.big_integers), a_node(counts.tie_rule));
  // A search with too many steps makes too many calls, as in nests before these were sorted by exponent.
  EXPECT_LE(a_node(counts.asked), 20);
  EXPECT_LE(a_node(counts.double_double), bound->double_double);
  EXPECT_LE(a_node(counts.integers), bound->integers);
  EXPECT_LE(a_node(counts.big_integers), bound->big_integers);
  EXPECT_LE(a_node(counts.tie_rule), bound->tie_rule);
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

INSTANTIATE_TEST_SUITE_P(Of, Distribution, ::testing::ValuesIn(names()), [](const auto& info) {
  std::string name = info.param;
  std::replace_if(
      name.begin(), name.end(), [](char c) { return !std::isalnum(static_cast<unsigned char>(c)); }, '_');
  return name;
});

}  // namespace
