// Voronoi cells cut at polygons, on a plane on which the borders of cells are straight: seen from the centre
// of the sphere, the plane that touches it in the middle of the polygon. A cell is what lies on the left of
// each of its sides, so a polygon with holes is cut along one line after the other. Coordinates are
// differences from the middle: a polygon of metres has as many digits as one of continents.
#include "files/clipping.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <optional>
#include <sstream>
#include <string>
#include <tuple>
#include <utility>

#include "files/cut_rings.h"
#include "files/map_rings.h"
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
/// Points nearer than this, in radians, are one corner: they are rounded in other planes.
constexpr double kSameCorner = 1e-14;

/// On a plane, or on the map: longitude and latitude.
struct Corner {
  double u, v;
  std::ptrdiff_t side = -1;  ///< to the next corner: which of Faces::corner it begins at in a cell; -1: none
};
using Ring = std::vector<Corner>;
using Rings = std::vector<Ring>;  ///< interior on the left: outlines counterclockwise, holes clockwise

/// Of what lies on its left, side() is positive. a*a + b*b = 1.
struct Line {
  double a, b, c;

  double side(const Corner& p) const { return a * p.u + b * p.v + c; }
  Line reversed() const { return {-a, -b, -c}; }
};

/// `side`: of the new sides.
Rings cut(const Rings& rings, const Line& line, std::ptrdiff_t side = -1) {
  return cut_rings(
      rings, [&](const Corner& p) { return line.side(p) > kOnLine; },
      [&](const Corner& p, const Corner& q, bool leaves) {
        const double at_p = line.side(p), t = std::clamp(at_p / (at_p - line.side(q)), 0.0, 1.0);
        Corner c = t == 0 ? p : t == 1 ? q : Corner{p.u + t * (q.u - p.u), p.v + t * (q.v - p.v)};
        c.side = leaves ? side : p.side;
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
  for (const auto& corners : region.rings) {
    Ring ring;
    for (std::size_t i = 0; i + 1 < corners.size(); ++i)
      ring.push_back({corners[i].first, corners[i].second});
    if ((area_on_plane(ring) < 0) == rings.empty()) std::reverse(ring.begin(), ring.end());
    rings.push_back(std::move(ring));
  }
  return rings;
}

/// The rings on the map, cut into pieces that lie within 75 degrees of the middle of their box. Only a
/// polygon that does not is cut, at meridians and the equator.
std::vector<Rings> pieces_on_map(const Rings& rings) {
  std::vector<Rings> pieces, queue{rings};
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
    const double middle = (box.west + box.east) / 2;
    const Line line = width > 90 ? Line{1, 0, -middle} : Line{0, 1, 0};
    for (const Line& side : {line, line.reversed()}) {
      Rings& half = queue.emplace_back(cut(piece, side));
      for (Ring& ring : half)
        for (Corner& c : ring)
          if (std::fabs(side.side(c)) < 1e-12) (side.a != 0 ? c.u : c.v) = side.a != 0 ? middle : 0;
    }
  }
  return pieces;
}

/// Number of arcs that keep as near to a side that is straight on the map as clipped_to_polygons() promises.
///
/// Go along the side in unit time, a radians to the east and b to the north. Its acceleration across it, on
/// the sphere, is sin(lat) a (2 b^2 + c^2) / v, c = a cos(lat), v = |(b,c)|; as b^2 <= b v, at most |sin(lat)
/// a| (v + |b|). The arc of one n-th of the side is an eighth of this over n^2 away. No arc is longer than 10
/// degrees, where higher terms are a hundredth of this; 1.1 is for them.
int divisions_of(const Corner& p, const Corner& q) {
  constexpr double kOfLength = 5e-7, kLeast = 1e-9;
  if (p.u == q.u || (p.v == 0 && q.v == 0)) return 1;
  const double a = std::fabs(q.u - p.u) / kRadian, b = std::fabs(q.v - p.v) / kRadian;
  const double sine =
      std::max(std::fabs(point_sets::sin_degrees(p.v)), std::fabs(point_sets::sin_degrees(q.v)));
  const double cosine =
      p.v * q.v < 0 ? 1 : std::max(point_sets::cos_degrees(p.v), point_sets::cos_degrees(q.v));
  const double length = std::hypot(b, a * cosine), bend = 1.1 * sine * a * (length + b) / 8,
               most = std::max(kOfLength * length, kLeast);
  return static_cast<int>(std::ceil(std::max({1.0, std::sqrt(bend / most), std::max(a, b) * kRadian / 10})));
}

/// By their heights above a plane along which few corners lie, which differ by no more than their places.
using Corners = std::multimap<double, MapCorner>;

/// The earlier corner within kSameCorner, else this one, which is added.
const MapCorner& same_corner(Corners& corners, const MapCorner& corner) {
  const double height = dot(corner.p, {0.36, 0.48, 0.8});
  for (auto c = corners.lower_bound(height - 2 * kSameCorner);
       c != corners.end() && c->first <= height + 2 * kSameCorner; ++c)
    if (length(minus(c->second.p, corner.p)) < kSameCorner) return c->second;
  return corners.emplace(height, corner)->second;
}

/// One piece of a polygon on its plane.
struct Sheet {
  Plane plane;
  Rings rings;

  Sheet(const Rings& piece, Corners& same) : plane(box_of(piece).middle()) {
    for (const Ring& on_map : piece) {
      Ring ring;
      const auto add = [&](double lon, double lat) {
        const Corner c = plane.at(lon, lat);
        if (!ring.empty() && ring.back().u == c.u && ring.back().v == c.v) return;
        ring.push_back(c);
        same_corner(same, {point_sets::from_degrees(lon, lat), lon, lat});
      };
      for_each_side(on_map, [&](const Corner& p, const Corner& q) {
        add(p.u, p.v);
        const int n = divisions_of(p, q);
        const bool swap = Place(q.u, q.v) < Place(p.u, p.v);  // the same bits in both directions
        const Corner &from = swap ? q : p, &to = swap ? p : q;
        for (int k = 1; k < n; ++k) {
          const double t = static_cast<double>(swap ? n - k : k) / n;
          add(from.u + t * (to.u - from.u), from.v + t * (to.v - from.v));
        }
      });
      while (ring.size() > 1 && ring.front().u == ring.back().u && ring.front().v == ring.back().v)
        ring.pop_back();
      if (ring.size() > 2) rings.push_back(std::move(ring));
    }
  }
};

/// The normals of the great circles of the sides of cells.
std::vector<Point> normals_of(const Faces& cells, const Edges& edges) {
  std::vector<Point> normals(edges.nodes.size() / 2);
  for (std::size_t e = 0; e < normals.size(); ++e) {
    const Point &from = cells.numbered(edges.nodes[2 * e]), &to = cells.numbered(edges.nodes[2 * e + 1]);
    normals[e] = cross(from, minus(to, from));
    // The rounding of a normal is 1e-16 over the distance of the points that it is computed from.
    const std::int32_t left = edges.faces[2 * e], right = edges.faces[2 * e + 1];
    if (left <= 0 || right <= 0 || left == right) continue;
    const Point &a = cells.centres[static_cast<std::size_t>(left) - 1],
                &b = cells.centres[static_cast<std::size_t>(right) - 1], d = minus(a, b);
    if (dot(d, d) <= dot(normals[e], normals[e])) continue;
    // Lengths are 1 only up to rounding, which moves what is as far from a as from b by 1e-16 over |d|.
    const Point sum = plus(a, b);
    const double t = dot(sum, sum) > 1 ? dot(sum, d) / dot(sum, sum) : 0;
    normals[e] = {d.x - t * sum.x, d.y - t * sum.y, d.z - t * sum.z};
  }
  return normals;
}

class Clipper {
 public:
  explicit Clipper(const Faces& cells)
      : cells_(cells),
        edges_(edges_of(cells)),
        normals_(normals_of(cells, edges_)),
        angles_(cells.points, true),
        radius_(cells.size()) {
    cells.for_each_corner([&](std::size_t f, std::size_t k) {
      radius_[f] = std::max(radius_[f], angle_between(cells.centres[f], cells.point(k)));
    });
  }

  /// The sum of the areas of the parts, and that of the sheet.
  void clip(const Rings& piece, std::size_t feature) {
    const Sheet sheet(piece, same_);
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
      if (part.empty()) continue;
      candidates.push_back({f, box_of(part)});
    }
    area_ = around_ = 0;
    clip(candidates.begin(), candidates.end(), sheet.rings);
    // Cells that were cut before need not cover it.
    const double more = area_ - area, rounding = 1e-9 * std::fabs(area) + 10 * kThin * (around + around_);
    if (more > rounding || (cells_.nodes.empty() && more < -rounding)) fail();
  }

  /// The parts since the last call, in the order of their cells.
  void move_to(Pieces& pieces) {
    std::stable_sort(parts_.begin(), parts_.end(),
                     [](const Part& a, const Part& b) { return a.cell < b.cell; });
    for (const Part& part : parts_) pieces.add(part.ring, part.cell, part.area);
    parts_.clear();
  }

 private:
  struct Part {
    std::size_t cell;
    MapRing ring;
    double area;
  };
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
    for (std::size_t k = cells_.begin[cell]; k < cells_.begin[cell + 1] && !rings.empty(); ++k) {
      const std::size_t edge = static_cast<std::size_t>(edges_.of_faces[k]) - 1;
      const Point& normal = normals_[edge];
      if (normal == Point{0, 0, 0}) continue;
      const bool is_left = cells_.corner[k] == edges_.nodes[2 * edge];
      if (const auto line = sheet_->plane.line(normal))
        rings = cut(rings, is_left ? *line : line->reversed(), static_cast<std::ptrdiff_t>(k));
      else if ((dot(normal, sheet_->plane.middle()) > 0) != is_left)
        return {};
    }
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

  /// Adds the parts of a cell. If one has a hole, they are cut in two through the middle of the hole.
  void add_parts(std::size_t cell, const Rings& rings, std::size_t most_holes = SIZE_MAX) {
    Rings parts;
    std::size_t holes = 0, hole = 0;
    for (const Ring& ring : rings) {
      const double area = area_on_plane(ring);
      if (std::fabs(area) <= kThin / 2 * length_on_plane(ring)) continue;
      if (area < 0) ++holes, hole = parts.size();
      parts.push_back(ring);
    }
    if (holes > most_holes) fail();  // one that is cut remains: it is in no outline
    if (holes == 0) {
      for (const Ring& ring : parts) add(cell, ring);
      return;
    }
    const Box box = box_of({parts[hole]});
    const auto [u, v] = box.middle();
    const Line line = box.east - box.west > box.north - box.south ? Line{1, 0, -u} : Line{0, 1, -v};
    for (const Line& half : {line, line.reversed()}) add_parts(cell, cut(parts, half), holes - 1);
  }

  void add(std::size_t cell, const Ring& ring) {
    const double area = area_on_sphere(ring);
    area_ += area;
    around_ += length_on_plane(ring);
    MapRing corners;
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const Corner &c = ring[i], &before = ring[i > 0 ? i - 1 : ring.size() - 1];
      const Point p = sheet_->plane.on_sphere(c);
      MapCorner corner{p, longitude(p), latitude(p)};
      if (before.side >= 0 && c.side >= 0 && before.side != c.side) {
        // Two sides of the cell meet at its corner. If they are nearly one arc, they do not tell where.
        corner = corner_at(cells_, cells_.corner[static_cast<std::size_t>(c.side)], angles_);
      }
      corners.push_back(same_corner(same_, corner));
    }
    parts_.push_back({cell, std::move(corners), area});
  }

  const Faces& cells_;
  Edges edges_;
  std::vector<Point> normals_;  ///< of the edges
  LonLat angles_;
  std::vector<double> radius_;  ///< of a cap around the node that holds the cell
  Corners same_;
  std::vector<Part> parts_;
  const Sheet* sheet_ = nullptr;
  std::size_t feature_ = 0;
  double area_ = 0, around_ = 0;  ///< of the parts in the sheet
};

}  // namespace

void expect_no_crossing(const MapRegion& polygon) {
  struct Side {
    Place from, to;
    std::size_t ring, number;
  };
  std::vector<Side> sides;
  for (std::size_t r = 0; r < polygon.rings.size(); ++r)
    for (std::size_t i = 1; i < polygon.rings[r].size(); ++i)
      sides.push_back({polygon.rings[r][i - 1], polygon.rings[r][i], r + 1, i});
  const auto west = [](const Side& s) { return std::min(s.from.first, s.to.first); };
  std::sort(sides.begin(), sides.end(), [&](const Side& s, const Side& t) { return west(s) < west(t); });
  const auto left = [](const Side& s, const Place& c) {
    return pstripack::left({s.from.first, s.from.second, 1}, {s.to.first, s.to.second, 1},
                           {c.first, c.second, 1});
  };
  const auto is_wrong = [&](const Side& s, const Side& t) {
    const int from = left(s, t.from), to = left(s, t.to);
    if (from != 0 || to != 0) return from * to < 0 && left(t, s.from) * left(t, s.to) < 0;
    const auto [s_low, s_high] = std::minmax(s.from, s.to);  // on one line
    const auto [t_low, t_high] = std::minmax(t.from, t.to);
    return std::max(s_low, t_low) < std::min(s_high, t_high);
  };
  const auto named = [&](const Side& s) {
    std::ostringstream text;
    text.precision(15);
    text << "side " << s.number;
    if (polygon.rings.size() > 1) text << " of ring " << s.ring;
    text << " from " << s.from.first << ',' << s.from.second << " to " << s.to.first << ',' << s.to.second;
    return text.str();
  };
  for (auto s = sides.begin(); s != sides.end(); ++s)
    for (auto t = s + 1; t != sides.end() && west(*t) <= std::max(s->from.first, s->to.first); ++t) {
      const auto [low, high] = std::minmax({s->from.second, s->to.second});
      if (std::max(t->from.second, t->to.second) < low || std::min(t->from.second, t->to.second) > high ||
          !is_wrong(*s, *t))
        continue;
      const bool in_order = std::tie(s->ring, s->number) < std::tie(t->ring, t->number);
      throw NoMesh("feature " + std::to_string(polygon.feature) + ": " + named(in_order ? *s : *t) +
                   " crosses or lies on " + named(in_order ? *t : *s) +
                   ": mend the polygon, say by ogr2ogr -makevalid");
    }
}

Faces clipped_to_polygons(const Faces& cells, const std::vector<MapRegion>& polygons) {
  Clipper clipper(cells);
  Pieces pieces(cells);
  Column number = whole_numbers("polygon", "number of the feature that the cell was cut at", {});
  Column name{"polygon_name", "its property name or id"};
  bool has_names = false;
  for (const MapRegion& polygon : polygons) {
    expect_no_crossing(polygon);
    for (const Rings& piece : pieces_on_map(oriented(polygon))) clipper.clip(piece, polygon.feature);
    clipper.move_to(pieces);
    number.numbers.resize(pieces.size(), static_cast<double>(polygon.feature));
    name.texts.resize(pieces.size(), polygon.name);
    has_names = has_names || !polygon.name.empty();
  }
  Faces parts = pieces.take();
  if (polygons.front().feature > 0) parts.columns_of_parts.push_back(std::move(number));
  if (has_names) parts.columns_of_parts.push_back(std::move(name));
  return parts;
}

}  // namespace files
