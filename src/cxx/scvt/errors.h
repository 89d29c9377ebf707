#pragma once
// Why generators have no centroidal tessellation.

#include <cstdint>
#include <stdexcept>
#include <string>

#include "geometry/point.h"

namespace pstripack::scvt {

struct NoTessellation : std::runtime_error {
  using std::runtime_error::runtime_error;
};

struct BadDensity : NoTessellation {
  BadDensity(const Point& p, double v);
  Point place;
  double value;
};

struct BadGenerators : NoTessellation {
  using NoTessellation::NoTessellation;
};
/// Two generators coincide; numbers from 1.
struct CoincidentGenerators : BadGenerators {
  CoincidentGenerators(std::int64_t f, std::int64_t s);
  std::int64_t first, second;
};
/// A global number of a generator is below 1, or occurs twice.
struct BadNumber : BadGenerators {
  explicit BadNumber(std::int64_t number);
};
/// The generators lie in a hemisphere: some cells are unbounded.
struct GeneratorsInHemisphere : BadGenerators {
  GeneratorsInHemisphere();
};

}  // namespace pstripack::scvt
