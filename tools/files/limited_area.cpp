#include "files/limited_area.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "files/measures.h"
#include "files/text_file.h"
#include "point_sets.h"

namespace files {

// ---- areas ------------------------------------------------------------------------------------------------

std::vector<std::pair<double, double>> LimitedArea::inside(double parallel) const {
  std::vector<std::pair<double, double>> pairs;
  for (const MapRegion& polygon : polygons)
    for (const auto& pair : polygon.inside(parallel)) pairs.push_back(pair);
  return pairs;
}

bool LimitedArea::contains(const Point& p) const {
  return std::any_of(polygons.begin(), polygons.end(),
                     [&](const MapRegion& polygon) { return polygon.contains(p); });
}

std::vector<std::vector<Point>> LimitedArea::boundary() const {
  constexpr double kStep = 0.1;  // degrees. An arc leaves a line on the map by at most step^2 / 16.
  std::vector<std::vector<Point>> lines;
  for (const MapRegion& polygon : polygons)
    for (const auto& ring : polygon.rings) {
      std::vector<Point>& line = lines.emplace_back();
      for (std::size_t i = 1; i < ring.size(); ++i) {
        const auto [x, y] = ring[i - 1];
        const double dx = ring[i].first - x, dy = ring[i].second - y;
        const double steps = std::ceil(std::max({std::fabs(dx), std::fabs(dy), kStep}) / kStep);
        for (double k = 0; k < steps; ++k)
          line.push_back(point_sets::from_degrees(x + k / steps * dx, y + k / steps * dy));
      }
      line.push_back(line.front());
    }
  return lines;
}

std::vector<Region> LimitedArea::boxes() const {
  std::vector<Region> boxes;
  for (const MapRegion& polygon : polygons) {
    Region& box = boxes.emplace_back(Region{INFINITY, -INFINITY, 90, -90});
    for (const auto& ring : polygon.rings)
      for (const auto& [x, y] : ring)
        box = {std::min(box.west, x), std::max(box.east, x), std::min(box.south, y), std::max(box.north, y)};
  }
  return boxes;
}

LimitedArea box_area(std::string name, const Region& box, bool great_circles) {
  LimitedArea area{std::move(name), {region_of_box(box)}, great_circles};
  if (great_circles) follow_great_circles(area.name, area.polygons[0]);
  return area;
}

LimitedArea circle_area(std::string name, double lon, double lat, double radius, bool great_circles) {
  return {std::move(name),
          {ellipse_region(lon, lat, radius, radius, 0, great_circles ? 100 : 3600)},
          great_circles};
}

LimitedArea file_area(const std::string& file, double radius, bool are_degrees, bool great_circles) {
  LimitedArea area{file, read_polygons(file, radius), great_circles};
  bool may_be_radians = !are_degrees;
  for (MapRegion& polygon : area.polygons) {
    try {
      expect_no_crossing(polygon);
    } catch (const NoMesh& e) {
      fail(file, "{}", e.what());
    }
    may_be_radians = may_be_radians && polygon.corners.empty();
    for (const auto& [lon, lat] : polygon.rings[0])
      may_be_radians = may_be_radians && std::fabs(lon) <= 2 * kPi && std::fabs(lat) <= kPi / 2;
    if (great_circles && polygon.corners.empty()) follow_great_circles(file, polygon);
    area.has_chains = !polygon.corners.empty();
  }
  if (may_be_radians)
    fail(file,
         "all longitudes are within 2 pi and all latitudes within pi/2: GeoJSON is in degrees; "
         "if these are degrees, say --units degrees");
  return area;
}

// ---- layers -----------------------------------------------------------------------------------------------

namespace {

class Layers {
 public:
  Layers(const Mesh& mesh, const LimitedArea& area)
      : area_(area), reader_(mesh.lists()), cells_(unit(mesh.points)), layer_(cells_.size(), kUnknown) {}

  std::vector<std::int32_t> run() {
    std::size_t now = 0;
    const auto go_to = [&](const Point& p) { now = walk(now, cells_[now], p, false); };
    if (area_.has_chains) {
      for (const MapRegion& polygon : area_.polygons)
        for (const std::vector<Point>& line : polygon.corners) {
          go_to(line.back());
          for (const Point& corner : line) {
            const std::size_t before = now;
            go_to(corner);
            add_chain(before, now);
          }
        }
    } else {
      for (const std::vector<Point>& line : area_.boundary()) {
        go_to(line[0]);
        for (std::size_t k = 1; k < line.size(); ++k) now = walk(now, line[k - 1], line[k], true);
      }
    }
    fill();
    check_cells(now);
    check_connected();
    add_layers();
    return std::move(layer_);
  }

 private:
  static constexpr std::int32_t kUnknown = -2, kInside = -3;

  std::string place(std::size_t cell) const {
    return fmt::format("lon {:.6g} lat {:.6g}", longitude(cells_[cell]), latitude(cells_[cell]));
  }

  /// Square of the distance.
  double apart(const Point& p, std::size_t cell) const {
    const Point d = minus(p, cells_[cell]);
    return dot(d, d);
  }

  /// From the cell of p to that of q, through all cells that the arc from p to q crosses, which become part
  /// of the region. The difference of the squares of the distances to two nodes is linear along the chord:
  /// its zero is where the chord leaves the cell. Each cell's node is nearer to q than the one before.
  std::size_t walk(std::size_t cell, const Point& p, const Point& q, bool marks) {
    while (true) {
      if (marks) layer_[cell] = 0;
      const double here = apart(q, cell);
      std::size_t next = cell;
      double first = 2;
      for_each_neighbour(reader_, cell, [&](std::size_t n) {
        const double nearer = here - apart(q, n);
        if (!(nearer > 0)) return;
        const double before = std::min(0.0, apart(p, cell) - apart(p, n));
        if (const double part = -before / (nearer - before); part < first) first = part, next = n;
      });
      if (next == cell) return cell;
      cell = next;
    }
  }

  /// Makes a chain from cell to cell part of the region: the next is, of the neighbours nearer to the end,
  /// the one nearest to the great circle through both ends.
  void add_chain(std::size_t cell, std::size_t end) {
    const Point normal = cross(cells_[cell], minus(cells_[end], cells_[cell]));
    layer_[cell] = layer_[end] = 0;
    while (cell != end) {
      double least = INFINITY;
      const double here = apart(cells_[end], cell);
      const std::size_t before = cell;
      for_each_neighbour(reader_, before, [&](std::size_t n) {
        const double off = std::fabs(dot(normal, cells_[n]));
        if (off < least && apart(cells_[end], n) < here) least = off, cell = n;
      });
      if (cell == before) fail(area_.name, "the triangles at {} are not those of Delaunay", place(cell));
      layer_[cell] = 0;
    }
  }

  /// Calls visit(i) for the cell and all that can be reached from it through unvisited ones of which
  /// enter(i) is true, once.
  template <class Enter, class Visit>
  void flood(std::size_t cell, std::vector<bool>& visited, const Enter& enter, const Visit& visit) const {
    std::vector<std::size_t> stack{cell};
    visited[cell] = true;
    while (!stack.empty()) {
      const std::size_t i = stack.back();
      stack.pop_back();
      visit(i);
      for_each_neighbour(reader_, i, [&](std::size_t n) {
        if (visited[n] || !enter(n)) return;
        visited[n] = true;
        stack.push_back(n);
      });
    }
  }

  /// Between cells on the boundary, neighbours lie on the same side of it: their cells touch. A chain may
  /// leave the boundary by the width of a cell, so cells away from it tell first on which side they are.
  void fill() {
    std::vector<bool> visited(cells_.size());
    for (const bool touches : {false, true})
      for (std::size_t cell = 0; cell < cells_.size(); ++cell) {
        if (layer_[cell] != kUnknown) continue;
        bool touches_boundary = false;
        for_each_neighbour(reader_, cell,
                           [&](std::size_t n) { touches_boundary = touches_boundary || layer_[n] == 0; });
        if (touches_boundary != touches) continue;
        const std::int32_t layer = area_.contains(cells_[cell]) ? kInside : kLeftOut;
        flood(
            cell, visited, [&](std::size_t n) { return layer_[n] == kUnknown; },
            [&](std::size_t i) { layer_[i] = layer; });
      }
    std::replace(layer_.begin(), layer_.end(), kInside, 0);
  }

  /// Throws if no node lies in the area; `cell`: one on its boundary.
  void check_cells(std::size_t cell) const {
    bool has_cells = false;
    for (std::size_t i = 0; i < cells_.size() && !has_cells; ++i)
      has_cells = layer_[i] == 0 && area_.contains(cells_[i]);
    if (has_cells) return;
    double sum = 0, count = 0;
    for_each_neighbour(reader_, cell,
                       [&](std::size_t n) { sum += std::sqrt(apart(cells_[n], cell)), ++count; });
    fail(area_.name,
         "no cell has its centre in the region; those at {} are {:.2g} degrees wide: enlarge the "
         "region, or take a finer mesh",
         place(cell), sum / count / kDegree);
  }

  void check_connected() const {
    const auto is_in = [&](std::size_t n) { return layer_[n] == 0; };
    std::vector<bool> visited(cells_.size());
    const auto first = static_cast<std::size_t>(std::find(layer_.begin(), layer_.end(), 0) - layer_.begin());
    flood(first, visited, is_in, [](std::size_t) {});
    for (std::size_t i = 0; i < cells_.size(); ++i)
      if (is_in(i) && !visited[i])
        fail(area_.name, "two parts that do not touch, at {} and at {}: make a mesh of each", place(first),
             place(i));
  }

  void add_layers() {
    std::vector<std::size_t> last, next;
    for (std::size_t i = 0; i < cells_.size(); ++i)
      if (layer_[i] == 0) last.push_back(i);
    for (std::int32_t layer = 0; layer <= kLayers; ++layer, last.swap(next)) {
      next.clear();
      for (const std::size_t i : last) {
        if (reader_.on_boundary(static_cast<std::int32_t>(i) + 1))
          fail(area_.name,
               "at {} the mesh ends within {} layers of cells around the region: make the region "
               "smaller",
               place(i), kLayers);
        if (layer < kLayers)
          for_each_neighbour(reader_, i, [&](std::size_t n) {
            if (layer_[n] != kLeftOut) return;
            layer_[n] = layer + 1;
            next.push_back(n);
          });
      }
    }
  }

  const LimitedArea& area_;
  const pstripack::ListReader<std::int32_t> reader_;
  const std::vector<Point> cells_;
  std::vector<std::int32_t> layer_;
};

}  // namespace

void set_layers(Mesh& mesh, const LimitedArea& area) { mesh.layers = Layers(mesh, area).run(); }

Mesh mesh_with_boundary(std::vector<Point> points, const pstripack::Triangles& triangles) {
  try {
    return mesh_of(std::move(points), triangles);
  } catch (const NoMesh& e) {
    throw NoMesh(
        fmt::format("the boundary of what is kept touches itself ({}): only --to mpas can hold this; or "
                    "choose another region",
                    e.what()));
  }
}

Mesh cut(const Mesh& mesh) {
  std::vector<std::size_t> kept;
  std::vector<pstripack::index_t> number(mesh.points.size(), pstripack::index_t{-1});
  for (std::size_t i = 0; i < number.size(); ++i)
    if (mesh.layers[i] != kLeftOut) {
      number[i] = static_cast<pstripack::index_t>(kept.size());
      kept.push_back(i);
    }
  pstripack::Triangles triangles;
  const std::vector<std::int32_t> corners = triangles_of(mesh);
  for (std::size_t k = 0; k < corners.size(); k += 3) {
    pstripack::Triangle t;
    for (std::size_t j = 0; j < 3; ++j) t[j] = number[static_cast<std::size_t>(corners[k + j]) - 1];
    if (*std::min_element(t.begin(), t.end()) >= 0) triangles.push_back(t);
  }
  Mesh part = mesh_with_boundary(values_at(mesh.points, kept), triangles);
  static_cast<NodeValues&>(part) = at_nodes(mesh, kept);
  if (find(part.columns, kBdyMaskCell) == nullptr)
    part.columns.push_back(whole_numbers(kBdyMaskCell, "0: region, 1 to 7: layers around it",
                                         {part.layers.begin(), part.layers.end()}));
  part.layers.clear();
  part.variant = mesh.variant;
  return part;
}

}  // namespace files
