#pragma once
// The point sets whose time is compared with that of random nodes: pstripack-benchmark --only distributions,
// and the tests that judge small ones of them.

#include <string>
#include <vector>

namespace point_sets {

struct Distribution {
  std::string name;  ///< as point_sets::make takes it
  double limit;      ///< time a node at most, in units of that of as many random nodes
};

const std::vector<Distribution>& distributions();

}  // namespace point_sets
