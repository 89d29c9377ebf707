#pragma once

#include <cstddef>
#include <vector>

#include "geometry/point.h"

/// Seconds that Qhull takes for the convex hull of the points. Facets that are coplanar within its rounding
/// are merged, not triangulated (no Qt). `vertices` receives the number of points that became vertices.
/// Throws std::runtime_error if Qhull gives up.
double qhull_seconds(const std::vector<pstripack::Point>& points, std::size_t& vertices);
const char* qhull_version();
