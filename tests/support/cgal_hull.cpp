#include "cgal_hull.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/convex_hull_3.h>

#include <array>
#include <map>

#include "reference_predicates.h"

Hull cgal_hull(const Nodes& nodes) {
  using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
  using Surface = CGAL::Surface_mesh<Kernel::Point_3>;
  std::vector<Kernel::Point_3> points;
  std::map<std::array<double, 3>, std::int32_t> number;
  for (const auto& p : nodes) {
    number.emplace(std::array<double, 3>{p.x, p.y, p.z}, static_cast<std::int32_t>(points.size()));
    points.emplace_back(p.x, p.y, p.z);
  }
  Surface surface;
  CGAL::convex_hull_3(points.begin(), points.end(), surface);
  Hull hull;
  for (const auto face : surface.faces()) {
    std::array<std::int32_t, 3> f{};
    int corner = 0;
    for (const auto vertex : surface.vertices_around_face(surface.halfedge(face))) {
      const auto& p = surface.point(vertex);
      f[corner++] = number.at({p.x(), p.y(), p.z()});
    }
    if (exact::left(nodes[f[0]], nodes[f[1]], nodes[f[2]]) > 0) hull.faces.push_back(f);
  }
  sort_faces(hull.faces);
  hull.hidden = nodes.size() - surface.number_of_vertices();
  return hull;
}
