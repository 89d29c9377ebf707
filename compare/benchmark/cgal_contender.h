#pragma once

#include <cstddef>
#include <vector>

#include "geometry/point.h"

/// Seconds that CGAL's Delaunay_triangulation_on_sphere_2 takes to insert all points in an order of its
/// choice. `vertices`: receives the number of points that became vertices.
double cgal_seconds(const std::vector<pstripack::Point>& points, std::size_t& vertices);
const char* cgal_version();
