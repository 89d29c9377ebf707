// TRMESH with 64-bit integers gives the lists of that with 32-bit ones.

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>

#include "point_sets.h"
#include "support/expect.h"

namespace {

using point_sets::make;

const char* const families[] = {"random", "latlon", "cap:1e-8", "hemisphere-rim", "ring", "hemisphere"};

TEST(WideTrmesh, WritesTheSameAndNothingElse) {
  for (const char* family : families)
    for (const std::size_t n : {3, 4, 5, 6, 7, 12, 200, 1000}) {
      const Nodes nodes = make(family, n);
      const Mesh expected = trmesh(nodes);
      for (const Edge edge : {Edge::begin, Edge::end})
        EXPECT_TRUE(trmesh_i8(nodes, edge) == expected && trmesh_i8(nodes, edge).ier == expected.ier)
            << family << ", " << nodes.size() << " nodes";
    }
}

TEST(WideTrmesh, WritesTheSameOnThreads) {
  const Nodes nodes = make("random", 50000);
  EXPECT_TRUE(trmesh_i8(nodes) == trmesh(nodes));
}

TEST(WideTrmesh, StopsBeforeADuplicate) {
  for (const std::size_t copy : {4, 5, 20, 99}) {
    Nodes nodes = make("random", 100);
    nodes[copy] = nodes[2];
    const Mesh m = trmesh_i8(nodes);
    EXPECT_EQ(m.ier, 3);
    EXPECT_TRUE(m == trmesh(nodes));
  }
}

TEST(WideTrmesh, WritesNothingOnOtherCodes) {
  ::testing::internal::CaptureStderr();
  Nodes nodes = make("random", 10);
  nodes[7].y = std::nan("");
  Mesh m = trmesh_i8(nodes);
  EXPECT_EQ(m.ier, PSTRIPACK_BAD_COORDINATE);
  EXPECT_TRUE(is_untouched(m));
  nodes[1] = nodes[0], nodes[7].y = 0;
  m = trmesh_i8(nodes);
  EXPECT_EQ(m.ier, PSTRIPACK_COLLINEAR);
  EXPECT_TRUE(is_untouched(m));
  m = trmesh_i8({nodes[0], nodes[2]});
  EXPECT_EQ(m.ier, PSTRIPACK_TOO_FEW_NODES);
  EXPECT_TRUE(is_untouched(m));
  const std::string text = ::testing::internal::GetCapturedStderr();
  EXPECT_NE(text.find("node 8 of 10 is"), std::string::npos) << text;
}

TEST(WideTrmesh, TouchesNoArrayIfThereAreTooManyNodes) {
  const auto code_of = [](std::int64_t n) {
    return pstripack_trmesh_i8(n, nullptr, nullptr, nullptr, nullptr, nullptr, nullptr, nullptr);
  };
  ::testing::internal::CaptureStderr();
  EXPECT_EQ(code_of(357913944), PSTRIPACK_TOO_MANY_NODES);
  // Numbers whose lower halves are numbers of nodes that could be triangulated.
  EXPECT_EQ(code_of((std::int64_t{1} << 32) + 10), PSTRIPACK_TOO_MANY_NODES);
  EXPECT_EQ(code_of(std::numeric_limits<std::int64_t>::max()), PSTRIPACK_TOO_MANY_NODES);
  EXPECT_EQ(code_of(-(std::int64_t{1} << 32) + 10), PSTRIPACK_TOO_FEW_NODES);
  const std::string text = ::testing::internal::GetCapturedStderr();
  EXPECT_NE(text.find(" 4294967306 nodes: too many nodes"), std::string::npos) << text;
}

}  // namespace
