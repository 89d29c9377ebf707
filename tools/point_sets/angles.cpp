#include <cmath>

#include "shapes.h"

namespace point_sets {

// The angle is reduced to 45 degrees without rounding, so that symmetric angles have equal sines.
double sin_degrees(double angle) {
  const double turn = std::fmod(angle, 360);
  const double quarter = std::round(turn / 90);
  const double t = (turn - 90 * quarter) / degrees_per_radian, s = t * t;
  double sine = 0, cosine = 0;
  for (int k = 19; k >= 3; k -= 2) sine = (1 + sine) * (-s / (k * (k - 1)));
  for (int k = 18; k >= 2; k -= 2) cosine = (1 + cosine) * (-s / (k * (k - 1)));
  switch ((static_cast<int>(quarter) % 4 + 4) % 4) {
    case 0:
      return t + t * sine;
    case 1:
      return 1 + cosine;
    case 2:
      return -(t + t * sine);
    default:
      return -(1 + cosine);
  }
}

double cos_degrees(double angle) { return sin_degrees(90 - std::fabs(std::fmod(angle, 360))); }

Point from_degrees(double longitude, double latitude) {
  const double r = cos_degrees(latitude);
  return {r * cos_degrees(longitude), r * sin_degrees(longitude), sin_degrees(latitude)};
}

Point normalized(const Point& p) {
  const double length = std::sqrt(p.x * p.x + p.y * p.y + p.z * p.z);
  return {p.x / length, p.y / length, p.z / length};
}

Point rounded_to_single(const Point& p) {
  // Volatile: GCC 12 otherwise omits the rounding of two components that it vectorizes.
  volatile const float x = static_cast<float>(p.x), y = static_cast<float>(p.y), z = static_cast<float>(p.z);
  return {x, y, z};
}

}  // namespace point_sets
