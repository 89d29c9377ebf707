#include "methods/regional_widths.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <stdexcept>
#include <utility>

#include "files/measures.h"
#include "methods/densities.h"
#include "point_sets.h"
#include "scvt/front.h"
#include "scvt/vectors.h"

namespace methods {
namespace {

using files::Point;

using files::kDegree;
using Interval = std::pair<double, double>;

/// Ticks from `first` to `last`, a step apart in the intervals, and farther apart the farther they are from
/// these. Intervals repeat after a turn.
std::vector<double> ticks_of(double first, double last, double step, const std::vector<Interval>& intervals) {
  const auto distance = [&](double x) {
    double least = 180;
    for (const auto& [west, east] : intervals)
      for (const double turn : {-720, -360, 0, 360, 720})
        least = std::min(least, std::max({0.0, west + turn - x, x - east - turn}));
    return least;
  };
  std::vector<double> ticks{first};
  while (true) {
    const double next = ticks.back() + std::max(step, distance(ticks.back()) / 4);
    if (!(next < last - step / 2)) break;
    ticks.push_back(next);
  }
  ticks.push_back(last);
  return ticks;
}

/// Half of the distance between the ticks on both sides.
double half_of_two(const std::vector<double>& ticks, std::size_t i) {
  return (ticks[std::min(i + 1, ticks.size() - 1)] - ticks[i > 0 ? i - 1 : 0]) / 2;
}

/// 1 within a distance from a place, where few cells need a table; elsewhere another density.
std::unique_ptr<Density> one_near(const Point& place, double distance, std::unique_ptr<Density> other) {
  return std::make_unique<DensityBy>(
      [place, cosine = std::cos(distance), elsewhere = std::shared_ptr(std::move(other))](
          std::size_t n, const Point* p, double* value) {
        constexpr std::size_t kBatch = 256;
        Point far[kBatch];
        double values[kBatch];
        for (std::size_t first = 0; first < n; first += kBatch) {
          const std::size_t last = std::min(n, first + kBatch);
          std::size_t count = 0;
          for (std::size_t i = first; i < last; ++i)
            if (!(dot(p[i], place) > cosine)) far[count++] = p[i];
          elsewhere->at(count, far, values);
          count = 0;
          for (std::size_t i = first; i < last; ++i)
            value[i] = dot(p[i], place) > cosine ? 1 : values[count++];
        }
      });
}

/// How far from the place all values of the table are the least one: a cell of the grid has no longer
/// diagonal than `diagonal` there.
double reach_of_least(const Table& table, const Point& place, double diagonal) {
  const double least = *std::min_element(table.values.begin(), table.values.end());
  double reach = 1;
  for (std::size_t i = 0; i < table.values.size(); ++i)
    if (table.values[i] > least) {
      const Point d = minus(
          place, point_sets::from_degrees(table.lon[i % table.lon.size()], table.lat[i / table.lon.size()]));
      reach = std::min(reach, std::sqrt(dot(d, d)) - diagonal);  // a chord is shorter than its arc
    }
  return reach;
}

}  // namespace

std::vector<Point> front_around(const Point& centre, std::size_t n, const Density& density) {
  const double third = 1 / std::sqrt(3.0);
  // The mirror image at the plane between the centre and the face of (0, 1, g), (1, g, 0), (g, 0, 1), which
  // exchanges them, and is its own inverse.
  const Point across = minus(centre, {third, third, third});
  const double square = dot(across, across);
  const auto mirror = [&](const Point& p) {
    const double part = square > 1e-20 ? 2 * dot(across, p) / square : 0;
    return Point{p.x - part * across.x, p.y - part * across.y, p.z - part * across.z};
  };
  const DensityBy mirrored([&](std::size_t count, const Point* p, double* value) {
    std::vector<Point> places(p, p + count);
    for (Point& place : places) place = mirror(place);
    density.at(count, places.data(), value);
  });
  std::vector<Point> generators = pstripack::scvt::front_generators(n, mirrored);
  for (Point& generator : generators) generator = mirror(generator);
  return files::unit(generators);
}

RegionalWidths widths_in(const files::LimitedArea& area, const Widths& given, double gradient,
                         double radius) {
  constexpr double kSteps = 300;  // across the area
  constexpr double kFlat =
      files::kLayers + 3;  // widths: the first cells, the last ones, and what coarse neighbours change
  const auto widths_at = [&](const std::vector<Point>& places) {
    std::vector<double> widths(places.size());
    given.density->at(places.size(), places.data(), widths.data());
    for (double& width : widths) width = given.least / std::sqrt(std::sqrt(width));
    return widths;
  };
  double widest = 0;
  for (const std::vector<Point>& line : area.boundary())
    for (const double width : widths_at(line)) widest = std::max(widest, width);
  const double margin = kFlat * widest / radius / kDegree;
  std::vector<Interval> lons, lats;
  double across = 0, up = 0, nearest_to_equator = 90;
  for (const files::Region& box : area.boxes()) {
    const double most = std::max(std::fabs(box.south), std::fabs(box.north)) + margin,
                 east = margin / std::max(std::cos(std::min(most, 90.0) * kDegree), 1e-6);
    lons.emplace_back(box.west - std::min(east, 180.0), box.east + std::min(east, 180.0));
    lats.emplace_back(box.south - margin, box.north + margin);
    across += lons.back().second - lons.back().first;
    up += lats.back().second - lats.back().first;
    nearest_to_equator =
        std::min(nearest_to_equator,
                 box.south * box.north < 0 ? 0 : std::min(std::fabs(box.south), std::fabs(box.north)));
  }
  across = std::min(across, 360.0) / kSteps, up = std::min(up, 180.0) / kSteps;
  Table table{ticks_of(lons[0].first, lons[0].first + 360, across, lons), ticks_of(-90, 90, up, lats), {}};
  const double spacing = std::hypot(up, across * std::cos(nearest_to_equator * kDegree)) * kDegree * radius;

  const std::size_t columns = table.lon.size() - 1;
  RegionalWidths regional;
  std::vector<bool> inside(table.lat.size() * columns);
  std::vector<Point> places;
  for (std::size_t r = 0; r < table.lat.size(); ++r) {
    places.clear();
    for (const double lon : table.lon) places.push_back(point_sets::from_degrees(lon, table.lat[r]));
    const std::vector<double> widths = widths_at(places);
    table.values.insert(table.values.end(), widths.begin(), widths.end());
    const double height = half_of_two(table.lat, r) * std::cos(table.lat[r] * kDegree) * kDegree * kDegree;
    for (const auto& [west, east] : area.inside(table.lat[r]))
      for (std::size_t c = 0; c < columns; ++c) {
        const double lon = west + std::fmod(std::fmod(table.lon[c] - west, 360) + 360, 360);
        if (lon > east || inside[r * columns + c]) continue;
        inside[r * columns + c] = true;
        const double ratio = radius / widths[c];
        const double cells = height * half_of_two(table.lon, c) * ratio * ratio / (std::sqrt(3) / 2);
        regional.inside += cells;
        Point& sum = regional.centre;
        sum = {sum.x + cells * places[c].x, sum.y + cells * places[c].y, sum.z + cells * places[c].z};
      }
  }
  if (!(regional.inside >= 1))
    throw std::runtime_error(fmt::format(
        "{}: the region is smaller than a cell of {:.4g} km: enlarge it, or make the width smaller",
        area.name, widest));
  regional.centre = pstripack::scvt::normalized(regional.centre);
  set_outside(table, inside, gradient, radius, kFlat, spacing, radius / 6);
  const double reach = reach_of_least(table, regional.centre, spacing / radius);
  regional.widths = widths_of(std::move(table), radius);
  if (reach > 0)
    regional.widths.density = one_near(regional.centre, reach, std::move(regional.widths.density));
  return regional;
}

}  // namespace methods
