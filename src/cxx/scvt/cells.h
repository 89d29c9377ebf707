#pragma once
// Integrals over the Voronoi cells of generators on the unit sphere.

#include <cmath>
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
/// The cells are those of the directions of the points. Errors for a constant density, however small a cell
/// is: of the mass, relative to it, and of the pull, relative to the mass times the root of energy / mass,
/// 1e-7; of the energy, relative to it, 5e-7, but 1.5e-5 in a long cell 0.06 to 0.15 rad in radius. (For
/// cells more than 10^8 times as long as wide add 1e-15 times that ratio.) For a smooth density errors grow
/// with the third power of the width of the cell. Cells narrower than 1e-75, or without an area, are not
/// is_good(). Throws BadDensity, std::bad_alloc, and what the density throws.
void integrate(const Point* points, const NeighbourLists& stars, const ScaledDensity& density, Cells& cells);

/// The neighbour of point i that is nearest to it: an index from 0.
std::size_t nearest_neighbour(const Point* points, const NeighbourLists& stars, std::size_t i);

/// Whether the masses of all cells of density 1 may add up to `area`: to 4 pi up to ten times their error.
inline bool is_sphere(double area) { return std::fabs(area / 12.566370614359172 - 1) <= 1e-6; }

/// Whether the integrals of cell i are positive, finite, and not rounded to 0 or nearly.
inline bool is_good(const Cells& cells, std::size_t i) {
  constexpr double kLeast = 0x1p-1000, kMost = 0x1p900;
  return cells.mass[i] > kLeast && cells.mass[i] < kMost && cells.energy[i] > kLeast &&
         cells.energy[i] < kMost && std::isfinite(dot(cells.pull[i], {1, 1, 1}));
}

}  // namespace pstripack::scvt
