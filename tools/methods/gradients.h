#pragma once
// Gradients of scattered values, estimated at their nodes.

#include <vector>

#include "methods/triangulated.h"

namespace methods {

/// The gradient at each node, a tangent vector on the unit sphere. It is that of the quadratic in the tangent
/// plane that passes through the node's value and fits best those of its neighbours and their neighbours,
/// weighted by one over the squared distance (Renka, Interpolation of data on the surface of a sphere, ACM
/// TOMS 10, 1984, section 3). If the nodes do not determine a quadratic, a linear function is fitted; if not
/// even that, the gradient is zero. The differences between nodes are right up to 4 * 2^-53 of their lengths;
/// how much the fit magnifies that depends on the nodes. Any number of threads gives the same bits.
std::vector<Point> gradients(const Triangulated& mesh, const std::vector<double>& values);

}  // namespace methods
