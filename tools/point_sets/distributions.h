#pragma once
// The point sets of `pstripack-benchmark --only distributions`, which compares their time with that of random
// nodes. Tests use small ones of them.

#include <string>
#include <vector>

namespace point_sets {

struct Distribution {
  std::string name;  ///< name for point_sets::make
  double limit;      ///< largest time per node, relative to the same number of random nodes
};

const std::vector<Distribution>& distributions();

}  // namespace point_sets
