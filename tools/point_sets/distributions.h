#pragma once
// The point sets whose time is compared with that of random nodes: pstripack-benchmark --only distributions,
// and the tests of small ones of them.

#include <string>
#include <vector>

namespace point_sets {

struct Distribution {
  std::string name;  ///< name for point_sets::make
  double limit;      ///< largest time per node, in units of that of as many random nodes
};

const std::vector<Distribution>& distributions();

}  // namespace point_sets
