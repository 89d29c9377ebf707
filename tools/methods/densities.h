#pragma once
// Densities of centroidal Voronoi tessellations: formulas, values at nodes, values on a grid.

#include <cstddef>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "files/nodes.h"
#include "scvt/density.h"

namespace methods {

using pstripack::scvt::Density;

/// A density as a function that sets value[i] at p[i], i = 0..n-1, as Density::at() does.
class DensityBy final : public Density {
 public:
  using Function = std::function<void(std::size_t n, const files::Point* p, double* value)>;
  explicit DensityBy(Function function) : function_(std::move(function)) {}
  using Density::at;
  void at(std::size_t n, const files::Point* p, double* value) const override { function_(n, p, value); }

 private:
  Function function_;
};

/// "constant", or "bump" with or without ":LON,LAT,RADIUS,WIDTH,RATIO" in degrees:
///     (1 + (RATIO-1) (1 + tanh((RADIUS-d)/WIDTH))/2)^4
/// at the distance d from LON, LAT; cells are RATIO times narrower there. Throws std::invalid_argument.
std::unique_ptr<Density> density_of(const std::string& formula);

/// Linear interpolation between values at nodes. Throws files::NoMesh.
std::unique_ptr<Density> density_between(const std::vector<files::Point>& nodes, std::vector<double> values);

/// Bilinear interpolation in longitude and latitude between values on a grid, row after row of latitude.
/// Longitudes must go once around the globe. Between the last row and the pole the value changes linearly to
/// the mean of that row. Throws std::runtime_error, saying why, if the axes are no such grid.
std::unique_ptr<Density> density_on_grid(const files::Grid& grid, const std::vector<double>& values);

}  // namespace methods
