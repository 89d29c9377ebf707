#pragma once
// Gradients of scattered values, estimated at their nodes.

#include <vector>

#include "methods/triangulated.h"

namespace methods {

/// At each node the gradient on the unit sphere of the quadratic in the tangent plane that passes through the
/// node's value and fits those of its neighbours and their neighbours best, weighted by one over the squared
/// distance (Renka, Interpolation of data on the surface of a sphere, ACM TOMS 10, 1984, section 3); of the
/// linear function where the nodes do not determine a quadratic, and zero where not even that. Unit vectors;
/// the gradient is tangential. The same bits for any number of threads.
std::vector<Point> gradients(const Triangulated& mesh, const std::vector<double>& values);

}  // namespace methods
