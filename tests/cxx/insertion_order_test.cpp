// The order in which nodes are inserted: only speed depends on it.

#include "geometry/insertion_order.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <string>
#include <tuple>
#include <vector>

#include "point_sets.h"

namespace {

using namespace pstripack;

class InsertionOrder : public ::testing::TestWithParam<std::tuple<const char*, std::size_t>> {};

// Late, it would take over the triangles of all nodes on its circle from others of high rank, again and
// again.
TEST_P(InsertionOrder, HasEachNodeOnceAndThatOfHighestRankEarly) {
  const auto& [family, n] = GetParam();
  const std::vector<Point> nodes = point_sets::make(family, n);
  std::vector<std::uint32_t> order(nodes.size()), sorted(nodes.size());
  Workspace workspace(16 * nodes.size());
  const std::size_t early = insertion_order(nodes.data(), nodes.size(), order.data(), workspace);
  std::partial_sort_copy(order.begin(), order.end(), sorted.begin(), sorted.end());
  std::vector<std::uint32_t> all(nodes.size());
  std::iota(all.begin(), all.end(), 0);
  EXPECT_EQ(sorted, all);
  EXPECT_LE(early, 257);
  const auto rank = [&](std::uint32_t k) { return std::tuple(nodes[k].x, nodes[k].y, nodes[k].z); };
  const auto highest = *std::max_element(all.begin(), all.end(),
                                         [&](std::uint32_t a, std::uint32_t b) { return rank(a) < rank(b); });
  EXPECT_EQ(std::count(order.begin(), order.begin() + static_cast<std::ptrdiff_t>(early), highest), 1);
}

INSTANTIATE_TEST_SUITE_P(Of, InsertionOrder,
                         ::testing::Combine(::testing::Values("random", "ring", "latlon", "antipodal:1e-4"),
                                            ::testing::Values(100, 3000, 100000)),
                         [](const auto& info) {
                           std::string name = std::get<0>(info.param);
                           return name.substr(0, name.find(':')) + "_" +
                                  std::to_string(std::get<1>(info.param));
                         });

}  // namespace
