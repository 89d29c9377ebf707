#pragma once

#include <vector>

#include "lists.h"

/// The coordinates of nodes in three arrays, as TRMESH takes them.
template <class Real = double>
struct Columns {
  explicit Columns(const Nodes& nodes) {
    for (const auto& p : nodes) {
      x.push_back(static_cast<Real>(p.x));
      y.push_back(static_cast<Real>(p.y));
      z.push_back(static_cast<Real>(p.z));
    }
  }
  std::vector<Real> x, y, z;
};
