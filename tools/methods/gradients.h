#pragma once
// Gradients of scattered values, estimated at their nodes.

#include <cstddef>
#include <cstdint>
#include <vector>

#include "methods/triangulated.h"

namespace methods {

/// Values of the nodes: `columns` of `stride` consecutive ones for each node.
struct NodeValues {
  const double* first;
  std::size_t columns, stride;
};

/// The gradient at each node, a tangent vector on the unit sphere. It is that of the quadratic in the tangent
/// plane that passes through the node's value and fits best those of its neighbours and their neighbours,
/// weighted by one over the squared distance (Renka, Interpolation of data on the surface of a sphere, ACM
/// TOMS 10, 1984, section 3). If the nodes do not determine a quadratic, a linear function is fitted. If the
/// nodes around lie on a great circle, to 1e-4 of their distances, a straight line along it is fitted, and
/// the part across it is zero. The differences between nodes are right up to 4 * 2^-53 of their lengths; how
/// much the fit magnifies that depends on the nodes. Any number of threads gives the same bits.
///
/// The result has `columns` consecutive gradients for each node.
std::vector<Point> gradients(const Triangulated& mesh, const NodeValues& values);
inline std::vector<Point> gradients(const Triangulated& mesh, const std::vector<double>& values) {
  return gradients(mesh, {values.data(), 1, 1});
}

/// The same as sums for each node: the gradient is that of part * (value of `node` - its own value).
struct GradientTerm {
  std::int32_t node;  ///< from 1
  Point part;
};
using GradientTerms = std::vector<std::vector<GradientTerm>>;
GradientTerms gradient_terms(const Triangulated& mesh);

}  // namespace methods
