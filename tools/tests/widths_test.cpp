// Widths of cells: their density, their number of cells, the limit of their gradient.

#include "methods/widths.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <tuple>
#include <vector>

#include "methods/quality.h"
#include "methods/regional_widths.h"
#include "point_sets.h"

namespace methods {
namespace {

using files::Point;

constexpr double kDegree = 0.017453292519943295;

std::vector<double> ticks(double first, double step, int count) {
  std::vector<double> values;
  for (int i = 0; i < count; ++i) values.push_back(first + i * step);
  return values;
}

template <class Value = float, class Width>
TableOf<Value> table(const files::Grid& grid, const Width& width) {
  std::vector<double> km;
  for (const double lat : grid.lat)
    for (const double lon : grid.lon) km.push_back(width(lon, lat));
  return table_of<Value>(grid, km);
}

/// Of a place in degrees.
double width_at(const Widths& widths, double lon, double lat) {
  return widths.least / std::sqrt(std::sqrt(widths.density->at(point_sets::from_degrees(lon, lat))));
}
double width_at(const GridValues<float>& widths, double lon, double lat) {
  const Point p = point_sets::from_degrees(lon, lat);
  double value = 0;
  widths.at(1, &p, &value);
  return value;
}
constexpr double km = 1 / 6371.0 / kDegree;  // in degrees

TEST(widths, give_their_density_and_number_of_cells) {
  // w = 60 (2 + z): the integral of 4 pi R^2 / (sqrt(3)/2 60^2) (1/2) int_-1^1 dz / (2 + z)^2, which is 1/3.
  const files::Grid grid{ticks(-180, 5, 73), ticks(-90, 0.5, 361)};
  const Widths widths =
      widths_of(table(grid, [](double, double lat) { return 60 * (2 + std::sin(lat * kDegree)); }), 6371);
  EXPECT_DOUBLE_EQ(widths.least, 60);
  EXPECT_NEAR(widths.cells / (cells_of_width(60, 6371) / 3), 1, 1e-5);
  EXPECT_DOUBLE_EQ(widths.density->at(point_sets::from_degrees(17, 0)), 0.0625);
  EXPECT_DOUBLE_EQ(widths.density->at(point_sets::from_degrees(17, -90)), 1);
}

TEST(grid_values, know_longitude_and_latitude) {
  const files::Grid grid{ticks(0, 5, 72), ticks(-90, 7.5, 25)};
  const GridValues lats(table<double>(grid, [](double, double lat) { return 100 + lat; })),
      lons(table<double>(grid, [](double lon, double) { return 100 + std::min(lon, 360 - lon); }));
  std::vector<Point> places = point_sets::make("random", 3000);
  for (const double lon : {0.0, 22.5, 45.0, 67.5, 90.0, 135.0, 180.0, 202.5, 270.0, 315.0})
    for (const double lat : {-90.0, -67.5, -1e-9, 0.0, 22.5, 45.0, 90.0})
      places.push_back(point_sets::from_degrees(lon, lat));
  std::vector<double> lat(places.size()), lon(places.size());
  lats.at(places.size(), places.data(), lat.data());
  lons.at(places.size(), places.data(), lon.data());
  for (std::size_t i = 0; i < places.size(); ++i) {
    const long double x = places[i].x, y = places[i].y, z = places[i].z, degree = std::acos(-1.0L) / 180;
    EXPECT_NEAR(lat[i] - 100, static_cast<double>(std::atan2(z, std::hypot(x, y)) / degree), 1e-13);
    if (std::hypot(x, y) == 0) continue;
    EXPECT_NEAR(lon[i] - 100, static_cast<double>(std::fabs(std::atan2(y, x)) / degree), 2e-13);
  }
}

TEST(grid_values, take_a_row_that_misses_the_pole_by_rounding_for_the_pole) {
  files::Grid grid{ticks(-180, 0.5, 721), {}};
  for (double lat = -90; lat < 90.05; lat += 0.1) grid.lat.push_back(lat);
  ASSERT_NE(grid.lat.back(), 90);
  const std::size_t rows = grid.lat.size();
  const Table t = table(grid, [](double, double) { return 60; });
  EXPECT_EQ(t.lat.size(), rows);
  EXPECT_EQ(t.lat.back(), 90);
}

/// The largest field below the given one that satisfies limit_gradient()'s condition: each place against all.
std::vector<double> limited(const Table& t, double gradient, double radius) {
  std::vector<Point> places;
  for (const double lat : t.lat)
    for (const double lon : t.lon) places.push_back(point_sets::from_degrees(lon, lat));
  std::vector<double> least(t.values.begin(), t.values.end());
  for (std::size_t i = 0; i < places.size(); ++i)
    for (std::size_t j = 0; j < places.size(); ++j) {
      const Point d = minus(places[i], places[j]);
      const double arc = 2 * std::asin(std::min(1.0, std::sqrt(dot(d, d)) / 2));
      least[i] = std::min(least[i], t.values[j] + gradient * radius * arc);
    }
  return least;
}

TEST(limit_gradient, is_the_condition_for_all_pairs_also_at_poles_and_across_the_first_meridian) {
  // Random widths, a step at an oblique circle, single narrow places at a pole, near it and at the meridian.
  point_sets::Random random(1);
  const auto at = [](double lon, double lat, double width) {
    return [=](double x, double y) { return x == lon && y == lat ? width : 400; };
  };
  const Point axis = point_sets::from_degrees(20, 60);
  const auto step = [&](double lon, double lat) {
    return dot(axis, point_sets::from_degrees(lon, lat)) > 0.9 ? 60 : 240;
  };
  const files::Grid with_poles{ticks(-180, 12, 31), ticks(-90, 7.5, 25)},
      between{ticks(0, 10, 36), ticks(-85, 10, 18)};
  for (const files::Grid& grid : {with_poles, between})
    for (const Table& t : {table(grid, [&](double, double) { return random.uniform(50, 500); }),
                           table(grid, step), table(grid, at(0, grid.lat.back(), 60)),
                           table(grid, at(36, -75, 60)), table(grid, at(-180, 15, 60))})
      for (const double gradient : {0.02, 0.1, 1.0}) {
        const std::vector<double> expected = limited(t, gradient, 6371);
        Table lowered = t;
        const Lowered told = limit_gradient(lowered, gradient, 6371);
        double most = 0;
        for (std::size_t i = 0; i < expected.size(); ++i) {
          EXPECT_GE(lowered.values[i], expected[i] * (1 - 1e-7));
          // Where cones meet, a place may keep one that is not the lowest.
          EXPECT_LE(lowered.values[i], expected[i] + gradient * 0.1 * 7.5 * kDegree * 6371);
          most = std::max<double>(most, t.values[i] - lowered.values[i]);
        }
        EXPECT_NEAR(told.most, most, 1e-4);
        EXPECT_EQ(told.places == 0, most == 0);
      }
}

TEST(limit_gradient, changes_nothing_that_is_flat_enough_and_says_what_it_changed) {
  const files::Grid grid{ticks(-180, 5, 73), ticks(-90, 5, 37)};
  const double spacing = 5 * kDegree * 6371;
  Table cone = table(grid, [&](double, double lat) { return 60 + 0.1999 * spacing * (lat + 90) / 5; });
  const std::vector<float> before = cone.values;
  EXPECT_EQ(limit_gradient(cone, 0.2, 6371).places, 0u);
  EXPECT_EQ(cone.values, before);
  Table peak = table(grid, [&](double lon, double lat) { return lon == 20 && lat == 0 ? 1000 : 100; });
  const Lowered lowered = limit_gradient(peak, 0.2, 6371);
  EXPECT_EQ(lowered.places, 1u);
  EXPECT_EQ(lowered.of, 72u * 35 + 2);
  EXPECT_NEAR(lowered.most, 900 - 0.2 * spacing, 1e-4);
  EXPECT_EQ(lowered.lon, 20);
  EXPECT_EQ(lowered.lat, 0);
}

TEST(widths_of_name, are_those_of_mpas_tools) {
  const Widths ec = widths_of(methods::widths_of_name("ec60to30"), 6371.22);
  EXPECT_NEAR(width_at(ec, 77, 0), 30.047244527610236, 1e-5);
  EXPECT_NEAR(width_at(ec, 77, -15), 35.13957616457637, 1e-5);
  EXPECT_NEAR(width_at(ec, 77, 73), 40.4976691150104, 1e-5);
  EXPECT_NEAR(ec.cells, 326958, 3);
  const Widths rrs = widths_of(methods::widths_of_name("rrs18to6"), 6371.22);
  EXPECT_NEAR(width_at(rrs, 77, 15), 16.671279447372207, 1e-5);
  EXPECT_NEAR(width_at(rrs, 77, -90), 6, 1e-5);
  EXPECT_NEAR(rrs.cells, 6069837, 60);
  EXPECT_TRUE(methods::widths_of_name("ec30to60").values.empty());
}

TEST(width_formula, is_as_documented) {
  const Widths disc = WidthFormula("disc:10,120,500,1000,20,-30").widths(6371);
  EXPECT_DOUBLE_EQ(disc.least, 10);
  EXPECT_NEAR(width_at(disc, 20, -30), 10, 1e-12);
  EXPECT_NEAR(width_at(disc, 20, -30 + 499 * km), 10, 1e-12);
  EXPECT_NEAR(width_at(disc, 20, -30 + 1000 * km), 65, 1e-6);
  EXPECT_NEAR(width_at(disc, 20, -30 - 750 * km), 10 + 110 * 0.15625, 1e-6);
  EXPECT_NEAR(width_at(disc, 20, -30 - 1501 * km), 120, 1e-9);
  EXPECT_NEAR(width_at(disc, -160, 30), 120, 1e-9);
  const Widths band = WidthFormula("band:30,60,1000,500,10").widths(6371);
  EXPECT_NEAR(width_at(band, 77, 10 - 999 * km), 30, 1e-9);
  EXPECT_NEAR(width_at(band, 77, 10 + 1250 * km), 45, 1e-6);
  EXPECT_NEAR(width_at(band, 77, -90), 60, 1e-9);
  // Number of cells: without transition a cap, and a zone.
  const double whole = cells_of_width(1, 6371), cap = (1 - std::cos(500 / 6371.0)) / 2;
  EXPECT_NEAR(
      WidthFormula("disc:10,120,500,0,20,-30").widths(6371).cells / (whole * (cap / 100 + (1 - cap) / 14400)),
      1, 1e-9);
  const double zone = (std::sin(10 * kDegree + 1000 / 6371.0) - std::sin(10 * kDegree - 1000 / 6371.0)) / 2;
  EXPECT_NEAR(
      WidthFormula("band:30,60,1000,0,10").widths(6371).cells / (whole * (zone / 900 + (1 - zone) / 3600)), 1,
      1e-9);
  // With one: the same widths on a grid.
  const files::Grid grid{ticks(-180, 0.5, 721), ticks(-90, 0.5, 361)};
  for (const Widths* const widths : {&disc, &band}) {
    const Table t = table(grid, [&](double lon, double lat) { return width_at(*widths, lon, lat); });
    EXPECT_NEAR(widths_of(t, 6371).cells / widths->cells, 1, 4e-3);
  }
  for (const char* const formula :
       {"disc:", "disc:1,2,3,4,5", "disc:1,2,3,4,5,6,7", "disc:1,2,3,x,5,6", "disc:0,2,3,4,5,6",
        "disc:1,-2,3,4,5,6", "disc:1,2,-3,4,5,6", "disc:1,2,3,nan,5,6", "disc:1,2,3,4,5,91",
        "band:1,2,3,4,5,6", "band:1,2,3,4,-91", "0", "-60km", "nankm", "60miles", "km"})
    EXPECT_THROW(WidthFormula{formula}, std::invalid_argument) << formula;
}

TEST(width_formula, is_limited_in_its_gradient) {
  WidthFormula fine("disc:10,120,500,100,0,0"), coarse("disc:120,10,5000,100,0,0"),
      flat("disc:10,120,500,1000,0,0");
  EXPECT_TRUE(fine.limit(0.2));
  EXPECT_TRUE(coarse.limit(0.2));
  EXPECT_FALSE(flat.limit(0.2));
  EXPECT_DOUBLE_EQ(fine.transition(), 825);
  double steepest = 0;
  for (double d = 0; d < 10000; ++d)
    for (const WidthFormula& formula : {fine, coarse})
      steepest = std::max(steepest, std::fabs(formula.width(d + 1) - formula.width(d)));
  EXPECT_NEAR(steepest, 0.2, 1e-6);
  EXPECT_EQ(fine.width(500), 10);
  EXPECT_LT(coarse.width(5099), 10.01);  // the fine cells stay
  EXPECT_EQ(coarse.width(5100), 10);
  EXPECT_EQ(coarse.width(4275), 120);
}

files::WidthRegion region(double width, double transition,
                          std::vector<std::vector<std::pair<double, double>>> rings) {
  return {{1, {}, std::move(rings)}, width, transition};
}

TEST(widths_of_regions, change_over_the_transitions_and_hold_holes_datelines_and_poles) {
  const auto box = [](double west, double south, double east, double north) {
    return std::vector<std::pair<double, double>>{
        {west, south}, {east, south}, {east, north}, {west, north}, {west, south}};
  };
  // Narrower, with a hole; across the dateline; a cap with the pole; wider.
  const Table t =
      widths_of_regions({region(30, 1000, {box(0, -20, 40, 20), box(10, -10, 30, 10)}),
                         region(40, 500, {box(170, -20, 190, 20)}), region(50, 0, {box(-180, 80, 180, 90)}),
                         region(240, 1000, {box(60, -70, 120, -20)})},
                        WidthFormula("120km"), 6371);
  EXPECT_NEAR(t.lat[1] - t.lat[0], 30 * km, 0.001);
  const GridValues widths(t);
  const auto width = [&](double lon, double lat) { return width_at(widths, lon, lat); };
  for (const double lon : {1.0, 5.0, 39.0}) EXPECT_EQ(width(lon, 0), 30);
  EXPECT_NEAR(width(20, 0), 120, 1e-5);  // 10 degrees inside the hole
  EXPECT_NEAR(width(20, 20 + 500 * km), 75, 2);
  EXPECT_NEAR(width(20, 20 + 1001 * km), 120, 2);
  for (const double lon : {171.0, 179.9, -180.0, -179.0, -171.0}) EXPECT_EQ(width(lon, 0), 40);
  EXPECT_NEAR(width(-170 + 250 * km, 0), 80, 4);
  EXPECT_EQ(width(77, 90), 50);
  EXPECT_EQ(width(77, 80.5), 50);
  EXPECT_EQ(width(77, 79), 120);
  EXPECT_NEAR(width(90, -20 - 500 * km), 180, 4);
  EXPECT_NEAR(width(90, -45), 240, 1e-5);
  EXPECT_EQ(width(90, -19), 120);
  EXPECT_THROW(widths_of_regions({region(30, 0, {box(0, 0, 0.2, 0.2)})}, WidthFormula("120km"), 6371),
               std::runtime_error);
}

TEST(widths_of_distance, grow_from_lines_also_across_the_dateline_but_not_from_where_polygons_are_cut) {
  const Table t =
      widths_of_distance({{{170, 0}, {190, 0}}, {{-180, -60}, {-180, -90}, {180, -90}, {180, -60}}},
                         WidthDistance("a:b.json:50:250:1000"), 6371);
  const GridValues widths(t);
  const auto width = [&](double lon, double lat) { return width_at(widths, lon, lat); };
  for (const double lon : {171.0, 179.9, -180.0, -171.0}) EXPECT_NEAR(width(lon, 0), 50, 0.2 * 26);
  EXPECT_NEAR(width(180, 500 * km), 150, 2);
  EXPECT_NEAR(width(-170 + 500 * km, 0), 150, 2);
  EXPECT_NEAR(width(-175, -900 * km), 230, 2);
  EXPECT_EQ(width(180, -20), 250);
  EXPECT_EQ(width(180, -75), 250);
  EXPECT_EQ(width(0, 90), 250);
  EXPECT_EQ(WidthDistance("a:b.json:50:250:1000").file, "a:b.json");
  for (const char* const text : {"", "a", "1:2:3", "a:0:2:3", "a:2:1:3", "a:1:2:0", "a:1:2:km"})
    EXPECT_THROW(WidthDistance{text}, std::invalid_argument) << text;
}

TEST(widths_in, are_those_asked_for_in_the_area_and_ten_widths_around_it_then_grow) {
  // The disc holds neither pole, and crosses the dateline.
  const files::LimitedArea disc = files::circle_area("disc", 170, 80, 1000 / 6371.0),
                           cap = files::circle_area("cap", 0, 90, 2000 / 6371.0),
                           box = files::box_area("box", {-20, 25, -15, 15});
  struct Rim {
    const files::LimitedArea& area;
    double lon, lat;
    int towards;  // the outside: 1 northwards, -1 southwards
  };
  for (const auto& [area, lon, lat, towards] :
       {Rim{disc, 170, 80 - 1000 * km, -1}, {cap, 33, 90 - 2000 * km, -1}, {box, 0, 15, 1}}) {
    const RegionalWidths regional = widths_in(area, WidthFormula("20").widths(6371), 0.2, 6371);
    const auto width = [&, lon = lon, lat = lat](double degrees) {
      return width_at(regional.widths, lon, lat + degrees);
    };
    for (double inside = -190; inside <= 200; inside += 10)
      EXPECT_NEAR(width(towards * inside * km), 20, 1e-9) << area.name;
    for (const double outside : {400.0, 1000.0, 3000.0}) {
      EXPECT_GT(width(towards * outside * km), 20 + 0.2 * (outside - 200) - 12) << area.name << outside;
      EXPECT_LT(width(towards * outside * km), 20 + 0.2 * (outside - 200) + 2) << area.name << outside;
    }
    const double part = area.name == "box"
                            ? 45.0 / 360 * std::sin(15 * kDegree)
                            : (1 - std::cos(area.name == "disc" ? 1000 / 6371.0 : 2000 / 6371.0)) / 2;
    EXPECT_NEAR(regional.inside / (part * cells_of_width(20, 6371)), 1, 0.03) << area.name;
    EXPECT_LT(regional.widths.cells, 2 * regional.inside) << area.name;
    EXPECT_TRUE(area.contains(regional.centre)) << area.name;
    if (area.name == "box") continue;
    const auto wider =  // the same in all directions
        area.name == "disc" ? files::circle_area("", 170, 80, 1195 / 6371.0)
                            : files::circle_area("", 0, 90, 2195 / 6371.0);
    const std::vector<Point> around = wider.boundary()[0];
    for (const Point& p : around) EXPECT_NEAR(regional.widths.density->at(p), 1, 1e-12);
  }
  // Other widths in the area than one; those outside do not count.
  const Widths wide = WidthFormula("disc:5,60,100,300,-170,0").widths(6371);
  EXPECT_EQ(widths_in(box, wide, 0.2, 6371).widths.least, 60);
  const RegionalWidths steep =
      widths_in(box, WidthFormula("disc:20,60,500,1000,0,0").widths(6371), 0.2, 6371);
  EXPECT_NEAR(width_at(steep.widths, 0, 1000 * km), 40, 0.1);
  EXPECT_THROW(
      widths_in(files::circle_area("small", 0, 0, 5 / 6371.0), WidthFormula("20").widths(6371), 0.2, 6371),
      std::runtime_error);
}

TEST(front_around, is_one_lattice_around_the_centre) {
  const files::LimitedArea area = files::circle_area("disc", -77, 33, 1000 / 6371.0);
  const RegionalWidths regional = widths_in(area, WidthFormula("80").widths(6371), 0.2, 6371);
  const auto n = static_cast<std::size_t>(regional.widths.cells);
  files::Mesh mesh = files::triangulate(front_around(regional.centre, n, *regional.widths.density));
  EXPECT_EQ(mesh.points.size(), n);
  files::set_layers(mesh, area);
  const Quality quality = quality_of(mesh);
  EXPECT_GT(quality.cells[6], 700u);
  EXPECT_LE(quality.cells[5] + quality.cells[7], quality.cells[6] / 50);
}

}  // namespace
}  // namespace methods
