#pragma once
// Counts the method's defects exactly; not part of the method.

#include <cstddef>
#include <vector>

#include "mesh/triangulation.h"

namespace thesis {

struct Defects {
  std::size_t inverted = 0;      ///< triangles that are not counterclockwise
  std::size_t boundary = 0;      ///< arcs without a triangle on the other side
  std::size_t not_delaunay = 0;  ///< arcs with the opposite node in the circle, by `above`, without ties
  std::size_t ties = 0;          ///< those whose node is less than 1e-14 above the plane of the other three
};
Defects find_defects(const std::vector<pstripack::Point>& points, const pstripack::Triangles& triangles);

}  // namespace thesis
