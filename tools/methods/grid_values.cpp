#include "methods/grid_values.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <stdexcept>
#include <utility>

#include "files/measures.h"

namespace methods {
namespace {

using files::Point;

using files::kDegree;

/// The order in which the numbers increase.
template <class Key>
std::vector<std::size_t> sorted(std::size_t n, const Key& key) {
  std::vector<std::size_t> order(n);
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) { return key(a) < key(b); });
  return order;
}

void require_distinct(const std::vector<double>& ticks, const char* name) {
  if (ticks.size() < 2) throw std::runtime_error(fmt::format("the axis {} has a single value", name));
  for (std::size_t i = 1; i < ticks.size(); ++i)
    if (!(ticks[i - 1] < ticks[i]))
      throw std::runtime_error(fmt::format("the axis {} holds {} twice", name, ticks[i]));
}

/// atan2(y, x) in degrees, with an error below 1e-15 of itself; without branches, so that a loop of them
/// takes half the time. atan t = t + t^3 (polynomial in t^2) on |t| <= tan 22.5 degrees, from a Chebyshev
/// fit.
inline double degrees_of(double y, double x) {
  constexpr double kTan = 0.41421356237309503;  // of 22.5 degrees
  constexpr double kMin = std::numeric_limits<double>::min();
  const double along = std::fabs(x), across = std::fabs(y);
  const double more = across > along ? across : along, less = across > along ? along : across;
  const double ratio = less / (more > kMin ? more : kMin);
  const double turned = (ratio - 1) / (ratio + 1);
  const bool is_turned = ratio > kTan;
  const double t = is_turned ? turned : ratio, z = t * t;
  const double z2 = z * z, z4 = z2 * z2;
  const double low =
      (-0.3333333333333325 + 0.19999999999898324 * z) + (-0.1428571426608229 + 0.11111109635603796 * z) * z2;
  const double middle = (-0.09090852527088297 + 0.07691054614825647 * z) +
                        (-0.06649607953399717 + 0.057362969593526145 * z) * z2;
  const double sum = low + z4 * (middle + z4 * (-0.04483218628995374 + 0.022748939747779046 * z));
  double angle = (t + t * z * sum) / kDegree + (is_turned ? 45 : 0);
  angle = across > along ? 90 - angle : angle;
  angle = x < 0 ? 180 - angle : angle;
  return std::copysign(angle, y);
}

/// Turns the axis so that it begins between 180 degrees west, inclusive, and 180 degrees east.
std::vector<double> from_180_west(std::vector<double> lon) {
  const double turns = std::floor((lon.front() + 180) / 360);
  for (double& tick : lon) tick -= 360 * turns;
  return lon;
}

}  // namespace

double in_range(double mean) {
  using Limits = std::numeric_limits<double>;
  return std::clamp(mean, Limits::denorm_min(), Limits::max());
}

Axis::Axis(std::vector<double> ticks) : ticks_(std::move(ticks)) {
  last_ = static_cast<std::int64_t>(ticks_.size()) - 2;
  ticks_per_unit_ = static_cast<double>(last_ + 1) / (ticks_.back() - ticks_.front());
  is_equidistant_ = true;
  for (std::size_t i = 0; i < ticks_.size(); ++i) {
    const double position = (ticks_[i] - ticks_.front()) * ticks_per_unit_;
    is_equidistant_ &= std::fabs(position - static_cast<double>(i)) < 1e-9;
  }
}

std::int64_t Axis::found(double x) const {
  return std::upper_bound(ticks_.begin() + 1, ticks_.end() - 1, x) - ticks_.begin() - 1;
}

template <class Value>
GridValues<Value>::GridValues(TableOf<Value> table)
    : columns_(table.lon.size()),
      lon_(from_180_west(std::move(table.lon))),
      lat_(std::move(table.lat)),
      values_(std::move(table.values)) {}

template <class Value>
void GridValues<Value>::at(std::size_t n, const Point* p, double* value) const {
  constexpr std::size_t kBatch = 256;
  double lon[kBatch], lat[kBatch];
  const double west = lon_.first();
  for (std::size_t first = 0; first < n; first += kBatch) {
    const std::size_t count = std::min(kBatch, n - first);
    const Point* const place = p + first;
    for (std::size_t i = 0; i < count; ++i) {
      const double angle = degrees_of(place[i].y, place[i].x);
      lon[i] = angle < west ? angle + 360 : angle;
    }
    for (std::size_t i = 0; i < count; ++i)
      lat[i] = degrees_of(place[i].z, std::sqrt(place[i].x * place[i].x + place[i].y * place[i].y));
    for (std::size_t i = 0; i < count; ++i) {
      const auto [column, east] = lon_.place(lon[i]);
      const auto [row, north] = lat_.place(lat[i]);
      const Value* const low = values_.data() + row * static_cast<std::int64_t>(columns_) + column;
      const Value* const high = low + columns_;
      value[first + i] = in_range((1 - north) * ((1 - east) * low[0] + east * low[1]) +
                                  north * ((1 - east) * high[0] + east * high[1]));
    }
  }
}

template class GridValues<float>;
template class GridValues<double>;

template <class Value>
TableOf<Value> table_of(const files::Grid& grid, const std::vector<double>& values) {
  // Columns from the first one eastwards, without a last column that repeats the first one 360 degrees on.
  const double west = grid.lon.front();
  const auto east_of_first = [&](std::size_t i) {
    return grid.lon[i] - west - 360 * std::floor((grid.lon[i] - west) / 360);
  };
  std::vector<std::size_t> columns = sorted(grid.lon.size(), east_of_first);
  std::vector<double> lon, lat;
  if (columns.size() > 1 && east_of_first(columns[1]) == 0) columns.erase(columns.begin() + 1);
  for (const std::size_t i : columns) lon.push_back(east_of_first(i) + west);
  require_distinct(lon, "of longitudes");
  double widest = 0;
  lon.push_back(west + 360);
  for (std::size_t i = 1; i < lon.size(); ++i) widest = std::max(widest, lon[i] - lon[i - 1]);
  if (widest > 2.5 * 360 / static_cast<double>(columns.size()))
    throw std::runtime_error(
        fmt::format("the grid leaves out {} degrees of longitude: a density must cover the sphere", widest));
  const std::vector<std::size_t> rows = sorted(grid.lat.size(), [&](std::size_t i) { return grid.lat[i]; });
  for (const std::size_t i : rows) lat.push_back(grid.lat[i]);
  require_distinct(lat, "of latitudes");
  const double spacing = (lat.back() - lat.front()) / static_cast<double>(lat.size() - 1);
  const double near = 1e-6 * spacing;  // sums of steps miss the poles by rounding
  if (std::fabs(lat.front() + 90) < near) lat.front() = -90;
  if (std::fabs(lat.back() - 90) < near) lat.back() = 90;
  if (std::max(90 - lat.back(), lat.front() + 90) > 2.5 * spacing)
    throw std::runtime_error(fmt::format(
        "the grid ends at latitudes {} and {}: a density must cover the sphere", lat.front(), lat.back()));

  std::vector<Value> table;
  const auto add_row = [&](std::size_t row) {
    const double* const v = &values[row * grid.lon.size()];
    for (const std::size_t c : columns) table.push_back(static_cast<Value>(v[c]));
    table.push_back(static_cast<Value>(v[columns[0]]));
  };
  const auto add_pole = [&](std::size_t row) {
    const auto count = static_cast<double>(columns.size());
    double sum = 0, mean = 0;
    for (const std::size_t c : columns) {
      sum += values[row * grid.lon.size() + c];
      mean += values[row * grid.lon.size() + c] / count;  // cannot overflow
    }
    table.insert(table.end(), columns.size() + 1,
                 static_cast<Value>(std::isfinite(sum) ? sum / count : in_range(mean)));
  };
  if (lat.front() > -90) add_pole(rows.front());
  for (const std::size_t row : rows) add_row(row);
  if (lat.back() < 90) add_pole(rows.back());
  if (lat.front() > -90) lat.insert(lat.begin(), -90);
  if (lat.back() < 90) lat.push_back(90);
  return {std::move(lon), std::move(lat), std::move(table)};
}
template TableOf<float> table_of(const files::Grid&, const std::vector<double>&);
template TableOf<double> table_of(const files::Grid&, const std::vector<double>&);

}  // namespace methods
