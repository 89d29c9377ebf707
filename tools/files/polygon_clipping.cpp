// Voronoi cells cut at polygons.
//
// clang-format off
//          chain         A cell is convex. What is left of a polygon's rings in it are chains, with the
//      .---X<--.         polygon on their left, that enter the cell (E) and leave it (X), and rings
//      |    \   \        within the cell. From where a chain leaves, the border of the part follows the
//      |     \   |       cell's border, counterclockwise, to where the next chain enters.
//      |      E--'
//      '-->---'  cell
// clang-format on

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <tuple>

#include "files/clipping.h"
#include "files/measures.h"
#include "files/pieces.h"
#include "geometry/predicates.h"
#include "point_sets.h"

namespace files {
namespace {

/// What is nearer to one point than to another. Of the half beyond, side() is the same number but for its
/// sign.
struct Half {
  Point near, far;

  double side(const Point& p) const { return dot(p, minus(near, far)); }
};

constexpr double kSphere = 12.566370614359172;
/// Rounding of areas is below 1e-9 of this.
constexpr double kLeast = 1e-5;

struct Chain {
  MapRing points;
  bool is_closed = false;
};

/// Where the arc from p to q crosses the border of the half: the same bits for both halves and directions.
MapCorner crossing(const MapCorner& p, const MapCorner& q, const Half& half) {
  const bool swap = std::tie(q.p.x, q.p.y, q.p.z) < std::tie(p.p.x, p.p.y, p.p.z);
  const MapCorner &a = swap ? q : p, &b = swap ? p : q;
  const double at_a = half.side(a.p), at_b = half.side(b.p), t = std::clamp(at_a / (at_a - at_b), 0.0, 1.0);
  if (at_a == 0 || at_b == 0) return at_a == 0 ? a : b;
  const Point x =
      unit({a.p.x + t * (b.p.x - a.p.x), a.p.y + t * (b.p.y - a.p.y), a.p.z + t * (b.p.z - a.p.z)});
  return {x, longitude(x), latitude(x)};
}

/// The parts of the chain inside the half.
void cut(const Chain& chain, const Half& half, std::vector<Chain>& parts) {
  const std::size_t n = chain.points.size();
  std::vector<bool> inside(n);
  std::size_t out = n;
  for (std::size_t i = 0; i < n; ++i) {
    inside[i] = half.side(chain.points[i].p) > 0;
    if (!inside[i]) out = i;
  }
  if (out == n) return parts.push_back(chain);
  const std::size_t start = chain.is_closed ? out : 0, steps = chain.is_closed ? n : n - 1;
  const auto at = [&](std::size_t i) { return (start + i) % n; };
  if (inside[start]) parts.push_back({{chain.points[start]}, false});
  for (std::size_t i = 0; i < steps; ++i) {
    const MapCorner &p = chain.points[at(i)], &q = chain.points[at(i + 1)];
    const bool from = inside[at(i)], to = inside[at(i + 1)];
    if (!from && to) parts.push_back({{crossing(p, q, half)}, false});
    if (from && !to) parts.back().points.push_back(crossing(p, q, half));
    if (to) parts.back().points.push_back(q);
  }
}

std::vector<Chain> cut(const std::vector<Chain>& chains, const Half& half) {
  std::vector<Chain> parts;
  for (const Chain& chain : chains) cut(chain, half, parts);
  return parts;
}

/// Positive if the ring is counterclockwise and smaller than half the sphere.
double area_of(const MapRing& ring) {
  double area = 0;
  for (std::size_t i = 1; i + 1 < ring.size(); ++i)
    area += triangle_area(ring[0].p, ring[i].p, ring[i + 1].p);
  return area;
}

/// The rings of a polygon as arcs, the outline counterclockwise on the map and the holes clockwise, in blocks
/// of neighbouring sides that a cap holds each.
class Polygon {
 public:
  explicit Polygon(const MapRegion& region) : feature(region.feature) {
    for (std::size_t k = 0; k < region.rings.size(); ++k) {
      MapRing ring;
      const auto add = [&](double x, double lat) {
        const double lon = wrapped(x);
        MapCorner& c = ring.emplace_back(MapCorner{point_sets::from_degrees(lon, lat), lon, lat});
        c.turn = static_cast<int>(std::lround((x - lon) / 360));
        c.straight = true;
      };
      for (std::size_t i = 0; i + 1 < region.rings[k].size(); ++i) {
        const auto [x, lat] = region.rings[k][i];
        const auto [next, next_lat] = region.rings[k][i + 1];
        add(x, lat);
        if (std::fabs(lat - next_lat) == 180) add((x + next) / 2, 0);  // from pole to pole
      }
      double twice = 0;
      for (std::size_t i = 0; i < ring.size(); ++i) {
        const MapCorner &p = ring[i], &q = ring[(i + 1) % ring.size()];
        twice +=
            (p.x() - ring[0].x()) * (q.lat - ring[0].lat) - (q.x() - ring[0].x()) * (p.lat - ring[0].lat);
      }
      if ((twice < 0) == (k == 0)) std::reverse(ring.begin(), ring.end());
      const auto [west, east] = std::minmax_element(
          ring.begin(), ring.end(), [](const MapCorner& a, const MapCorner& b) { return a.x() < b.x(); });
      surrounds_sphere = surrounds_sphere || east->x() - west->x() > 360 - 1e-9;
      rings_.push_back(with_arcs(ring));
      add_blocks(rings_.back());
    }
  }

  /// The parts of the rings that may lie within an angle of the point, and more.
  std::vector<Chain> near(const Point& centre, double radius) const {
    std::vector<Chain> chains;
    for (std::size_t k = 0; k < rings_.size(); ++k) {
      const MapRing& ring = rings_[k];
      const std::size_t count = blocks_[k].size();
      std::vector<bool> is_near(count);
      std::size_t far = count;
      for (std::size_t b = 0; b < count; ++b) {
        is_near[b] = angle_between(centre, blocks_[k][b].centre) <= radius + blocks_[k][b].radius + 1e-9;
        if (!is_near[b]) far = b;
      }
      if (far == count) {
        chains.push_back({ring, true});
        continue;
      }
      for (std::size_t i = 1; i < count; ++i) {
        const std::size_t b = (far + i) % count;
        if (!is_near[b]) continue;
        if (!is_near[(far + i - 1) % count]) chains.push_back({{ring[b * kBlock]}, false});
        for (std::size_t j = b * kBlock; j < std::min(ring.size(), (b + 1) * kBlock); ++j)
          chains.back().points.push_back(ring[(j + 1) % ring.size()]);
      }
    }
    return chains;
  }

  /// True if a meridian northwards from the point crosses an odd number of sides, the pole's included.
  bool holds(const Point& p) const {
    const double lon = longitude(p);
    bool inside = false;
    for (std::size_t k = 0; k < rings_.size(); ++k)
      for (std::size_t block = 0; block < blocks_[k].size(); ++block) {
        const Block& limits = blocks_[k][block];
        if (turned(lon, limits.west) >= limits.east) continue;
        const MapRing& ring = rings_[k];
        for (std::size_t i = block * kBlock; i < std::min(ring.size(), (block + 1) * kBlock); ++i) {
          const MapCorner &a = ring[i], &b = ring[(i + 1) % ring.size()];
          const double west = std::min(a.x(), b.x()), east = std::max(a.x(), b.x());
          if (turned(lon, west) >= east) continue;
          const bool is_above =
              a.p == b.p ? a.p.z > 0 : (pstripack::left(a.p, b.p, p) < 0) == (a.x() < b.x());
          inside = inside != is_above;
        }
      }
    return inside;
  }

  /// Its area but for multiples of that of the sphere.
  double area() const {
    double area = 0;
    for (const MapRing& ring : rings_) {
      // A corner keeps the digits of small areas; other points show where a ring is a great circle.
      const bool is_small = std::all_of(ring.begin(), ring.end(),
                                        [&](const MapCorner& c) { return dot(c.p, ring[0].p) > 0.5; });
      const Point from = is_small ? ring[0].p : unit(Point{0.5, 0.6, 0.7});
      for (std::size_t i = 0; i < ring.size(); ++i)
        area += triangle_area(from, ring[i].p, ring[(i + 1) % ring.size()].p);
    }
    return area;
  }

  std::size_t feature;
  bool surrounds_sphere = false;  ///< a side at the meridian 180 may be there twice

 private:
  static constexpr std::size_t kBlock = 32;
  struct Block {
    Point centre;
    double radius, west, east;
  };
  /// The equal longitude from `west` to `west` + 360.
  static double turned(double lon, double west) { return lon + 360 * std::ceil((west - lon) / 360); }

  void add_blocks(const MapRing& ring) {
    std::vector<Block>& blocks = blocks_.emplace_back();
    for (std::size_t b = 0; b < ring.size(); b += kBlock) {
      const std::size_t end = std::min(ring.size(), b + kBlock);
      Block block{{1, 0, 0}, 4, INFINITY, -INFINITY};
      Point sum{0, 0, 0};
      for (std::size_t j = b; j <= end; ++j) {
        const MapCorner& c = ring[j % ring.size()];
        sum = {sum.x + c.p.x, sum.y + c.p.y, sum.z + c.p.z};
        block.west = std::min(block.west, c.x());
        block.east = std::max(block.east, c.x());
      }
      if (dot(sum, sum) > 1e-6) {
        block.centre = unit(sum);
        block.radius = 0;
        for (std::size_t j = b; j <= end; ++j)
          block.radius = std::max(block.radius, angle_between(block.centre, ring[j % ring.size()].p));
        if (block.radius > 1.5) block.radius = 4;  // arcs may leave a large cap
      }
      blocks.push_back(block);
    }
  }

  std::vector<MapRing> rings_;
  std::vector<std::vector<Block>> blocks_;
};

class Clipper {
 public:
  Clipper(const Faces& cells, const Edges& edges, const Polygon& polygon, Pieces& pieces)
      : cells_(cells), edges_(edges), polygon_(polygon), pieces_(pieces), angles_(cells.points, true) {}

  void run() {
    for (std::size_t f = 0; f < cells_.size(); ++f) cut_cell(f);
  }

 private:
  static constexpr int kDeepest = 60;
  /// Chains shorter than this, in radians, are rounding where a border passes a corner of the polygon.
  static constexpr double kShort = 1e-13;
  /// Rounding of places on the border of a cell.
  static constexpr double kSame = 1e-15;

  template <class Visit>
  void for_each_neighbour(std::size_t f, const Visit& visit) const {
    for (std::size_t k = cells_.begin[f]; k < cells_.begin[f + 1]; ++k) {
      const auto edge = static_cast<std::size_t>(edges_.of_faces[k]) - 1;
      for (const std::int32_t face : {edges_.faces[2 * edge], edges_.faces[2 * edge + 1]})
        if (face > 0 && static_cast<std::size_t>(face) - 1 != f) visit(static_cast<std::size_t>(face) - 1);
    }
  }

  static Point middle_of(const MapRing& corners) {
    Point sum{0, 0, 0};
    for (const MapCorner& c : corners) sum = {sum.x + c.p.x, sum.y + c.p.y, sum.z + c.p.z};
    return unit(sum);
  }

  void cut_cell(std::size_t f) {
    const Point& node = cells_.centres[f];
    const MapRing corners = ring_of(cells_, f, angles_, cells_.corner);
    double radius = 0;
    for (const MapCorner& c : corners) radius = std::max(radius, angle_between(node, c.p));
    std::vector<Chain> chains = polygon_.near(node, radius);
    if (!chains.empty())
      for_each_neighbour(f, [&](std::size_t other) { chains = cut(chains, {node, cells_.centres[other]}); });
    remove_short(chains);
    if (polygon_.surrounds_sphere)
      split(f, corners, chains, {{0, 1, 0}, {0, -1, 0}}, 0);
    else
      add_parts(f, corners, chains, 0);
  }

  static void remove_short(std::vector<Chain>& chains) {
    const auto is_short = [](const Chain& chain) {
      return std::all_of(chain.points.begin(), chain.points.end(), [&](const MapCorner& c) {
        const Point d = minus(c.p, chain.points[0].p);
        return dot(d, d) < kShort * kShort;
      });
    };
    chains.erase(std::remove_if(chains.begin(), chains.end(), is_short), chains.end());
  }

  /// Adds the parts of both halves of a convex polygon.
  void split(std::size_t f, const MapRing& corners, const std::vector<Chain>& chains, const Half& half,
             int depth) {
    for (const Half& h : {half, Half{half.far, half.near}}) {
      // Rounding may cut off a sliver where a side follows the border of the half.
      const std::vector<Chain> left = cut({{corners, true}}, h);
      const auto largest = std::max_element(left.begin(), left.end(), [](const Chain& a, const Chain& b) {
        return std::fabs(area_of(a.points)) < std::fabs(area_of(b.points));
      });
      std::vector<Chain> of_half = cut(chains, h);
      remove_short(of_half);
      if (largest != left.end() && largest->points.size() > 2)
        add_parts(f, largest->points, of_half, depth + 1);
    }
  }

  /// Adds the parts of a convex polygon, part of a cell.
  void add_parts(std::size_t f, const MapRing& corners, const std::vector<Chain>& chains, int depth) {
    for (const Chain& chain : chains) {
      if (!chain.is_closed || area_of(chain.points) > 0 || depth == kDeepest) continue;
      const Point& p = chain.points[0].p;  // a hole: cut through it
      const auto apart = [&](const MapCorner& c) { return dot(minus(c.p, p), minus(c.p, p)); };
      const auto farthest =
          std::max_element(chain.points.begin(), chain.points.end(),
                           [&](const MapCorner& a, const MapCorner& b) { return apart(a) < apart(b); });
      return split(f, corners, chains, {p, farthest->p}, depth);
    }
    std::vector<const MapRing*> open;
    for (const Chain& chain : chains)
      if (chain.is_closed)
        add(chain.points, f);
      else
        open.push_back(&chain.points);
    if (!open.empty())
      join(f, corners, open);
    else if (chains.empty() && polygon_.holds(middle_of(corners)))
      add(corners, f);
  }

  /// Adds the part unless it is narrower than rounding, as where a side of the polygon follows a border of
  /// cells.
  void add(const MapRing& part, std::size_t f) {
    double around = 0;
    for (std::size_t i = 0; i < part.size(); ++i)
      around += angle_between(part[i].p, part[(i + 1) % part.size()].p);
    if (area_of(part) > 1e-14 * around) pieces_.add(part, f);
  }

  /// Adds the parts between the chains and the border of the convex polygon.
  void join(std::size_t f, const MapRing& corners, const std::vector<const MapRing*>& chains) {
    const std::size_t n = corners.size(), m = chains.size();
    std::vector<double> begin(n + 1);  // of the sides, along the border
    for (std::size_t k = 0; k < n; ++k)
      begin[k + 1] = begin[k] + angle_between(corners[k].p, corners[(k + 1) % n].p);
    const double all = begin[n];
    const auto place_of = [&](const Point& p) {
      std::size_t side = 0;
      double least = 10;
      for (std::size_t k = 0; k < n; ++k)
        if (const double off = distance_to_arc(p, corners[k].p, corners[(k + 1) % n].p); off < least)
          least = off, side = k;
      const double place = std::min(begin[side] + angle_between(corners[side].p, p), begin[side + 1]);
      return place < all - kSame ? place : 0;
    };
    struct End {
      double place;
      std::size_t chain;
      bool operator<(const End& other) const { return place < other.place; }
    };
    std::vector<End> entries, exits;
    for (std::size_t c = 0; c < m; ++c) {
      entries.push_back({place_of(chains[c]->front().p), c});
      exits.push_back({place_of(chains[c]->back().p), c});
    }
    std::sort(entries.begin(), entries.end());
    std::sort(exits.begin(), exits.end());
    // Entries and exits alternate; so the k-th exit leads to an entry that is k-th from some other one, and
    // all ways together are shortest. This remains a pairing where rounding exchanges two of them.
    const auto way = [&](std::size_t k, std::size_t shift) {
      const double length = entries[(k + shift) % m].place - exits[k].place;
      return length < -kSame ? length + all : std::max(0.0, length);
    };
    std::size_t best = 0;
    double least = INFINITY;
    for (std::size_t shift = 0; shift < m; ++shift) {
      double sum = 0;
      for (std::size_t k = 0; k < m && sum < least; ++k) sum += way(k, shift);
      if (sum < least) least = sum, best = shift;
    }
    std::vector<std::size_t> exit_of(m);
    for (std::size_t k = 0; k < m; ++k) exit_of[exits[k].chain] = k;
    std::vector<bool> is_done(m);
    for (std::size_t first = 0; first < m; ++first) {
      MapRing part;
      for (std::size_t c = first; !is_done[c];) {
        is_done[c] = true;
        part.insert(part.end(), chains[c]->begin(), chains[c]->end());
        const std::size_t k = exit_of[c];
        const double from = exits[k].place, to = from + way(k, best);
        for (std::size_t turn = 0; turn < 2; ++turn)
          for (std::size_t i = 0; i < n; ++i)
            if (const double at = begin[i] + static_cast<double>(turn) * all; at > from && at < to)
              part.push_back(corners[i]);
        c = entries[(k + best) % m].chain;
      }
      add(part, f);
    }
  }

  const Faces& cells_;
  const Edges& edges_;
  const Polygon& polygon_;
  Pieces& pieces_;
  LonLat angles_;
};

}  // namespace

Faces clipped_to_polygons(const Faces& cells, const std::vector<MapRegion>& polygons) {
  Pieces pieces(cells);
  const Edges edges = edges_of(cells);
  std::vector<Polygon> all(polygons.begin(), polygons.end());
  std::vector<std::size_t> end;  // of the parts of each polygon
  for (const Polygon& polygon : all) {
    Clipper(cells, edges, polygon, pieces).run();
    end.push_back(pieces.size());
  }
  Faces parts = pieces.take();
  const std::vector<double> of_parts = areas(parts);
  std::size_t f = 0;
  for (std::size_t k = 0; k < all.size(); ++k) {
    double sum = 0;
    for (; f < end[k]; ++f) sum += of_parts[f];
    if (std::fabs(std::remainder(sum - all[k].area(), kSphere)) > 1e-9 * std::max(sum, kLeast))
      throw NoMesh(
          fmt::format("the rings of the polygon of feature {} cross or overlap each other or themselves",
                      all[k].feature));
  }
  return parts;
}

}  // namespace files
