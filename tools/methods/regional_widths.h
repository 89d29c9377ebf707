#pragma once
// Widths of cells for a mesh from which a limited area is cut.

#include "files/limited_area.h"
#include "methods/widths.h"

namespace methods {

struct RegionalWidths {
  Widths widths;
  double inside = 0;             ///< cells in the area, without layers; to some percent
  files::Point centre{0, 0, 0};  ///< of these, a unit vector
};

/// The given widths in the area. The layers of cells around it have the widths at its boundary; from there
/// on widths grow by `gradient` km per km, up to a sixth of the radius, which is in km. On a grid that is
/// fine at the area and coarse elsewhere. Throws std::runtime_error if the area is smaller than a cell.
RegionalWidths widths_in(const files::LimitedArea& area, const Widths& given, double gradient, double radius);

/// front_generators() of the scvt, with the centre in the middle of a face of their icosahedron: up to 2300
/// km from there on the Earth, all of an area is one lattice, without the faults between the lattices of
/// faces.
std::vector<files::Point> front_around(const files::Point& centre, std::size_t n, const Density& density);

}  // namespace methods
