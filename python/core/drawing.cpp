#include "drawing.h"

#include <algorithm>
#include <memory>
#include <numeric>

#include "base/parallel_for.h"
#include "files/clipping.h"
#include "files/map_rings.h"
#include "pictures/view.h"

namespace bindings {
namespace {

/// Cells have no such sides: files::voronoi_cells() divides them.
void expect_no_half_turn(const files::Faces& faces) {
  faces.for_each_corner([&](std::size_t f, std::size_t k) {
    if (dot(faces.point(k), faces.point(faces.after(f, k))) < -1 + 1e-12)
      throw NoTriangulation(NoTriangulation::Cause::too_few,
                            "triangle " + std::to_string(f) +
                                " (counted from 0) has two corners opposite each other: it cannot be drawn");
  });
}

/// Runs visit(face, add) for each face, on threads; add(outline, x_y) adds an outline, a vector of items, of
/// which x_y gives the coordinates.
template <class Visit>
Outlines collect(std::size_t faces, const Visit& visit) {
  struct Part {
    std::vector<double> xy;
    std::vector<std::int32_t> corners, face;
  };
  const int threads = pstripack::threads_for(100 * faces);
  std::vector<Part> parts(static_cast<std::size_t>(threads));
  pstripack::ErrorsOfThreads errors(parts.size());
  pstripack::parallel_pieces(faces, threads, [&](std::size_t first, std::size_t last, int piece) {
    const auto number = static_cast<std::size_t>(piece);
    errors.keep(number, [&] {
      Part& part = parts[number];
      for (std::size_t f = first; f < last; ++f)
        visit(f, [&](const auto& outline, const auto& x_y) {
          for (const auto& corner : outline) {
            const auto [x, y] = x_y(corner);
            part.xy.push_back(x);
            part.xy.push_back(y);
          }
          part.corners.push_back(static_cast<std::int32_t>(outline.size()));
          part.face.push_back(static_cast<std::int32_t>(f));
        });
    });
  });
  errors.rethrow();
  const auto joined = [&](auto Part::*member, std::size_t before, auto& to) {
    std::size_t count = before;
    for (const Part& part : parts) count += (part.*member).size();
    to = std::remove_reference_t<decltype(to)>(count);
    auto* next = to.data() + before;
    for (const Part& part : parts) next = std::copy((part.*member).begin(), (part.*member).end(), next);
  };
  Outlines all;
  joined(&Part::xy, 0, all.xy);
  joined(&Part::face, 0, all.face);
  joined(&Part::corners, 1, all.begin);
  all.begin[0] = 0;
  std::partial_sum(all.begin.begin(), all.begin.end(), all.begin.begin());
  return all;
}

/// A view, and the coordinates of its places.
class Drawing {
 public:
  explicit Drawing(const Window& window) {
    const pictures::Frame frame{0, 0, kPixels, kPixels};
    const pictures::Spot centre{window.lon, window.lat};
    if (window.orthographic) {
      auto view = std::make_unique<pictures::Orthographic>(centre, window.radius, frame);
      x_ = {view->middle().x, 1 / view->scale(), -1, 1};
      y_ = {view->middle().y, -1 / view->scale(), -1, 1};
      view_ = std::move(view);
    } else {
      auto view = std::make_unique<pictures::LonLat>(centre, window.radius, frame);
      const pictures::Frame& used = view->frame();
      // Rounding must not carry a corner over the edge.
      const auto& [west, east, south, north] = view->bounds();
      x_ = {used.left, (east - west) / used.width(), west, east, west};
      y_ = {used.bottom, -(north - south) / used.height(), south, north, south};
      view_ = std::move(view);
    }
  }

  const pictures::View& view() const { return *view_; }
  std::pair<double, double> operator()(const pictures::Place& p) const { return {x_.of(p.x), y_.of(p.y)}; }

 private:
  /// Lines are straight within a twentieth of a pixel.
  static constexpr double kPixels = 4000;
  struct Axis {
    double origin, per_pixel, low, high, at_origin = 0;
    double of(double pixel) const { return std::clamp(at_origin + (pixel - origin) * per_pixel, low, high); }
  };
  Axis x_, y_;
  std::unique_ptr<const pictures::View> view_;
};

Outlines outlines_on_map(const files::Faces& faces) {
  const files::MapLines lines(faces);
  return collect(faces.size(), [&](std::size_t f, const auto& add) {
    for (const files::MapRing& ring : lines.polygons(f))
      add(ring, [](const files::MapCorner& c) { return std::pair(c.x(), c.lat); });
  });
}

}  // namespace

files::Faces faces_of(const Triangulation& mesh, bool cells) {
  files::Faces faces;
  std::vector<Point> nodes(mesh.size());
  for (std::size_t i = 0; i < nodes.size(); ++i) nodes[i] = mesh.at(static_cast<std::int32_t>(i));
  if (cells) {
    faces = mesh.cells();
    faces.centres = std::move(nodes);
  } else {
    faces.points = std::move(nodes);
    for (const std::int32_t corner : mesh.triangles()) faces.corner.push_back(corner + 1);
    for (std::size_t k = 0; k <= faces.corner.size(); k += 3) faces.begin.push_back(k);
  }
  expect_no_half_turn(faces);
  return faces;
}

Outlines map_polygons(const Triangulation& mesh, bool cells) {
  return outlines_on_map(faces_of(mesh, cells));
}

CutCells cut_cells(const Triangulation& mesh, const std::vector<files::MapRegion>& polygons) {
  files::Faces cells = faces_of(mesh, true);
  for (Point& centre : cells.centres) centre = files::unit(centre);
  const files::Faces parts = files::clipped_to_polygons(cells, polygons);
  CutCells all{outlines_on_map(parts), Buffer<double>(cells.size())};
  for (std::int32_t& face : all.outlines.face)
    face = static_cast<std::int32_t>(parts.nodes[static_cast<std::size_t>(face)]);
  std::fill(all.area.begin(), all.area.end(), 0);
  for (std::size_t f = 0; f < parts.size(); ++f) all.area[parts.nodes[f]] += parts.area[f];
  return all;
}

Outlines polygons_in(const Window& window, const Triangulation& mesh, bool cells) {
  const files::Faces faces = faces_of(mesh, cells);
  const Drawing drawing(window);
  return collect(faces.size(), [&](std::size_t f, const auto& add) {
    std::vector<Point> corners;
    for (std::size_t k = faces.begin[f]; k < faces.begin[f + 1]; ++k) corners.push_back(faces.point(k));
    for (const pictures::Outline& outline : drawing.view().polygon(corners)) add(outline, drawing);
  });
}

Outlines lines_in(const Window& window, const Triangulation& mesh, bool cells) {
  const files::Faces faces = faces_of(mesh, cells);
  const Drawing drawing(window);
  // Sides on the boundary belong to one triangle, all others to two faces.
  std::vector<std::int32_t> next_on_boundary(faces.points.size() + 1);
  if (!cells) {
    const std::vector<std::int32_t> boundary = mesh.boundary();
    for (std::size_t k = 0; k < boundary.size(); ++k)
      next_on_boundary[static_cast<std::size_t>(boundary[k]) + 1] = boundary[(k + 1) % boundary.size()] + 1;
  }
  return collect(faces.size(), [&](std::size_t f, const auto& add) {
    for (std::size_t k = faces.begin[f]; k < faces.begin[f + 1]; ++k) {
      const std::int32_t from = faces.corner[k], to = faces.corner[faces.after(f, k)];
      if (from > to && next_on_boundary[static_cast<std::size_t>(from)] != to) continue;
      for (const pictures::Outline& line : drawing.view().arc(faces.numbered(from), faces.numbered(to)))
        add(line, drawing);
    }
  });
}

}  // namespace bindings
