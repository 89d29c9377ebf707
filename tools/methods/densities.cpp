#include "methods/densities.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <utility>

#include "files/measures.h"
#include "files/nearest.h"
#include "files/text_file.h"
#include "methods/grid_values.h"
#include "methods/triangulated_nodes.h"
#include "point_sets.h"

namespace methods {

using files::kDegree;
using files::Point;

std::unique_ptr<Density> density_of(const std::string& formula) {
  if (formula == "constant") return std::make_unique<pstripack::scvt::ConstantDensity>();
  std::vector<double> v{0, 30, 30, 10, 3};
  const auto fail = [&](const char* what) {
    throw std::invalid_argument("density '" + files::excerpt(formula) + "': " + what);
  };
  if (formula.rfind("bump", 0) != 0 || (formula.size() > 4 && formula[4] != ':'))
    fail("expected constant, bump or bump:LON,LAT,RADIUS,WIDTH,RATIO");
  if (formula.size() > 4) {
    v = files::numbers_between(formula.substr(5), ',');
    if (v.size() != 5) fail("expected five numbers: LON,LAT,RADIUS,WIDTH,RATIO");
    if (!(std::fabs(v[1]) <= 90)) fail("LAT is beyond the pole");
    if (!(v[3] > 0)) fail("WIDTH must be positive");
    if (!(v[4] > 0 && v[4] <= 1000)) fail("RATIO must be above 0, and at most 1000");
  }
  return std::make_unique<pstripack::scvt::BumpDensity>(point_sets::from_degrees(v[0], v[1]), v[2] * kDegree,
                                                        v[3] * kDegree, v[4]);
}

std::unique_ptr<Density> density_between(const std::vector<Point>& nodes, std::vector<double> values) {
  const auto interpolation = std::make_shared<const Interpolation>(interpolation_between(nodes));
  return std::make_unique<DensityBy>(
      [interpolation, values = std::move(values)](std::size_t n, const Point* p, double* value) {
        thread_local std::vector<Share> shares;
        thread_local std::int32_t near = 1;  // start near the last place; the result does not depend on it
        if (static_cast<std::size_t>(near) > values.size()) near = 1;  // that density had more nodes
        for (std::size_t i = 0; i < n; ++i) {
          value[i] = std::numeric_limits<double>::quiet_NaN();
          if (!interpolation->linear(p[i], near, shares)) continue;
          double mean = 0;
          for (const Share& s : shares) mean += s.part * values[static_cast<std::size_t>(s.node) - 1];
          value[i] = in_range(mean);
        }
      });
}

std::unique_ptr<Density> density_on_grid(const files::Grid& grid, const std::vector<double>& values) {
  return std::make_unique<DensityBy>(
      [table = GridValues<double>(table_of<double>(grid, values))](std::size_t n, const Point* p,
                                                                   double* value) { table.at(n, p, value); });
}

}  // namespace methods
