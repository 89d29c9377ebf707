#pragma once

#include <cstddef>
#include <type_traits>

#include "geometry/point.h"

namespace pstripack {

/// The caller's nodes, read where they are: point after point, or x, y and z in arrays of their own.
class NodeArrays {
  template <class Real, class Body>
  auto visit_arrays(const Body& body) const {
    const auto *const x = static_cast<const Real*>(x_), *const y = static_cast<const Real*>(y_),
                      *const z = static_cast<const Real*>(z_);
    return body([=](std::size_t i) {
      return Point{static_cast<double>(x[i]), static_cast<double>(y[i]), static_cast<double>(z[i])};
    });
  }

 public:
  NodeArrays() = default;
  NodeArrays(const Point* points) : points_(points) {}
  template <class Real>
  NodeArrays(const Real* x, const Real* y, const Real* z)
      : x_(x), y_(y), z_(z), are_single_(std::is_same_v<Real, float>) {}

  /// body(node), where node(i) is node i: for loops that should not ask each time how the nodes lie.
  template <class Body>
  auto visit(const Body& body) const {
    if (points_ != nullptr) return body([points = points_](std::size_t i) { return points[i]; });
    return are_single_ ? visit_arrays<float>(body) : visit_arrays<double>(body);
  }

  Point operator[](std::size_t i) const {
    return visit([=](const auto& node) { return node(i); });
  }

  /// The nodes first..first+n-1 as points: where they are, or copied to `room`.
  const Point* points(std::size_t first, std::size_t n, Point* room) const {
    if (points_ != nullptr) return points_ + first;
    visit([=](const auto& node) {
      for (std::size_t i = 0; i < n; ++i) room[i] = node(first + i);
    });
    return room;
  }

 private:
  const Point* points_ = nullptr;
  const void *x_ = nullptr, *y_ = nullptr, *z_ = nullptr;
  bool are_single_ = false;
};

}  // namespace pstripack
