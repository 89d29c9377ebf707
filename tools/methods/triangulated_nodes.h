#pragma once

#include <vector>

#include "methods/interpolation.h"

namespace methods {

/// On the triangulation of the directions of nodes. Throws files::NoMesh with indices into `nodes`.
Interpolation interpolation_between(const std::vector<Point>& nodes);

}  // namespace methods
