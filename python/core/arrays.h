#pragma once
// NumPy arrays of results, and calls that release Python's lock.

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>

#include <memory>
#include <type_traits>
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

template <class T>
std::vector<T> items(const Array<T>& array) {
  return {array.data(), array.data() + array.size()};
}

/// Runs body() on this number of threads without Python's lock.
template <class Body>
auto compute(int threads, const Body& body) {
  const py::gil_scoped_release unlocked;
  const pstripack::ChosenThreads limit(threads);
  return pstripack::in_default_floating_point(body);
}

/// An array that takes over the values.
template <class T, class Values>
py::array array_of(Values&& values, std::vector<py::ssize_t> shape) {
  auto owner = std::make_unique<Values>(std::move(values));
  T* const data = reinterpret_cast<T*>(owner->data());
  const py::capsule base(owner.release(), [](void* p) { delete static_cast<Values*>(p); });
  return Array<T>(std::move(shape), data, base);
}
/// The same in one dimension, or of points with a row for each.
template <class Values>
py::array array_of(Values&& values) {
  using Item = std::remove_pointer_t<decltype(values.data())>;
  const auto n = static_cast<py::ssize_t>(values.size());
  if constexpr (std::is_same_v<Item, pstripack::Point>)
    return array_of<double>(std::move(values), {n, 3});
  else
    return array_of<Item>(std::move(values), {n});
}

}  // namespace bindings
