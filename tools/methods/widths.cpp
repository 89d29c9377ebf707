#include "methods/widths.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <deque>
#include <numeric>
#include <queue>
#include <stdexcept>
#include <utility>

#include "files/measures.h"
#include "files/nearest.h"
#include "files/text_file.h"
#include "methods/densities.h"
#include "numbers.h"
#include "point_sets.h"

namespace methods {
namespace {

using files::Point;

using files::kDegree;
using files::kPi;

/// `widths` sets widths as DensityBy's function sets densities.
std::unique_ptr<Density> density_of_widths(double least, DensityBy::Function widths) {
  return std::make_unique<DensityBy>(
      [least, widths = std::move(widths)](std::size_t n, const Point* p, double* value) {
        widths(n, p, value);
        for (std::size_t i = 0; i < n; ++i) {
          const double square = least / value[i] * (least / value[i]);
          value[i] = std::min(1.0, square * square);  // bilinear widths round below the least
        }
      });
}

// Each place of the grid knows its source: the place y whose cone w(y) + gradient d(x,y) is the lowest one
// known at x. A place that is lowered offers its source to its eight neighbours, the lowest place first. So
// distances are lengths of arcs, not of paths along the grid (Danielsson, Comput. Graph. Image Process. 14,
// 1980; in the order of Dijkstra, as in fast marching: Sethian, PNAS 93, 1996).
class GradientLimit {
 public:
  GradientLimit(Table& table, double gradient, double radius)
      : row_(table.lon.size()), slope_(gradient * radius), radius_(radius), table_(table) {
    if (table.values.size() > 0xffffffff) throw std::runtime_error("the grid has more than 4e9 places");
    for (const double lon : table.lon) east_.push_back({std::cos(lon * kDegree), std::sin(lon * kDegree), 0});
    for (const double lat : table.lat)
      up_.push_back({std::fabs(lat) == 90 ? 0 : std::cos(lat * kDegree), 0, std::sin(lat * kDegree)});
    given_ = table.values;
    source_.resize(given_.size());
    std::iota(source_.begin(), source_.end(), std::uint32_t{0});
  }

  /// `inside`: by place, without the last column. Only places whose entry is `sources` keep others low, and
  /// only other ones are lowered.
  Lowered run(const std::vector<bool>* inside = nullptr, bool sources = true) {
    std::vector<float>& width = table_.values;
    const auto is_source = [&](Place i) { return inside == nullptr || (*inside)[i - i / row_] == sources; };
    for_each_place([&](Place i) {
      if (!is_source(i)) return;
      bool lowers = false;
      for_each_neighbour(i, [&](Place n) {  // a chord is shorter than its arc
        lowers = lowers || (width[i] < width[n] && width[i] + slope_ * chord(i, n) < width[n]);
      });
      if (lowers) queue_.emplace(-width[i], i);
    });
    while (!queue_.empty()) {
      const auto [value, i] = queue_.top();
      queue_.pop();
      if (-value != width[i]) continue;  // it was lowered again
      const Place s = source_[i];
      for_each_neighbour(i, [&](Place n) {
        const auto offer = static_cast<float>(width[s] + slope_ * arc(s, n));
        if (!(offer < width[n]) || (inside != nullptr && is_source(n))) return;
        width[n] = offer;
        source_[n] = s;
        queue_.emplace(-offer, n);
      });
    }
    return finish();
  }

  /// After run(&inside): the cones begin `flat` times their own value and `more` km from their source, and
  /// end at `most`.
  void flatten(const std::vector<bool>& inside, double flat, double more, double most) {
    std::vector<float>& width = table_.values;
    for_each_place([&](Place i) {
      if (inside[i - i / row_]) return;
      const double value = width[source_[i]], from = radius_ * arc(source_[i], i) - flat * value - more;
      width[i] = static_cast<float>(
          source_[i] == i ? most : std::min(most, value + slope_ / radius_ * std::max(0.0, from)));
    });
    finish();
  }

 private:
  /// The index of a place in the table. The last column, which repeats the first one, has none.
  using Place = std::uint32_t;

  Point place(Place i) const {
    const Point &e = east_[i % row_], &u = up_[i / row_];
    return {u.x * e.x, u.x * e.y, u.z};
  }
  double chord(Place i, Place j) const {
    const Point d = minus(place(i), place(j));
    return std::sqrt(dot(d, d));
  }
  double arc(Place i, Place j) const { return 2 * std::asin(std::min(1.0, chord(i, j) / 2)); }
  template <class Visit>
  void for_each_place(const Visit& visit) const {
    for (std::size_t i = 0; i < given_.size(); ++i)
      if (i % row_ != row_ - 1) visit(static_cast<Place>(i));
  }
  template <class Visit>
  void for_each_neighbour(Place i, const Visit& visit) const {
    const std::size_t columns = row_ - 1, row = i / row_, column = i % row_;
    for (std::size_t r = row == 0 ? 0 : row - 1; r < std::min(row + 2, up_.size()); ++r)
      for (std::size_t k = columns - 1; k < columns + 2; ++k)
        if (r != row || k != columns) visit(static_cast<Place>(r * row_ + (column + k) % columns));
  }

  /// Repeats the first column.
  Lowered finish() {
    Lowered lowered;
    bool poles[2] = {};
    for_each_place([&](Place i) {
      const std::size_t r = i / row_, c = i % row_;
      if (c == 0) table_.values[i + row_ - 1] = table_.values[i];
      const double change = given_[i] - table_.values[i];
      if (source_[i] == i || change <= 1e-6 * given_[i]) return;  // rounding of single precision
      if (change > lowered.most)
        lowered.most = change, lowered.lon = table_.lon[c], lowered.lat = table_.lat[r];
      if (r == 0 || r + 1 == up_.size())
        poles[r > 0] = true;
      else
        ++lowered.places;
    });
    lowered.places += poles[0] + poles[1];
    lowered.of = (up_.size() - 2) * (row_ - 1) + 2;
    return lowered;
  }

  std::size_t row_;               ///< places in a row of the table, one of them twice
  double slope_;                  ///< km per radian
  double radius_;                 ///< km
  Table& table_;                  ///< lowered in place
  std::vector<Point> east_, up_;  ///< of columns and rows: the factors of a place
  std::vector<float> given_;
  std::vector<Place> source_;
  using Entry = std::pair<float, Place>;                 ///< minus the value
  std::priority_queue<Entry, std::deque<Entry>> queue_;  ///< a deque never needs room for a copy
};

/// Ticks about as far apart as the narrowest cell is wide, with values 0.
Table grid_for(double least, double radius) {
  constexpr double kFinest = 0.1, kCoarsest = 0.5;
  const double step = std::clamp(least / radius / kDegree, kFinest, kCoarsest);
  const auto rows = static_cast<std::size_t>(std::ceil(180 / step)) + 1, columns = 2 * (rows - 1);
  Table t;
  for (std::size_t c = 0; c <= columns; ++c)
    t.lon.push_back(-180 + 360 * static_cast<double>(c) / static_cast<double>(columns));
  for (std::size_t r = 0; r < rows; ++r)
    t.lat.push_back(-90 + 180 * static_cast<double>(r) / static_cast<double>(rows - 1));
  t.values.resize(rows * (columns + 1));
  return t;
}

/// The columns of an equidistant table without its last one that lie inside the region at this latitude.
template <class Visit>
void for_each_inside(const files::WidthRegion& region, double lat, std::size_t columns, const Visit& visit) {
  const double per_degree = static_cast<double>(columns) / 360;
  // A side along a pole belongs to the region.
  for (const auto& [west, east] : region.inside(std::clamp(lat, -90 + 1e-9, 90 - 1e-9))) {
    const auto first = static_cast<std::int64_t>(std::ceil((west + 180) * per_degree));
    const auto last = static_cast<std::int64_t>(std::floor((east + 180) * per_degree));
    for (std::int64_t c = first; c <= last && c < first + static_cast<std::int64_t>(columns); ++c)
      visit(static_cast<std::size_t>(c + 2 * static_cast<std::int64_t>(columns)) % columns);
  }
}

/// In km: a number, with or without "km", or with "m".
double width_of(const std::string& text) {
  double value = 0;
  const std::size_t end = text.find_last_of("0123456789.") + 1;
  const std::string unit = text.substr(end);
  if (!point_sets::parse(text.substr(0, end), value) || !(value > 0) ||
      !(unit.empty() || unit == "km" || unit == "m"))
    throw std::invalid_argument("'" + files::excerpt(text) + "' is no width: expected, say, 60km");
  return unit == "m" ? value / 1000 : value;
}

}  // namespace

WidthFormula::WidthFormula(const std::string& text) : is_band_(text.rfind("band:", 0) == 0) {
  if (!is_band_ && text.rfind("disc:", 0) != 0) {
    inner_ = outer_ = width_of(text);
    return;
  }
  const auto fail = [&](const std::string& what) {
    throw std::invalid_argument("width '" + files::excerpt(text) + "': " + what);
  };
  const std::vector<double> numbers = files::numbers_between(text.substr(5), ',');
  if (numbers.size() != (is_band_ ? 5 : 6))
    fail(is_band_ ? "expected five numbers: INNER,OUTER,RADIUS,TRANSITION,LAT"
                  : "expected six numbers: INNER,OUTER,RADIUS,TRANSITION,LON,LAT");
  inner_ = numbers[0], outer_ = numbers[1], radius_ = numbers[2], transition_ = numbers[3];
  lat_ = numbers.back();
  if (!(inner_ > 0 && outer_ > 0)) fail("INNER and OUTER must be above 0");
  if (!(radius_ >= 0 && transition_ >= 0)) fail("RADIUS and TRANSITION must not be negative");
  if (!(std::fabs(lat_) <= 90)) fail("LAT is beyond the pole");
  centre_ = point_sets::from_degrees(numbers[4], lat_);
}

bool WidthFormula::limit(double gradient) {
  const double needed = 1.5 * std::fabs(outer_ - inner_) / gradient;  // width() is steepest in the middle
  if (!(needed > transition_)) return false;
  if (inner_ > outer_) radius_ -= needed - transition_;  // the circle where OUTER begins stays
  transition_ = needed;
  return true;
}

double WidthFormula::width(double distance) const {
  if (distance <= radius_ || inner_ == outer_) return inner_;
  const double t = (distance - radius_) / transition_;
  return t >= 1 ? outer_ : inner_ + (outer_ - inner_) * t * t * (3 - 2 * t);
}

double WidthFormula::at(const Point& p, double radius) const {
  if (is_band_)
    return width(radius * std::fabs(std::atan2(p.z, std::sqrt(p.x * p.x + p.y * p.y)) - lat_ * kDegree));
  const Point apart = minus(p, centre_), sum{p.x + centre_.x, p.y + centre_.y, p.z + centre_.z};
  return width(radius * (2 * std::atan2(std::sqrt(dot(apart, apart)), std::sqrt(dot(sum, sum)))));
}

Widths WidthFormula::widths(double radius) const {
  // The integral over colatitude, or over the distance from the centre: Gauss' rule on pieces between the
  // places where the formula changes.
  const double from = is_band_ ? (90 - lat_) * kDegree : 0;
  std::vector<double> ends{0, kPi};
  for (const double d : {0.0, radius_, radius_ + transition_})
    for (const double end : {from - d / radius, from + d / radius})
      if (end > 0 && end < kPi) ends.push_back(end);
  std::sort(ends.begin(), ends.end());
  double cells = 0;
  constexpr int kPieces = 400;
  constexpr double kPlace = 0.7745966692414834;
  for (std::size_t i = 1; i < ends.size(); ++i)
    for (int k = 0; k < kPieces; ++k) {
      const double half = (ends[i] - ends[i - 1]) / kPieces / 2, middle = ends[i - 1] + (2 * k + 1) * half;
      for (const auto& [place, weight] : {std::pair(-kPlace, 5.0 / 9), {0.0, 8.0 / 9}, {kPlace, 5.0 / 9}}) {
        const double angle = middle + place * half, ratio = radius / width(radius * std::fabs(angle - from));
        cells += 2 * kPi * weight * half * std::sin(angle) * ratio * ratio / (std::sqrt(3) / 2);
      }
    }
  return {density_of_widths(least(),
                            [formula = *this, radius](std::size_t n, const Point* p, double* width) {
                              for (std::size_t i = 0; i < n; ++i) width[i] = formula.at(p[i], radius);
                            }),
          least(), cells};
}

Table widths_of_name(const std::string& name) {
  // A density between two values, `from` towards the pole and `to` towards the equator of the latitude `at`.
  const auto step = [](double lat, double at, double length, double to, double from) {
    return from + (to - from) * (1 + std::tanh((at - lat) / length)) / 2;
  };
  const auto density = [](double width, double least) { return std::pow(least / width, 4); };
  const auto ec = [&](double lat) {
    const double equator = density(30, 30), middle = density(60, 30), pole = density(35, 30);
    return 30 / std::pow(lat < 40 ? step(lat, 15, 6, equator, middle) : step(lat, 73, 9, middle, pole), 0.25);
  };
  const auto rrs = [&](double lat) {
    const double equator = density(18, 6);
    return 6 / std::pow(equator + (1 - equator) * std::pow(std::sin(lat * kDegree), 4), 0.25);
  };
  Table table{{0, 120, 240, 360}, {}, {}};
  if (name != "ec60to30" && name != "rrs18to6") return table;
  constexpr int kRowsPerDegree = 10;
  for (int row = -90 * kRowsPerDegree; row <= 90 * kRowsPerDegree; ++row) {
    table.lat.push_back(row / static_cast<double>(kRowsPerDegree));
    const double lat = std::fabs(table.lat.back());
    table.values.insert(table.values.end(), table.lon.size(),
                        static_cast<float>(name == "ec60to30" ? ec(lat) : rrs(lat)));
  }
  return table;
}

Lowered limit_gradient(Table& table, double gradient, double radius) {
  return GradientLimit(table, gradient, radius).run();
}

void set_outside(Table& table, const std::vector<bool>& inside, double gradient, double radius, double flat,
                 double more, double most) {
  const std::size_t columns = table.lon.size() - 1;
  double widest = 0;
  for (std::size_t i = 0; i < inside.size(); ++i)
    if (inside[i]) widest = std::max<double>(widest, table.values[i / columns * (columns + 1) + i % columns]);
  most = std::max(most, widest);
  for (std::size_t r = 0; r < table.lat.size(); ++r)
    for (std::size_t c = 0; c <= columns; ++c)
      if (!inside[r * columns + c % columns])
        table.values[r * (columns + 1) + c] = static_cast<float>(most + gradient * (flat * widest + more));
  GradientLimit limit(table, gradient, radius);
  limit.run(&inside);
  limit.flatten(inside, flat, more, most);
}

Table widths_of_regions(const std::vector<files::WidthRegion>& regions, const WidthFormula& elsewhere,
                        double radius) {
  double least = elsewhere.least();
  for (const files::WidthRegion& region : regions) least = std::min(least, region.width);
  Table t = grid_for(least, radius);
  const std::size_t rows = t.lat.size(), columns = t.lon.size() - 1;
  float* next = t.values.data();
  for (const double lat : t.lat)
    for (const double lon : t.lon)
      *next++ = static_cast<float>(elsewhere.at(point_sets::from_degrees(lon, lat), radius));

  // Wider regions first: narrower ones cut into them.
  std::vector<const files::WidthRegion*> order;
  for (const files::WidthRegion& region : regions) order.push_back(&region);
  std::stable_sort(order.begin(), order.end(),
                   [](const auto* a, const auto* b) { return a->width > b->width; });
  for (const files::WidthRegion* const region : order) {
    const bool is_wide = region->width > elsewhere.most();
    std::vector<bool> inside(rows * columns);
    bool has_places = false;
    for (std::size_t r = 0; r < rows; ++r)
      for_each_inside(*region, t.lat[r], columns, [&](std::size_t c) {
        has_places = inside[r * columns + c] = true;
        float& value = t.values[r * (columns + 1) + c];
        const auto width = static_cast<float>(region->width);
        value = is_wide ? width : std::min(value, width);
        if (c == 0) t.values[r * (columns + 1) + columns] = value;
      });
    const auto fail = [&](const std::string& of) {
      throw std::runtime_error(
          fmt::format("feature {}: it is smaller than {}: enlarge it, make its width smaller, or use a disc",
                      region->feature, of));
    };
    if (region->area() * radius * radius < std::sqrt(3) / 2 * region->width * region->width)
      fail(fmt::format("a cell of {:g} km", region->width));
    if (!has_places) fail(fmt::format("a spacing of the grid, {:.3g} degrees", t.lat[1] - t.lat[0]));
    const double change = is_wide ? region->width - elsewhere.least() : elsewhere.most() - region->width;
    if (region->transition > 0 && change > 0)
      GradientLimit(t, change / region->transition, radius).run(&inside, !is_wide);
  }
  return t;
}

WidthDistance::WidthDistance(const std::string& text) {
  const std::vector<std::string> parts = files::parts_of(text, ':');
  const std::size_t n = parts.size();
  if (n < 4 || !point_sets::parse(parts[n - 3], near) || !point_sets::parse(parts[n - 2], far) ||
      !point_sets::parse(parts[n - 1], distance) || !(near > 0 && far >= near && distance > 0))
    throw std::invalid_argument("'" + files::excerpt(text) +
                                "': expected FILE:NEAR:FAR:KM, NEAR and KM above 0 and FAR at least NEAR");
  file = text.substr(0, text.size() - (parts[n - 3] + parts[n - 2] + parts[n - 1]).size() - 3);
}

Table widths_of_distance(const std::vector<std::vector<std::pair<double, double>>>& lines,
                         const WidthDistance& given, double radius) {
  Table t = grid_for(given.near, radius);
  std::fill(t.values.begin(), t.values.end(), static_cast<float>(given.far));
  const double slope = (given.far - given.near) / given.distance, step = t.lat[1] - t.lat[0];
  const std::size_t columns = t.lon.size() - 1;
  const auto lower_around = [&](double lon, double lat) {
    const Point p = point_sets::from_degrees(lon, lat);
    const auto row = std::min(static_cast<std::size_t>((lat + 90) / step), t.lat.size() - 2);
    const auto column = static_cast<std::size_t>((lon + 900) / step);  // not negative; two turns too far
    for (const std::size_t r : {row, row + 1})
      for (const std::size_t c : {column % columns, (column + 1) % columns}) {
        const Point d = minus(p, point_sets::from_degrees(t.lon[c], t.lat[r]));
        float& value = t.values[r * (columns + 1) + c];
        const double width = given.near + slope * radius * 2 * std::asin(std::sqrt(dot(d, d)) / 2);
        value = std::min(value, static_cast<float>(width));
      }
  };
  for (const auto& line : lines)
    for (std::size_t i = 1; i < line.size(); ++i) {
      const auto [lon, lat] = line[i - 1];
      const auto [to_lon, to_lat] = line[i];
      const bool is_cut = std::fabs(lon) == 180 && std::fabs(to_lon) == 180;
      if (is_cut || std::fabs(lat) == 90 || std::fabs(to_lat) == 90) continue;
      const double east = to_lon - lon, north = to_lat - lat;
      const double pieces = std::ceil(4 * std::max({std::fabs(east), std::fabs(north), step}) / step);
      for (double k = 0; k <= pieces; ++k) lower_around(lon + k / pieces * east, lat + k / pieces * north);
    }
  GradientLimit(t, slope, radius).run();
  return t;
}

/// The integral of 1/(sqrt(3)/2 w^2): Gauss' rule with three points along each side of a cell of the grid.
double cells_of(const Table& t, double radius) {
  constexpr double kPlaces[] = {-0.7745966692414834, 0, 0.7745966692414834}, kWeights[] = {5, 8, 5};  // / 18
  double cells = 0;
  for (std::size_t row = 0; row + 1 < t.lat.size(); ++row) {
    const double south = std::sin(t.lat[row] * kDegree), north = std::sin(t.lat[row + 1] * kDegree);
    const double height = t.lat[row + 1] - t.lat[row];
    for (int j = 0; j < 3; ++j) {
      const double z = (south + north + kPlaces[j] * (north - south)) / 2;
      const double up = (std::asin(z) / kDegree - t.lat[row]) / height;
      double sum = 0;
      for (std::size_t column = 0; column + 1 < t.lon.size(); ++column) {
        const float* const low = &t.values[row * t.lon.size() + column];
        const float* const high = low + t.lon.size();
        const double west = (1 - up) * low[0] + up * high[0], east = (1 - up) * low[1] + up * high[1];
        for (int i = 0; i < 3; ++i) {
          const double ratio = radius / (west + (1 + kPlaces[i]) / 2 * (east - west));
          sum += kWeights[i] / 18 * ratio * ratio * (t.lon[column + 1] - t.lon[column]) * kDegree;
        }
      }
      cells += kWeights[j] / 18 * (north - south) * sum / (std::sqrt(3) / 2);
    }
  }
  return cells;
}

Widths widths_of(Table km, double radius) {
  const double least = *std::min_element(km.values.begin(), km.values.end());
  const double cells = cells_of(km, radius);
  return {
      density_of_widths(least, [table = GridValues(std::move(km))](std::size_t n, const Point* p,
                                                                   double* width) { table.at(n, p, width); }),
      least, cells};
}

double cells_of_width(double width, double radius) {
  const double ratio = radius / width;
  return 4 * kPi / (std::sqrt(3) / 2) * ratio * ratio;
}

}  // namespace methods
