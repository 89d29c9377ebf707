#pragma once

#include <algorithm>
#include <cstddef>
#include <vector>

#include "geometry/point.h"
#include "parallel/global_number.h"

namespace pstripack {

/// A node on its way between patches or ranks.
struct Record {
  Point point;
  GlobalNumber number;
};

/// The nodes that a patch is given: its own ones, then its halo.
struct PatchNodes {
  const Record* first;
  std::size_t own, halo;
  std::size_t count() const { return own + halo; }
};

/// Sorts by number and leaves out what is there twice.
inline void keep_one_of_each(std::vector<Record>& nodes) {
  std::sort(nodes.begin(), nodes.end(), [](const Record& a, const Record& b) { return a.number < b.number; });
  nodes.erase(std::unique(nodes.begin(), nodes.end(),
                          [](const Record& a, const Record& b) { return a.number == b.number; }),
              nodes.end());
}

}  // namespace pstripack
