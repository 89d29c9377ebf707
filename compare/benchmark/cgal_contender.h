#pragma once

#include <cstddef>
#include <vector>

#include "geometry/point.h"

/// Seconds that CGAL's Delaunay_triangulation_on_sphere_2 takes to insert the points, all at once and in the
/// order that it likes best. `vertices` receives how many of them became vertices.
double cgal_seconds(const std::vector<pstripack::Point>& points, std::size_t& vertices);
const char* cgal_version();
