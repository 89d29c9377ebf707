#pragma once
// Lengths, angles and areas of arcs and triangles with unit vectors as corners.

#include <algorithm>
#include <cmath>

#include "geometry/point.h"

namespace files {

constexpr double kPi = 3.14159265358979323846;
constexpr double kDegree = kPi / 180;           ///< radians
constexpr double kRadian = 57.295779513082321;  ///< degrees
constexpr double kEarthRadius = 6371;           ///< km

/// The longitude of a vector of any length, in degrees.
inline double longitude(const pstripack::Point& p) { return std::atan2(p.y, p.x) * kRadian; }
inline double latitude(const pstripack::Point& p) { return std::atan2(p.z, std::hypot(p.x, p.y)) * kRadian; }

/// The unit vector in the direction of p.
inline pstripack::Point unit(const pstripack::Point& p) {
  const double length = std::hypot(p.x, p.y, p.z);
  return {p.x / length, p.y / length, p.z / length};
}

/// Angle between two vectors in radians; accurate for small angles.
inline double angle_between(const pstripack::Point& a, const pstripack::Point& b) {
  const pstripack::Point d = minus(a, b);
  return 2 * std::asin(std::min(1.0, std::sqrt(dot(d, d)) / 2));
}

/// det(a,b,c), accurate for close vectors.
inline double volume(const pstripack::Point& a, const pstripack::Point& b, const pstripack::Point& c) {
  return dot(a, cross(minus(b, a), minus(c, a)));
}

inline double length(const pstripack::Point& p) { return std::sqrt(dot(p, p)); }

/// Area of the spherical triangle in steradians; positive if counterclockwise (van Oosterom & Strackee 1983).
/// Computed from differences of the corners, so that small triangles keep their digits.
inline double triangle_area(const pstripack::Point& a, const pstripack::Point& b, const pstripack::Point& c) {
  return 2 * std::atan2(volume(a, b, c), 1 + dot(a, b) + dot(b, c) + dot(c, a));
}

}  // namespace files
