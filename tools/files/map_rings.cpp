#include "files/map_rings.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>
#include <tuple>

#include "files/cut_rings.h"
#include "files/measures.h"
#include "geometry/predicates.h"
#include "point_sets.h"

namespace files {
namespace {

constexpr Point kNorthPole{0, 0, 1};
/// Largest distance of straight lines from arcs: 0.001 degrees, in radians.
constexpr double kStraight = 0.001 / kRadian;
/// Rounding of corners, in radians: what is closer to a pole is at the pole, what is narrower is a line.
constexpr double kRounding = 1e-15;
/// Corners closer than this to a meridian, in degrees, are on it.
constexpr double kThin = kSamePlace * kRadian;

double distance(const Point& a, const Point& b) { return length(minus(a, b)); }

bool is_pole(const MapCorner& c) { return c.p.x == 0 && c.p.y == 0; }
MapCorner pole(double z) { return {{0, 0, std::copysign(1.0, z)}, 0, std::copysign(90.0, z)}; }

bool is_at_pole(const Point& p) { return p.x * p.x + p.y * p.y < kRounding * kRounding; }
bool leads_through_pole(const Point& a, const Point& b) {
  if (a.x * b.x + a.y * b.y >= 0) return false;
  const Point normal = cross(a, minus(b, a));
  return std::fabs(normal.z) < kRounding * length(normal);
}

/// Such arcs follow meridians.
bool leads_to_pole(const Point& a, const Point& b) {
  return is_at_pole(a) || is_at_pole(b) || leads_through_pole(a, b);
}

/// A line has the same bits in the faces on both sides if its ends are exchanged where this is true.
bool is_backward(const Point& from, const Point& to) {
  return std::tie(to.x, to.y, to.z) < std::tie(from.x, from.y, from.z);
}

/// The number of turns to add to `lon` so that it is closest to x.
int turn_near(double lon, double x) { return static_cast<int>(std::round((x - lon) / 360)); }

/// The turn of `to` if an arc leads there from `from`.
int turn_after(const MapCorner& from, const MapCorner& to) {
  // The difference of longitudes shows the direction, except for arcs close to a pole, whose ends are nearly
  // 180 degrees apart. An arc leads east if the north pole is on its left.
  const int turn = turn_near(to.lon, from.x());
  const double step = to.lon + 360.0 * turn - from.x();
  if (std::fabs(step) <= 90) return turn;
  const int east = pstripack::left(from.p, to.p, kNorthPole);
  return step < 0 ? turn + (east > 0) : turn - (east < 0);
}

/// Where the line from p to q meets the meridian lon + 360 turn; p or q if it is there.
MapCorner at_meridian(const MapCorner& p, const MapCorner& q, double lon, int turn) {
  const double x = lon + 360.0 * turn;
  if (p.x() == x || q.x() == x) return p.x() == x ? p : q;
  // The same bits if p and q are exchanged, and for all turns.
  const auto [a, b] = is_backward(p.p, q.p) ? std::tie(q, p) : std::tie(p, q);
  const double to_line = 360.0 * (turn - a.turn) + lon - a.lon,
               to_b = 360.0 * (b.turn - a.turn) + b.lon - a.lon,
               lat = a.lat + std::clamp(to_line / to_b, 0.0, 1.0) * (b.lat - a.lat);
  return {point_sets::from_degrees(lon, lat), lon, lat, turn};
}

/// The ring without corners that equal the next corner.
MapRing without_repeats(const MapRing& ring) {
  MapRing kept;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const MapCorner& next = ring[(i + 1) % ring.size()];
    if (ring[i].x() != next.x() || ring[i].lat != next.lat) kept.push_back(ring[i]);
  }
  return kept;
}

/// Moves corners to the meridians lon + 360 k if they are as close as rounding. What is cut off at a meridian
/// is then no sliver that rounding makes. Their vectors stay: they tell that corners are the same.
void move_to_meridian(MapRing& ring, double lon) {
  for (MapCorner& c : ring)
    if (std::fabs(c.lon - lon - 360 * turn_near(lon, c.lon)) < kThin) {
      c.turn = turn_near(lon, c.x());
      c.lon = lon;
    }
}

/// Moves corners closer than kSamePlace to a pole to the pole, where longitudes are rounding.
void move_to_poles(MapRing& ring) {
  for (MapCorner& c : ring)
    if (c.p.x * c.p.x + c.p.y * c.p.y < kSamePlace * kSamePlace) c = pole(c.p.z);
}

/// Corners that differ, with poles where arcs lead through them.
MapRing with_poles(const MapRing& ring) {
  MapRing corners;
  const auto add = [&](const MapCorner& c) {
    if (corners.empty() || corners.back().p != c.p) corners.push_back(c);
  };
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Point &a = ring[i].p, &b = ring[(i + 1) % ring.size()].p;
    add(is_at_pole(a) ? pole(a.z) : MapCorner{a, ring[i].lon, ring[i].lat});
    if (leads_through_pole(a, b)) add(pole(a.z + b.z));
  }
  while (corners.size() > 1 && corners.front().p == corners.back().p) corners.pop_back();
  return corners;
}

/// Closes a ring that goes once around a pole, eastwards (north pole) or westwards:
///
///       pole 2 ---<--- pole 1         the same for the south pole, upside down and
///            |         |              from right to left
///       begin ..>..>.. end
///       west           west + 360
MapRing closed_at_pole(const MapRing& ring, double west, int around) {
  const std::size_t n = ring.size();
  const double from = ring[0].x();
  // The cut: the meridian `west` on the way from the first corner to itself, 360 degrees further.
  const int turn =
      static_cast<int>(around > 0 ? std::ceil((from - west) / 360) : std::floor((from - west) / 360));
  const double x = west + 360.0 * turn;
  const auto corner = [&](std::size_t i) {
    MapCorner c = ring[i % n];
    c.turn += static_cast<int>(i / n) * around;
    return c;
  };
  std::size_t i = 0;
  while (i + 1 < n && around * corner(i + 1).x() <= around * x) ++i;
  MapRing closed{at_meridian(corner(i), corner(i + 1), west, turn)};
  for (std::size_t k = i + 1; k <= i + n; ++k) closed.push_back(corner(k));
  MapCorner end = closed.front(), at_pole = pole(around);
  at_pole.lon = west;
  end.turn += around;
  at_pole.turn = turn + around;
  closed.push_back(end);
  closed.push_back(at_pole);
  at_pole.turn = turn;
  closed.push_back(at_pole);
  return without_repeats(closed);
}

/// Width of a polygon: area over perimeter, in radians.
double width_of(const MapRing& ring) {
  Point sum{0, 0, 0};
  for (const MapCorner& c : ring) sum = {sum.x + c.p.x, sum.y + c.p.y, sum.z + c.p.z};
  if (dot(sum, sum) < 1e-12) return 1;  // the ring is a great circle
  const Point centre = unit(sum);
  double area = 0, length = 0;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Point &p = ring[i].p, &q = ring[(i + 1) % ring.size()].p;
    area += triangle_area(centre, p, q);
    length += angle_between(p, q);
  }
  return std::fabs(area) / length;
}

}  // namespace

double wrapped(double lon) { return lon >= -180 && lon <= 180 ? lon : lon - 360 * std::round(lon / 360); }

std::vector<std::int32_t> merged_corners(const Faces& faces) {
  std::vector<std::int32_t> first(faces.points.size() + 1);
  std::iota(first.begin(), first.end(), 0);
  const auto find = [&](std::int32_t i) {
    const auto of = [&](std::int32_t k) -> std::int32_t& { return first[static_cast<std::size_t>(k)]; };
    while (of(i) != i) i = of(i) = of(of(i));
    return i;
  };
  faces.for_each_corner([&](std::size_t f, std::size_t k) {
    const std::size_t next = faces.after(f, k);
    if (distance(faces.point(k), faces.point(next)) >= kSamePlace) return;
    const std::int32_t a = find(faces.corner[k]), b = find(faces.corner[next]);
    first[static_cast<std::size_t>(std::max(a, b))] = std::min(a, b);
  });
  std::vector<std::int32_t> merged(faces.corner.size());
  for (std::size_t k = 0; k < merged.size(); ++k) merged[k] = find(faces.corner[k]);
  return merged;
}

MapCorner corner_at(const Faces& faces, std::int32_t corner, const LonLat& angles) {
  const auto i = static_cast<std::size_t>(corner) - 1;
  return {faces.points[i], wrapped(angles.lon[i]), angles.lat[i]};
}

MapRing ring_of(const Faces& faces, std::size_t face, const LonLat& angles,
                const std::vector<std::int32_t>& corner) {
  MapRing ring;
  for (std::size_t k = faces.begin[face]; k < faces.begin[face + 1]; ++k)
    ring.push_back(corner_at(faces, corner[k], angles));
  return ring;
}

MapRing unrolled(const MapRing& polygon, double west) {
  MapRing corners = with_poles(polygon);
  move_to_meridian(corners, west);
  const auto first =
      std::find_if(corners.begin(), corners.end(), [](const MapCorner& c) { return !is_pole(c); });
  if (corners.size() < 3 || first == corners.end() || width_of(corners) < kRounding) return {};
  std::rotate(corners.begin(), first, corners.end());
  corners.push_back(corners.front());
  MapRing ring{corners[0]};
  for (std::size_t i = 1; i < corners.size(); ++i) {
    MapCorner to = corners[i];
    MapCorner& from = ring.back();
    const double x = from.x();
    if (is_pole(to)) {
      to.lon = from.lon;
      to.turn = from.turn;
    } else if (is_pole(from)) {
      // The interior is on the left: a line that leaves the north pole has it to the west, at most 180
      // degrees wide.
      to.turn = static_cast<int>(from.lat > 0 ? std::floor((x + 90 - to.lon) / 360)
                                              : std::ceil((x - 90 - to.lon) / 360));
      MapCorner leaving = from;
      leaving.lon = to.lon;
      leaving.turn = to.turn;
      ring.push_back(leaving);
    } else {
      to.turn = turn_after(from, to);
    }
    ring.push_back(to);
  }
  const int around = ring.back().turn - ring.front().turn;
  ring.pop_back();
  if (around == 0) return without_repeats(ring);
  // A polygon with a corner at the pole does not contain the pole, whatever `around` says: the corner is
  // wider than 180 degrees.
  for (std::size_t k = 0; k + 1 < ring.size(); ++k)
    if (is_pole(ring[k]) && is_pole(ring[k + 1]) && (ring[k].lat > 0) == (around > 0)) {
      for (std::size_t i = k + 1; i < ring.size(); ++i) ring[i].turn -= around;
      return without_repeats(ring);
    }
  return closed_at_pole(ring, west, around);
}

std::vector<MapRing> cut_at_dateline(MapRing ring) {
  std::vector<MapRing> parts;
  if (ring.empty()) return parts;
  move_to_meridian(ring, -180);
  const auto [low, high] = std::minmax_element(ring.begin(), ring.end(),
                                               [](const auto& a, const auto& b) { return a.x() < b.x(); });
  const double west = low->x(), east = high->x();
  for (int turn = static_cast<int>(std::floor((west + 180) / 360)); 360.0 * turn - 180 < east; ++turn) {
    std::vector<MapRing> pieces{ring};
    for (const int side : {-1, 1}) {
      const int at = side < 0 ? turn : turn + 1;
      pieces = cut_rings(
          pieces, [&](const MapCorner& c) { return side * (c.x() - (360.0 * at - 180)) <= 0; },
          [&](const MapCorner& p, const MapCorner& q, bool) { return at_meridian(p, q, -180, at); },
          [&](const MapCorner& c) { return side * c.lat; });
    }
    for (MapRing& piece : pieces) {
      for (MapCorner& c : piece) c.turn -= turn;
      parts.push_back(without_repeats(piece));
    }
  }
  return parts;
}

namespace {

/// Throws NoMesh, naming the triangle, if a side is a half turn: its ends do not determine its great circle.
/// Cells have none: voronoi_cells() divides them.
void expect_no_half_turn(const MapRing& ring, std::size_t face) {
  for (std::size_t i = 0; i < ring.size(); ++i)
    if (dot(ring[i].p, ring[(i + 1) % ring.size()].p) < -1 + 1e-12)
      throw NoMesh("two corners of triangle " + std::to_string(face + 1) +
                   " are opposite each other: remove one");
}

/// Twice the area of the ring on the map; positive if counterclockwise.
double area_on_map(const MapRing& ring) {
  double sum = 0;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const MapCorner &p = ring[i], &q = ring[(i + 1) % ring.size()];
    sum += (p.x() - ring[0].x()) * (q.lat - ring[0].lat) - (q.x() - ring[0].x()) * (p.lat - ring[0].lat);
  }
  return sum;
}

/// Largest distance from an arc to the straight line between its ends on the map, which is f(t)/4 or less at
/// t and 1-t of the way, f = 4t(1-t) times this.
///
/// Let X(t) be the point of the line, n the unit normal of the arc, f(t) = n X(t), so f(0) = f(1) = 0 and
/// |f(t)| <= t(1-t)/2 max |f''|. With width w and height h of the line on the map, in radians, and t(X) the
/// eastern unit vector at X, f'' = n_z sin(lat) w^2 - 2 sin(lat) (n t(X)) w h + r, |r| <= (w^2+h^2) max |f|.
/// n t(X) differs from its value in the middle by n_z tan(lat) w/2 or less. 1.15 is for r, if w <= 1 and
/// h <= 0.1.
double distance_of_line(const MapCorner& a, const MapCorner& b) {
  const double w = std::fabs(a.x() - b.x()) / kRadian, h = std::fabs(a.lat - b.lat) / kRadian;
  const Point n = cross(a.p, minus(b.p, a.p)), sum{a.p.x + b.p.x, a.p.y + b.p.y, 0};
  const double sine = std::max(std::fabs(a.p.z), std::fabs(b.p.z)) + h;
  const double cosine = std::sqrt(std::min(a.p.x * a.p.x + a.p.y * a.p.y, b.p.x * b.p.x + b.p.y * b.p.y));
  const double up = std::fabs(n.z) / length(n);
  const double east = std::fabs(n.y * sum.x - n.x * sum.y) / (length(n) * length(sum));
  return 1.15 / 8 * sine * w * (up * w + 2 * h * (east + up * w * sine / (2 * cosine)));
}

/// True if the straight line on the map is as close to the arc as MapLines promises.
bool is_close(const MapCorner& a, const MapCorner& b) {
  constexpr double kLong = 0.99619469809174555;  // cosine of 5 degrees: longer arcs are always halved
  constexpr double kOfLength = 0.01;
  if (a.x() == b.x()) return true;
  if (dot(a.p, b.p) < kLong || std::fabs(a.x() - b.x()) > kRadian) return false;
  const double off = distance_of_line(a, b);
  return off < kRounding || off < std::min(kStraight, kOfLength * distance(a.p, b.p));
}

/// Halves the arc until the lines between the corners are close to it, and adds those between a and b.
void add_corners(const MapCorner& a, const MapCorner& b, int depth, MapRing& ring) {
  constexpr int kDeepest = 50;
  if (depth == kDeepest || is_close(a, b)) return;
  const Point middle = unit({a.p.x + b.p.x, a.p.y + b.p.y, a.p.z + b.p.z});
  const double lon = longitude(middle);
  const MapCorner m{middle, lon, latitude(middle), turn_near(lon, (a.x() + b.x()) / 2)};
  add_corners(a, m, depth + 1, ring);
  ring.push_back(m);
  add_corners(m, b, depth + 1, ring);
}

}  // namespace

MapLines::MapLines(const Faces& faces)
    : faces_(faces),
      angles_(angles_of(faces.points, faces.given_points, true)),
      corner_(merged_corners(faces)) {}

MapRing MapLines::corners_between(std::int32_t from, std::int32_t to) const {
  MapRing corners;
  if (from == to || leads_to_pole(point(from), point(to))) return corners;
  const MapCorner low = at(std::min(from, to));
  MapCorner high = at(std::max(from, to));
  high.turn = turn_after(low, high);
  add_corners(low, high, 0, corners);
  if (from > to) std::reverse(corners.begin(), corners.end());
  return corners;
}

std::vector<MapRing> MapLines::polygons(std::size_t face) const {
  MapRing corners = ring_of(faces_, face, angles_, corner_);
  expect_no_half_turn(corners, face);
  move_to_poles(corners);
  MapRing ring;
  for (std::size_t k = 0; k < corners.size(); ++k) {
    ring.push_back(corners[k]);
    const Point &a = corners[k].p, &b = corners[(k + 1) % corners.size()].p;
    if (a == b || leads_to_pole(a, b)) continue;
    const std::size_t slot = faces_.begin[face] + k;
    const MapRing between = corners_between(corner_[slot], corner_[faces_.after(face, slot)]);
    ring.insert(ring.end(), between.begin(), between.end());
  }
  std::vector<MapRing> polygons;
  for (MapRing& part : cut_at_dateline(unrolled(ring, -180)))
    if (area_on_map(part) > 0) polygons.push_back(std::move(part));
  return polygons;
}

}  // namespace files
