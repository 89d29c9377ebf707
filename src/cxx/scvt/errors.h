#pragma once
// Why generators have no centroidal tessellation. `code` is that of the C interface.

#include <cmath>
#include <cstdint>
#include <cstdio>
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

/// As printf with %g.
inline std::string number(double value, const char* format = "%g") {
  char text[32];
  std::snprintf(text, sizeof text, format, value);
  return text;
}

/// "lon 10.5 lat -30", in degrees.
inline std::string lon_lat(const Point& p) {
  constexpr double kDegrees = 57.295779513082321;
  return "lon " + number(std::atan2(p.y, p.x) * kDegrees, "%.6g") + " lat " +
         number(std::atan2(p.z, std::hypot(p.x, p.y)) * kDegrees, "%.6g");
}

/// A value that is not positive and finite, or too far from another one; of a density or of a width.
struct BadDensity : NoTessellation {
  BadDensity(const Point& p, double v, double value_elsewhere = 1, bool of_width = false)
      : NoTessellation((of_width ? "the width is " : "the density is ") + number(v) + " at " + lon_lat(p) +
                       (v > 0 && std::isfinite(v)
                            ? " and " + number(value_elsewhere) + " elsewhere: the ratio is too large"
                            : ": it must be positive and finite everywhere")),
        place(p),
        value(v),
        elsewhere(value_elsewhere),
        is_width(of_width) {}
  Point place;
  double value, elsewhere;
  bool is_width;
};
/// The density is so large, or so small, that a result would be beyond the doubles.
struct DensityOutOfRange : NoTessellation {
  DensityOutOfRange(const char* result, double largest)
      : NoTessellation(std::string(result) +
                       " is beyond the largest double: divide the density, which reaches " + number(largest) +
                       ", by a constant") {}
};

struct BadGenerators : NoTessellation {
  explicit BadGenerators(const std::string& why, std::int32_t c = PSTRIPACK_BAD_COORDINATE)
      : NoTessellation(why, c) {}
};
/// Two generators coincide; numbers from 1.
struct CoincidentGenerators : BadGenerators {
  CoincidentGenerators(std::int64_t f, std::int64_t s)
      : BadGenerators(
            "generators " + std::to_string(f) + " and " + std::to_string(s) + " coincide: remove one of them",
            PSTRIPACK_COINCIDENT),
        first(f),
        second(s) {}
  std::int64_t first, second;
};
/// The cell of a generator is so small, or so thin, that doubles do not hold its integrals. `second` is its
/// nearest neighbour.
struct GeneratorsTooNear : BadGenerators {
  GeneratorsTooNear(std::int64_t f, std::int64_t s)
      : BadGenerators("the cell of generator " + std::to_string(f) +
                          " is too small: move it away from generator " + std::to_string(s) +
                          ", or remove one of them",
                      PSTRIPACK_COINCIDENT),
        first(f),
        second(s) {}
  std::int64_t first, second;
};
/// The generators lie in a hemisphere: some cells are unbounded.
struct GeneratorsInHemisphere : BadGenerators {
  GeneratorsInHemisphere()
      : BadGenerators(
            "the generators lie in one hemisphere: a tessellation needs generators all around the sphere",
            PSTRIPACK_HEMISPHERE) {}
};

}  // namespace pstripack::scvt
