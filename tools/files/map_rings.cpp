#include "files/map_rings.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>

#include "files/measures.h"
#include "geometry/predicates.h"
#include "point_sets.h"

namespace files {
namespace {

constexpr Point kNorthPole{0, 0, 1};
/// Largest distance of straight lines from arcs, and of arcs from parallels: 0.001 and 0.0001 degrees, in
/// radians.
constexpr double kStraight = 0.001 / kRadian, kBent = 0.0001 / kRadian;
/// Arcs longer than 5 degrees are always halved: across the equator an arc is S-shaped and its middle can lie
/// on the straight line. Cosine of 5 degrees.
constexpr double kLong = 0.99619469809174555;
constexpr int kDeepest = 16;
/// Pieces narrower than this, in degrees, result from rounding and are dropped.
constexpr double kThin = kSamePlace * kRadian;

bool is_pole(const MapCorner& c) { return c.p.x == 0 && c.p.y == 0; }
MapCorner pole(double z) { return {{0, 0, std::copysign(1.0, z)}, 0, std::copysign(90.0, z)}; }

bool same_place(const Point& a, const Point& b) {
  const Point d = minus(a, b);
  return dot(d, d) < kSamePlace * kSamePlace;
}

/// The number of turns to add to `lon` so that it is closest to x.
int turn_near(double lon, double x) { return static_cast<int>(std::round((x - lon) / 360)); }

/// p + t (q-p), with the same bits if p and q are exchanged: the cells on both sides of an arc get the same
/// corner.
template <class Part>
Point on_chord(const Point& p, const Point& q, const Part& part) {
  const bool swap = std::tie(q.x, q.y, q.z) < std::tie(p.x, p.y, p.z);
  const Point &a = swap ? q : p, &b = swap ? p : q;
  const double t = part(a, b);
  return {a.x + t * (b.x - a.x), a.y + t * (b.y - a.y), a.z + t * (b.z - a.z)};
}

/// Where the line from p to q meets the meridian lon + 360 turn.
MapCorner at_meridian(const MapCorner& p, const MapCorner& q, double lon, int turn) {
  double lat = p.lat;
  if (p.straight) {
    const double t = (lon + 360.0 * turn - p.x()) / (q.x() - p.x());
    if (q.lat != p.lat) lat += std::clamp(t, 0.0, 1.0) * (q.lat - p.lat);
  } else {
    const Point east{-point_sets::sin_degrees(lon), point_sets::cos_degrees(lon), 0};
    lat = latitude(on_chord(p.p, q.p, [&](const Point& a, const Point& b) {
      const double at_a = dot(east, a), at_b = dot(east, b);
      return at_a == at_b ? 0.5 : std::clamp(at_a / (at_a - at_b), 0.0, 1.0);
    }));
  }
  return {point_sets::from_degrees(lon, lat), lon, lat, turn, p.straight, p.seam};
}

/// Where the line from p to q meets the parallel. The latitude must increase or decrease all along the line.
MapCorner at_parallel(const MapCorner& p, const MapCorner& q, double lat) {
  double lon = p.lon;
  if (!p.straight)
    lon = longitude(on_chord(p.p, q.p, [&](const Point& a, const Point& b) {
      const auto height = [&](double t) {
        return latitude({a.x + t * (b.x - a.x), a.y + t * (b.y - a.y), a.z + t * (b.z - a.z)}) - lat;
      };
      double from = 0, to = 1;
      const bool up = height(1) > height(0);
      for (int step = 0; step < 60; ++step) {
        const double middle = (from + to) / 2;
        ((height(middle) < 0) == up ? from : to) = middle;
      }
      return (from + to) / 2;
    }));
  const int turn = p.straight ? p.turn : turn_near(lon, (p.x() + q.x()) / 2);
  return {point_sets::from_degrees(lon, lat), lon, lat, turn, p.straight, p.seam};
}

/// The ring without corners that equal the next corner.
MapRing without_repeats(const MapRing& ring) {
  MapRing kept;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const MapCorner& next = ring[(i + 1) % ring.size()];
    if (std::fabs(ring[i].x() - next.x()) > kThin || std::fabs(ring[i].lat - next.lat) > kThin)
      kept.push_back(ring[i]);
  }
  return kept;
}

struct Box {
  double west, east, south, north;
  bool is_thin() const { return east - west < kThin || north - south < kThin; }
};
Box box_of(const MapRing& ring) {
  const auto [w, e] = std::minmax_element(ring.begin(), ring.end(),
                                          [](const auto& a, const auto& b) { return a.x() < b.x(); });
  const auto [s, n] = std::minmax_element(ring.begin(), ring.end(),
                                          [](const auto& a, const auto& b) { return a.lat < b.lat; });
  return {w->x(), e->x(), s->lat, n->lat};
}

/// Adds the parts of `ring` on the inner side of a straight line.
///
///          exit   entry  exit   entry     The chains of inner corners end at exits. From each exit, the
///       ----<------>------<------>----    border of its part goes along the line, interior on the left, to
///           |      |      |      |        an entry. Interior and exterior alternate along the line; so the
///           '------'      '------'        k-th exit goes to the k-th entry, counted in this direction, and
///       (here the interior is above)      this remains a pairing where rounding exchanges two of them.
///
/// inside(corner); cross(p, q): where the line from p to q crosses; along(corner): grows in that direction.
template <class Inside, class Cross, class Along>
void cut(const MapRing& ring, const Inside& inside, const Cross& cross, const Along& along,
         std::vector<MapRing>& parts) {
  const std::size_t n = ring.size();
  const auto at = [&](std::size_t i) -> const MapCorner& { return ring[i % n]; };
  std::size_t start = 0;
  while (start < n && (inside(at(start)) || !inside(at(start + 1)))) ++start;
  if (start == n) {
    if (n > 0 && inside(ring[0])) parts.push_back(ring);
    return;
  }
  std::vector<MapRing> chains;
  for (std::size_t i = start; i < start + n; ++i) {
    const bool from = inside(at(i)), to = inside(at(i + 1));
    if (from) chains.back().push_back(at(i));
    if (!from && to) chains.push_back({cross(at(i), at(i + 1))});
    if (from && !to) {
      chains.back().push_back(cross(at(i), at(i + 1)));
      chains.back().back().straight = true;
      chains.back().back().seam = false;
    }
  }
  std::vector<std::size_t> exits(chains.size()), entries(chains.size()), next(chains.size());
  std::iota(exits.begin(), exits.end(), std::size_t{0});
  entries = exits;
  std::sort(exits.begin(), exits.end(),
            [&](std::size_t a, std::size_t b) { return along(chains[a].back()) < along(chains[b].back()); });
  std::sort(entries.begin(), entries.end(), [&](std::size_t a, std::size_t b) {
    return along(chains[a].front()) < along(chains[b].front());
  });
  for (std::size_t k = 0; k < chains.size(); ++k) next[exits[k]] = entries[k];
  for (std::size_t first = 0; first < chains.size(); ++first) {
    MapRing part;
    for (std::size_t k = first; !chains[k].empty(); k = next[k]) {
      part.insert(part.end(), chains[k].begin(), chains[k].end());
      chains[k].clear();
    }
    part = without_repeats(part);
    if (part.size() >= 3 && !box_of(part).is_thin()) parts.push_back(part);
  }
}

/// Corners that differ, with poles where sides lead through them.
MapRing with_poles(const MapRing& ring) {
  MapRing corners;
  const auto add = [&](const MapCorner& c) {
    if (corners.empty() || !same_place(corners.back().p, c.p)) corners.push_back(c);
  };
  for (std::size_t i = 0; i < ring.size(); ++i) {
    MapCorner c{ring[i].p, ring[i].lon, ring[i].lat};
    add(std::hypot(c.p.x, c.p.y) < kSamePlace ? pole(c.p.z) : c);
    const Point &a = ring[i].p, &b = ring[(i + 1) % ring.size()].p, normal = cross(a, b);
    const bool passes =
        std::fabs(normal.z) < kSamePlace * std::sqrt(dot(normal, normal)) && a.x * b.x + a.y * b.y < 0;
    if (passes) add(pole(a.z + b.z));
  }
  while (corners.size() > 1 && same_place(corners.front().p, corners.back().p)) corners.pop_back();
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
  MapRing closed{corner(i).x() == x ? corner(i) : at_meridian(corner(i), corner(i + 1), west, turn)};
  for (std::size_t k = i + 1; k <= i + n; ++k) closed.push_back(corner(k));
  MapCorner end = closed.front(), at_pole = pole(around);
  end.straight = end.seam = at_pole.straight = at_pole.seam = true;
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

/// Finds the point of an arc with the largest or smallest latitude. False if that is an end of the arc.
bool has_apex(const Point& a, const Point& b, Point& apex) {
  const double cosine = dot(a, b);
  const double up_at_a = b.z - cosine * a.z, up_at_b = a.z - cosine * b.z;  // towards the other end
  if (!((up_at_a > 0 && up_at_b > 0) || (up_at_a < 0 && up_at_b < 0))) return false;
  const bool swap = std::tie(b.x, b.y, b.z) < std::tie(a.x, a.y, a.z);
  const Point n = swap ? cross(b, a) : cross(a, b);
  const double sign = up_at_a > 0 ? 1 : -1;
  apex = unit({-sign * n.x * n.z, -sign * n.y * n.z, sign * (n.x * n.x + n.y * n.y)});
  return true;
}

}  // namespace

double wrapped(double lon) { return lon >= -180 && lon <= 180 ? lon : lon - 360 * std::round(lon / 360); }

MapRing ring_of(const Faces& faces, std::size_t face, const LonLat& angles) {
  MapRing ring;
  for (std::size_t k = faces.begin[face]; k < faces.begin[face + 1]; ++k) {
    const auto i = static_cast<std::size_t>(faces.corner[k]) - 1;
    ring.push_back({faces.points[i], wrapped(angles.lon[i]), angles.lat[i]});
  }
  return ring;
}

void expect_no_half_turn(const MapRing& ring, const Faces& faces, std::size_t face) {
  for (std::size_t i = 0; i < ring.size(); ++i)
    if (dot(ring[i].p, ring[(i + 1) % ring.size()].p) < -1 + 1e-12)
      throw NoMesh(
          faces.centres.empty()
              ? fmt::format("two corners of triangle {} are opposite each other: remove one", face + 1)
              : fmt::format("the cell of node {} reaches halfway around the sphere: add nodes elsewhere",
                            faces.node_of(face) + 1));
}

MapRing unrolled(const MapRing& polygon, double west) {
  MapRing corners = with_poles(polygon);
  const auto first =
      std::find_if(corners.begin(), corners.end(), [](const MapCorner& c) { return !is_pole(c); });
  if (corners.size() < 3 || first == corners.end() || width_of(corners) < kSamePlace) return {};
  std::rotate(corners.begin(), first, corners.end());
  corners.push_back(corners.front());
  MapRing ring{corners[0]};
  for (std::size_t i = 1; i < corners.size(); ++i) {
    MapCorner to = corners[i];
    MapCorner& from = ring.back();
    const double x = from.x();
    if (is_pole(to)) {
      from.straight = to.straight = true;
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
      // An arc leads east if the north pole is on its left. The difference of longitudes shows this too,
      // except for arcs close to a pole, whose ends are nearly 180 degrees apart.
      to.turn = turn_near(to.lon, x);
      const int east = pstripack::left(from.p, to.p, kNorthPole);
      const double step = to.x() - x;
      if (east > 0 && step < -90) ++to.turn;
      if (east < 0 && step > 90) --to.turn;
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

std::vector<MapRing> between_meridians(const MapRing& ring, double west, double width) {
  std::vector<MapRing> parts;
  if (ring.empty()) return parts;
  const Box box = box_of(ring);
  for (int turn = static_cast<int>(std::floor((box.west - west - width) / 360));
       west + 360.0 * turn < box.east; ++turn) {
    const double left = west + 360.0 * turn, right = west + width + 360.0 * turn;
    std::vector<MapRing> halves, pieces;
    if (box.west >= left && box.east <= right) {
      pieces.push_back(ring);
    } else if (std::min(box.east, right) - std::max(box.west, left) > kThin) {
      cut(
          ring, [&](const MapCorner& c) { return c.x() <= right; },
          [&](const MapCorner& p, const MapCorner& q) { return at_meridian(p, q, west + width, turn); },
          [](const MapCorner& c) { return c.lat; }, halves);
      for (const MapRing& half : halves)
        cut(
            half, [&](const MapCorner& c) { return c.x() >= left; },
            [&](const MapCorner& p, const MapCorner& q) { return at_meridian(p, q, west, turn); },
            [](const MapCorner& c) { return -c.lat; }, pieces);
    }
    for (MapRing& piece : pieces) {
      for (MapCorner& c : piece) c.turn -= turn;
      parts.push_back(std::move(piece));
    }
  }
  return parts;
}

std::vector<MapRing> between_parallels(const MapRing& ring, double south, double north) {
  MapRing monotone;  // each side that crosses a parallel crosses it once
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const MapCorner &p = ring[i], &q = ring[(i + 1) % ring.size()];
    monotone.push_back(p);
    Point apex;
    if (p.straight || !has_apex(p.p, q.p, apex)) continue;
    // Cut an arc that touches a parallel there: its polygon falls into two parts that touch.
    const bool above = latitude(apex) > north - kThin, below = latitude(apex) < south + kThin;
    const auto crosses = [](bool at_apex, bool at_p, bool at_q) {
      return at_apex != at_p || at_apex != at_q;
    };
    if (!crosses(above, p.lat > north, q.lat > north) && !crosses(below, p.lat < south, q.lat < south))
      continue;
    const double lon = longitude(apex);
    const double lat = above   ? std::max(latitude(apex), north + kThin)
                       : below ? std::min(latitude(apex), south - kThin)
                               : latitude(apex);
    monotone.push_back({apex, lon, lat, turn_near(lon, (p.x() + q.x()) / 2)});
  }
  std::vector<MapRing> lower, parts;
  cut(
      monotone, [&](const MapCorner& c) { return c.lat <= north; },
      [&](const MapCorner& p, const MapCorner& q) { return at_parallel(p, q, north); },
      [](const MapCorner& c) { return -c.x(); }, lower);
  for (const MapRing& part : lower)
    cut(
        part, [&](const MapCorner& c) { return c.lat >= south; },
        [&](const MapCorner& p, const MapCorner& q) { return at_parallel(p, q, south); },
        [](const MapCorner& c) { return c.x(); }, parts);
  return parts;
}

namespace {

/// Appends the arc from a to b in straight pieces, without its two ends.
void add_straight_lines(const MapCorner& a, const MapCorner& b, double tolerance, MapRing& ring,
                        int depth = 0) {
  if (depth == kDeepest) return;
  const double x = (a.x() + b.x()) / 2;
  const Point normal = cross(a.p, b.p), on_line = point_sets::from_degrees(x, (a.lat + b.lat) / 2);
  if (dot(a.p, b.p) > kLong && std::fabs(dot(normal, on_line)) <= tolerance * std::sqrt(dot(normal, normal)))
    return;
  const Point middle = unit({a.p.x + b.p.x, a.p.y + b.p.y, a.p.z + b.p.z});
  const double lon = longitude(middle);
  const MapCorner m{middle, lon, latitude(middle), turn_near(lon, x)};
  add_straight_lines(a, m, tolerance, ring, depth + 1);
  ring.push_back(m);
  add_straight_lines(m, b, tolerance, ring, depth + 1);
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

}  // namespace

MapRing with_straight_lines(const MapRing& ring) {
  // Sides of slivers must not cross: lines are closer to arcs than a fraction of the width.
  constexpr double kClosest = 1e-8, kOfWidth = 0.1;
  const double tolerance = std::clamp(kOfWidth * width_of(ring), kClosest, kStraight);
  MapRing all;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    all.push_back(ring[i]);
    if (!ring[i].straight) add_straight_lines(ring[i], ring[(i + 1) % ring.size()], tolerance, all);
  }
  return area_on_map(all) > 0 ? all : MapRing{};
}

MapRing with_arcs(const MapRing& ring) {
  MapRing all;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const MapCorner &p = ring[i], &q = ring[(i + 1) % ring.size()];
    all.push_back(p);
    if (!p.straight || p.seam || (is_pole(p) && is_pole(q))) continue;
    const double width = q.x() - p.x(), height = q.lat - p.lat;
    // The middle of an arc of w radians between equal latitudes is w^2 sin(2 lat)/16 from the parallel.
    const double bend = std::fabs(point_sets::sin_degrees(2 * p.lat));
    const double step = std::min(90.0, kRadian * 4 * std::sqrt(kBent / std::max(bend, 1e-9)));
    const double pieces = std::ceil(std::max(std::fabs(width) / step, std::fabs(height) / 90));
    for (double k = 1; k < pieces; ++k) {
      const double lon = wrapped(p.x() + width * (k / pieces)), lat = p.lat + height * (k / pieces);
      all.push_back(
          {point_sets::from_degrees(lon, lat), lon, lat, turn_near(lon, p.x() + width * (k / pieces))});
    }
  }
  return all;
}

}  // namespace files
