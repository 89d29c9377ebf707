#pragma once
// Spherical centroidal Voronoi tessellations by Lloyd's method.

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "files/mesh.h"
#include "methods/interpolation.h"

namespace methods {

/// A positive function on the sphere.
class Density {
 public:
  virtual ~Density() = default;
  /// Density at a unit vector; NaN if unknown. `near` as in Interpolation.
  virtual double at(const Point& p, std::int32_t& near) const = 0;
  virtual double largest() const = 0;
};

/// "constant", or "bump" with or without ":LON,LAT,RADIUS,WIDTH,RATIO" in degrees:
///     (1 + (RATIO-1) (1 + tanh((RADIUS-d)/WIDTH))/2)^4
/// at the distance d from LON, LAT; cells are RATIO times narrower there. Throws std::invalid_argument.
std::unique_ptr<Density> density_of(const std::string& formula);

/// Linear interpolation between positive values at nodes. Throws files::NoMesh.
std::unique_ptr<Density> density_between(const std::vector<Point>& nodes, std::vector<double> values);

/// n random generators, with about the final density: proportional to the square root of the density.
std::vector<Point> random_generators(std::size_t n, const Density& density, std::uint64_t seed);

/// Lloyd's method (Du, Gunzburger, Ju: Constrained centroidal Voronoi tessellations for surfaces, SIAM J.
/// Sci. Comput. 24, 2003): each step moves every generator to the centroid of its Voronoi cell, the direction
/// of the integral of density times place.
///
/// Quadrature: a cell is the fan of the triangles g, a, b of its generator and two consecutive corners. With
/// the plane triangle's points q, which are seen from the centre at q/|q|,
///     integral of f over g,a,b on the sphere = det(g,a,b)/2 times the mean of f(q/|q|)/|q|^3 over the
///     triangle,
/// and the mean is that of the midpoints of the three sides: exact for polynomials of degree 2 in the plane,
/// so the centroid is right up to the width of the cell cubed.
class Lloyd {
 public:
  Lloyd(std::vector<Point> generators, const Density& density);

  struct Step {
    double energy =
        0;  ///< of the generators before the step: integral of density times squared distance (chord)
    double move = 0;  ///< the largest, each relative to the width of its cell, the square root of its area
  };
  /// The same bits for any number of threads and ranks. Throws files::NoMesh, also if the generators lie in a
  /// hemisphere or the density is unknown.
  Step step();

  const std::vector<Point>& generators() const { return generators_; }
  std::vector<double> densities() const;  ///< at the generators

 private:
  std::vector<Point> generators_;
  const Density& density_;
  std::vector<std::int32_t> near_;  ///< for each generator: where the density was last found
};

}  // namespace methods
