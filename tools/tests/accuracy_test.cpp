// Weights, gradients and qualities against 400 digits, for nodes of all distances.

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <string>
#include <vector>

#include "files/mesh.h"
#include "methods/gradients.h"
#include "methods/quality.h"
#include "methods/triangulated_nodes.h"
#include "point_sets.h"
#include "stripack/list_queries.h"
#include "support/many_digits.h"

namespace methods {
namespace {

using many_digits::Real;
using many_digits::Vector;
using point_sets::Random;
using Points = std::vector<Point>;

/// Six nodes around the sphere, so that the cells of all others are small.
const Points kFar{{1, 0, 0}, {-0.2, 1, 0.1}, {-1, -0.1, 0}, {0, -1, -0.3}, {0.1, 0, -1}, {0.7, 0.5, 0.9}};

/// The place x, y of the tangent plane at g.
Point near(const Point& g, double x, double y) {
  const Point e = files::unit(Point{-g.y, g.x, 0}), f = cross(g, e);
  return files::unit({g.x + x * e.x + y * f.x, g.y + x * e.y + y * f.y, g.z + x * e.z + y * f.z});
}

/// Sets of nodes, and places between some of them.
struct Case {
  std::string shape;
  double width;
  Points nodes, places;
};

std::vector<Case> cases() {
  std::vector<Case> all;
  Random random(4);
  const Point g = files::unit(Point{-0.3, -0.5, 0.4});
  const auto add = [&](const char* shape, double width, int count, const std::function<Point()>& node) {
    Case c{shape, width, kFar, {}};
    for (int k = 0; k < count; ++k) c.nodes.push_back(node());
    for (int k = 0; k < 3; ++k) c.places.push_back(node());
    all.push_back(c);
  };
  for (const double w : {1.0, 1e-2, 1e-4, 1e-6, 1e-8, 1e-10, 1e-12}) {
    add("cluster", w, 10, [&] { return near(g, random.uniform(-w, w), random.uniform(-w, w)); });
    add("needles", w, 10, [&] { return near(g, random.uniform(-w, w), 1e-3 * random.uniform(-w, w)); });
    Case& beside = all.emplace_back(all[all.size() - 2]);  // very near a node
    beside.shape = "beside a node";
    beside.places.clear();
    const Point& node = beside.nodes[8];
    for (const double d : {1e-3, std::max(1e-7, 4e-16 / w)})
      beside.places.push_back(files::unit({node.x + d * w, node.y - d * w, node.z + d * w}));
  }
  for (const double w : {1e-17, 1e-100, 1e-150})
    add("at a pole", w, 8, [&] { return Point{random.uniform(-w, w), random.uniform(-w, w), 1}; });
  return all;
}

Vector exact(const Points& nodes, std::int32_t node) {
  return many_digits::direction(nodes[static_cast<std::size_t>(node) - 1]);
}

std::vector<std::int32_t> ring_of(const files::Mesh& mesh, std::int32_t node) {
  const pstripack::ListReader<std::int32_t> reader(mesh.lists());
  std::vector<std::int32_t> ring;
  reader.for_each_neighbour(node, [&](std::int32_t neighbour) { ring.push_back(neighbour); });
  return ring;
}

Real cell(const files::Mesh& mesh, std::int32_t node) {
  std::vector<Vector> ring;
  for (const std::int32_t other : ring_of(mesh, node)) ring.push_back(exact(mesh.points, other));
  return many_digits::cell(exact(mesh.points, node), ring);
}

/// Prints the row of a table, and the largest error in units of 2^-53.
void report(const char* what, const Case& c, double error, double bound) {
  std::printf("%-10s %-14s %-8.0e %8.2g\n", what, c.shape.c_str(), c.width, error);
  EXPECT_LE(error, bound) << what << ' ' << c.shape << ' ' << c.width;
}

TEST(accuracy, of_barycentric_weights) {
  for (const Case& c : cases()) {
    const Interpolation in = interpolation_between(c.nodes);
    double worst = 0;
    for (const Point& place : c.places) {
      std::int32_t near = 1;
      Interpolation::Corners corners;
      std::vector<Share> shares;
      ASSERT_TRUE(in.triangle(place, near, corners));
      ASSERT_TRUE(in.linear(place, near, shares));
      ASSERT_EQ(shares.size(), 3U);
      const Vector p = many_digits::direction(place);
      Real part[3], sum = 0;
      for (std::size_t k = 0; k < 3; ++k) {
        part[k] = dot(p, cross(exact(c.nodes, corners[(k + 1) % 3]), exact(c.nodes, corners[(k + 2) % 3])));
        ASSERT_GE(part[k], 0);
        sum += part[k];
      }
      for (std::size_t k = 0; k < 3; ++k)
        worst = std::max(worst, many_digits::error(shares[k].part, part[k] / sum, part[k] / sum));
    }
    report("linear", c, worst, 512);
  }
}

TEST(accuracy, of_natural_weights) {
  for (const Case& c : cases()) {
    const Interpolation in = interpolation_between(c.nodes);
    const files::Mesh before = files::triangulate(c.nodes);
    double of_all = 0, of_itself = 0;
    for (const Point& place : c.places) {
      std::int32_t near = 1;
      std::vector<Share> shares;
      ASSERT_TRUE(in.natural(place, near, shares));
      Points more = c.nodes;
      more.push_back(place);
      const files::Mesh after = files::triangulate(more);
      const auto number = static_cast<std::int32_t>(more.size());
      ASSERT_EQ(shares.size(), ring_of(after, number).size());
      const Real all = cell(after, number);
      for (const Share& s : shares) {
        const Real part = (cell(before, s.node) - cell(after, s.node)) / all;
        of_all = std::max(of_all, many_digits::error(s.part, part, 1));
        of_itself = std::max(of_itself, many_digits::error(s.part, part, part));
      }
    }
    report("natural", c, of_all, 64);
    EXPECT_LE(of_itself, 0x1p21) << c.shape << ' ' << c.width;
  }
}

TEST(accuracy, of_gradients) {
  for (const Case& c : cases()) {
    if (c.shape != "cluster" || c.width == 1) continue;
    // A linear function around a node that has two rings of neighbours in the cluster.
    Points nodes = kFar;
    const std::size_t centre = nodes.size();
    for (int x = -3; x <= 3; ++x)
      for (int y = -3; y <= 3; ++y)
        nodes.push_back(near(c.nodes[8], c.width * (x + 0.1 * y * y), c.width * (y + 0.2 * x * x)));
    std::swap(nodes[centre], nodes[centre + 24]);
    const Vector p = many_digits::direction(nodes[centre]);
    const Vector slope = cross(p, many_digits::vector({0.3, 0.7, -0.2}));
    std::vector<double> values;
    for (const Point& node : nodes)
      values.push_back(static_cast<double>(Real(dot(slope, many_digits::direction(node) - p))));
    const Point found = gradients(interpolation_between(nodes).mesh(), values)[centre];
    const Vector difference = many_digits::vector(found) - slope;
    report("gradient", c, many_digits::error(many_digits::length(difference), 0, many_digits::length(slope)),
           1000);
  }
}

TEST(accuracy, of_qualities) {
  for (const Case& c : cases()) {
    const files::Mesh mesh = files::triangulate(c.nodes);
    const std::vector<std::int32_t> triangles = files::triangles_of(mesh);
    Real smallest = 10, ratio = 1;
    std::size_t acute = 0;
    for (std::size_t t = 0; t < triangles.size(); t += 3) {
      bool is_acute = true;
      for (std::size_t k = 0; k < 3; ++k) {
        const Vector a = exact(c.nodes, triangles[t + k]), b = exact(c.nodes, triangles[t + (k + 1) % 3]),
                     d = exact(c.nodes, triangles[t + (k + 2) % 3]);
        const Real cosine = dot(b - a, d - a),
                   angle = atan2(many_digits::length(cross(b - a, d - a)), cosine);
        if (angle < smallest) smallest = angle;
        is_acute = is_acute && cosine > 0;
      }
      if (is_acute) ++acute;
    }
    std::vector<Real> areas;
    for (std::size_t i = 0; i < c.nodes.size(); ++i)
      areas.push_back(cell(mesh, static_cast<std::int32_t>(i) + 1));
    for (std::size_t i = 0; i < c.nodes.size(); ++i)
      for (const std::int32_t other : ring_of(mesh, static_cast<std::int32_t>(i) + 1))
        if (const Real r = areas[i] / areas[static_cast<std::size_t>(other) - 1]; r > ratio) ratio = r;
    const Quality quality = quality_of(mesh);
    const Real angle = smallest * Real(180) / acos(Real(-1));
    report("angle", c, many_digits::error(quality.smallest_angle, angle, angle), 68);
    report("ratio", c, many_digits::error(quality.largest_ratio, ratio, ratio), 260);
    EXPECT_EQ(quality.obtuse, static_cast<std::int64_t>(triangles.size() / 3 - acute))
        << c.shape << ' ' << c.width;
  }
}

}  // namespace
}  // namespace methods
