#pragma once

#include <cstddef>
#include <vector>

#include "geometry/point.h"

/// Seconds that Qhull takes for the convex hull of the points, facets as it finds them: those that are flat
/// to within its rounding are one, and not cut into triangles (no Qt). `vertices` receives how many of the
/// points became vertices. Throws std::runtime_error if Qhull gives up.
double qhull_seconds(const std::vector<pstripack::Point>& points, std::size_t& vertices);
const char* qhull_version();
