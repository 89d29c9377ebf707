#pragma once
// Integrals over the Voronoi cells of generators on the unit sphere.

#include <cstddef>
#include <cstdint>
#include <vector>

#include "geometry/point.h"
#include "scvt/density.h"

namespace pstripack::scvt {

/// The neighbours of the first `count` of some points: those of point i (from 0) are neighbour[end[i-1]] ...
/// neighbour[end[i]-1], numbers from 1, counterclockwise, beginning with the one of smallest number in the
/// whole tessellation. LEND and LIST of TRMESH's canonical lists are such arrays.
struct NeighbourLists {
  std::size_t count = 0;
  const std::int32_t* end = nullptr;
  const std::int32_t* neighbour = nullptr;

  std::size_t begin_of(std::size_t i) const { return i == 0 ? 0 : static_cast<std::size_t>(end[i - 1]); }
  std::size_t end_of(std::size_t i) const { return static_cast<std::size_t>(end[i]); }
};

/// Of each generator g, over its cell. With the chord, |p-g|^2 = 2 - 2 p.g, the integral of density times p
/// is
///     pull + (mass - energy/2) g,
/// and the derivative of the energy of all cells to g is -2 pull: the boundaries of the cells add nothing.
struct Cells {
  std::vector<Point> pull;     ///< integral of density times p, its part at right angles to g
  std::vector<double> mass;    ///< of density
  std::vector<double> energy;  ///< of density times |p-g|^2

  void resize(std::size_t n) {
    pull.resize(n);
    mass.resize(n);
    energy.resize(n);
  }
};

/// The direction of the integral of density times p over cell i of the generator g: where Lloyd's method
/// moves it.
Point centroid(const Cells& cells, std::size_t i, const Point& g);

/// Integrates the cells of the first stars.count points, which have unit length; other points are only
/// neighbours. On threads, unless the density is serial. A cell has the same bits whatever its number is and
/// whoever integrates it, if its star begins with the same neighbour. Relative errors are below 5e-7 for a
/// constant density, and grow with the third power of the width of the cell where a smooth density varies.
/// Throws BadDensity, std::bad_alloc, and what the density throws.
void integrate(const Point* points, const NeighbourLists& stars, const Density& density, Cells& cells);

}  // namespace pstripack::scvt
