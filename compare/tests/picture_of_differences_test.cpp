#include "picture_of_differences.h"

#include <gtest/gtest.h>

#include <array>
#include <boost/property_tree/xml_parser.hpp>
#include <cmath>
#include <cstdio>
#include <sstream>
#include <stdexcept>

namespace comparison {
namespace {

using pstripack::Point;

/// Four nodes around the north pole, one at the south pole; the diagonal at the top is 1-3 or, ours, 2-4.
const std::vector<Point> kPyramid{{.6, 0, .8}, {0, .6, .8}, {-.6, 0, .8}, {0, -.6, .8}, {0, 0, -1}};

Result with_two_diagonals() {
  Result result;
  result.points_name = "a <pyramid>";
  result.original_checked.triangles = {{0, 1, 2}, {0, 2, 3}, {0, 4, 1}, {0, 3, 4}, {1, 4, 2}, {2, 4, 3}};
  result.ours_checked.triangles = {{0, 1, 3}, {1, 2, 3}, {0, 4, 1}, {0, 3, 4}, {1, 4, 2}, {2, 4, 3}};
  result.differences.decisions = {{Cause::exact_tie, {0, 2, 3, 1}, "arc 1 - 3 & so on", "0", ""}};
  return result;
}

std::size_t count(const std::string& text, const std::string& what) {
  std::size_t found = 0;
  for (std::size_t at = text.find(what); at != text.npos; at = text.find(what, at + 1)) ++found;
  return found;
}

TEST(plot, shows_the_arc_of_each_mesh_in_its_colour_and_the_deciding_circle) {
  Plot plot("a.svg");
  plot.add(with_two_diagonals(), kPyramid);
  EXPECT_EQ(plot.rows(), 1u);
  const std::string svg = plot.svg();
  std::istringstream in(svg);
  boost::property_tree::ptree tree;
  boost::property_tree::read_xml(in, tree);  // throws unless well-formed
  EXPECT_EQ(count(svg, "<path class=\"theirs\""), 1u);
  EXPECT_EQ(count(svg, "<path class=\"ours\""), 1u);
  EXPECT_EQ(count(svg, "<circle class=\"deciding\""), 2u);
  EXPECT_EQ(count(svg, "class=\"decided\""), 16u);  // a dot and a number, four nodes, two panels
  EXPECT_EQ(count(svg, "a &lt;pyramid&gt;: exact tie: arc 1 - 3 &amp; so on"), 1u);
}

TEST(plot, has_the_four_nodes_of_a_tie_on_one_circle) {
  Plot plot("a.svg");
  plot.add(with_two_diagonals(), kPyramid);
  const std::string svg = plot.svg();
  const auto circles = [&](const char* kind) {
    std::vector<std::array<double, 3>> found;
    const std::string begin = std::string("<circle class=\"") + kind + "\" cx=\"%lf\" cy=\"%lf\" r=\"%lf\"";
    for (std::size_t at = svg.find("<circle"); at != svg.npos; at = svg.find("<circle", at + 1)) {
      std::array<double, 3> c{};
      if (std::sscanf(svg.c_str() + at, begin.c_str(), &c[0], &c[1], &c[2]) == 3) found.push_back(c);
    }
    return found;
  };
  const auto deciding = circles("deciding")[0];
  const auto nodes = circles("decided");
  ASSERT_EQ(nodes.size(), 8u);
  for (const auto& node : nodes)
    EXPECT_NEAR(std::hypot(node[0] - deciding[0], node[1] - deciding[1]), deciding[2], 0.05);
}

TEST(plot, of_nothing_is_empty_and_what_cannot_be_written_is_an_error) {
  Plot plot("/no/such/folder/a.svg");
  plot.add(Result{}, kPyramid);
  EXPECT_EQ(plot.rows(), 0u);
  EXPECT_THROW(plot.write(), std::runtime_error);
  EXPECT_THROW(Plot("a.gif"), std::invalid_argument);
}

}  // namespace
}  // namespace comparison
