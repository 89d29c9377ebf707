#pragma once

#include <vector>

#include "mesh/triangulation.h"
#include "thesis/rounded_tests.h"

namespace thesis {

/// Nodes on one side of a stripe, from south to north.
using Chain = std::vector<pstripack::index_t>;

/// Algorithm 5.3: the |left| + |right| - 2 triangles between the right chain of a stripe and the left chain
/// of the next stripe to the east. None if a chain is empty, or if both are sides of the same stripe.
pstripack::Triangles stitch(const std::vector<Point>& points, const Chain& left, const Chain& right);

}  // namespace thesis
