// How far the questions of triangulating a distribution go through the stages of the predicates: measured,
// and bounded. A stage that answers less than it should is an error that only time would show.

#include "distributions.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdio>

#include "point_sets.h"
#include "stage_counts.h"

namespace {

/// At most so many times a node a stage may be entered. The nests are smaller: each node is near all scales.
struct Bound {
  const char* distribution;
  std::size_t n;
  double double_double, integers, big_integers, tie_rule;
};

const std::vector<Bound> kBounds{
    {"latlon", 3000, 2.6, 2.4, 2.4, 0.2},
    {"earth", 3000, 2.6, 2.5, 2.5, 0.2},
    {"rotated-pole:0.7", 3000, 2.5, 0.8, 0.8, 0.2},
    {"reduced-gaussian", 3000, 0.3, 0.3, 0.3, 0.3},
    {"healpix", 3000, 0.5, 0.4, 0.4, 0.2},
    {"cubed-sphere", 3000, 0.5, 0.5, 0.5, 0.4},
    {"icosahedral", 3000, 0.2, 0.2, 0.2, 0.2},
    {"tripolar", 3000, 2.7, 2, 2, 0.3},
    {"refined:20", 3000, 0.4, 0.4, 0.4, 0.2},
    {"fibonacci", 3000, 0.1, 0.1, 0.1, 0.1},
    {"lattice", 3000, 0.2, 0.2, 0.2, 0.2},
    {"single", 3000, 0.1, 0.1, 0.1, 0.1},
    {"rounded:3", 3000, 0.1, 0.1, 0.1, 0.1},
    {"rounded:5", 3000, 0.1, 0.1, 0.1, 0.1},
    {"rounded:7", 3000, 0.1, 0.1, 0.1, 0.1},
    {"satellite:98.2", 3000, 0.1, 0.1, 0.1, 0.1},
    {"swaths:200", 3000, 0.3, 0.3, 0.3, 0.1},
    {"tracks:50", 3000, 0.1, 0.1, 0.1, 0.1},
    {"rivers:1e-4", 3000, 0.1, 0.1, 0.1, 0.1},
    {"coast:0.3", 3000, 0.1, 0.1, 0.1, 0.1},
    {"earthquakes:1e-4", 3000, 0.1, 0.1, 0.1, 0.1},
    {"ring", 3000, 19, 19, 19, 19},
    {"small-circle:1", 3000, 20, 18, 18, 0.1},
    {"small-circle:1e-3", 3000, 4.8, 0.6, 0.6, 0.2},
    {"ellipse:1e-9", 3000, 8, 1.5, 1.5, 0.1},
    {"spiral:20", 3000, 0.1, 0.1, 0.1, 0.1},
    {"strip:1e-9", 3000, 0.2, 0.2, 0.2, 0.1},
    {"strip:1e-15", 3000, 21, 14, 14, 0.1},
    {"two-curves:1e-3", 3000, 9, 7, 7, 0.1},
    {"two-curves:1e-9", 3000, 8, 7, 7, 0.1},
    {"crossing:1e-3", 3000, 0.4, 0.2, 0.2, 0.1},
    {"comb:1e-9", 3000, 0.1, 0.1, 0.1, 0.1},
    {"tee:1e-8", 3000, 0.2, 0.1, 0.1, 0.1},
    {"falling-tee:6", 3000, 6, 0.2, 0.2, 0.1},
    {"moment:6", 3000, 7, 2.3, 2.3, 0.1},
    {"hemisphere-rim", 3000, 7, 7, 7, 1.1},
    {"variable:1e6", 3000, 0.1, 0.1, 0.1, 0.1},
    {"clusters:1e-7", 3000, 0.5, 0.2, 0.2, 0.1},
    {"dense-cap:1e-7", 3000, 0.3, 0.1, 0.1, 0.1},
    {"antipodal:1e-6", 3000, 0.4, 0.2, 0.2, 0.1},
    {"cap:1e-6", 3000, 0.1, 0.1, 0.1, 0.1},
    {"cap:1e-10", 3000, 0.4, 0.2, 0.2, 0.1},
    {"cap:1e-11", 3000, 18, 0.5, 0.5, 0.1},
    {"cap:1e-12", 3000, 25, 13, 13, 0.1},
    {"axis-cap:1e-150", 3000, 37, 37, 37, 0.2},
    {"pairs:1e-10", 3000, 0.7, 0.1, 0.1, 0.1},
    {"ulp-groups:2", 3000, 13, 2, 2, 0.1},
    {"ulp-groups:8", 3000, 21, 16, 16, 0.1},
    {"falling:14", 3000, 4.2, 2.3, 2.3, 0.1},
    {"rays:12", 3000, 0.9, 0.2, 0.2, 0.1},
    {"rays:100", 500, 53, 53, 53, 0.1},
    {"nest:150", 500, 84, 84, 84, 0.1},
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
  EXPECT_LE(a_node(counts.double_double), bound->double_double);
  EXPECT_LE(a_node(counts.integers), bound->integers);
  EXPECT_LE(a_node(counts.big_integers), bound->big_integers);
  EXPECT_LE(a_node(counts.tie_rule), bound->tie_rule);
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
