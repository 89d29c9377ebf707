#pragma once
// Widths of cells: the distance of neighbours in a mesh of regular hexagons.

#include "scvt/density.h"

namespace pstripack::scvt {

/// How many cells have these widths on a sphere of this radius: the integral of 1/(sqrt(3)/2 width^2). To
/// about 1e-5 of itself; jumps to 1e-4. Sees features down to half a degree; where these are, it looks
/// closer. `widths` may be anything positive; throws BadDensity.
double cells_of_widths(const Density& widths, double radius);

/// Replaces widths by densities of cells with these widths, width^-4. Throws BadDensity.
void densities_of_widths(std::size_t n, const Point* p, double* widths);

}  // namespace pstripack::scvt
