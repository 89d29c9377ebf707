#include "pictures/view.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>

#include "files/map_rings.h"
#include "files/measures.h"
#include "point_sets.h"

namespace pictures {
namespace {

using pstripack::cross;
using pstripack::dot;

/// A piece looks straight if its middle is at most this many pixels off.
constexpr double kStraight = 0.05;
/// Longer pieces are always cut: the middle of an S-shaped piece can lie on the straight line. Cosine of 10
/// degrees.
const double kLong = std::cos(10 / files::kRadian);
constexpr int kDeepest = 16;

Point middle_of(const Point& a, const Point& b) {
  const Point sum{a.x + b.x, a.y + b.y, a.z + b.z};
  if (dot(sum, sum) > 1e-24) return point_sets::normalized(sum);
  // Antipodal points: any connecting arc is equally long.
  return point_sets::normalized(cross(a, std::fabs(a.z) < 0.9 ? Point{0, 0, 1} : Point{0, 1, 0}));
}

double distance_from_line(const Place& p, const Place& a, const Place& b) {
  const double x = b.x - a.x, y = b.y - a.y, length = std::hypot(x, y);
  if (length < 1e-9) return std::hypot(p.x - a.x, p.y - a.y);
  return std::fabs(x * (p.y - a.y) - y * (p.x - a.x)) / length;
}

/// True if a piece from a over its middle m to b lies completely outside the frame, so that its curvature
/// does not matter. `turn`: pixels after which the map repeats to the right; 0: it does not.
bool misses(const Place& a, const Place& m, const Place& b, const Frame& frame, double turn) {
  const double bend = 2 * distance_from_line(m, a, b);
  if (std::max({a.y, m.y, b.y}) + bend < frame.top || std::min({a.y, m.y, b.y}) - bend > frame.bottom)
    return true;
  const double left = std::min({a.x, m.x, b.x}) - bend, right = std::max({a.x, m.x, b.x}) + bend;
  if (turn == 0) return right < frame.left || left > frame.right;
  return std::ceil((frame.left - right) / turn) > std::floor((frame.right - left) / turn);
}

/// The part of the outline where inside(p) >= 0; inside is linear.
template <class Item, class Inside, class Between>
std::vector<Item> cut(const std::vector<Item>& outline, const Inside& inside, const Between& between) {
  std::vector<Item> kept;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Item &p = outline[i], &q = outline[(i + 1) % outline.size()];
    const double at_p = inside(p), at_q = inside(q);
    if (at_p >= 0) kept.push_back(p);
    if ((at_p > 0 && at_q < 0) || (at_p < 0 && at_q > 0)) kept.push_back(between(p, q, at_p / (at_p - at_q)));
  }
  return kept;
}

Place between(const Place& a, const Place& b, double t) {
  return {a.x + t * (b.x - a.x), a.y + t * (b.y - a.y)};
}

/// The number without trailing zeros.
std::string number(double degrees, int decimals) {
  const double factor = std::pow(10, decimals);
  char text[40];
  std::snprintf(text, sizeof text, "%.10g", std::round(std::fabs(degrees) * factor) / factor);
  return text;
}

/// The equal longitude that is nearest to `near`.
double turned_to(double lon, double near) { return lon + 360 * std::round((near - lon) / 360); }

/// How far the place is inside the four sides.
std::array<double, 4> inside(const Place& p, const Frame& frame) {
  return {p.x - frame.left, frame.right - p.x, p.y - frame.top, frame.bottom - p.y};
}

/// The part of an outline inside the frame. It follows the frame's border where the outline leaves the frame.
Outline clipped_polygon(Outline outline, const Frame& frame) {
  for (std::size_t side = 0; side < 4; ++side) {
    const auto depth = [&](const Place& p) { return inside(p, frame)[side]; };
    outline = cut(outline, depth, between);
  }
  return outline;
}

/// The parts of a line in the frame.
std::vector<Outline> clipped_line(const Outline& line, const Frame& frame) {
  std::vector<Outline> parts;
  bool goes_on = false;  // with the last part
  for (std::size_t i = 0; i + 1 < line.size(); ++i) {
    const Place &a = line[i], &b = line[i + 1];
    double from = 0, to = 1;  // Liang & Barsky 1984
    for (std::size_t side = 0; side < 4; ++side) {
      const double at_a = inside(a, frame)[side], at_b = inside(b, frame)[side];
      if (at_a < 0 && at_b < 0) from = 2;
      if (at_a < 0 && at_b >= 0) from = std::max(from, at_a / (at_a - at_b));
      if (at_a >= 0 && at_b < 0) to = std::min(to, at_a / (at_a - at_b));
    }
    if (from > to) {
      goes_on = false;
      continue;
    }
    if (!goes_on || from > 0) parts.push_back({from > 0 ? between(a, b, from) : a});
    parts.back().push_back(to < 1 ? between(a, b, to) : b);
    goes_on = to == 1;
  }
  return parts;
}

/// Half of the longitudes of a cap, in degrees.
double half_width(const Spot& centre, double radius) {
  if (std::fabs(centre.lat) + radius >= 90) return 180;
  return files::kRadian * std::asin(point_sets::sin_degrees(radius) / point_sets::cos_degrees(centre.lat));
}

/// The point where the chord between two turned points on both sides of the limb meets it.
Point on_limb(const Point& a, const Point& b, double t) {
  Point p = {a.x + t * (b.x - a.x), a.y + t * (b.y - a.y), 0};
  const double length = std::hypot(p.x, p.y);
  return {p.x / length, p.y / length, 0};
}

/// 90 or -90 for a pole, 0 for other points.
double pole_at(const Point& p) {
  constexpr double kNear = 1e-9;
  return std::fabs(p.x) < kNear && std::fabs(p.y) < kNear ? std::copysign(90.0, p.z) : 0;
}

/// True if the arc from a to b leads through a pole between them.
bool leads_over_pole(const Point& a, const Point& b) {
  const Point normal = cross(a, b);
  // The great circle contains both poles, but the arc from a to b need not.
  return std::fabs(normal.z) <= 1e-9 * std::sqrt(dot(normal, normal)) && a.x * b.x + a.y * b.y <= 0;
}

}  // namespace

Spot spot_of(const Point& p) { return {files::longitude(p), files::latitude(p)}; }

std::string name_of_longitude(double lon, int decimals) {
  lon = turned_to(lon, 0);
  const std::string size = number(lon, decimals);
  return size + "°" + (size == "0" || size == "180" ? "" : lon < 0 ? "W" : "E");
}

std::string name_of_latitude(double lat, int decimals) {
  const std::string size = number(lat, decimals);
  return size + "°" + (size == "0" ? "" : lat < 0 ? "S" : "N");
}

// ---- orthographic -----------------------------------------------------------------------------------------

Orthographic::Orthographic(const Spot& centre, double radius, const Frame& frame)
    : eye_(point_sets::from_degrees(centre.lon, centre.lat)),
      east_{-point_sets::sin_degrees(centre.lon), point_sets::cos_degrees(centre.lon), 0},
      north_(cross(eye_, east_)),
      middle_{(frame.left + frame.right) / 2, (frame.top + frame.bottom) / 2} {
  is_disc_ = radius >= 90;
  const double half = std::min(frame.width(), frame.height()) / 2;
  frame_ = {middle_.x - half, middle_.y - half, middle_.x + half, middle_.y + half};
  scale_ = is_disc_ ? half : half / point_sets::sin_degrees(radius);
  // The corners of the square are farther from the centre than its sides.
  const double reach = files::kRadian * std::asin(std::min(1.0, std::sqrt(2.0) * half / scale_)),
               east = half_width(centre, reach);
  bounds_ = {centre.lon - east, centre.lon + east, std::max(-90.0, centre.lat - reach),
             std::min(90.0, centre.lat + reach)};
}

std::optional<Place> Orthographic::place(const Point& p) const {
  const Point t = turned(p);
  const Place q = on_paper(t);
  const bool seen =
      t.z >= 0 && q.x >= frame_.left && q.x <= frame_.right && q.y >= frame_.top && q.y <= frame_.bottom;
  return seen ? std::optional(q) : std::nullopt;
}

/// Appends the arc, turned, without its first point.
void Orthographic::add_arc(const Point& a, const Point& b, Outline& outline, int depth) const {
  const Point m = middle_of(a, b);
  const Place from = on_paper(a), middle = on_paper(m), to = on_paper(b);
  const bool halve =
      depth < kDeepest && (dot(a, b) < kLong || (distance_from_line(middle, from, to) > kStraight &&
                                                 (is_disc_ || !misses(from, middle, to, frame_, 0))));
  if (halve) {
    add_arc(a, m, outline, depth + 1);
    add_arc(m, b, outline, depth + 1);
  } else {
    outline.push_back(to);
  }
}

// Cut at the limb:
//
//        b .---.            a b c is cut to a b p q. The side from p to q runs along the limb,
//         /     \ p         which is a great circle.
//      a '--.    '.
//            '--. :\        A convex polygon whose corners are all behind the limb is behind it.
//               q'--' c
std::vector<Outline> Orthographic::polygon(const std::vector<Point>& corners) const {
  std::vector<Point> all;
  for (const Point& p : corners) all.push_back(turned(p));
  const std::vector<Point> seen = cut(
      all, [](const Point& p) { return p.z; }, on_limb);
  if (seen.size() < 3) return {};
  Outline outline;
  for (std::size_t i = 0; i < seen.size(); ++i) add_arc(seen[i], seen[(i + 1) % seen.size()], outline);
  if (!is_disc_) outline = clipped_polygon(outline, frame_);
  if (outline.size() < 3) return {};
  return {outline};
}

std::vector<Outline> Orthographic::arc(const Point& a, const Point& b) const {
  Point p = turned(a), q = turned(b);
  if (p.z < 0 && q.z < 0) return {};
  const double t = p.z / (p.z - q.z);
  if (p.z < 0)
    p = on_limb(p, q, t);
  else if (q.z < 0)
    q = on_limb(p, q, t);
  Outline line{on_paper(p)};
  add_arc(p, q, line);
  if (is_disc_) return {line};
  return clipped_line(line, frame_);
}

// ---- longitude and latitude -------------------------------------------------------------------------------

LonLat::LonLat(const Spot& centre, double radius, const Frame& frame) {
  const bool all = radius >= 90;
  const double half = all ? 180 : half_width(centre, radius);
  bounds_ = {centre.lon - half, centre.lon + half, all ? -90 : std::max(-90.0, centre.lat - radius),
             all ? 90 : std::min(90.0, centre.lat + radius)};
  fill(frame, all ? 1 : std::max(0.05, point_sets::cos_degrees(centre.lat)));
}

LonLat::LonLat(const files::Region& region, const Frame& frame) {
  bounds_ = region;
  fill(frame, std::max(0.05, point_sets::cos_degrees((region.south + region.north) / 2)));
}

void LonLat::fill(const Frame& frame, double squeezed) {
  per_lat_ = std::min(frame.width() / (squeezed * (bounds_.east - bounds_.west)),
                      frame.height() / (bounds_.north - bounds_.south));
  per_lon_ = per_lat_ * squeezed;
  const double width = per_lon_ * (bounds_.east - bounds_.west), middle = (frame.left + frame.right) / 2;
  frame_ = {middle - width / 2, frame.top, middle + width / 2,
            frame.top + per_lat_ * (bounds_.north - bounds_.south)};
}

/// Appends the points of the arc, without b, between which it looks straight.
void LonLat::add_arc(const Point& a, const Point& b, std::vector<Point>& points, int depth) const {
  if (pole_at(a) != 0) return points.push_back({0, 0, std::copysign(1.0, a.z)});
  if (pole_at(b) == 0 && leads_over_pole(a, b)) {
    points.push_back(a);
    return points.push_back({0, 0, std::copysign(1.0, a.z + b.z)});
  }
  const Point m = middle_of(a, b);
  const Spot from = spot_of(a);
  Spot middle = spot_of(m), to = spot_of(b);
  to.lon = turned_to(to.lon, from.lon);
  middle.lon = turned_to(middle.lon, (from.lon + to.lon) / 2);
  const Place p = on_paper(from), q = on_paper(middle), r = on_paper(to);
  const bool bent = distance_from_line(q, p, r) > kStraight && !misses(p, q, r, frame_, 360 * per_lon_);
  if (depth == kDeepest || pole_at(b) != 0 ||
      (dot(a, b) >= kLong && std::fabs(to.lon - from.lon) <= 10 && !bent))
    return points.push_back(a);
  add_arc(a, m, points, depth + 1);
  add_arc(m, b, points, depth + 1);
}

/// Calls visit(longitude of the turn) for each copy of what reaches from `from` to `to` that is in view.
template <class Visit>
void LonLat::for_each_turn(double from, double to, const Visit& visit) const {
  for (double turn = 360 * std::ceil((bounds_.west - to) / 360); from + turn <= bounds_.east; turn += 360)
    visit(turn);
}

double LonLat::scale() const { return per_lat_ * files::kRadian; }

std::optional<Place> LonLat::place(const Point& p) const {
  Spot s = spot_of(p);
  s.lon = turned_to(s.lon, (bounds_.west + bounds_.east) / 2);
  if (s.lon < bounds_.west || s.lon > bounds_.east || s.lat < bounds_.south || s.lat > bounds_.north)
    return std::nullopt;
  return on_paper(s);
}

std::vector<Outline> LonLat::polygon(const std::vector<Point>& corners) const {
  std::vector<Point> points;
  for (std::size_t i = 0; i < corners.size(); ++i)
    add_arc(corners[i], corners[(i + 1) % corners.size()], points);
  files::MapRing ring;
  for (const Point& p : points) ring.push_back({p, spot_of(p).lon, spot_of(p).lat});
  ring = files::unrolled(ring, bounds_.west);
  std::vector<Outline> parts;
  if (ring.empty()) return parts;
  const auto [low, high] = std::minmax_element(ring.begin(), ring.end(),
                                               [](const auto& a, const auto& b) { return a.x() < b.x(); });
  for_each_turn(low->x(), high->x(), [&](double turn) {
    Outline outline;
    for (const files::MapCorner& c : ring) outline.push_back(on_paper({c.x() + turn, c.lat}));
    outline = clipped_polygon(outline, frame_);
    if (outline.size() >= 3) parts.push_back(outline);
  });
  return parts;
}

std::vector<Outline> LonLat::arc(const Point& a, const Point& b) const {
  std::vector<Point> points;
  add_arc(a, b, points);
  points.push_back(b);
  std::vector<std::vector<Spot>> lines(1);  // they end at poles
  for (std::size_t i = 0; i < points.size(); ++i) {
    Spot s = spot_of(points[i]);
    std::vector<Spot>& line = lines.back();
    if (!line.empty()) s.lon = turned_to(s.lon, line.back().lon);
    if (const double pole = pole_at(points[i]); pole == 0) {
      line.push_back(s);
    } else {
      if (!line.empty()) line.push_back({line.back().lon, pole});
      if (i + 1 < points.size()) lines.push_back({{spot_of(points[i + 1]).lon, pole}});
    }
  }
  std::vector<Outline> parts;
  for (const std::vector<Spot>& line : lines) {
    if (line.empty()) continue;
    const auto [low, high] = std::minmax_element(line.begin(), line.end(),
                                                 [](const Spot& s, const Spot& t) { return s.lon < t.lon; });
    for_each_turn(low->lon, high->lon, [&](double turn) {
      Outline outline;
      for (const Spot& s : line) outline.push_back(on_paper({s.lon + turn, s.lat}));
      for (Outline& part : clipped_line(outline, frame_)) parts.push_back(std::move(part));
    });
  }
  return parts;
}

}  // namespace pictures
