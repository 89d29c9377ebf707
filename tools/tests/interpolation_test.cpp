// Interpolation between scattered nodes: properties of shares and values.

#include "methods/interpolation.h"

#include <gtest/gtest.h>
#ifdef _OPENMP
#include <omp.h>
#endif

#include <algorithm>
#include <cmath>
#include <exception>
#include <functional>
#include <utility>

#include "files/measures.h"
#include "geometry/measures.h"
#include "methods/gradients.h"
#include "methods/quality.h"
#include "methods/triangulated_nodes.h"
#include "point_sets.h"
#include "stripack/list_queries.h"
#include "support/failing_allocation.h"

namespace methods {
namespace {

using Points = std::vector<Point>;
using Method = Interpolation::Method;

/// Cocircular nodes, uneven densities, and regional nodes.
const char* const kFamilies[] = {"random", "latlon", "healpix", "variable", "clusters", "hemisphere", "cap"};

Points places(std::size_t n, std::uint64_t seed) { return point_sets::make("random", n, seed); }

bool shares_at(const Interpolation& in, Method method, const Point& p, std::vector<Share>& shares) {
  std::int32_t near = 1;
  return method == Method::linear ? in.linear(p, near, shares) : in.natural(p, near, shares);
}

std::vector<double> values_at(const Interpolation& in, const Points& at, const std::vector<double>& values,
                              Method method) {
  return in.values_at(at, values, method, Interpolation::Outside::missing).values;
}

std::vector<double> random_values(std::size_t n) {
  point_sets::Random random(5);
  std::vector<double> values(n);
  for (double& v : values) v = random.uniform(-1, 1);
  return values;
}

TEST(shares, are_positive_and_add_up_to_one) {
  for (const char* const family : kFamilies)
    for (const Method method : {Method::linear, Method::natural}) {
      const Interpolation in = interpolation_between(point_sets::make(family, 400));
      std::vector<Share> shares;
      std::size_t inside = 0;
      for (const Point& p : places(2000, 3)) {
        if (!shares_at(in, method, p, shares)) continue;
        ++inside;
        double sum = 0;
        for (const Share& s : shares) {
          EXPECT_GT(s.part, 0);
          sum += s.part;
        }
        EXPECT_NEAR(sum, 1, 1e-14);
      }
      EXPECT_TRUE(inside > 0 || family == std::string("cap")) << family;
    }
}

TEST(shares, of_a_node_are_its_own_alone) {
  std::vector<Points> sets;
  for (const char* const family : kFamilies) sets.push_back(point_sets::make(family, 300));
  for (const std::size_t n : {12u, 100u, 1000u}) {  // on half a circle up to rounding
    Points& nodes = sets.emplace_back();
    point_sets::Random random(1);
    for (std::size_t i = 0; i < n; ++i) {
      const double a = random.uniform(0, 3.14159);
      nodes.push_back({std::cos(a), std::sin(a) * std::cos(0.7), std::sin(a) * std::sin(0.7)});
    }
  }
  for (const Points& nodes : sets)
    for (const Method method : {Method::linear, Method::natural, Method::cubic}) {
      const std::vector<double> values = random_values(nodes.size());
      const Interpolation::Result result =
          interpolation_between(nodes).values_at(nodes, values, method, Interpolation::Outside::missing);
      EXPECT_EQ(result.values, values);
      EXPECT_EQ(result.outside, 0u);
    }
}

TEST(linear, does_not_depend_on_where_the_search_begins) {
  for (const char* const family : {"random", "latlon", "healpix"}) {
    const Points nodes = point_sets::make(family, 400);
    const Interpolation in = interpolation_between(nodes);
    Points on_arcs;  // up to rounding; many exactly
    const std::vector<std::int32_t> triangles = files::triangles_of(files::triangulate(nodes));
    for (std::size_t t = 0; t + 2 < triangles.size(); t += 3) {
      const Point a = nodes[static_cast<std::size_t>(triangles[t]) - 1],
                  b = nodes[static_cast<std::size_t>(triangles[t + 1]) - 1];
      on_arcs.push_back(files::unit({a.x + b.x, a.y + b.y, a.z + b.z}));
    }
    for (const Point& p : on_arcs) {
      std::vector<Share> first, other;
      ASSERT_TRUE(shares_at(in, Method::linear, p, first));
      for (std::int32_t near : {77, 200, 399}) {
        ASSERT_TRUE(in.linear(p, near, other));
        ASSERT_EQ(first.size(), other.size()) << family;
        for (std::size_t i = 0; i < first.size(); ++i)
          EXPECT_EQ(std::pair(first[i].node, first[i].part), std::pair(other[i].node, other[i].part));
      }
    }
  }
}

double smooth(const Point& p) { return std::exp(p.x) * (1 + 0.3 * p.y * p.z); }

double largest_error(const char* family, std::size_t n, Method method) {
  const Points nodes = point_sets::make(family, n), at = places(3000, 11);
  std::vector<double> values;
  for (const Point& p : nodes) values.push_back(smooth(p));
  const std::vector<double> found = values_at(interpolation_between(nodes), at, values, method);
  double largest = 0;
  for (std::size_t i = 0; i < at.size(); ++i)
    largest = std::max(largest, std::fabs(found[i] - smooth(at[i])));
  return largest;
}

TEST(cubic, is_of_higher_order_than_linear_and_natural) {
  for (const char* const family : {"fibonacci", "random", "latlon"}) {
    const double coarse = largest_error(family, 500, Method::cubic),
                 fine = largest_error(family, 8000, Method::cubic);
    EXPECT_LT(fine, coarse / 24)
        << family;  // at a quarter of the spacing the second order gives 16, the third 64
    EXPECT_LT(fine, largest_error(family, 8000, Method::natural) / 3) << family;
  }
}

TEST(cubic, meets_the_values_with_the_gradients_of_the_nodes) {
  const Points nodes = point_sets::make("random", 200);
  const std::vector<double> values = random_values(nodes.size());
  const Interpolation in = interpolation_between(nodes);
  const std::vector<Point> slopes = gradients(interpolation_between(nodes).mesh(), values);
  constexpr double kStep = 1e-6;
  Points beside, ways;  // one step from each node in each direction
  for (std::size_t i = 0; i < nodes.size(); ++i)
    for (const Point& away : places(4, 1000 + i)) {
      const Point& p = nodes[i];
      const Point t = files::unit(cross(p, away));
      ways.push_back(t);
      beside.push_back(files::unit({p.x + kStep * t.x, p.y + kStep * t.y, p.z + kStep * t.z}));
    }
  EXPECT_EQ(values_at(in, nodes, values, Method::cubic), values);
  const std::vector<double> found = values_at(in, beside, values, Method::cubic);
  for (std::size_t k = 0; k < found.size(); ++k) {
    const std::size_t i = k / 4;
    const double slope = std::sqrt(dot(slopes[i], slopes[i]));
    EXPECT_LT(std::fabs(dot(slopes[i], nodes[i])), 1e-12 * slope + 1e-300);
    EXPECT_NEAR((found[k] - values[i]) / kStep, dot(slopes[i], ways[k]), 1e-2 * (1 + slope));
  }
}

TEST(gradients, are_those_of_a_quadratic_and_zero_where_nodes_determine_none) {
  const Points nodes = point_sets::make("random", 2000);
  std::vector<double> values;
  for (const Point& p : nodes) values.push_back(3 + p.z);
  const std::vector<Point> slopes = gradients(interpolation_between(nodes).mesh(), values);
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const Point& p = nodes[i];
    const Point error = minus(slopes[i], {-p.z * p.x, -p.z * p.y, 1 - p.z * p.z});
    EXPECT_LT(std::sqrt(dot(error, error)), 0.02);
  }
  const Points three{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  for (const Point& slope : gradients(interpolation_between(three).mesh(), {5, 5, 5}))
    EXPECT_EQ(slope, (Point{0, 0, 0}));
}

// Nodes along a meridian, up to rounding or some metres: they tell the slope along it only.
TEST(gradients, are_along_the_line_of_nodes_that_lie_on_one) {
  for (const double turn : {0.0, 0.3, 1.0, 1.5707963267948966})
    for (const double aside : {1e-15, 1e-6}) {
      Points nodes;
      std::vector<double> values;
      const Point east{-std::sin(turn), std::cos(turn), 0};
      for (int k = 0; k < 17; ++k) {
        const double lat = (5 * k - 20) / files::kRadian, by = aside * (k * k % 5);
        nodes.push_back({std::cos(lat) * std::cos(turn) + by * east.x,
                         std::cos(lat) * std::sin(turn) + by * east.y, std::sin(lat)});
        values.push_back(28 + 3 * lat);
      }
      const std::vector<Point> slopes = gradients(interpolation_between(nodes).mesh(), values);
      for (std::size_t k = 0; k < 17; ++k) {
        EXPECT_NEAR(dot(slopes[k], cross(nodes[k], east)), 3, 1e-5) << turn << ' ' << aside << ' ' << k;
        EXPECT_NEAR(dot(slopes[k], east), 0, 1e-4) << turn << ' ' << aside << ' ' << k;
      }
    }
}

std::vector<double> cell_areas(const Points& nodes) {
  return files::voronoi_faces(files::triangulate(nodes), false).area;
}

TEST(natural, shares_are_what_the_cells_lose_to_a_new_node) {
  for (const char* const family : {"random", "latlon", "variable", "hemisphere"}) {
    Points nodes = point_sets::make(family, 150);
    const std::vector<double> before = cell_areas(nodes);
    const Interpolation in = interpolation_between(nodes);
    for (const Point& p : places(60, 8)) {
      std::vector<Share> shares;
      if (!shares_at(in, Method::natural, p, shares)) continue;
      nodes.push_back(p);
      const std::vector<double> after = cell_areas(nodes);
      nodes.pop_back();
      std::vector<double> parts(nodes.size());
      for (const Share& s : shares) parts[static_cast<std::size_t>(s.node) - 1] = s.part;
      for (std::size_t i = 0; i < nodes.size(); ++i)
        EXPECT_NEAR(parts[i] * after.back(), before[i] - after[i], 1e-12) << family;
    }
  }
}

TEST(values, are_continuous) {
  constexpr double kStep = 1e-7;
  for (const char* const family : {"random", "latlon", "healpix", "icosahedral"})
    for (const Method method : {Method::linear, Method::natural}) {
      const Points nodes = point_sets::make(family, 200);
      const std::vector<double> values = random_values(nodes.size());
      // Pairs of places on both sides of arcs, of corners of cells, and of nodes.
      Points pairs;
      const auto add = [&](const Point& middle, const Point& towards) {
        for (const double step : {-kStep, kStep})
          pairs.push_back(files::unit(
              {middle.x + step * towards.x, middle.y + step * towards.y, middle.z + step * towards.z}));
      };
      const files::Mesh mesh = files::triangulate(nodes);
      const files::Faces triangles = files::triangle_faces(mesh);
      for (std::size_t t = 0; t < triangles.size(); ++t) {
        const auto at = [&](std::size_t k) {
          return triangles.points[static_cast<std::size_t>(triangles.corner[3 * t + k]) - 1];
        };
        const Point a = at(0), b = at(1), c = at(2),
                    centre = circumcircle(pstripack::direction_of(a), pstripack::direction_of(b),
                                          pstripack::direction_of(c))
                                 .centre;
        for (const Point& towards : {cross(a, b), b, c}) {
          add(a, towards);
          add({a.x + 2 * b.x, a.y + 2 * b.y, a.z + 2 * b.z}, towards);
          add(centre, towards);
          // On the circumcircle of the triangle, where the set of natural neighbours changes.
          add({2 * dot(a, centre) * centre.x - a.x, 2 * dot(a, centre) * centre.y - a.y,
               2 * dot(a, centre) * centre.z - a.z},
              centre);
        }
      }
      const std::vector<double> v = values_at(interpolation_between(nodes), pairs, values, method);
      for (std::size_t i = 0; i < v.size(); i += 2) EXPECT_NEAR(v[i], v[i + 1], 2e-4) << family;
    }
}

TEST(values, lie_between_those_of_the_nodes_with_a_share) {
  const Points nodes = point_sets::make("random", 300);
  const std::vector<double> values = random_values(nodes.size());
  const Interpolation in = interpolation_between(nodes);
  const Points at = places(3000, 6);
  for (const Method method : {Method::linear, Method::natural}) {
    const std::vector<double> v = values_at(in, at, values, method);
    std::vector<Share> shares;
    for (std::size_t i = 0; i < at.size(); ++i) {
      ASSERT_TRUE(shares_at(in, method, at[i], shares));
      double low = 2, high = -2, sum = 0;
      for (const Share& s : shares) {
        const double value = values[static_cast<std::size_t>(s.node) - 1];
        low = std::min(low, value), high = std::max(high, value), sum += s.part * value;
      }
      EXPECT_TRUE(low <= v[i] && v[i] <= high);
      EXPECT_NEAR(v[i], sum, 1e-12);
    }
  }
  const std::vector<double> constant(nodes.size(), 0.1);
  EXPECT_EQ(values_at(in, at, constant, Method::natural), std::vector<double>(at.size(), 0.1));  // all bits
}

TEST(outside, is_what_lies_beyond_the_border_but_not_the_border) {
  const Points nodes = point_sets::make("hemisphere", 200);
  const files::Mesh mesh = files::triangulate(nodes);
  const pstripack::ListReader<std::int32_t> reader(mesh.lists());
  const Interpolation in = interpolation_between(nodes);
  std::vector<Share> shares;
  const std::int32_t first = reader.first_boundary_node();
  std::int32_t node = first;
  do {
    const std::int32_t next = reader.first_neighbour(node);
    const Point a = nodes[static_cast<std::size_t>(node) - 1], b = nodes[static_cast<std::size_t>(next) - 1];
    const Point on = files::unit({a.x + 2 * b.x, a.y + 2 * b.y, a.z + 2 * b.z}), out = cross(b, a);
    for (const Method method : {Method::linear, Method::natural}) {
      EXPECT_TRUE(shares_at(in, method, on, shares));
      EXPECT_FALSE(shares_at(
          in, method, files::unit({on.x + 1e-9 * out.x, on.y + 1e-9 * out.y, on.z + 1e-9 * out.z}), shares));
    }
    node = next;
  } while (node != first);
  const Points at = places(1000, 2);
  const Interpolation::Result result =
      in.values_at(at, random_values(nodes.size()), Method::linear, Interpolation::Outside::missing);
  EXPECT_EQ(static_cast<std::size_t>(std::count_if(result.values.begin(), result.values.end(),
                                                   [](double v) { return std::isnan(v); })),
            result.outside);
  EXPECT_GT(result.outside, 450u);
}

TEST(outside, beside_the_border_has_the_weights_of_the_nearest_arc) {
  // A triangle of 1e-12. Places a little outside an arc, and beyond its ends.
  const double w = 1e-12, off = 1e-16;
  const Interpolation in = interpolation_between({{w, 0, 1}, {0, w, 1}, {-w, 0, 1}});
  for (const Method method : {Method::linear, Method::natural})
    for (const double x : {-w - 1e-16, -w, -0.5 * w, 0.0, 0.25 * w, w, w + 1e-16}) {
      std::vector<Share> shares;
      ASSERT_TRUE(shares_at(in, method, {x, -off, 1}, shares)) << x;
      double part[5] = {};
      for (const Share& s : shares) part[s.node] = s.part;
      const double right = std::clamp(0.5 + 0.5 * x / w, 0.0, 1.0);
      const double nearly = off * off / (w * w);  // by sines of the distances to the ends
      EXPECT_NEAR(part[1], right, nearly) << x;
      EXPECT_NEAR(part[3], 1 - right, nearly) << x;
      EXPECT_EQ(part[2], 0) << x;
    }
}

TEST(nearest, is_the_nearest_of_all_nodes_wherever_the_place) {
  for (const char* const family :
       {"random", "hemisphere", "cap", "cap:0.8", "cap:1.4", "strip:1e-9", "box"}) {
    const Points nodes = point_sets::make(family, 200), at = places(500, 9);
    const std::vector<double> values = random_values(nodes.size());
    const Interpolation in = interpolation_between(nodes);
    const std::vector<std::int32_t> found = in.weights_at(at, Method::nearest, {}).node;
    const Interpolation::Result result =
        in.values_at(at, values, Method::nearest, Interpolation::Outside::missing);
    EXPECT_EQ(result.outside, 0u);
    for (std::size_t i = 0; i < at.size(); ++i) {
      const auto node = static_cast<std::size_t>(found[i]) - 1;
      const auto distance = [&](const Point& p) {
        return arc_length(pstripack::direction_of(p), pstripack::direction_of(at[i]));
      };
      double least = 4;
      for (const Point& p : nodes) least = std::min(least, distance(p));
      EXPECT_NEAR(distance(nodes[node]), least, 1e-15) << family;
      EXPECT_EQ(in.nearest(at[i], 100), found[i]) << family;
      EXPECT_EQ(result.values[i], values[node]);
    }
  }
}

TEST(weights, give_the_values_in_all_their_bits) {
  for (const char* const family : {"random", "cap", "latlon"})
    for (const Method method : {Method::linear, Method::natural, Method::cubic, Method::nearest})
      for (const auto outside : {Interpolation::Outside::missing, Interpolation::Outside::nearest}) {
        const double rounding = method == Method::cubic ? 1e-12 : 0;
        const Points nodes = point_sets::make(family, 300);
        const std::vector<double> values = random_values(nodes.size());
        const Interpolation in = interpolation_between(nodes);
        const Points at = places(1500, 9);
        const Interpolation::Result result = in.values_at(at, values, method, outside);
        const files::Weights weights = in.weights_at(at, method, outside);
        ASSERT_EQ(weights.begin.size(), at.size() + 1);
        EXPECT_EQ(weights.outside, result.outside);
        for (std::size_t i = 0; i < at.size(); ++i) {
          double sum = weights.begin[i] == weights.begin[i + 1] ? std::nan("") : 0;
          for (std::size_t k = weights.begin[i]; k < weights.begin[i + 1]; ++k)
            sum += weights.part[k] * values[static_cast<std::size_t>(weights.node[k]) - 1];
          EXPECT_TRUE(std::fabs(sum - result.values[i]) <= rounding ||
                      (std::isnan(sum) && std::isnan(result.values[i])))
              << family << " " << i;
        }
      }
}

TEST(nearest, is_found_across_the_far_side_of_a_region) {
  // The region's border is far north at longitudes 90 and 270: a descent from longitude 180 ends there, and
  // the nearest node is not on the border.
  Points nodes;
  for (const auto& [lon, lat] :
       {std::pair(-10.0, 10.0), std::pair(10.0, 10.0), std::pair(0.0, 10.2), std::pair(90.0, 50.0),
        std::pair(180.0, 10.0), std::pair(270.0, 50.0), std::pair(30.0, 80.0)})
    nodes.push_back(point_sets::from_degrees(lon, lat));
  const Interpolation in = interpolation_between(nodes);
  for (std::int32_t near = 1; near <= 7; ++near)
    EXPECT_EQ(in.nearest(point_sets::from_degrees(0, -60), near), 3);
}

#ifdef _OPENMP
TEST(memory, that_runs_out_on_threads_is_an_exception) {
  omp_set_num_threads(2);
  const files::Mesh mesh = files::triangulate(point_sets::make("random", 2500));
  const Interpolation in = interpolation_between(point_sets::make("random", 2500));
  const Points at = places(2500, 3);
  const std::vector<double> values = random_values(2500);
  const std::function<void()> each[] = {
      [&] { quality_of(mesh); },
      [&] { in.values_at(at, values, Method::cubic, Interpolation::Outside::nearest); },
      [&] { in.weights_at(at, Method::natural, Interpolation::Outside::nearest); }};
  for (const auto& work : each) {
    bool failed = true;
    for (long which = 1; failed; which += 1 + which / 16) {
      const FailingAllocation memory(which, true);
      try {
        work();
      } catch (const std::exception&) {  // std::bad_alloc; of ranks AgreedFailure
      }
      failed = FailingAllocation::happened();
    }
  }
}
#endif

}  // namespace
}  // namespace methods
