// Densities of centroidal tessellations.

#include "methods/densities.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

#include "error_of.h"
#include "point_sets.h"
#include "scvt/errors.h"
#include "scvt/first_generators.h"
#include "scvt/tessellation.h"

namespace methods {
namespace {

using files::Point;
using Points = std::vector<Point>;

TEST(density, is_as_documented) {
  const auto at = [&](const char* formula, double lon, double lat) {
    return density_of(formula)->at(point_sets::from_degrees(lon, lat));
  };
  EXPECT_EQ(at("constant", 3, 4), 1);
  for (const char* const formula : {"bump", "bump:0,30,30,10,3"}) {
    EXPECT_NEAR(at(formula, 0, 0), 16, 1e-12);  // at distance RADIUS tanh is 0: (1 + 2/2)^4
    EXPECT_NEAR(at(formula, 0, 40), std::pow(2 + std::tanh(2), 4), 1e-11);
    EXPECT_NEAR(at(formula, 180, -30), 1, 1e-11);
  }
  EXPECT_NEAR(at("bump:90,0,10,5,0.5", 90, 10), 0.31640625, 1e-14);  // RATIO < 1: coarser there
  for (const char* const formula :
       {"", "potato", "bumpy", "bump:", "bump:1,2,3,4", "bump:1,2,3,4,5,6", "bump:1,2,3,x,5",
        "bump:0,91,3,4,5", "bump:0,0,3,0,5", "bump:0,0,3,4,0", "bump:0,0,3,4,nan"})
    EXPECT_THROW(density_of(formula), std::invalid_argument) << formula;
}

TEST(sampled_density, is_linear_between_its_nodes_and_must_be_known) {
  const Points nodes = point_sets::make("random", 300);
  std::vector<double> values;
  for (const Point& p : nodes) values.push_back(2 + p.z);
  const std::unique_ptr<Density> density = density_between(nodes, values);
  EXPECT_EQ(density->at(nodes[7]), values[7]);
  EXPECT_NEAR(density->at(point_sets::from_degrees(20, 30)), 2.5, 0.05);
  // After a density with more nodes on the same thread.
  EXPECT_EQ(density_between(Points(nodes.begin(), nodes.begin() + 50),
                            std::vector<double>(values.begin(), values.begin() + 50))
                ->at(nodes[7]),
            values[7]);

  const std::unique_ptr<Density> regional =
      density_between(point_sets::make("hemisphere", 100), std::vector<double>(100, 1));
  EXPECT_THROW(pstripack::scvt::random_generators(100, *regional, 1), pstripack::scvt::BadDensity);
  EXPECT_THROW(pstripack::scvt::run(point_sets::make("fibonacci", 100), *regional, {}),
               pstripack::scvt::BadDensity);
}

std::vector<double> ticks(double first, double step, int count) {
  std::vector<double> t;
  for (int i = 0; i < count; ++i) t.push_back(first + i * step);
  return t;
}

/// A value for each column and row.
double value_of(double lon, double lat) { return 3 + std::cos(lon / 57.29577951308232) + lat / 100; }
std::vector<double> values_on(const files::Grid& grid) {
  std::vector<double> values;
  for (const double lat : grid.lat)
    for (const double lon : grid.lon) values.push_back(value_of(lon, lat));
  return values;
}
double at(const Density& density, double lon, double lat) {
  return density.at(point_sets::from_degrees(lon, lat));
}

TEST(density_on_grid, is_bilinear_also_across_the_dateline_whatever_the_order_of_the_axes) {
  const files::Grid cells{ticks(-175, 10, 36), ticks(-85, 10, 18)}, from_0{ticks(5, 10, 36), cells.lat},
      downwards{cells.lon, ticks(85, -10, 18)}, westwards{ticks(175, -10, 36), cells.lat},
      repeated{ticks(5, 10, 37), cells.lat};
  for (const files::Grid& grid : {cells, from_0, downwards, westwards, repeated}) {
    const std::unique_ptr<Density> density = density_on_grid(grid, values_on(grid));
    for (const double lon : {-175, -5, 5, 175, 185, 365})
      for (const double lat : {-85, 5, 85})
        EXPECT_NEAR(at(*density, lon, lat), value_of(lon, lat), 1e-12) << lon << ' ' << lat;
    for (const double lon : {-180, 180, 0, 60}) {  // including places halfway between columns and rows
      const double east = value_of(lon + 5, 0), west = value_of(lon - 5, 0);
      EXPECT_NEAR(at(*density, lon, 0), (east + west) / 2, 1e-12) << lon;
    }
    EXPECT_NEAR(at(*density, 178, 5), 0.7 * value_of(175, 5) + 0.3 * value_of(185, 5), 1e-12);
  }
}

TEST(density_on_grid, goes_to_the_mean_of_the_last_row_at_a_pole_that_has_no_row) {
  const files::Grid cells{ticks(-175, 10, 36), ticks(-85, 10, 18)};
  const std::unique_ptr<Density> density = density_on_grid(cells, values_on(cells));
  for (const double lon : {-180, 0, 77}) {
    EXPECT_NEAR(at(*density, lon, 90), 3.85, 1e-12);
    EXPECT_NEAR(at(*density, lon, -90), 2.15, 1e-12);
  }
  EXPECT_NEAR(at(*density, 5, 87.5), (value_of(5, 85) + 3.85) / 2, 1e-12);
  const files::Grid to_poles{ticks(0, 30, 12), ticks(-90, 30, 7)};
  std::vector<double> values = values_on(to_poles);
  for (std::size_t i = 72; i < 84; ++i) values[i] = 7;
  EXPECT_NEAR(at(*density_on_grid(to_poles, values), 12, 90), 7, 1e-12);
  EXPECT_NEAR(at(*density_on_grid(to_poles, values), 30, 75), (value_of(30, 60) + 7) / 2, 1e-12);
}

TEST(density_on_grid, refuses_what_does_not_cover_the_sphere) {
  const auto refuses = [](const files::Grid& grid, const std::string& words) {
    const std::string error = error_of([&] { density_on_grid(grid, values_on(grid)); });
    EXPECT_NE(error.find(words), std::string::npos) << error;
  };
  const std::vector<double> lon = ticks(-175, 10, 36), lat = ticks(-85, 10, 18);
  refuses({ticks(-20, 10, 10), lat}, "the grid leaves out 270 degrees of longitude");
  refuses({lon, ticks(20, 10, 5)}, "the grid ends at latitudes 20 and 60");
  refuses({{0, 90, 180, 90, 270}, lat}, "the axis of longitudes holds 90 twice");
  refuses({lon, {-60, 0, 0, 60}}, "the axis of latitudes holds 0 twice");
  refuses({{10}, lat}, "the axis of longitudes has a single value");
  refuses({lon, {0}}, "the axis of latitudes has a single value");
}

}  // namespace
}  // namespace methods
