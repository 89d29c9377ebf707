#pragma once
// Integrals over the Voronoi cells of generators on the unit sphere.

#include <cstddef>
#include <cstdint>
#include <vector>

#include "geometry/point.h"
#include "scvt/density.h"

namespace pstripack::scvt {

/// The neighbours of points 0..count-1: those of point i are neighbour[end[i-1]] ... neighbour[end[i]-1],
/// as indices from 1 into the array of points, counterclockwise. The first is the one with the smallest
/// number in the whole tessellation. end[-1] counts as 0. LEND and LIST of TRMESH's canonical lists are such
/// arrays.
struct NeighbourLists {
  std::size_t count = 0;
  const std::int32_t* end = nullptr;
  const std::int32_t* neighbour = nullptr;

  std::size_t begin_of(std::size_t i) const { return i == 0 ? 0 : static_cast<std::size_t>(end[i - 1]); }
  std::size_t end_of(std::size_t i) const { return static_cast<std::size_t>(end[i]); }
};

/// Integrals over the cell of each generator g. Since |p-g|^2 = 2 - 2 p.g (chord length), the integral of
/// density times p is
///     pull + (mass - energy/2) g,
/// and the derivative of the energy of all cells with respect to g is -2 pull: the moving boundaries of the
/// cells contribute nothing.
struct Cells {
  std::vector<Point> pull;     ///< integral of density times p, the part perpendicular to g
  std::vector<double> mass;    ///< integral of density
  std::vector<double> energy;  ///< integral of density times |p-g|^2

  void resize(std::size_t n) {
    pull.resize(n);
    mass.resize(n);
    energy.resize(n);
  }
};

/// The centroid of cell i, whose generator is g: the direction of the integral of density times p over the
/// cell. A unit vector.
Point centroid(const Cells& cells, std::size_t i, const Point& g);

/// Integrates the cells of points 0..stars.count-1, which have unit length; other points are only
/// neighbours. On threads, unless the density is serial. The results of a cell have the same bits whatever
/// its number is and whichever thread or rank integrates it, if its star begins with the same neighbour.
/// Relative errors are below 5e-7 for a constant density. For a smooth density they grow with the third
/// power of the width of the cell. Throws BadDensity, std::bad_alloc, and what the density throws.
void integrate(const Point* points, const NeighbourLists& stars, const Density& density, Cells& cells);

}  // namespace pstripack::scvt
