#include "scvt/errors.h"

#include <cmath>
#include <cstdio>

namespace pstripack::scvt {
namespace {

/// "lon 10.5 lat -30", in degrees.
std::string lon_lat(const Point& p) {
  constexpr double kDegrees = 57.295779513082321;
  char text[64];
  std::snprintf(text, sizeof text, "lon %.6g lat %.6g", std::atan2(p.y, p.x) * kDegrees,
                std::atan2(p.z, std::hypot(p.x, p.y)) * kDegrees);
  return text;
}

std::string number(double value) {
  char text[32];
  std::snprintf(text, sizeof text, "%g", value);
  return text;
}

}  // namespace

BadDensity::BadDensity(const Point& p, double v, double value_elsewhere, bool of_width)
    : NoTessellation((of_width ? "the width is " : "the density is ") + number(v) + " at " + lon_lat(p) +
                     (v > 0 && std::isfinite(v)
                          ? " and " + number(value_elsewhere) + " elsewhere: the ratio is too large"
                          : ": it must be positive and finite everywhere")),
      place(p),
      value(v),
      elsewhere(value_elsewhere),
      is_width(of_width) {}

DensityOutOfRange::DensityOutOfRange(const char* result, double largest)
    : NoTessellation(std::string(result) +
                     " is beyond the largest double: divide the density, which reaches " + number(largest) +
                     ", by a constant") {}

CoincidentGenerators::CoincidentGenerators(std::int64_t f, std::int64_t s)
    : BadGenerators(
          "generators " + std::to_string(f) + " and " + std::to_string(s) + " coincide: remove one of them",
          PSTRIPACK_COINCIDENT),
      first(f),
      second(s) {}

GeneratorsTooNear::GeneratorsTooNear(std::int64_t f, std::int64_t s)
    : BadGenerators("the cell of generator " + std::to_string(f) +
                        " is too small: move it away from generator " + std::to_string(s) +
                        ", or remove one of them",
                    PSTRIPACK_COINCIDENT),
      first(f),
      second(s) {}

BadNumber::BadNumber(std::int64_t number)
    : BadGenerators(
          "the generators' number " + std::to_string(number) + (number < 1 ? " is below 1" : " occurs twice"),
          PSTRIPACK_BAD_NUMBER) {}

GeneratorsInHemisphere::GeneratorsInHemisphere()
    : BadGenerators(
          "the generators lie in one hemisphere: a tessellation needs generators all around the sphere",
          PSTRIPACK_HEMISPHERE) {}

}  // namespace pstripack::scvt
