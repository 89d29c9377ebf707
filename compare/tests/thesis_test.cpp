// The parts of the published method, in one process.

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <set>

#include "capi/pstripack.h"
#include "our_checks.h"
#include "point_sets.h"
#include "thesis/defects.h"
#include "thesis/stripe.h"

namespace thesis {
namespace {

using Points = std::vector<Point>;

Triangles canonical(Triangles t) {
  pstripack::make_canonical(t);
  return t;
}

Triangles delaunay_triangles(const Points& points) {
  const std::size_t n = points.size();
  std::vector<double> x, y, z;
  for (const Point& p : points) x.push_back(p.x), y.push_back(p.y), z.push_back(p.z);
  std::vector<std::int32_t> list(6 * n - 12), lptr(list.size()), lend(n);
  std::int32_t lnew = 0;
  const int ier = pstripack_trmesh(static_cast<std::int32_t>(n), x.data(), y.data(), z.data(), list.data(),
                                   lptr.data(), lend.data(), &lnew);
  EXPECT_EQ(ier, 0);
  return comparison::check(points, ier, list, lptr, lend, lnew).triangles;
}

using Arcs = std::set<std::pair<index_t, index_t>>;

/// The arcs that have a triangle on their left and none on their right.
Arcs boundary(const Triangles& triangles) {
  Arcs arcs;
  for (const auto& t : triangles)
    for (std::size_t i = 0; i < 3; ++i)
      EXPECT_TRUE(arcs.insert({t[i], t[(i + 1) % 3]}).second) << "two triangles on one side of an arc";
  Arcs open;
  for (const auto& [a, b] : arcs)
    if (arcs.count({b, a}) == 0) open.insert({a, b});
  return open;
}

Stripe stripe_of_many(const Points& points, int k, int count) {
  return triangulate(points, pick(points, k, count), middle(k, count));
}

/// The whole method in one process.
Triangles stitched_stripes(const Points& points, int count) {
  Triangles all;
  std::vector<Stripe> stripes;
  for (int k = 0; k < count; ++k) stripes.push_back(stripe_of_many(points, k, count));
  for (std::size_t k = 0; k < stripes.size(); ++k) {
    EXPECT_EQ(stripes[k].failure, "");
    const Stripe& west = stripes[k == 0 ? stripes.size() - 1 : k - 1];
    const Triangles between = stitch(points, west.right, stripes[k].left);
    all.insert(all.end(), stripes[k].triangles.begin(), stripes[k].triangles.end());
    all.insert(all.end(), between.begin(), between.end());
  }
  return all;
}

TEST(pick, every_node_is_in_exactly_one_stripe) {
  for (const char* family : {"random", "latlon"})
    for (const int count : {1, 3, 4, 7, 64}) {
      const Points points = point_sets::make(family, 1000);
      std::vector<index_t> all;
      for (int k = 0; k < count; ++k) {
        const Nodes nodes = pick(points, k, count);
        all.insert(all.end(), nodes.begin(), nodes.end());
      }
      std::sort(all.begin(), all.end());
      Nodes expected(points.size());
      std::iota(expected.begin(), expected.end(), 0);
      EXPECT_EQ(all, expected) << family << " " << count;
    }
}

TEST(pick, a_pole_has_longitude_0) {
  EXPECT_EQ(stripe_of({0, 0, 1}, 8), 0);
  EXPECT_EQ(stripe_of({0, 0, -1}, 8), 0);
  EXPECT_EQ(stripe_of({0, 1, 0}, 8), 2);
  EXPECT_EQ(stripe_of({1, -1e-300, 0}, 8), 7);
}

// What a stripe promises: the triangles of the Delaunay triangulation of its nodes and the three huge
// vertices, without those that have a huge corner.
TEST(stripe, is_the_exact_triangulation_with_the_huge_vertices) {
  for (const int count : {1, 3, 4, 8, 32}) {
    const Points points = point_sets::make("random", 4000, static_cast<std::uint64_t>(count));
    const int k = count / 2;
    const Nodes nodes = pick(points, k, count);
    Points with_huge;
    for (const index_t v : nodes) with_huge.push_back(points[static_cast<std::size_t>(v)]);
    for (const Point& p : huge_vertices(middle(k, count))) with_huge.push_back(p);
    Triangles expected;
    for (const auto& [a, b, c] : delaunay_triangles(with_huge)) {
      const auto n = static_cast<index_t>(nodes.size());
      const auto node = [&](index_t v) { return nodes[static_cast<std::size_t>(v)]; };
      if (a < n && b < n && c < n) expected.push_back({node(a), node(b), node(c)});
    }
    const Stripe stripe = stripe_of_many(points, k, count);
    EXPECT_EQ(stripe.failure, "");
    EXPECT_EQ(canonical(stripe.triangles), canonical(expected)) << count << " stripes";
  }
}

TEST(stripe, its_two_sides_are_its_boundary_but_for_the_two_ends) {
  for (const char* family : {"random", "latlon"}) {
    const Points points = point_sets::make(family, 4000);
    const Stripe stripe = stripe_of_many(points, 1, 8);
    Arcs arcs = boundary(stripe.triangles);
    for (std::size_t i = 1; i < stripe.right.size(); ++i)
      EXPECT_EQ(arcs.erase({stripe.right[i - 1], stripe.right[i]}), 1u) << family;
    for (std::size_t i = 1; i < stripe.left.size(); ++i)
      EXPECT_EQ(arcs.erase({stripe.left[i], stripe.left[i - 1]}), 1u) << family;
    Arcs ends;  // of a row of nodes; a single northernmost node is the end of both sides
    if (stripe.left.front() != stripe.right.front()) ends.insert({stripe.left.front(), stripe.right.front()});
    if (stripe.left.back() != stripe.right.back()) ends.insert({stripe.right.back(), stripe.left.back()});
    EXPECT_EQ(arcs, ends) << family;
    EXPECT_EQ(ends.size(), std::string(family) == "latlon" ? 2u : 0u);
  }
}

TEST(stripe, one_node_or_two_are_sides_without_triangles) {
  const Points points{{0.6, 0, -0.8}, {0.8, 0, 0.6}};
  EXPECT_TRUE(triangulate(points, Nodes{}, 0).left.empty());
  const Stripe one = triangulate(points, Nodes{1}, 0), two = triangulate(points, Nodes{1, 0}, 0);
  EXPECT_EQ(one.left, Chain{1});
  EXPECT_EQ(one.right, Chain{1});
  EXPECT_EQ(two.left, (Chain{0, 1}));
  EXPECT_EQ(two.right, (Chain{0, 1}));
  EXPECT_TRUE(two.triangles.empty());
}

TEST(stitch, makes_a_strip_between_the_chains) {
  point_sets::Random random(5);
  for (const auto& [l, r] :
       std::vector<std::pair<int, int>>{{1, 1}, {1, 9}, {9, 1}, {2, 2}, {40, 7}, {30, 30}}) {
    Points points;
    Chain left, right;
    const auto add = [&](Chain& chain, int count, double longitude) {
      for (int i = 0; i < count; ++i) {
        chain.push_back(static_cast<index_t>(points.size()));
        points.push_back(
            point_sets::from_degrees(longitude + random.uniform(-1, 1), -60 + 120 * (i + 0.5) / count));
      }
    };
    add(left, l, 0);
    add(right, r, 5);
    const Triangles strip = stitch(points, left, right);
    EXPECT_EQ(strip.size(), left.size() + right.size() - 2);
    Arcs expected;  // counterclockwise: along the left chain southwards, across, the right one northwards,
                    // across
    for (std::size_t i = 1; i < left.size(); ++i) expected.insert({left[i], left[i - 1]});
    for (std::size_t i = 1; i < right.size(); ++i) expected.insert({right[i - 1], right[i]});
    if (!strip.empty()) {
      expected.insert({left.front(), right.front()});
      expected.insert({right.back(), left.back()});
    }
    EXPECT_EQ(boundary(strip), expected) << l << " " << r;
  }
}

// Between two columns of a grid the circle decides: the nearer node of the two chains comes first.
TEST(stitch, joins_columns_of_equal_latitudes_row_by_row) {
  Points points;
  Chain left, right;
  for (int row = 0; row < 10; ++row)
    for (Chain* chain : {&left, &right}) {
      chain->push_back(static_cast<index_t>(points.size()));
      points.push_back(point_sets::from_degrees(chain == &left ? 0 : 4, -40 + 8 * row));
    }
  for (const auto& [a, b, c] : stitch(points, left, right)) {
    const auto [lowest, highest] = std::minmax({a / 2, b / 2, c / 2});  // rows
    EXPECT_EQ(highest - lowest, 1);
  }
}

TEST(stitch, makes_nothing_of_an_empty_chain_or_of_one_stripe_alone) {
  const Points points = point_sets::make("random", 10);
  EXPECT_TRUE(stitch(points, {}, {1, 2}).empty());
  EXPECT_TRUE(stitch(points, {1, 2}, {}).empty());
  EXPECT_TRUE(stitch(points, {1, 2, 3}, {1, 4, 3}).empty());
}

// The corners of the two holes are the northernmost, or southernmost, nodes of the stripes.
TEST(method, leaves_two_polar_holes_and_arcs_that_are_not_delaunay) {
  for (const int count : {3, 4, 8, 16}) {
    const Points points = point_sets::make("random", 3000, static_cast<std::uint64_t>(count));
    const Triangles mesh = stitched_stripes(points, count);
    const auto corners = static_cast<std::size_t>(count);
    EXPECT_EQ(mesh.size() + 2 * (corners - 2), 2 * points.size() - 4);
    const Defects found = find_defects(points, mesh);
    EXPECT_EQ(found.boundary, 2 * corners);
    EXPECT_GT(found.not_delaunay, 0u);
  }
}

TEST(defects, none_in_the_exact_mesh_and_one_for_each_wrong_triangle) {
  const Points points = point_sets::make("random", 500);
  const Triangles exact = delaunay_triangles(points);
  const Defects none = find_defects(points, exact);
  EXPECT_EQ(none.inverted + none.boundary + none.not_delaunay + none.ties, 0u);
  Triangles mesh = exact;
  mesh.pop_back();
  EXPECT_EQ(find_defects(points, mesh).boundary, 3u);
  mesh = exact;
  std::swap(mesh[7][1], mesh[7][2]);
  EXPECT_EQ(find_defects(points, mesh).inverted, 1u);
}

TEST(defects, a_grid_cut_along_its_columns_has_ties_alone) {
  const Points points = point_sets::make("latlon", 1000);
  const Defects found = find_defects(points, stitched_stripes(points, 4));
  EXPECT_GT(found.ties, 100u);
  EXPECT_EQ(found.not_delaunay, 0u);
}

}  // namespace
}  // namespace thesis
