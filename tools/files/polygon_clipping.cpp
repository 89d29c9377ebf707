// Voronoi cells cut at polygons, on a plane on which the borders of cells are straight: seen from the centre
// of the sphere, the plane that touches it in the middle of the polygon. A cell is what lies on the left of
// each of its sides, so a polygon with holes is cut along one line after the other. Coordinates are
// differences from the middle: a polygon of metres has as many digits as one of continents.
#include <algorithm>
#include <array>
#include <boost/functional/hash.hpp>
#include <cmath>
#include <cstdint>
#include <map>
#include <optional>
#include <sstream>
#include <string>
#include <tuple>
#include <unordered_map>
#include <utility>

#include "files/clipping.h"
#include "files/cut_rings.h"
#include "files/measures.h"
#include "files/pieces.h"
#include "geometry/predicates.h"
#include "point_sets.h"

namespace files {
namespace {

using Place = std::pair<double, double>;  // longitude and latitude, degrees

/// What is nearer to a line than this, in radians, is on it: 13 nm on the Earth. Corners and nodes are
/// rounded to 2e-16, lines on a plane to a few times as much.
constexpr double kOnLine = 2e-15;
/// Parts narrower than this are left out.
constexpr double kThin = 4 * kOnLine;
/// Arcs may change the area of a polygon by this part of it. A piece of the plane between an arc and a curve
/// that is at most d away from it, and as a parabola, has two thirds of d times the length.
constexpr double kOfArea = 1e-6;
/// Points nearer than this, in radians, are one corner: they are rounded in other planes.
constexpr double kSameCorner = 1e-14;

/// On a plane, or on the map: longitude and latitude.
struct Corner {
  double u, v;
  std::int32_t place = -1;  ///< which corner of the polygon it is; -1: none
  bool drawn = true;        ///< the side to the next corner is one of the polygon, not of a cell
};
using Ring = std::vector<Corner>;
using Rings = std::vector<Ring>;  ///< interior on the left: outlines counterclockwise, holes clockwise

/// Of what lies on its left, side() is positive. a*a + b*b = 1.
struct Line {
  double a, b, c;

  double side(const Corner& p) const { return a * p.u + b * p.v + c; }
  Line reversed() const { return {-a, -b, -c}; }
};

Rings cut(const Rings& rings, const Line& line) {
  return cut_rings(
      rings, [&](const Corner& p) { return line.side(p) > kOnLine; },
      [&](const Corner& p, const Corner& q, bool leaves) {
        const double at_p = line.side(p), t = std::clamp(at_p / (at_p - line.side(q)), 0.0, 1.0);
        Corner c = t == 0 ? p : t == 1 ? q : Corner{p.u + t * (q.u - p.u), p.v + t * (q.v - p.v)};
        c.drawn = !leaves && p.drawn;
        return c;
      },
      [&](const Corner& p) { return line.b * p.u - line.a * p.v; });
}

struct Box {
  double west = INFINITY, east = -INFINITY, south = INFINITY, north = -INFINITY;

  void add(const Corner& c) {
    west = std::min(west, c.u), east = std::max(east, c.u);
    south = std::min(south, c.v), north = std::max(north, c.v);
  }
  void add(const Box& box) {
    add(Corner{box.west, box.south});
    add(Corner{box.east, box.north});
  }
  Ring ring() const { return {{west, south}, {east, south}, {east, north}, {west, north}}; }
  Place middle() const { return {(west + east) / 2, (south + north) / 2}; }
};
Box box_of(const Rings& rings) {
  Box box;
  for (const Ring& ring : rings)
    for (const Corner& c : ring) box.add(c);
  return box;
}

/// Calls visit(p, q) for the sides of the ring, from p to q.
template <class Visit>
void for_each_side(const Ring& ring, const Visit& visit) {
  for (std::size_t i = 0; i < ring.size(); ++i) visit(ring[i], ring[(i + 1) % ring.size()]);
}

/// Positive if counterclockwise.
double area_on_plane(const Ring& ring) {
  double twice = 0;
  for (std::size_t i = 1; i + 1 < ring.size(); ++i)
    twice += (ring[i].u - ring[0].u) * (ring[i + 1].v - ring[0].v) -
             (ring[i + 1].u - ring[0].u) * (ring[i].v - ring[0].v);
  return twice / 2;
}

double length_on_plane(const Ring& ring) {
  double around = 0;
  for_each_side(ring, [&](const Corner& p, const Corner& q) { around += std::hypot(q.u - p.u, q.v - p.v); });
  return around;
}

bool holds(const Ring& ring, const Corner& p) {
  bool inside = false;
  for_each_side(ring, [&](const Corner& a, const Corner& b) {
    if ((a.v > p.v) != (b.v > p.v) && p.u < a.u + (p.v - a.v) / (b.v - a.v) * (b.u - a.u)) inside = !inside;
  });
  return inside;
}

/// The area on the sphere of a ring on a plane, from differences of its corners (measures.h: triangle_area).
double area_on_sphere(const Ring& ring) {
  const auto length_of = [](const Corner& p) { return std::sqrt(p.u * p.u + p.v * p.v + 1); };
  const auto product = [](const Corner& p, const Corner& q) { return p.u * q.u + p.v * q.v + 1; };
  double area = 0;
  for (std::size_t i = 1; i + 1 < ring.size(); ++i) {
    const Corner &a = ring[0], &b = ring[i], &c = ring[i + 1];
    const double volume = (b.u - a.u) * (c.v - a.v) - (c.u - a.u) * (b.v - a.v);
    const double of_a = length_of(a), of_b = length_of(b), of_c = length_of(c);
    area += 2 * std::atan2(volume, of_a * of_b * of_c + product(a, b) * of_c + product(b, c) * of_a +
                                       product(c, a) * of_b);
  }
  return area;
}

/// The plane that touches the sphere in a place.
class Plane {
 public:
  explicit Plane(const Place& place)
      : lon_(place.first),
        lat_(place.second),
        sine_(point_sets::sin_degrees(lat_)),
        cosine_(point_sets::cos_degrees(lat_)),
        up_(point_sets::from_degrees(lon_, lat_)),
        east_{-point_sets::sin_degrees(lon_), point_sets::cos_degrees(lon_), 0},
        north_(cross(up_, east_)) {}

  Corner at(double lon, double lat) const {
    const double cosine = point_sets::cos_degrees(lat), half = point_sets::sin_degrees((lon - lon_) / 2),
                 sag = 2 * cosine * half * half;
    const double up = point_sets::cos_degrees(lat - lat_) - cosine_ * sag;
    return {cosine * point_sets::sin_degrees(lon - lon_) / up,
            (point_sets::sin_degrees(lat - lat_) + sine_ * sag) / up};
  }
  Point on_sphere(const Corner& c) const {
    return unit({up_.x + c.u * east_.x + c.v * north_.x, up_.y + c.u * east_.y + c.v * north_.y,
                 up_.z + c.u * east_.z + c.v * north_.z});
  }
  /// The great circle with this normal; none if it is the horizon.
  std::optional<Line> line(const Point& normal) const {
    const double a = dot(normal, east_), b = dot(normal, north_), norm = std::hypot(a, b);
    if (norm < 1e-9 * length(normal)) return {};
    return Line{a / norm, b / norm, dot(normal, up_) / norm};
  }
  const Point& middle() const { return up_; }

 private:
  double lon_, lat_, sine_, cosine_;
  Point up_, east_, north_;
};

/// The rings on the map, with the interior on their left.
Rings oriented(const MapRegion& region) {
  Rings rings;
  for (std::size_t k = 0; k < region.rings.size(); ++k) {
    Ring& ring = rings.emplace_back();
    for (std::size_t i = 0; i + 1 < region.rings[k].size(); ++i)
      ring.push_back({region.rings[k][i].first, region.rings[k][i].second, static_cast<std::int32_t>(i)});
    if ((area_on_plane(ring) < 0) != (k > 0)) std::reverse(ring.begin(), ring.end());
  }
  return rings;
}

/// Throws NoMesh if two sides of the polygon cross, or lie on each other in one direction, as those of holes
/// in each other; decided exactly.
void expect_no_crossing(const Rings& rings, std::size_t feature) {
  struct Side {
    Corner from, to;
    std::size_t ring;
    Box box;
  };
  std::vector<Side> sides;
  for (std::size_t r = 0; r < rings.size(); ++r)
    for (std::size_t i = 0; i < rings[r].size(); ++i) {
      Side& side = sides.emplace_back(Side{rings[r][i], rings[r][(i + 1) % rings[r].size()], r, {}});
      side.box.add(side.from);
      side.box.add(side.to);
    }
  std::sort(sides.begin(), sides.end(), [](const Side& a, const Side& b) { return a.box.west < b.box.west; });
  const auto left = [](const Side& side, const Corner& c) {
    return pstripack::left({side.from.u, side.from.v, 1}, {side.to.u, side.to.v, 1}, {c.u, c.v, 1});
  };
  const auto is_wrong = [&](const Side& s, const Side& t) {
    const double width = std::min(s.box.east, t.box.east) - std::max(s.box.west, t.box.west),
                 height = std::min(s.box.north, t.box.north) - std::max(s.box.south, t.box.south);
    if (width < 0 || height < 0) return false;
    const int from = left(s, t.from), to = left(s, t.to);
    if (from == 0 && to == 0)
      return std::max(width, height) > 0 && (s.to.u - s.from.u) * (t.to.u - t.from.u) >= 0 &&
             (s.to.v - s.from.v) * (t.to.v - t.from.v) >= 0;
    return from * to < 0 && left(t, s.from) * left(t, s.to) < 0;
  };
  for (std::size_t i = 0; i < sides.size(); ++i)
    for (std::size_t j = i + 1; j < sides.size() && sides[j].box.west <= sides[i].box.east; ++j) {
      if (!is_wrong(sides[i], sides[j])) continue;
      const auto named = [&](const Side& side) {  // as in the file, where the ring may be reversed
        const auto last = static_cast<std::int32_t>(rings[side.ring].size()) - 1;
        const bool is_forward =
            side.to.place == side.from.place + 1 || (side.from.place == last && side.to.place == 0);
        const Corner &from = is_forward ? side.from : side.to, &to = is_forward ? side.to : side.from;
        std::ostringstream text;
        text.precision(15);
        text << "side " << from.place + 1;
        if (rings.size() > 1) text << " of ring " << side.ring + 1;
        text << " from " << from.u << ',' << from.v << " to " << to.u << ',' << to.v;
        return std::tuple(side.ring, from.place, text.str());
      };
      const auto first = named(sides[i]), second = named(sides[j]);
      throw NoMesh("feature " + std::to_string(feature) + ": " + std::get<2>(std::min(first, second)) +
                   " crosses or lies on " + std::get<2>(std::max(first, second)) +
                   ": mend the polygon, say by ogr2ogr -makevalid");
    }
}

/// The rings on the map, cut into pieces that lie within 75 degrees of the middle of their box and within
/// -180 to 180. Only a polygon that does not is cut, at meridians and the equator.
std::vector<Rings> pieces_on_map(const Rings& rings) {
  const auto halves = [](const Rings& all, const Line& line) {
    std::array<Rings, 2> parts{cut(all, line), cut(all, line.reversed())};
    for (Rings& part : parts)
      for (Ring& ring : part)
        for (Corner& c : ring) {
          c.drawn = true;
          if (std::fabs(line.side(c)) > 1e-12) continue;
          (line.a != 0 ? c.u : c.v) = 0.0 - line.c * (line.a + line.b);
        }
    return parts;
  };
  auto [east, west] = halves(rings, {1, 0, -180});
  for (Ring& ring : east)
    for (Corner& c : ring) c.u -= 360;
  std::vector<Rings> pieces, queue{std::move(west), std::move(east)};
  while (!queue.empty()) {
    const Rings piece = std::move(queue.back());
    queue.pop_back();
    if (piece.empty()) continue;
    const Box box = box_of(piece);
    const double width = box.east - box.west, lat = (box.south + box.north) / 2;
    bool is_near = width <= 360 - 1e-9;
    for (const double end : {box.south, box.north})
      is_near = is_near && point_sets::sin_degrees(lat) * point_sets::sin_degrees(end) +
                                   point_sets::cos_degrees(lat) * point_sets::cos_degrees(end) *
                                       point_sets::cos_degrees(width / 2) >
                               0.26;
    if (is_near) {
      pieces.push_back(piece);
      continue;
    }
    for (Rings& half : halves(piece, width > 90 ? Line{1, 0, -(box.west + box.east) / 2} : Line{0, 1, 0}))
      queue.push_back(std::move(half));
  }
  return pieces;
}

/// Into how many arcs a side is divided, if more than one: in all polygons into as many.
using Divisions = std::unordered_map<std::pair<Place, Place>, int, boost::hash<std::pair<Place, Place>>>;

std::pair<Place, Place> side_between(const Corner& p, const Corner& q) {
  return std::minmax(Place(p.u, p.v), Place(q.u, q.v));
}

/// Number of arcs that keep within `deviation`, in radians, of a side that is straight on the map.
///
/// Go along the side in unit time, a radians to the east and b to the north. Its acceleration across it, on
/// the sphere, is sin(lat) a (2 b^2 + c^2) / v, c = a cos(lat), v = |(b,c)|; as b^2 <= b v, at most |sin(lat)
/// a| (v + |b|). The arc of one n-th of the side is an eighth of this over n^2 away. No arc is longer than 10
/// degrees, where higher terms are a hundredth of this; 1.1 is for them.
int divisions_of(const Corner& p, const Corner& q, double deviation) {
  if (p.u == q.u || (p.v == 0 && q.v == 0)) return 1;
  const double a = std::fabs(q.u - p.u) / kRadian, b = std::fabs(q.v - p.v) / kRadian;
  const double sine =
      std::max(std::fabs(point_sets::sin_degrees(p.v)), std::fabs(point_sets::sin_degrees(q.v)));
  const double cosine =
      p.v * q.v < 0 ? 1 : std::max(point_sets::cos_degrees(p.v), point_sets::cos_degrees(q.v));
  const double bend = 1.1 * sine * a * (std::hypot(b, a * cosine) + b) / 8;
  return static_cast<int>(
      std::ceil(std::max({1.0, std::sqrt(bend / deviation), std::max(a, b) * kRadian / 10})));
}

/// One piece of a polygon on its plane.
struct Sheet {
  Plane plane;
  Rings rings;
  std::vector<Place> places;  ///< of its corners

  Sheet(const Rings& piece, const Divisions& divisions) : plane(box_of(piece).middle()) {
    for (const Ring& on_map : piece) {
      Ring ring;
      const auto add = [&](double lon, double lat) {
        Corner c = plane.at(lon, lat);
        if (!ring.empty() && ring.back().u == c.u && ring.back().v == c.v) return;
        c.place = static_cast<std::int32_t>(places.size());
        places.emplace_back(lon, lat);
        ring.push_back(c);
      };
      for_each_side(on_map, [&](const Corner& p, const Corner& q) {
        add(p.u, p.v);
        const auto side = side_between(p, q);
        const auto found = divisions.find(side);
        const int n = found == divisions.end() ? 1 : found->second;
        const bool swap = side.first != Place(p.u, p.v);
        for (int k = 1; k < n; ++k) {
          const double t = static_cast<double>(swap ? n - k : k) / n;
          add(side.first.first + t * (side.second.first - side.first.first),
              side.first.second + t * (side.second.second - side.first.second));
        }
      });
      while (ring.size() > 1 && ring.front().u == ring.back().u && ring.front().v == ring.back().v)
        ring.pop_back();
      if (ring.size() > 2) rings.push_back(std::move(ring));
    }
  }
};

void add_divisions(const std::vector<Rings>& pieces, Divisions& divisions) {
  double area = 0, around = 0;
  Rings all;
  for (const Rings& piece : pieces) {
    all.insert(all.end(), piece.begin(), piece.end());
    for (const Ring& ring : Sheet(piece, {}).rings) area += area_on_sphere(ring);
  }
  for (const Ring& ring : all)
    for_each_side(ring, [&](const Corner& p, const Corner& q) {
      around += std::hypot(q.v - p.v, (q.u - p.u) * point_sets::cos_degrees((p.v + q.v) / 2)) / kRadian;
    });
  // At most some 10,000 arcs for a side as long as all.
  const double deviation = std::max(1.5 * kOfArea * std::fabs(area) / around, 1e-9 * around);
  for (const Ring& ring : all)
    for_each_side(ring, [&](const Corner& p, const Corner& q) {
      const int n = divisions_of(p, q, deviation);
      if (n == 1) return;
      int& known = divisions[side_between(p, q)];
      known = std::max(known, n);
    });
}

/// Great circles of the sides of cells.
class Sides {
 public:
  explicit Sides(const Faces& cells)
      : cells_(cells), edges_(edges_of(cells)), normals_(edges_.nodes.size() / 2) {
    for (std::size_t e = 0; e < normals_.size(); ++e) {
      const Point &from = point(edges_.nodes[2 * e]), &to = point(edges_.nodes[2 * e + 1]);
      Point normal = cross(from, minus(to, from));
      // The rounding of a normal is 1e-16 over the distance of the points that it is computed from.
      if (const auto [left, right] = std::pair(edges_.faces[2 * e], edges_.faces[2 * e + 1]);
          left > 0 && right > 0 && left != right) {
        const Point &a = cells.centres[static_cast<std::size_t>(left) - 1],
                    &b = cells.centres[static_cast<std::size_t>(right) - 1], d = minus(a, b);
        if (dot(d, d) > dot(normal, normal)) {
          // Lengths are 1 only up to rounding, which moves what is as far from a as from b by 1e-16 over |d|.
          const Point sum{a.x + b.x, a.y + b.y, a.z + b.z};
          const double t = dot(sum, sum) > 1 ? dot(sum, d) / dot(sum, sum) : 0;
          normal = {d.x - t * sum.x, d.y - t * sum.y, d.z - t * sum.z};
        }
      }
      normals_[e] = normal;
    }
  }

  /// Calls visit(line) for each side of the cell; false if all of the plane is outside.
  template <class Visit>
  void for_each_line(std::size_t cell, const Plane& plane, const Visit& visit) const {
    for (std::size_t k = cells_.begin[cell]; k < cells_.begin[cell + 1]; ++k) {
      const auto edge = static_cast<std::size_t>(edges_.of_faces[k]) - 1;
      const Point& normal = normals_[edge];
      if (normal == Point{0, 0, 0}) continue;
      const bool is_left = cells_.corner[k] == edges_.nodes[2 * edge];
      if (const auto line = plane.line(normal))
        visit(is_left ? *line : line->reversed());
      else if ((dot(normal, plane.middle()) > 0) != is_left)
        visit(Line{0, 0, -1});
    }
  }

 private:
  const Point& point(std::int32_t corner) const {
    return cells_.points[static_cast<std::size_t>(corner) - 1];
  }

  const Faces& cells_;
  Edges edges_;
  std::vector<Point> normals_;
};

/// Gives corners the bits of an earlier one within kSameCorner.
class SameCorners {
 public:
  const MapCorner& of(const MapCorner& corner) {
    // Heights above a plane along which few corners lie differ by no more than their places.
    const double height = dot(corner.p, {0.36, 0.48, 0.8});
    for (auto c = corners_.lower_bound(height - 2 * kSameCorner);
         c != corners_.end() && c->first <= height + 2 * kSameCorner; ++c)
      if (length(minus(c->second.p, corner.p)) < kSameCorner) return c->second;
    return corners_.emplace(height, corner)->second;
  }

 private:
  std::multimap<double, MapCorner> corners_;
};

class Clipper {
 public:
  explicit Clipper(const Faces& cells)
      : cells_(cells), sides_(cells), angles_(cells.points, true), radius_(cells.size()), pieces_(cells) {
    cells.for_each_corner([&](std::size_t f, std::size_t k) {
      radius_[f] = std::max(radius_[f], angle_between(cells.centres[f], cells.point(k)));
    });
  }

  /// The sum of the areas of the parts, and that of the sheet.
  void clip(const Sheet& sheet, std::size_t feature) {
    sheet_ = &sheet;
    feature_ = feature;
    const Box box = box_of(sheet.rings);
    double reach = 0, area = 0, around = 0;
    for (const Ring& ring : sheet.rings) {
      area += area_on_sphere(ring);
      around += length_on_plane(ring);
      for (const Corner& c : ring) reach = std::max(reach, std::atan(std::hypot(c.u, c.v)));
    }
    std::vector<Candidate> candidates;
    for (std::size_t f = 0; f < cells_.size(); ++f) {
      if (angle_between(cells_.centres[f], sheet.plane.middle()) > reach + radius_[f] + 1e-9) continue;
      const Rings part = cut_at_sides({box.ring()}, f);
      if (!part.empty()) candidates.push_back({f, box_of(part)});
    }
    area_ = around_ = 0;
    clip(candidates.begin(), candidates.end(), sheet.rings);
    if (std::fabs(area_ - area) > 1e-9 * std::fabs(area) + 10 * kThin * (around + around_)) fail();
  }

  Faces take() { return pieces_.take(); }
  std::size_t size() const { return pieces_.size(); }

 private:
  struct Candidate {
    std::size_t cell;
    Box box;  ///< of the cell
  };
  using Candidates = std::vector<Candidate>::iterator;

  [[noreturn]] void fail() const {
    throw NoMesh(
        "feature " + std::to_string(feature_) +
        ": its rings touch, overlap or lie in each other, which a polygon does not allow: mend the polygon, "
        "say by ogr2ogr -makevalid");
  }

  Rings cut_at_sides(Rings rings, std::size_t cell) const {
    sides_.for_each_line(cell, sheet_->plane, [&](const Line& line) {
      if (!rings.empty()) rings = cut(rings, line);
    });
    return rings;
  }

  /// Halves the cells, and for each half cuts the rings at its box, until one cell is left.
  void clip(Candidates first, Candidates last, Rings rings) {
    if (first == last || rings.empty()) return;
    Box box;
    for (auto c = first; c != last; ++c) box.add(c->box);
    const Box of_rings = box_of(rings);
    const double margin = 1e-12 + 1e-6 * std::max(box.east - box.west, box.north - box.south);
    if (of_rings.west < box.west - margin) rings = cut(rings, {1, 0, margin - box.west});
    if (of_rings.east > box.east + margin) rings = cut(rings, {-1, 0, box.east + margin});
    if (of_rings.south < box.south - margin) rings = cut(rings, {0, 1, margin - box.south});
    if (of_rings.north > box.north + margin) rings = cut(rings, {0, -1, box.north + margin});
    if (last - first == 1) return add_parts(first->cell, cut_at_sides(std::move(rings), first->cell));
    const bool by_u = box.east - box.west > box.north - box.south;
    const auto middle = first + (last - first) / 2;
    std::nth_element(first, middle, last, [&](const Candidate& a, const Candidate& b) {
      return by_u ? a.box.west + a.box.east < b.box.west + b.box.east
                  : a.box.south + a.box.north < b.box.south + b.box.north;
    });
    clip(first, middle, rings);
    clip(middle, last, std::move(rings));
  }

  /// Adds the parts of a cell. A part with a hole is cut in two, through the middle of the hole.
  void add_parts(std::size_t cell, const Rings& rings) {
    Rings outlines, holes;
    for (const Ring& ring : rings) {
      const double area = area_on_plane(ring);
      if (std::fabs(area) > kThin / 2 * length_on_plane(ring)) (area > 0 ? outlines : holes).push_back(ring);
    }
    std::vector<Rings> holes_of(outlines.size());
    for (Ring& hole : holes) {
      std::size_t best = outlines.size();
      std::size_t most = hole.size() - 1;
      for (std::size_t k = 0; k < outlines.size(); ++k) {
        std::size_t inside = 0;
        for_each_side(hole, [&](const Corner& p, const Corner& q) {  // corners may touch the outline
          if (holds(outlines[k], p)) ++inside;
          if (holds(outlines[k], {(p.u + q.u) / 2, (p.v + q.v) / 2})) ++inside;
        });
        if (inside > most) most = inside, best = k;
      }
      if (best == outlines.size()) fail();
      holes_of[best].push_back(std::move(hole));
    }
    for (std::size_t k = 0; k < outlines.size(); ++k) {
      if (holes_of[k].empty()) {
        add(cell, outlines[k]);
        continue;
      }
      const Box hole = box_of({holes_of[k][0]});
      const Line line = hole.east - hole.west > hole.north - hole.south
                            ? Line{1, 0, -(hole.west + hole.east) / 2}
                            : Line{0, 1, -(hole.south + hole.north) / 2};
      holes_of[k].push_back(std::move(outlines[k]));
      for (const Line& half : {line, line.reversed()}) add_parts(cell, cut(holes_of[k], half));
    }
  }

  void add(std::size_t cell, const Ring& ring) {
    const double area = area_on_sphere(ring);
    area_ += area;
    around_ += length_on_plane(ring);
    MapRing corners;
    const bool is_whole = std::none_of(ring.begin(), ring.end(), [](const Corner& c) { return c.drawn; }) &&
                          !cells_.area.empty();
    if (is_whole) {
      corners = ring_of(cells_, cell, angles_, cells_.corner);
    } else {
      for (const Corner& c : ring)
        if (c.place < 0) {
          const Point p = sheet_->plane.on_sphere(c);
          corners.push_back({p, longitude(p), latitude(p)});
        } else {
          const auto [lon, lat] = sheet_->places[static_cast<std::size_t>(c.place)];
          corners.push_back({point_sets::from_degrees(lon, lat), lon, lat});
        }
    }
    for (MapCorner& c : corners) c = same_.of(c);
    pieces_.add(corners, cell, is_whole ? cells_.area[cell] : area);
  }

  const Faces& cells_;
  Sides sides_;
  LonLat angles_;
  std::vector<double> radius_;  ///< of a cap around the node that holds the cell
  SameCorners same_;
  Pieces pieces_;
  const Sheet* sheet_ = nullptr;
  std::size_t feature_ = 0;
  double area_ = 0, around_ = 0;  ///< of the parts in the sheet
};

}  // namespace

void expect_no_crossing(const MapRegion& polygon) { expect_no_crossing(oriented(polygon), polygon.feature); }

Faces clipped_to_polygons(const Faces& cells, const std::vector<MapRegion>& polygons) {
  std::vector<std::vector<Rings>> pieces;
  Divisions divisions;
  for (const MapRegion& polygon : polygons) {
    const Rings rings = oriented(polygon);
    expect_no_crossing(rings, polygon.feature);
    pieces.push_back(pieces_on_map(rings));
    add_divisions(pieces.back(), divisions);
  }
  Clipper clipper(cells);
  Column number = whole_numbers("polygon", "number of the feature that the cell was cut at", {});
  Column name{"polygon_name", "its property name or id"};
  bool has_names = false;
  for (std::size_t k = 0; k < polygons.size(); ++k) {
    for (const Rings& piece : pieces[k]) clipper.clip(Sheet(piece, divisions), polygons[k].feature);
    number.numbers.resize(clipper.size(), static_cast<double>(polygons[k].feature));
    name.texts.resize(clipper.size(), polygons[k].name);
    has_names = has_names || !polygons[k].name.empty();
  }
  Faces parts = clipper.take();
  parts.columns_of_parts.push_back(std::move(number));
  if (has_names) parts.columns_of_parts.push_back(std::move(name));
  return parts;
}

}  // namespace files
