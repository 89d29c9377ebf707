#include "files/map_rings.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <numeric>
#include <string>
#include <utility>

#include "error_of.h"
#include "files/clipping.h"
#include "files/measures.h"
#include "point_sets.h"

namespace files {
namespace {

using Points = std::vector<Point>;

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

Faces cells_of(const Mesh& mesh) { return voronoi_faces(mesh); }

double sum(const std::vector<double>& values) { return std::accumulate(values.begin(), values.end(), 0.0); }

using Place = std::pair<double, double>;  // longitude, latitude

/// Sides of polygons without the same side, reversed, of another polygon. Those along a pole are left out,
/// and the dateline's two meridians are one.
std::vector<std::pair<Place, Place>> sides_without_partner(const std::vector<std::vector<MapRing>>& maps) {
  std::map<std::pair<Place, Place>, int> sides;
  for (const std::vector<MapRing>& rings : maps)
    for (const MapRing& ring : rings)
      for (std::size_t i = 0; i < ring.size(); ++i) {
        const MapCorner &p = ring[i], &q = ring[(i + 1) % ring.size()];
        if (p.lat == q.lat && std::fabs(p.lat) == 90) continue;
        const bool dateline = std::fabs(p.x()) == 180 && p.x() == q.x();
        const auto place = [&](const MapCorner& c) { return Place(dateline ? 180 : c.x(), c.lat); };
        ++sides[{place(p), place(q)}];
      }
  std::vector<std::pair<Place, Place>> alone;
  for (const auto& [side, times] : sides) {
    const auto partner = sides.find({side.second, side.first});
    if (times != 1 || partner == sides.end() || partner->second != 1) alone.push_back(side);
  }
  return alone;
}

/// The faces with a polygon that holds the place, in increasing order.
std::vector<std::size_t> faces_at(const std::vector<std::vector<MapRing>>& maps, double lon, double lat) {
  std::vector<std::size_t> found;
  for (std::size_t f = 0; f < maps.size(); ++f)
    for (const MapRing& ring : maps[f])
      if (holds(ring, lon, lat)) found.push_back(f);
  return found;
}

std::vector<std::vector<MapRing>> maps_of(const Faces& faces) {
  const MapLines lines(faces);
  std::vector<std::vector<MapRing>> maps;
  for (std::size_t f = 0; f < faces.size(); ++f) maps.push_back(lines.polygons(f));
  return maps;
}

/// Each side once each way: an arc has the same bits in the polygons on both sides. `is_inside(place)`: the
/// faces cover the surroundings of the place.
void expect_topology(
    const Faces& faces, const std::string& what,
    const std::function<bool(const Place&)>& is_inside = [](const Place&) { return true; }) {
  std::size_t alone = 0;
  for (const auto& [from, to] : sides_without_partner(maps_of(faces)))
    alone += is_inside(from) || is_inside(to);
  EXPECT_EQ(alone, 0u) << what;
}

// Overlaps, gaps, clockwise polygons, wrong cuts and missing poles would change the area.
void expect_cover(const Faces& faces, const std::string& what) {
  expect_topology(faces, what);
  double area = 0;
  for (const std::vector<MapRing>& rings : maps_of(faces))
    for (const MapRing& ring : rings) {
      EXPECT_GT(area_on_map(ring), 0) << what;
      area += area_on_map(ring);
      for (const MapCorner& c : ring) EXPECT_TRUE(std::fabs(c.x()) <= 180 && std::fabs(c.lat) <= 90);
    }
  EXPECT_NEAR(area, 360 * 180, 1e-7) << what;
}

void expect_cover_of_mesh(const Mesh& mesh, const std::string& what) {
  expect_cover(cells_of(mesh), what);
  if (!mesh.has_boundary()) expect_cover(triangle_faces(mesh), what);
}

Points read_nodes(const char* file) { return read(std::string(TEST_DATA_DIR "/") + file).points; }

/// Nodes in pairs `apart` radians apart, at random places, near the poles and near the dateline, and others
/// far away.
Points pairs(double apart, std::uint64_t seed) {
  point_sets::Random random(seed);
  Points points;
  for (int k = 0; k < 6; ++k) points.push_back(random.direction());
  for (const Place& place : {Place(random.uniform(-180, 180), random.uniform(-80, 80)),
                             Place(random.uniform(-180, 180), 90 - apart * random.uniform(0, 40)),
                             Place(random.uniform(-180, 180), apart * random.uniform(0, 40) - 90),
                             Place(180 + apart * random.uniform(-40, 40), random.uniform(-80, 80))}) {
    const Point p = point_sets::from_degrees(place.first, place.second), to = random.direction();
    const Point side = point_sets::normalized(cross(p, to));
    points.push_back(p);
    points.push_back(
        point_sets::normalized({p.x + apart * side.x, p.y + apart * side.y, p.z + apart * side.z}));
  }
  return points;
}

/// The chord between c and the nearest point of the arc from a to b. Computed from differences, so that small
/// distances keep their digits.
double distance_to_arc(const Point& c, const Point& a, const Point& b) {
  const Point n = cross(a, minus(b, a)), from_a = minus(c, a), from_b = minus(c, b);
  const bool is_beside = dot(cross(n, a), from_a) >= 0 && dot(cross(n, b), from_b) <= 0;
  return is_beside ? std::fabs(dot(n, from_a)) / length(n) : std::min(length(from_a), length(from_b));
}

TEST(map, is_covered_once_and_has_each_side_once_each_way) {
  expect_cover_of_mesh(triangulate(read_nodes("stations_111_m_apart.csv")), "three stations");
  expect_cover_of_mesh(triangulate(read_nodes("stations_2_m_apart.csv")), "two stations");
  for (const char* const family : {"random", "latlon", "reduced-gaussian", "icosahedral", "cubed-sphere",
                                   "healpix", "fibonacci", "clusters:1e-3", "dense-cap:1e-5", "variable:1e4",
                                   "pairs:1e-6", "spiral:20", "rounded:3", "cap", "ring"})
    for (const std::size_t n : {12u, 100u})
      expect_cover_of_mesh(triangulate(point_sets::make(family, n)), fmt::format("{} {}", family, n));
  for (const double metres : {0.1, 1.0, 10.0, 1e2, 1e3, 1e4, 1e5})
    for (const std::uint64_t seed : {1u, 2u}) {
      const Mesh mesh = triangulate(pairs(metres / 6371e3, seed));
      const std::string what = fmt::format("pairs {} m apart, {}", metres, seed);
      expect_topology(cells_of(mesh), what);
      if (metres >= 100) expect_topology(triangle_faces(mesh), what);
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
    for (const MapRing& part : cut_at_dateline(unrolled(corners, -180))) {
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
  const MapLines lines(cells);
  std::map<std::pair<double, double>, int> met;
  for (std::size_t f = 0; f < cells.size(); ++f)
    for (const MapRing& ring : lines.polygons(f))
      for (std::size_t i = 0; i < ring.size(); ++i) {
        ++met[{ring[i].x(), ring[i].lat}];
        const MapCorner &p = ring[i], &q = ring[(i + 1) % ring.size()];
        const Point normal = cross(p.p, q.p);
        if (length(normal) < 1e-12) continue;  // along a pole
        for (const double t : {0.1, 0.3, 0.5, 0.7, 0.9}) {
          const Point on_line =
              point_sets::from_degrees(p.x() + t * (q.x() - p.x()), p.lat + t * (q.lat - p.lat));
          EXPECT_LE(std::fabs(dot(on_line, normal)) / length(normal),
                    std::min(0.0011 / kRadian, 0.011 * length(minus(q.p, p.p))));
        }
      }
  for (const auto& [place, times] : met) {
    if (std::fabs(place.first) < 180) {
      EXPECT_GE(times, 2) << place.first << ' ' << place.second;
    }
  }
}

const std::vector<Region> kRegions{{170, 190, 25, 50},      {-180, 180, -60, 60},  {0, 360, -90, 90},
                                   {0, 360, 60, 90},        {-180, 180, -90, -88}, {-180, 180, -90, 85},
                                   {350, 370, -90, 90},     {100, 260, -70, 80},   {0, 300, -90, 90},
                                   {0, 180, -90, 90},       {0, 359, 10, 90},      {90, 100, 89, 90},
                                   {30, 30.001, 40, 40.001}};

TEST(cells, of_a_region_and_of_the_hull_have_each_side_once_each_way) {
  Points points;
  for (const double metres : {10.0, 1e3}) {
    const Faces all = cells_of(triangulate(pairs(metres / 6371e3, 3)));
    for (const Region& r : kRegions)
      expect_topology(clipped_to_polygons(all, {region_of_box(r)}),
                      fmt::format("{} m apart, {}", metres, r.west), [&](const Place& place) {
                        const double width = r.east - r.west, lon = place.first - r.west,
                                     from_west = lon - 360 * std::floor(lon / 360);
                        return place.second > r.south + 2e-3 && place.second < r.north - 2e-3 &&
                               (width == 360 || (from_west > 1e-9 && from_west < width - 1e-9));
                      });
  }
  for (const char* const family : {"cap", "cap:0.01", "hemisphere"})
    for (const double apart : {1e-7, 1e-4}) {
      points = point_sets::make(family, 12);
      for (std::size_t i = 0; i < 4; ++i) {
        const Point &p = points[i], side = point_sets::normalized(cross(p, points[i + 4]));
        points.push_back(
            point_sets::normalized({p.x + apart * side.x, p.y + apart * side.y, p.z + apart * side.z}));
      }
      const Mesh mesh = triangulate(points);
      const Faces triangles = triangle_faces(mesh);
      std::map<std::pair<std::int32_t, std::int32_t>, int> hull;
      for (std::size_t k = 0; k < triangles.corner.size(); ++k)
        ++hull[{triangles.corner[k], triangles.corner[k % 3 == 2 ? k - 2 : k + 1]}];
      expect_topology(clipped_to_hull(cells_of(mesh), mesh), fmt::format("{} {}", family, apart),
                      [&](const Place& place) {
                        const Point p = point_sets::from_degrees(place.first, place.second);
                        return std::none_of(hull.begin(), hull.end(), [&](const auto& side) {
                          const auto [a, b] = side.first;
                          return hull.count({b, a}) == 0 &&
                                 distance_to_arc(p, mesh.points[static_cast<std::size_t>(a) - 1],
                                                 mesh.points[static_cast<std::size_t>(b) - 1]) < 2e-5;
                        });
                      });
    }
}

TEST(cells, are_several_pieces_where_a_region_cuts_them_so) {
  const Mesh mesh = triangulate(point_sets::make("icosahedral", 12));
  const Faces cells = clipped_to_polygons(cells_of(mesh), {region_of_box({0, 359, -90, 90})});
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

using LonLats = std::vector<std::pair<double, double>>;
LonLats box(double west, double east, double south, double north) {
  return {{west, south}, {east, south}, {east, north}, {west, north}, {west, south}};
}
/// A ring with bays, its corners so close that its sides are arcs as they are.
LonLats with_bays(double lon, double lat, double radius) {
  LonLats ring;
  constexpr int kCorners = 800;
  for (int k = 0; k < kCorners; ++k) {
    const double t = 8 * std::atan(1.0) * k / kCorners, r = radius * (1 + 0.4 * std::sin(5 * t));
    ring.emplace_back(lon + r * std::cos(t), lat + r * std::sin(t));
  }
  ring.push_back(ring[0]);
  return ring;
}

/// The area within straight lines of the map: the integral of sin(lat) over the longitude.
double area_within(const LonLats& ring) {
  double sum = 0;
  for (std::size_t i = 0; i + 1 < ring.size(); ++i) {
    const double y = (ring[i].second + ring[i + 1].second) / 2 / kRadian,
                 half = (ring[i + 1].second - ring[i].second) / 2 / kRadian;
    sum -=
        (ring[i + 1].first - ring[i].first) / kRadian * std::sin(y) * (half == 0 ? 1 : std::sin(half) / half);
  }
  return std::fabs(sum);
}
double area_within(const MapRegion& region) {
  double area = 2 * area_within(region.rings[0]);
  for (const LonLats& ring : region.rings) area -= area_within(ring);
  return area;
}

MapRegion region(std::vector<LonLats> rings) { return {1, "", std::move(rings)}; }
LonLats closed(LonLats ring) {
  ring.push_back(ring[0]);
  return ring;
}

TEST(cells, fill_polygons_once) {
  const MapRegion bays = region({with_bays(178, 30, 12), with_bays(174, 31, 2), with_bays(181, 29, 1)});
  LonLats clockwise = box(0, 90, 0, 90);
  std::reverse(clockwise.begin(), clockwise.end());
  std::vector<MapRegion> polygons{
      bays, region({clockwise}), region({box(0, 360, -90, 90), bays.rings[0]}),
      region({with_bays(10, 20, 1e-3)}),
      // Sides that no great circle is near to.
      region({closed({{0, 0}, {60, 45}, {0, 45}})}), region({closed({{0, 60}, {90, 60}, {45, 90}})}),
      region({closed({{10, 45}, {11, 75}, {9, 75}})}),
      region({closed({{170, -80}, {300, 70}, {190, 85}, {200, 0}}), box(205, 206, 30, 31)}),
      region({closed({{8, 47}, {8.3, 47.1}, {8.2, 47.3}, {8.1, 47.15}})})};
  for (const Region& box : kRegions) polygons.push_back(region_of_box(box));
  std::map<const MapRegion*, double> area;
  for (const MapRegion& polygon : polygons) area[&polygon] = area_within(polygon);
  for (const char* const family :
       {"random", "latlon", "icosahedral", "healpix", "cap", "hemisphere", "strip"})
    for (const std::size_t n : {3u, 300u}) {
      const Faces all = cells_of(triangulate(point_sets::make(family, n)));
      for (const MapRegion& polygon : polygons) {
        const Faces cells = clipped_to_polygons(all, {polygon});
        EXPECT_NEAR(sum(areas(cells)) / area[&polygon], 1, 1e-4)
            << family << ' ' << n << ' ' << polygon.rings[0][0].first << ' ' << polygon.rings[0][0].second;
        EXPECT_GT(*std::min_element(cells.area.begin(), cells.area.end()), 0) << family << ' ' << n;
      }
      const Faces two = clipped_to_polygons(all, {bays, polygons[1]});
      EXPECT_NEAR(sum(areas(two)), area[&polygons[0]] + area[&polygons[1]], 1e-6) << family << ' ' << n;
    }
}

// The part of a cell around each place, and no other.
TEST(cells, of_polygons_are_those_of_the_nearest_nodes) {
  Points around_hole;
  for (const auto& [lon, lat] : {Place(0, 50.5), {0, 49.5}, {2, 53}, {-120, 0}, {120, 0}, {0, -80}})
    around_hole.push_back(point_sets::from_degrees(lon, lat));
  point_sets::Random random(5);
  for (const auto& [points, polygon] :
       {std::pair(around_hole, region({box(-2, 2, 49, 51), box(-0.5, 0.7, 49.3, 49.9)})),
        {around_hole, region({box(-2, 2, 49, 51), box(-0.5, 0.7, 49.3, 49.6), box(-1.5, 1.7, 49.61, 49.7),
                              box(1, 1.5, 50.1, 50.9)})},
        {point_sets::make("random", 200), region({with_bays(178, 30, 12), with_bays(174, 31, 2)})}}) {
    const Faces cells = clipped_to_polygons(cells_of(triangulate(points)), {polygon});
    const auto maps = maps_of(cells);
    for (int k = 0; k < 2000; ++k) {
      const double lon = polygon.rings[0][0].first + random.uniform(-13, 13) * (points.size() > 10 ? 2 : 0.4),
                   lat =
                       polygon.rings[0][0].second + random.uniform(-13, 13) * (points.size() > 10 ? 1 : 0.2);
      const Point p = point_sets::from_degrees(lon, lat);
      const bool is_inside = polygon.contains(p);
      const auto nearest =
          std::max_element(points.begin(), points.end(),
                           [&](const Point& a, const Point& b) { return dot(a, p) < dot(b, p); });
      const auto found = faces_at(maps, wrapped(lon), lat);
      ASSERT_EQ(found.size(), is_inside ? 1u : 0u) << lon << ' ' << lat;
      if (is_inside) {
        EXPECT_EQ(cells.node_of(found[0]), static_cast<std::size_t>(nearest - points.begin()));
      }
    }
  }
}

// Plots of centimetres to kilometres, and nodes as near as rounding lets them be.
TEST(cells, of_polygons_have_the_areas_of_their_plots_at_every_scale) {
  for (const double metres : {0.05, 0.2, 10.0, 1e3}) {
    const double lat = 47.3, step = metres / 111195, wide = step / point_sets::cos_degrees(lat);
    Points points;
    for (int k = 0; k < 9; ++k)
      points.push_back(point_sets::from_degrees(8.55 + (k % 3 - 1) * wide, lat + (k / 3 - 1) * step));
    const Faces cells = clipped_to_polygons(
        cells_of(triangulate(points)),
        {region({box(8.55 - 1.5 * wide, 8.55 + 1.5 * wide, lat - 1.5 * step, lat + 1.5 * step)})});
    ASSERT_EQ(cells.size(), 9u);
    for (const double area : cells.area)
      EXPECT_NEAR(area * std::pow(kRadian / step, 2), 1, 1e-9 + 1e-6 / metres + metres / 1e6) << metres;
  }
  const Mesh two =
      triangulate({point_sets::from_degrees(10, 47), point_sets::from_degrees(10.0000000000001, 47),
                   point_sets::from_degrees(100, 0), point_sets::from_degrees(-100, 10)});
  const Faces halves = clipped_to_polygons(cells_of(two), {region({box(0, 20, 37, 57)})});
  ASSERT_EQ(halves.size(), 2u);
  EXPECT_NEAR(halves.area[0] / halves.area[1], 1, 1e-4);
}

TEST(cells, of_a_polygon_whose_rings_cross_are_refused_by_its_sides) {
  const Faces cells = cells_of(triangulate(point_sets::make("random", 100)));
  const auto refusal = [&](const std::vector<LonLats>& rings) {
    return error_of([&] { clipped_to_polygons(cells, {region(rings)}); });
  };
  EXPECT_EQ(refusal({closed({{0, 10}, {10, 40}, {20, 10}, {-5, 30}, {25, 30}})}),
            "feature 1: side 1 from 0,10 to 10,40 crosses or lies on side 3 from 20,10 to -5,30: mend the "
            "polygon, say by ogr2ogr -makevalid");
  EXPECT_EQ(refusal({box(0, 10, 0, 10), box(5, 15, 5, 6)}),
            "feature 1: side 2 of ring 1 from 10,0 to 10,10 crosses or lies on side 1 of ring 2 from 5,5 "
            "to 15,5: mend the polygon, say by ogr2ogr -makevalid");
  for (const std::vector<LonLats>& rings : std::vector<std::vector<LonLats>>{
           {closed({{0, 0}, {1, 1}, {2, 2}, {2, 0}, {1, 1}, {0, 2}})},                // crosses at a corner
           {closed({{0, 0}, {10, 0}, {10, 10}, {5, 10}, {5, 5}, {5, 10}, {0, 10}})},  // a slit
           {box(0, 10, 0, 10), box(20, 30, 0, 10)},                 // a hole beside the polygon
           {box(0, 10, 0, 10), box(2, 8, 2, 8), box(3, 7, 3, 7)},   // a hole in a hole
           {box(0, 10, 0, 10), box(2, 8, 2, 8), box(2, 8, 2, 8)}})  // the same hole twice
    EXPECT_NE(refusal(rings).find("mend the polygon"), std::string::npos) << refusal(rings);
  // Rings may touch in a corner.
  EXPECT_EQ(refusal({box(0, 10, 0, 10), closed({{0, 5}, {3, 4}, {3, 6}}), closed({{3, 4}, {6, 4}, {6, 3}})}),
            "none");
}

// Sides along the borders of cells: whole cells, and no slivers.
TEST(cells, of_a_polygon_along_their_borders_are_whole) {
  Points points;
  for (double lon = -29.5; lon < 30; ++lon)
    for (double lat = -9.5; lat < 10; ++lat) points.push_back(point_sets::from_degrees(lon, lat));
  const Faces cells = clipped_to_polygons(cells_of(triangulate(points)), {region({box(-10, 10, -4.5, 0)})});
  EXPECT_EQ(cells.size(), 20u * 5);
  std::size_t alone = 0;
  for (const auto& [from, to] : sides_without_partner(maps_of(cells)))
    alone += std::fabs(from.first) < 10 - 1e-9 && from.second > -4.499 && from.second < -1e-9;
  EXPECT_EQ(alone, 0u);
}

TEST(cells, of_nodes_on_one_circle_are_lunes_with_corners_in_the_middle_of_their_sides) {
  const Mesh mesh = triangulate(
      {point_sets::from_degrees(0, 10), point_sets::from_degrees(20, 10), point_sets::from_degrees(10, 30)});
  const Faces cells = cells_of(mesh);
  const MapLines lines(cells);
  for (std::size_t f = 0; f < 3; ++f) {
    for (const MapRing& ring : lines.polygons(f)) EXPECT_GT(area_on_map(ring), 0);
  }
  // Close to a great circle: sides between neighbours anywhere are half turns.
  for (const char* const family : {"strip", "ellipse"})
    EXPECT_NEAR(sum(areas(cells_of(triangulate(point_sets::make(family, 10))))) / (16 * std::atan(1.0)), 1,
                1e-9)
        << family;
}

}  // namespace
}  // namespace files
