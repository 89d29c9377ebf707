#include "differences.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "determinant.h"

namespace comparison {
namespace {

using pstripack::Defect;
using pstripack::Point;
using pstripack::Triangle;
using pstripack::Triangles;
using pstripack::Verdict;

constexpr double kEpsilon = 0x1p-52;

Triangles canonical(Triangles triangles) {
  pstripack::make_canonical(triangles);
  return triangles;
}

Verdict valid() { return {}; }
Verdict invalid(Defect defect) {
  Verdict verdict;
  verdict.defect = defect;
  verdict.message = "broken on purpose";
  return verdict;
}

// Nodes 0..3 counterclockwise around the north pole, node 4 at the south pole. Four triangles meet at node 4;
// two, with the diagonal 0-2 or 1-3, cover the north pole.
std::vector<Point> pyramid() {
  const double s = 0.6, c = 0.8;
  return {{s, 0, c}, {0, s, c}, {-s, 0, c}, {0, -s, c}, {0, 0, -1}};
}
const Triangles kBottom{{1, 0, 4}, {2, 1, 4}, {3, 2, 4}, {0, 3, 4}};
Triangles with_diagonal_02() {
  Triangles t = kBottom;
  t.push_back({0, 1, 2});
  t.push_back({0, 2, 3});
  return canonical(t);
}
Triangles with_diagonal_13() {
  Triangles t = kBottom;
  t.push_back({0, 1, 3});
  t.push_back({1, 2, 3});
  return canonical(t);
}

Differences compare(const std::vector<Point>& points, const Triangles& original,
                    const Verdict& original_verdict, const Triangles& ours, const Verdict& our_verdict) {
  return differences(points, {original, original_verdict}, {ours, our_verdict}, kEpsilon, 5);
}

void expect_one_arc(const Differences& d, Cause cause) {
  EXPECT_EQ(d.of(cause).places, 1u) << name(cause);
  EXPECT_EQ(d.of(cause).original_arcs, 1u);
  EXPECT_EQ(d.of(cause).our_arcs, 1u);
  std::size_t places = 0;
  for (const Count& count : d.count) places += count.places;
  EXPECT_EQ(places, 1u);
  ASSERT_EQ(d.decisions.size(), 1u);
  EXPECT_EQ(d.decisions[0].cause, cause);
}

TEST(differences, of_equal_meshes_are_none) {
  const Differences d = compare(pyramid(), with_diagonal_02(), valid(), with_diagonal_02(), valid());
  EXPECT_TRUE(d.none());
  for (const Count& count : d.count) EXPECT_EQ(count.places + count.original_arcs + count.our_arcs, 0u);
}

TEST(differences, where_four_nodes_are_in_one_plane_are_an_exact_tie) {
  const Differences d =
      compare(pyramid(), with_diagonal_13(), invalid(Defect::not_delaunay), with_diagonal_02(), valid());
  expect_one_arc(d, Cause::exact_tie);
  EXPECT_EQ(d.decisions[0].nodes, (std::vector<pstripack::index_t>{1, 3, 0, 2}));
}

// The points rotated: exact ties become ties up to rounding.
std::vector<Point> turned(std::vector<Point> points, double angle) {
  const double c = std::cos(angle), s = std::sin(angle);
  for (Point& p : points) {
    p = {c * p.x - s * p.y, s * p.x + c * p.y, p.z};
    p = {c * p.x - s * p.z, p.y, s * p.x + c * p.z};
  }
  return points;
}

TEST(differences, below_the_rounding_of_the_swap_test_are_rounding) {
  int decided = 0;
  for (double angle = 0.1; angle < 1.5; angle += 0.1) {
    const std::vector<Point> points = turned(pyramid(), angle);
    const int right = swap_test(points[1], points[3], points[0], points[2]).sign();
    if (right == 0) continue;
    // swap_test > 0: node 2 is above 1,3,0, so that the diagonal 1-3 is wrong.
    const Triangles original = right > 0 ? with_diagonal_13() : with_diagonal_02();
    const Triangles ours = right > 0 ? with_diagonal_02() : with_diagonal_13();
    expect_one_arc(compare(points, original, invalid(Defect::not_delaunay), ours, valid()), Cause::rounding);
    ++decided;
  }
  EXPECT_GT(decided, 5);
}

TEST(differences, beyond_the_rounding_are_an_error_of_the_original) {
  std::vector<Point> points = pyramid();
  points[0].z += 1e-9;
  expect_one_arc(
      compare(points, with_diagonal_13(), invalid(Defect::not_delaunay), with_diagonal_02(), valid()),
      Cause::original_wrong);
}

TEST(differences, where_the_original_is_locally_delaunay_count_against_us) {
  std::vector<Point> points = pyramid();
  points[1].z += 1e-9;  // diagonal 1-3 is right, and the original has it
  const Differences d = compare(points, with_diagonal_13(), valid(), with_diagonal_02(), valid());
  EXPECT_EQ(d.of(Cause::ours_wrong).places, 1u);
  EXPECT_EQ(d.of(Cause::ours_wrong).original_arcs, 1u);
}

TEST(differences, count_against_us_whenever_our_mesh_fails_the_validator) {
  const Differences d =
      compare(pyramid(), with_diagonal_13(), valid(), with_diagonal_02(), invalid(Defect::orientation));
  EXPECT_EQ(d.of(Cause::ours_wrong).places, 1u);
}

TEST(differences, that_only_the_lengths_decide_are_named_so) {
  std::vector<Point> points = pyramid();
  for (double* c : {&points[0].x, &points[0].y, &points[0].z}) *c *= 0.999;  // shorter, same direction
  points[2].z = std::nextafter(points[2].z, 1);  // on directions 0-2 is right; as given 1-3
  Verdict directions;
  directions.lengths = pstripack::Lengths::directions;
  expect_one_arc(
      compare(points, with_diagonal_13(), invalid(Defect::not_delaunay), with_diagonal_02(), directions),
      Cause::directions);
}

TEST(differences, an_inverted_triangle_is_an_error_of_the_original) {
  // Node 0 is moved across the arc 1-3: diagonal 1-3 would need the triangle 0,1,3 upside down.
  std::vector<Point> points = pyramid();
  points[0] = {-0.28, 0, 0.96};
  const Differences d =
      compare(points, with_diagonal_13(), invalid(Defect::orientation), with_diagonal_02(), valid());
  EXPECT_EQ(d.of(Cause::original_wrong).places, 1u);
  EXPECT_EQ(d.decisions[0].nodes.size(), 3u);
}

TEST(differences, a_sliver_that_the_original_lacks_at_its_boundary_is_rounding) {
  // Nodes 0, 1, 2 on a great circle up to rounding: ours has the sliver 0,2,1 beside 0,3,2.
  int slivers = 0;
  for (double angle = 0.1; angle < 1.5; angle += 0.1) {
    const std::vector<Point> points =
        turned({{0.6, 0.8, 0}, {0, 1, 0}, {-0.6, 0.8, 0}, {0, 0.6, 0.8}}, angle);
    if (left_test(points[0], points[2], points[1]).sign() <= 0) continue;
    const Differences d = compare(points, canonical({{0, 3, 2}}), invalid(Defect::not_convex),
                                  canonical({{0, 3, 2}, {0, 2, 1}}), valid());
    EXPECT_EQ(d.of(Cause::rounding).places, 1u);
    EXPECT_EQ(d.of(Cause::ours_wrong).places + d.of(Cause::original_wrong).places, 0u);
    ++slivers;
  }
  EXPECT_GT(slivers, 2);
}

TEST(differences, broken_lists_of_the_original_are_an_error_of_the_original) {
  const Differences d = compare(pyramid(), {}, invalid(Defect::malformed), with_diagonal_02(), valid());
  EXPECT_EQ(d.of(Cause::original_wrong).places, 1u);
  EXPECT_EQ(d.of(Cause::ours_wrong).places, 0u);
}

TEST(differences, two_apart_are_two_places) {
  // The pyramid on both sides of the equator: a cube's corners, with diagonals on top and at the bottom.
  const double s = 0.6, c = 0.8;
  const std::vector<Point> points{{s, 0, c},  {0, s, c},  {-s, 0, c},  {0, -s, c},
                                  {s, 0, -c}, {0, s, -c}, {-s, 0, -c}, {0, -s, -c}};
  Triangles sides;
  for (pstripack::index_t i = 0; i < 4; ++i) {
    const pstripack::index_t j = (i + 1) % 4;
    sides.push_back({i, i + 4, j + 4});
    sides.push_back({i, j + 4, j});
  }
  Triangles a = sides, b = sides;
  for (const Triangle& t : {Triangle{0, 1, 2}, Triangle{0, 2, 3}, Triangle{4, 6, 5}, Triangle{4, 7, 6}})
    a.push_back(t);
  for (const Triangle& t : {Triangle{0, 1, 3}, Triangle{1, 2, 3}, Triangle{4, 7, 5}, Triangle{5, 7, 6}})
    b.push_back(t);
  const Differences d = compare(points, canonical(a), invalid(Defect::not_delaunay), canonical(b), valid());
  EXPECT_EQ(d.of(Cause::exact_tie).places, 2u);
  EXPECT_EQ(d.of(Cause::exact_tie).original_arcs, 2u);
}

TEST(boundary_nodes, are_those_with_an_open_side) {
  EXPECT_TRUE(boundary_nodes(with_diagonal_02()).empty());
  EXPECT_EQ(boundary_nodes({{0, 1, 2}, {0, 2, 3}}), (std::vector<pstripack::index_t>{0, 1, 2, 3}));
}

}  // namespace
}  // namespace comparison
