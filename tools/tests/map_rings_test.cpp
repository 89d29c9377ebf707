#include "files/map_rings.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <string>
#include <utility>

#include "files/clipping.h"
#include "point_sets.h"

namespace files {
namespace {

using Points = std::vector<Point>;
constexpr double kDegree = 57.295779513082321;

double area_on_map(const MapRing& ring) {
  double sum = 0;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const MapCorner &p = ring[i], &q = ring[(i + 1) % ring.size()];
    sum += p.x() * q.lat - q.x() * p.lat;
  }
  return sum / 2;
}

bool holds(const MapRing& ring, double x, double y) {
  bool inside = false;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const MapCorner &p = ring[i], &q = ring[(i + 1) % ring.size()];
    if ((p.lat > y) != (q.lat > y) && x < p.x() + (y - p.lat) / (q.lat - p.lat) * (q.x() - p.x()))
      inside = !inside;
  }
  return inside;
}

/// A face's parts on the map from -180 to 180.
std::vector<MapRing> map_of(const Faces& faces, std::size_t f) {
  const MapRing ring = ring_of(faces, f, angles_of(faces.points, faces.given_points, true));
  std::vector<MapRing> parts;
  for (const MapRing& part : between_meridians(unrolled(ring, -180), -180, 360))
    parts.push_back(with_straight_lines(part));
  return parts;
}

Faces cells_of(const Mesh& mesh) {
  Faces cells = voronoi_faces(mesh);
  divide_half_turns(cells, mesh);
  return cells;
}

double sum(const std::vector<double>& values) { return std::accumulate(values.begin(), values.end(), 0.0); }

// Overlaps, gaps, clockwise polygons, wrong cuts and missing poles would change the area.
TEST(map, is_covered_once_by_triangles_and_by_cells) {
  for (const char* const family : {"random", "latlon", "icosahedral", "cubed-sphere", "healpix", "fibonacci"})
    for (const std::size_t n : {30u, 200u}) {
      const Mesh mesh = triangulate(point_sets::make(family, n));
      for (const Faces& faces : {triangle_faces(mesh), cells_of(mesh)}) {
        double area = 0;
        for (std::size_t f = 0; f < faces.size(); ++f)
          for (const MapRing& ring : map_of(faces, f)) {
            EXPECT_GT(area_on_map(ring), 0) << family << ' ' << f;
            area += area_on_map(ring);
            for (const MapCorner& c : ring) EXPECT_TRUE(std::fabs(c.x()) <= 180 && std::fabs(c.lat) <= 90);
          }
        EXPECT_NEAR(area, 360 * 180, 1e-7) << family << ' ' << n;
      }
    }
}

TEST(map, has_a_pole_where_it_is_inside_a_corner_or_on_a_side) {
  const auto ring = [](const std::vector<std::pair<double, double>>& corners) {
    MapRing all;
    for (const auto& [lon, lat] : corners) all.push_back({point_sets::from_degrees(lon, lat), lon, lat});
    return all;
  };
  const auto area = [&](const MapRing& corners) {
    double all = 0;
    for (const MapRing& part : between_meridians(unrolled(corners, -180), -180, 360)) {
      EXPECT_LE(std::max_element(part.begin(), part.end(),
                                 [](const auto& a, const auto& b) { return a.lat < b.lat; })
                    ->lat,
                90);
      all += area_on_map(part);
    }
    return all;
  };
  // Straight on the map: meridians, the equator, and the pole.
  EXPECT_NEAR(area(ring({{-120, 0}, {-30, 0}, {60, 0}, {150, 0}})), 360 * 90, 1e-10);  // inside
  EXPECT_NEAR(area(ring({{-150, 0}, {120, 0}, {30, 0}, {-60, 0}})), 360 * 90, 1e-10);  // the south pole
  EXPECT_NEAR(area(ring({{100, 0}, {-170, 0}, {0, 90}})), 90 * 90, 1e-10);             // a corner
  EXPECT_NEAR(area(ring({{-170, 0}, {100, 0}, {0, -90}})), 90 * 90, 1e-10);            // the south pole
  EXPECT_NEAR(area(ring({{100, 0}, {-170, 0}, {-80, 50}, {100, 50}})), 180 * 90 - 90 * 25,
              1e-10);  // on a side
  EXPECT_NEAR(area(ring({{0, 0}, {150, 0}, {-80, 0}, {-80, 90}})), 280 * 90,
              1e-10);  // a corner of 280 degrees
  // Corners that are at the pole up to rounding count as the pole, whatever their longitude.
  MapRing rounded = ring({{100, 0}, {-170, 0}, {20, 90}, {-70, 90}});
  rounded[2].p = {-1e-16, 2e-17, 1}, rounded[3].p = {3e-17, 1e-16, 1};
  EXPECT_NEAR(area(rounded), 90 * 90, 1e-10);
  EXPECT_TRUE(unrolled(ring({{10, 0}, {10, 1e-12}, {10, 2e-12}}), -180).empty());
  // A polygon on one arc has an empty map, also if the arc crosses a pole.
  EXPECT_TRUE(unrolled(ring({{30, -60}, {30, -75}, {0, -90}}), -180).empty());
  EXPECT_TRUE(unrolled(ring({{85, 45}, {0, 90}, {-95, 0}}), -180).empty());
}

TEST(map, has_straight_lines_close_to_arcs_and_the_same_on_both_sides_of_an_arc) {
  const Mesh mesh = triangulate(point_sets::make("random", 50));
  const Faces cells = cells_of(mesh);
  std::map<std::pair<double, double>, int> met;
  for (std::size_t f = 0; f < cells.size(); ++f)
    for (const MapRing& ring : map_of(cells, f))
      for (std::size_t i = 0; i < ring.size(); ++i) {
        ++met[{ring[i].x(), ring[i].lat}];
        const MapCorner &p = ring[i], &q = ring[(i + 1) % ring.size()];
        const Point normal = cross(p.p, q.p);
        if (p.straight) continue;
        for (const double t : {0.1, 0.3, 0.5, 0.7, 0.9}) {
          const Point on_line =
              point_sets::from_degrees(p.x() + t * (q.x() - p.x()), p.lat + t * (q.lat - p.lat));
          EXPECT_LE(std::fabs(dot(on_line, normal)) / std::sqrt(dot(normal, normal)), 0.0011 / kDegree);
        }
      }
  for (const auto& [place, times] : met) {
    if (std::fabs(place.first) < 180) {
      EXPECT_GE(times, 2) << place.first << ' ' << place.second;
    }
  }
}

struct Case {
  Region region;
  const char* what;
};
const std::vector<Case> kRegions{{{170, 190, 25, 50}, "across the dateline"},
                                 {{-180, 180, -60, 60}, "a belt"},
                                 {{0, 360, -90, 90}, "the sphere"},
                                 {{0, 360, 60, 90}, "a cap"},
                                 {{-180, 180, -90, -88}, "a small cap"},
                                 {{-180, 180, -90, 85}, "all but a cap"},
                                 {{350, 370, -90, 90}, "from pole to pole"},
                                 {{100, 260, -70, 80}, "wide"},
                                 {{0, 300, -90, 90}, "wider than half"},
                                 {{0, 180, -90, 90}, "half"},
                                 {{0, 359, 10, 90}, "all but a slit"},
                                 {{90, 100, 89, 90}, "at a pole"},
                                 {{30, 30.001, 40, 40.001}, "within one cell"}};

TEST(cells, fill_a_region_once) {
  for (const char* const family : {"random", "latlon", "icosahedral", "cubed-sphere", "cap", "hemisphere"})
    for (const std::size_t n : {6u, 300u}) {
      const Faces all = cells_of(triangulate(point_sets::make(family, n)));
      for (const auto& [region, what] : kRegions) {
        const double width = region.east - region.west, height = region.north - region.south;
        const double area =
            width / kDegree * (point_sets::sin_degrees(region.north) - point_sets::sin_degrees(region.south));
        const Faces cells = clipped_to_region(all, region);
        EXPECT_NEAR(sum(areas(cells)), area, 2e-5 * std::sqrt(area)) << family << ' ' << what;
        double on_map = 0;
        for (std::size_t f = 0; f < cells.size(); ++f)
          for (const MapRing& ring : map_of(cells, f)) on_map += area_on_map(ring);
        // Where a cell was halved, its lines pass the corner of a neighbour at up to 0.001 degrees.
        EXPECT_NEAR(on_map, width * height, 0.001 * std::min(height, 50.0))
            << family << ' ' << n << ' ' << what;
        for (std::size_t i = 0; i < cells.points.size(); ++i) {
          const double lon = cells.given_points.lon[i], lat = cells.given_points.lat[i];
          EXPECT_TRUE(lat >= region.south && lat <= region.north && std::fabs(lon) <= 180) << what;
          const double from_west = lon - region.west - 360 * std::floor((lon - region.west) / 360);
          EXPECT_TRUE(from_west <= width + 1e-9 || from_west >= 360 - 1e-9 || std::fabs(lat) == 90)
              << what << ' ' << lon << ' ' << lat;
        }
      }
    }
}

// Past failure: the part of a cell between one arc and the parallel, with a corner on the parallel.
TEST(cells, fill_a_region_whose_parallel_leads_through_a_corner) {
  Points points;
  for (const auto& [lon, lat] : {std::pair(130, 0), {0, 90}, {175, 45}, {40, -45}, {-140, 45}})
    points.push_back(point_sets::from_degrees(lon, lat));
  const Faces cells = clipped_to_region(cells_of(triangulate(points)), {-90, 270, -90, -45});
  EXPECT_NEAR(sum(areas(cells)), 360 / kDegree * (1 - std::sqrt(0.5)), 2e-5);
}

TEST(cells, of_a_region_are_those_of_the_nearest_nodes) {
  const Mesh mesh = triangulate(point_sets::make("random", 40));
  const Faces all = cells_of(mesh);
  point_sets::Random random(5);
  for (const auto& [region, what] : kRegions) {
    const Faces cells = clipped_to_region(all, region);
    std::vector<std::vector<MapRing>> maps;
    for (std::size_t f = 0; f < cells.size(); ++f) maps.push_back(map_of(cells, f));
    for (int k = 0; k < 100; ++k) {
      const double lon = wrapped(random.uniform(region.west, region.east)),
                   lat = random.uniform(region.south, region.north);
      const Point p = point_sets::from_degrees(lon, lat);
      std::vector<double> near;
      for (const Point& node : mesh.points) near.push_back(dot(node, p));
      std::vector<double> sorted = near;
      std::sort(sorted.rbegin(), sorted.rend());
      if (sorted[0] - sorted[1] < 1e-4)
        continue;  // too close to the border: straight lines are not exactly arcs
      std::vector<std::size_t> found;
      for (std::size_t f = 0; f < cells.size(); ++f)
        for (const MapRing& ring : maps[f])
          if (holds(ring, lon, lat)) found.push_back(cells.node_of(f));
      ASSERT_EQ(found.size(), 1u) << what << ' ' << lon << ' ' << lat;
      EXPECT_EQ(near[found[0]], sorted[0]) << what;
    }
  }
}

TEST(cells, are_several_pieces_where_a_region_cuts_them_so) {
  const Mesh mesh = triangulate(point_sets::make("icosahedral", 12));
  const Faces cells = clipped_to_region(cells_of(mesh), {0, 359, -90, 90});
  EXPECT_GT(cells.size(), 12u);
  Faces with_columns = cells;
  Mesh numbered = mesh;
  numbered.columns = {whole_numbers("node", "", {1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12})};
  numbered.given = LonLat(mesh.points, true);
  add_columns(with_columns, numbered);
  const Column& node = *find(with_columns.columns_of_faces, "node");
  ASSERT_EQ(node.size(), cells.size());
  ASSERT_EQ(with_columns.given_centres.lon.size(), cells.size());
  for (std::size_t f = 0; f < cells.size(); ++f) {
    EXPECT_EQ(node.numbers[f], static_cast<double>(cells.node_of(f) + 1));
    EXPECT_EQ(cells.centres[f], mesh.points[cells.node_of(f)]);
    EXPECT_EQ(with_columns.given_centres.lon[f], numbered.given.lon[cells.node_of(f)]);
  }
}

TEST(cells, fill_the_hull_of_their_nodes) {
  for (const char* const family : {"cap", "cap:0.01", "hemisphere"})
    for (const std::size_t n : {3u, 4u, 7u, 30u, 500u}) {
      const Mesh mesh = triangulate(point_sets::make(family, n));
      const Faces all = cells_of(mesh), cells = clipped_to_hull(all, mesh);
      const double area = sum(areas(triangle_faces(mesh)));
      EXPECT_NEAR(sum(areas(cells)) / area, 1, 1e-9) << family << ' ' << n;
      EXPECT_NEAR(sum(areas(all)) / (16 * std::atan(1.0)), 1, 1e-12) << family << ' ' << n;
      EXPECT_EQ(cells.size(), n);
      // The corners of the hull are the nodes themselves, to the last bit.
      const auto is_corner = [&](const Point& p) {
        return std::find(cells.points.begin(), cells.points.end(), p) != cells.points.end();
      };
      if (n == 3) {
        for (const Point& p : cells.centres) EXPECT_TRUE(is_corner(p)) << family;
      }
    }
  const Mesh sphere = triangulate(point_sets::make("random", 50));
  EXPECT_EQ(clipped_to_hull(cells_of(sphere), sphere).corner, cells_of(sphere).corner);
}

TEST(cells, of_nodes_on_one_circle_are_lunes_with_corners_in_the_middle_of_their_sides) {
  const Mesh mesh = triangulate(
      {point_sets::from_degrees(0, 10), point_sets::from_degrees(20, 10), point_sets::from_degrees(10, 30)});
  const Faces cells = cells_of(mesh);
  for (std::size_t f = 0; f < 3; ++f) {
    EXPECT_NO_THROW(expect_no_half_turn(ring_of(cells, f, LonLat(cells.points, true)), cells, f));
    for (const MapRing& ring : map_of(cells, f)) EXPECT_GT(area_on_map(ring), 0);
  }
  EXPECT_THROW(clipped_to_region(voronoi_faces(mesh), {}), NoMesh);
  // Close to a great circle: sides between neighbours anywhere are half turns.
  for (const char* const family : {"strip", "ellipse"})
    EXPECT_NEAR(sum(areas(cells_of(triangulate(point_sets::make(family, 10))))) / (16 * std::atan(1.0)), 1,
                1e-9)
        << family;
}

}  // namespace
}  // namespace files
