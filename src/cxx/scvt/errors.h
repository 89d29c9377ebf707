#pragma once
// Why generators have no centroidal tessellation. `code` is that of the C interface.

#include <cstdint>
#include <stdexcept>
#include <string>

#include "capi/pstripack.h"
#include "geometry/point.h"

namespace pstripack::scvt {

struct NoTessellation : std::runtime_error {
  explicit NoTessellation(const std::string& why, std::int32_t c = PSTRIPACK_BAD_DENSITY)
      : std::runtime_error(why), code(c) {}
  std::int32_t code;
};

/// A value that is not positive and finite, or too far from another one; of a density or of a width.
struct BadDensity : NoTessellation {
  BadDensity(const Point& p, double v, double value_elsewhere = 1, bool of_width = false);
  Point place;
  double value, elsewhere;
  bool is_width;
};
/// The density is so large, or so small, that a result would be beyond the doubles.
struct DensityOutOfRange : NoTessellation {
  DensityOutOfRange(const char* result, double largest);
};

struct BadGenerators : NoTessellation {
  explicit BadGenerators(const std::string& why, std::int32_t c = PSTRIPACK_BAD_COORDINATE)
      : NoTessellation(why, c) {}
};
/// Two generators coincide; numbers from 1.
struct CoincidentGenerators : BadGenerators {
  CoincidentGenerators(std::int64_t f, std::int64_t s);
  std::int64_t first, second;
};
/// The cell of a generator is so small, or so thin, that doubles do not hold its integrals. `second` is its
/// nearest neighbour.
struct GeneratorsTooNear : BadGenerators {
  GeneratorsTooNear(std::int64_t f, std::int64_t s);
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
