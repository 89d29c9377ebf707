#pragma once
// NumPy arrays of results, and calls that release Python's lock.

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <memory>
#include <utility>
#include <vector>

#include "base/buffer.h"
#include "base/floating_point.h"
#include "base/parallel_for.h"
#include "geometry/point.h"

namespace bindings {

namespace py = pybind11;
using pstripack::Buffer;

template <class T>
using Array = py::array_t<T, py::array::c_style>;

/// Runs body() on this number of threads without Python's lock.
template <class Body>
auto compute(int threads, const Body& body) {
  const py::gil_scoped_release unlocked;
  const pstripack::ChosenThreads limit(threads);
  return pstripack::in_default_floating_point(body);
}

/// An array that takes over the buffer.
template <class T, class Item>
py::array array_of(Buffer<Item>&& buffer, std::vector<py::ssize_t> shape) {
  auto owner = std::make_unique<Buffer<Item>>(std::move(buffer));
  T* const data = reinterpret_cast<T*>(owner->data());
  const py::capsule base(owner.release(), [](void* p) { delete static_cast<Buffer<Item>*>(p); });
  return Array<T>(std::move(shape), data, base);
}
inline py::array array_of(Buffer<pstripack::Point>&& points) {
  const auto n = static_cast<py::ssize_t>(points.size());
  return array_of<double>(std::move(points), {n, 3});
}
template <class T>
py::array array_of(Buffer<T>&& values) {
  const auto n = static_cast<py::ssize_t>(values.size());
  return array_of<T>(std::move(values), {n});
}

}  // namespace bindings
