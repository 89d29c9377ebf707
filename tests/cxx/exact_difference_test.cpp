// The difference of lists from the exact mesh: for exact meshes, and after changes with a known effect.

#include "trmesh/exact_difference.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <string>
#include <vector>

#include "point_sets.h"
#include "stripack/arc_edit.h"
#include "stripack/list_edit.h"
#include "support/plain_lists.h"

using namespace pstripack;

namespace {

/// The exact mesh of the nodes in lists that can be changed.
struct Mesh {
  explicit Mesh(const std::vector<Point>& points) : nodes(points), n(static_cast<int>(points.size())) {
    std::vector<double> x, y, z;
    for (const Point& p : nodes) x.push_back(p.x), y.push_back(p.y), z.push_back(p.z);
    const PlainLists plain = plain_lists(points.size(), x.data(), y.data(), z.data());
    list = plain.list, lptr = plain.lptr, lend = plain.lend;
    lnew = static_cast<int>(plain.slots + 1);
  }

  EditedLists<int> lists() { return {n, list.data(), lptr.data(), lend.data(), &lnew}; }
  int at(const std::vector<int>& v, int i) const { return v[static_cast<std::size_t>(i) - 1]; }
  int last_slot(int k) const { return at(lend, k); }
  bool on_boundary(int k) const { return at(list, last_slot(k)) < 0; }
  int boundary_nodes() const {
    int count = 0;
    for (int k = 1; k <= n; ++k) count += on_boundary(k) ? 1 : 0;
    return count;
  }

  /// Swaps an arc opposite every `step`-th node if may_swap(its ends) is true and none of the four nodes took
  /// part in another swap. Returns the number of swaps.
  template <class MaySwap>
  int swap_arcs(int step, const MaySwap& may_swap) {
    std::vector<bool> touched(static_cast<std::size_t>(n) + 1, false);
    int swapped = 0;
    for (int k = 1; k <= n; k += step) {
      const int slot = at(lptr, last_slot(k)), b = at(list, slot), c = std::abs(at(list, at(lptr, slot)));
      const int d = after(c, b);  // the triangle beyond b-c is c, b, d
      if (d == 0) continue;
      const int quadrilateral[] = {k, b, c, d};
      if (std::any_of(std::begin(quadrilateral), std::end(quadrilateral),
                      [&](int node) { return touched[static_cast<std::size_t>(node)]; }))
        continue;
      int slot_of_new = 0;
      const auto unbounded = EditedLists<int>::unbounded(list.data(), lptr.data(), lend.data());
      if (!may_swap(b, c) || swap(k, d, b, c, unbounded, slot_of_new) != 0 || slot_of_new == 0) continue;
      for (const int node : quadrilateral) touched[static_cast<std::size_t>(node)] = true;
      ++swapped;
    }
    return swapped;
  }

  int swap_arcs(int step) {
    return swap_arcs(step, [](int, int) { return true; });
  }

  /// Removes at most `most` triangles at the boundary. Returns their number.
  int remove_triangles(int most) {
    int removed = 0;
    for (int k = 1; k <= n && removed < most; ++k)
      if (on_boundary(k) && delarc(k, at(list, at(lptr, last_slot(k))), lists()) == DelarcStatus::done)
        ++removed;
    return removed;
  }

  ExactDifference difference() const {
    const ListsView<int> view{nodes.size(), list.data(), lptr.data(), lend.data(), lnew};
    EXPECT_TRUE(check_topology(view)) << check_topology(view).message;
    return exact_difference(NodeArrays(nodes.data()), view);
  }

  std::vector<Point> nodes;
  int n, lnew;
  std::vector<int> list, lptr, lend;

 private:
  /// The third corner of the triangle left of a->b, 0 if there is none.
  int after(int a, int b) const {
    int slot = last_slot(a);
    do {
      slot = at(lptr, slot);
      if (at(list, slot) == b) return std::abs(at(list, at(lptr, slot)));
    } while (slot != last_slot(a));
    return 0;
  }
};

void expect_difference(const Mesh& mesh, std::int64_t arcs, std::int64_t triangles, const std::string& what) {
  const ExactDifference difference = mesh.difference();
  EXPECT_EQ(difference.ier, 0) << what;
  EXPECT_EQ(difference.arcs, arcs) << what;
  EXPECT_EQ(difference.boundary_triangles, triangles) << what;
}

TEST(ExactDifference, IsNoneForTheExactMesh) {
  for (const char* family :
       {"random", "hemisphere", "cap", "latlon", "ring", "cubed-sphere", "hemisphere-rim"})
    for (const std::size_t n : {60, 500})
      expect_difference(Mesh(point_sets::make(family, n)), 0, 0, family + std::to_string(n));
}

TEST(ExactDifference, CountsArcs) {
  for (const char* family : {"random", "hemisphere", "cap:1e-4"}) {  // these by directions
    Mesh mesh(point_sets::make(family, 500));
    const int swapped = mesh.swap_arcs(7);
    EXPECT_GT(swapped, 20) << family;
    expect_difference(mesh, swapped, 0, family);
  }
}

/// The corners of a cube: both diagonals of its sides are correct.
TEST(ExactDifference, DoesNotCountDiagonalsOfNodesInOneCircle) {
  std::vector<Point> nodes;
  for (const double x : {-0.5, 0.5})
    for (const double y : {-0.5, 0.5})
      for (const double z : {-0.5, 0.5}) nodes.push_back({x, y, z});
  Mesh mesh(nodes);
  const int swapped = mesh.swap_arcs(1, [&](int a, int b) {
    const Point &p = nodes[static_cast<std::size_t>(a - 1)], &q = nodes[static_cast<std::size_t>(b - 1)];
    return (p.x != q.x) + (p.y != q.y) + (p.z != q.z) == 2;
  });
  EXPECT_GT(swapped, 0);
  expect_difference(mesh, 0, 0, "");
}

TEST(ExactDifference, CountsBoundaryTriangles) {
  for (const char* family : {"hemisphere", "cap"})
    for (const int most : {1, 2, 5}) {
      Mesh mesh(point_sets::make(family, 300));
      EXPECT_EQ(mesh.remove_triangles(most), most);
      expect_difference(mesh, 0, most, family);
    }
}

/// Boundary nodes are pushed outwards while the lists stay the same: the exact mesh has fewer triangles.
TEST(ExactDifference, CountsTrianglesThatTheExactMeshHasNot) {
  const std::vector<Point> disc = point_sets::make("hemisphere", 300);
  Mesh mesh(disc);
  const int before = mesh.boundary_nodes();
  // A node a little inside the arc between two nodes of the boundary, in a triangle with them; then outside.
  int a = 1;
  while (!mesh.on_boundary(a)) ++a;
  const int b = mesh.at(mesh.list, mesh.at(mesh.lptr, mesh.last_slot(a)));
  const Point &p = disc[static_cast<std::size_t>(a - 1)], &q = disc[static_cast<std::size_t>(b - 1)];
  const auto beside_arc = [&](double step) {
    const Point normal{p.y * q.z - p.z * q.y, p.z * q.x - p.x * q.z, p.x * q.y - p.y * q.x};
    return Point{(p.x + q.x) / 2 + step * normal.x, (p.y + q.y) / 2 + step * normal.y,
                 (p.z + q.z) / 2 + step * normal.z};
  };
  std::vector<Point> nodes = disc;
  nodes.push_back(beside_arc(1e-9));
  Mesh inside(nodes);
  ASSERT_EQ(inside.boundary_nodes(), before);
  inside.nodes.back() = beside_arc(-1e-9);
  expect_difference(inside, 0, 1, "");
}

/// Only one of the two meshes covers the sphere.
TEST(ExactDifference, CountsTrianglesOverTheWholeBoundary) {
  const std::vector<Point> cap = point_sets::make("cap", 50);
  Mesh mesh({cap.begin(), cap.end() - 1});
  int start = 1;
  while (!mesh.on_boundary(start)) ++start;
  mesh.nodes = cap;
  mesh.n = 50;
  mesh.list.resize(6 * 50 - 12);
  mesh.lptr.resize(6 * 50 - 12);
  mesh.lend.resize(50);
  const int boundary = Mesh(cap).boundary_nodes();
  ASSERT_EQ(covsph(start, mesh.lists()), 0);
  ASSERT_EQ(mesh.boundary_nodes(), 0);
  EXPECT_EQ(mesh.difference().boundary_triangles, boundary - 2);
}

/// Coincident or collinear nodes with the lists of other nodes.
TEST(ExactDifference, TellsTheExactCode) {
  Mesh mesh(point_sets::make("random", 40));
  mesh.nodes[30] = mesh.nodes[10];
  EXPECT_EQ(mesh.difference().ier, 11);
  mesh.nodes[0] = {1, 0, 0};
  mesh.nodes[1] = {0, 1, 0};
  mesh.nodes[2] = {-0.6, 0.8, 0};
  EXPECT_EQ(mesh.difference().ier, -2);
}

}  // namespace
