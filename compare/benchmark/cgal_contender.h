#pragma once

#include <cstddef>
#include <vector>

#include "geometry/point.h"

/// Seconds that CGAL's Delaunay_triangulation_on_sphere_2 takes to insert all points at once, in the order it
/// chooses. `vertices` receives the number of points that became vertices.
double cgal_seconds(const std::vector<pstripack::Point>& points, std::size_t& vertices);
const char* cgal_version();
