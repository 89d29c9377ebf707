#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "geometry/point.h"

namespace pstripack {

/// A node on its way between patches or ranks.
struct Record {
  Point point;
  std::int64_t number;  ///< global, from 1
};

/// Sorts by number and leaves out what is there twice.
inline void keep_one_of_each(std::vector<Record>& nodes) {
  std::sort(nodes.begin(), nodes.end(), [](const Record& a, const Record& b) { return a.number < b.number; });
  nodes.erase(std::unique(nodes.begin(), nodes.end(),
                          [](const Record& a, const Record& b) { return a.number == b.number; }),
              nodes.end());
}

}  // namespace pstripack
