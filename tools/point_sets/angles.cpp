#include <cmath>
#include <optional>

#include "shapes.h"

namespace point_sets {
namespace {

constexpr double kRightAngle = 0x1.921fb54442d18p0, kRest = 0x1.1a62633145c07p-54;  // their sum is pi/2

/// The k, if the angle in radians is the Real nearest to k right angles. Beyond a million of them doubles are
/// too far apart to mean one.
template <class Real>
std::optional<int> right_angles(double angle) {
  const double k = std::round(angle / kRightAngle);
  if (!(std::fabs(k) <= 1e6) || std::fabs(angle - k * kRightAngle) > 1e-6 * std::fabs(k)) return {};
  const auto nearest = static_cast<Real>(std::fma(k, kRightAngle, k * kRest));
  return angle == static_cast<double>(nearest) ? std::optional(static_cast<int>(k)) : std::nullopt;
}

double sin_of_right_angles(int k) {
  constexpr double kSines[] = {0, 1, 0, -1};
  return kSines[(k % 4 + 4) % 4];
}

}  // namespace

// The angle is reduced to 45 degrees without rounding, so that symmetric angles have equal sines.
double sin_degrees(double angle) {
  const double turn = std::fmod(angle, 360);
  const double quarter = std::round(turn / 90);
  const double t = (turn - 90 * quarter) / degrees_per_radian, s = t * t;
  double sine = 0, cosine = 0;
  for (int k = 19; k >= 3; k -= 2) sine = (1 + sine) * (-s / (k * (k - 1)));
  for (int k = 18; k >= 2; k -= 2) cosine = (1 + cosine) * (-s / (k * (k - 1)));
  const int turned = (static_cast<int>(quarter) % 4 + 4) % 4;
  const double size = turned % 2 == 0 ? t + t * sine : 1 + cosine;
  return turned < 2 ? size : -size;
}

double cos_degrees(double angle) { return sin_degrees(90 - std::fabs(std::fmod(angle, 360))); }

Point from_degrees(double longitude, double latitude) {
  const double r = cos_degrees(latitude);
  return {r * cos_degrees(longitude), r * sin_degrees(longitude), sin_degrees(latitude)};
}

// No double is a multiple of pi/2 but 0: the nearest one means it.
double sin_radians(double angle) {
  const std::optional<int> k = right_angles<double>(angle);
  return k ? sin_of_right_angles(*k) : std::sin(angle);
}

double cos_radians(double angle) {
  const std::optional<int> k = right_angles<double>(angle);
  return k ? sin_of_right_angles(*k + 1) : std::cos(angle);
}

double radians_of_single(double angle) {
  const std::optional<int> k = right_angles<float>(angle);
  return k ? std::fma(*k, kRightAngle, *k * kRest) : angle;
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
