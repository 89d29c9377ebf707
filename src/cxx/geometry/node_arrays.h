#pragma once

#include <cstddef>

#include "geometry/point.h"

namespace pstripack {

/// The caller's nodes, not copied: an array of points, or three arrays x, y and z of float or double.
class NodeArrays {
  template <class Real, class Body>
  auto visit_reals(const Body& body) const {
    return body(static_cast<const Real*>(array_[0]), static_cast<const Real*>(array_[1]),
                static_cast<const Real*>(array_[2]));
  }

 public:
  NodeArrays() = default;
  NodeArrays(const Point* points) : points_(points) {}
  template <class Real>
  NodeArrays(const Real* x, const Real* y, const Real* z) : NodeArrays(sizeof(Real), x, y, z) {}
  /// Arrays of float (real_bytes = 4) or double (8).
  NodeArrays(std::size_t real_bytes, const void* x, const void* y, const void* z)
      : array_{x, y, z}, are_single_(real_bytes == sizeof(float)) {}

  // Only if constructed from arrays:
  std::size_t real_bytes() const { return are_single_ ? sizeof(float) : sizeof(double); }
  const void* array(int axis) const { return array_[axis]; }
  /// The nodes from `first` on.
  NodeArrays from(std::size_t first) const {
    const auto part = [&](int axis) { return static_cast<const char*>(array_[axis]) + first * real_bytes(); };
    return {real_bytes(), part(0), part(1), part(2)};
  }
  /// Calls body(x, y, z) with pointers to float or double.
  template <class Body>
  auto visit_arrays(const Body& body) const {
    return are_single_ ? visit_reals<float>(body) : visit_reals<double>(body);
  }

  /// Calls body(node), where node(i) is node i: for loops that should not test the layout at every node.
  template <class Body>
  auto visit(const Body& body) const {
    if (points_ != nullptr) return body([points = points_](std::size_t i) { return points[i]; });
    return visit_arrays([&](const auto* x, const auto* y, const auto* z) {
      return body([=](std::size_t i) {
        return Point{static_cast<double>(x[i]), static_cast<double>(y[i]), static_cast<double>(z[i])};
      });
    });
  }

  Point operator[](std::size_t i) const {
    return visit([=](const auto& node) { return node(i); });
  }

  void copy(std::size_t first, std::size_t n, Point* to) const {
    visit([=](const auto& node) {
      for (std::size_t i = 0; i < n; ++i) to[i] = node(first + i);
    });
  }
  /// The nodes first..first+n-1 as points: the caller's own, or else copied to `room`.
  const Point* points(std::size_t first, std::size_t n, Point* room) const {
    if (points_ != nullptr) return points_ + first;
    copy(first, n, room);
    return room;
  }

 private:
  const Point* points_ = nullptr;
  const void* array_[3] = {};
  bool are_single_ = false;
};

}  // namespace pstripack
