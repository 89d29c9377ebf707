// The parts of the published method, in one process.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <set>

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
  return triangulate(points, pick(points, k, 1, count)[0], middle(k, count));
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

/// Fans into the holes, each around one of its nodes. Returns the number of holes.
std::size_t fill_holes(Triangles& triangles) {
  std::map<index_t, index_t> next;  // around a hole: the arcs of the boundary, reversed
  for (const auto& [a, b] : boundary(triangles)) EXPECT_TRUE(next.emplace(b, a).second) << "holes touch";
  std::size_t holes = 0;
  for (; !next.empty(); ++holes) {
    const index_t centre = next.begin()->first;
    index_t a = next.at(centre);
    next.erase(centre);
    while (a != centre) {
      const index_t b = next.at(a);
      next.erase(a);
      if (b != centre) triangles.push_back({centre, a, b});
      a = b;
    }
  }
  return holes;
}

TEST(pick, every_node_is_in_exactly_one_stripe) {
  for (const char* family : {"random", "latlon"})
    for (const int count : {1, 3, 4, 7, 64}) {
      const Points points = point_sets::make(family, 1000);
      std::vector<index_t> all;
      for (const Nodes& nodes : pick(points, 0, count, count))
        all.insert(all.end(), nodes.begin(), nodes.end());
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
    const Nodes nodes = pick(points, k, 1, count)[0];
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
    EXPECT_EQ(stripe.counts.rescued, 0u);
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

TEST(stripe, a_grid_in_its_given_order_needs_no_rescue) {
  const Points points = point_sets::make("latlon", 5000);
  for (int k = 0; k < 8; ++k) EXPECT_EQ(stripe_of_many(points, k, 8).counts.rescued, 0u);
}

TEST(stripe, comes_back_from_nodes_that_coincide) {
  Points points = point_sets::make("random", 300);
  points.insert(points.end(), points.begin(), points.begin() + 100);
  const Triangles mesh = stitched_stripes(points, 4);
  const Defects found = find_defects(points, mesh, 0);
  EXPECT_GT(found.inverted + found.missing_nodes, 0u);
  EXPECT_NE(found.verdict, "");
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

// The corners of the two holes are the northernmost, or southernmost, nodes of the stripes. Where no triangle
// is inverted, which stitching does not promise, the holes are all that flips cannot mend.
TEST(method, is_exact_after_filling_the_two_polar_holes_and_flips) {
  int mended = 0;
  for (const int count : {3, 4, 8, 16})
    for (const std::uint64_t seed : {1, 2, 3, 4, 5}) {
      const Points points = point_sets::make("random", 3000, seed);
      Triangles mesh = stitched_stripes(points, count);
      const Expected right = expected(points);
      const Defects before = find_defects(points, mesh, right.area);
      EXPECT_EQ(before.missing_nodes, 0u);
      EXPECT_EQ(before.boundary_arcs, 2 * static_cast<std::size_t>(count));
      EXPECT_EQ(mesh.size() + 2 * (static_cast<std::size_t>(count) - 2), right.triangles);
      EXPECT_GT(before.uncovered_area, 0);
      EXPECT_GT(before.non_delaunay_arcs, 0u);
      EXPECT_NE(before.verdict, "");
      EXPECT_EQ(fill_holes(mesh), 2u);
      const Defects filled = find_defects(points, mesh, right.area);
      EXPECT_NEAR(filled.uncovered_area, 0, 1e-9);
      if (filled.inverted > 0) continue;
      const Repair repaired = repair(points, mesh);
      EXPECT_GT(repaired.flips, before.non_delaunay_arcs / 2);
      EXPECT_EQ(repaired.stuck, 0u);
      EXPECT_EQ(canonical(mesh), delaunay_triangles(points)) << count << " stripes, seed " << seed;
      ++mended;
    }
  EXPECT_GE(mended, 5);
}

TEST(method, hybrid_makes_the_same_triangles) {
  const Points points = point_sets::make("random", 3000);
  StripeSeconds seconds;
  const Stripe all = triangulate(points, pick(points, 0, 6, 6), 0, 6, seconds);
  Triangles mesh = all.triangles;
  mesh.insert(mesh.end(), all.stitched.begin(), all.stitched.end());
  const Triangles closing = stitch(points, all.right, all.left);
  mesh.insert(mesh.end(), closing.begin(), closing.end());
  EXPECT_EQ(canonical(mesh), canonical(stitched_stripes(points, 6)));
}

// ---- the counts -----------------------------------------------------------------------------------------

struct Broken : testing::Test {
  const Points points = point_sets::make("random", 500);
  const Expected right = expected(points);
  Triangles mesh = delaunay_triangles(points);
};

TEST_F(Broken, nothing_is_found_in_the_exact_mesh) {
  const Defects d = find_defects(points, mesh, right.area);
  EXPECT_EQ(d.missing_nodes + d.inverted + d.non_manifold_arcs + d.boundary_arcs + d.non_delaunay_arcs, 0u);
  EXPECT_NEAR(d.uncovered_area, 0, 1e-12);
  EXPECT_EQ(d.verdict, "");
  EXPECT_NEAR(right.area, 4 * std::acos(-1.0), 1e-12);
  EXPECT_EQ(repair(points, mesh).flips, 0u);
}

TEST_F(Broken, a_missing_triangle_is_three_boundary_arcs_and_its_area) {
  const auto [a, b, c] = mesh.back();
  mesh.pop_back();
  const Defects d = find_defects(points, mesh, right.area);
  EXPECT_EQ(d.boundary_arcs, 3u);
  const Point &p = points[static_cast<std::size_t>(a)], &q = points[static_cast<std::size_t>(b)],
              &r = points[static_cast<std::size_t>(c)];
  const Point n = cross(minus(q, p), minus(r, p));
  EXPECT_NEAR(d.uncovered_area, std::sqrt(dot(n, n)) / 2, 0.05 * d.uncovered_area);  // it is nearly flat
  EXPECT_NE(d.verdict, "");
}

TEST_F(Broken, a_star_that_is_missing_is_a_missing_node) {
  mesh.erase(std::remove_if(mesh.begin(), mesh.end(), [](const auto& t) { return t[0] == 0; }), mesh.end());
  EXPECT_EQ(find_defects(points, mesh, right.area).missing_nodes, 1u);  // canonical: 0 stands first
}

TEST_F(Broken, a_triangle_given_twice_is_not_manifold) {
  mesh.push_back(mesh.front());
  EXPECT_EQ(find_defects(points, mesh, right.area).non_manifold_arcs, 3u);
}

TEST_F(Broken, a_reversed_triangle_is_inverted) {
  std::swap(mesh[7][1], mesh[7][2]);
  const Defects d = find_defects(points, mesh, right.area);
  EXPECT_EQ(d.inverted, 1u);
  EXPECT_EQ(d.non_manifold_arcs, 3u);
}

TEST_F(Broken, a_wrong_flip_is_one_arc_and_is_repaired_in_place) {
  const Triangles exact = mesh;
  std::size_t flipped = 0;
  for (std::size_t t = 0; t < mesh.size() && flipped == 0; ++t)
    for (std::size_t u = t + 1; u < mesh.size() && flipped == 0; ++u)
      for (std::size_t i = 0; i < 9; ++i) {
        const index_t a = mesh[t][i % 3], b = mesh[t][(i + 1) % 3], c = mesh[t][(i + 2) % 3];
        const index_t d = mesh[u][i / 3];
        if (mesh[u][(i / 3 + 1) % 3] != c || mesh[u][(i / 3 + 2) % 3] != b) continue;
        const auto point = [&](index_t v) { return points[static_cast<std::size_t>(v)]; };
        if (pstripack::left(point(a), point(b), point(d)) <= 0 ||
            pstripack::left(point(d), point(c), point(a)) <= 0)
          continue;
        mesh[t] = {a, b, d};
        mesh[u] = {d, c, a};
        ++flipped;
        break;
      }
  ASSERT_EQ(flipped, 1u);
  const Defects d = find_defects(points, mesh, right.area);
  EXPECT_GE(d.non_delaunay_arcs, 1u);
  EXPECT_EQ(d.ties, 0u);
  EXPECT_NE(d.verdict, "");
  const Repair repaired = repair(points, mesh);
  EXPECT_GE(repaired.flips, 1u);
  EXPECT_EQ(canonical(mesh), exact);
}

TEST(ties, are_all_that_is_wrong_in_a_grid_cut_along_its_columns) {
  const Points points = point_sets::make("latlon", 1000);
  const Defects d = find_defects(points, stitched_stripes(points, 4), expected(points).area);
  EXPECT_GT(d.ties, 100u);
  EXPECT_EQ(d.non_delaunay_arcs, d.ties);
}

}  // namespace
}  // namespace thesis
