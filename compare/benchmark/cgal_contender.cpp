// Compiled separately with -O3 -march=native: CGAL at its best, PSTRIPACK as installed.
#include "cgal_contender.h"

#include <CGAL/Delaunay_triangulation_on_sphere_2.h>
#include <CGAL/Delaunay_triangulation_on_sphere_traits_2.h>
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/version.h>

#include <chrono>

double cgal_seconds(const std::vector<pstripack::Point>& points, std::size_t& vertices) {
  using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
  using Traits = CGAL::Delaunay_triangulation_on_sphere_traits_2<Kernel>;
  using Clock = std::chrono::steady_clock;

  std::vector<Kernel::Point_3> nodes;
  nodes.reserve(points.size());
  for (const pstripack::Point& p : points) nodes.emplace_back(p.x, p.y, p.z);

  const auto start = Clock::now();
  CGAL::Delaunay_triangulation_on_sphere_2<Traits> triangulation(Traits(Kernel::Point_3(0, 0, 0), 1));
  triangulation.insert(nodes.begin(), nodes.end());
  const double seconds = std::chrono::duration<double>(Clock::now() - start).count();
  vertices = triangulation.number_of_vertices();
  return seconds;
}

const char* cgal_version() { return CGAL_VERSION_STR; }
