#pragma once

#include <cmath>
#include <type_traits>

namespace pstripack {

/// A vector of numbers of the kind T. The order of evaluation of the functions below decides bits of results.
template <class T>
struct Vector3 {
  T x, y, z;
};

/// A node as the caller gave it: the vector from the centre of the sphere. Its length is 1 up to rounding
/// unless the predicates on directions are used.
using Point = Vector3<double>;

inline bool operator==(const Point& a, const Point& b) { return a.x == b.x && a.y == b.y && a.z == b.z; }
inline bool operator!=(const Point& a, const Point& b) { return !(a == b); }

template <class T>
Vector3<T> minus(const Vector3<T>& a, const Vector3<T>& b) {
  return {a.x - b.x, a.y - b.y, a.z - b.z};
}
template <class T>
Vector3<T> plus(const Vector3<T>& a, const Vector3<T>& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
template <class T>
Vector3<T> scaled(std::common_type_t<T> factor, const Vector3<T>& a) {
  return {factor * a.x, factor * a.y, factor * a.z};
}
template <class T>
T dot(const Vector3<T>& a, const Vector3<T>& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
/// a x b; every component is a difference of two products.
template <class T>
Vector3<T> cross(const Vector3<T>& a, const Vector3<T>& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

/// True for the square of a length from 2^-150 to 2^150. A product of at most six such lengths and components
/// of theirs does not overflow, and where a factor of it underflows, that changes it by less than 2^-1074 /
/// 2^-900 of the product of the lengths: far less than the roundings that filters allow for.
inline bool is_moderate_square(double square) { return square > 0x1p-300 && square < 0x1p300; }

/// Finite, and not zero.
inline bool has_direction(const Point& p) {
  return std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z) && p != Point{0, 0, 0};
}

}  // namespace pstripack
