#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "parallel/global_number.h"

namespace pstripack {

/// Numbers of two different nodes in the same direction.
using CoincidentPairs = std::vector<std::pair<GlobalNumber, GlobalNumber>>;

/// Of all pairs of nodes that coincide, the one that TRMESH reports: M is the smallest number of a node that
/// coincides with an earlier one, L the earliest that it coincides with.
struct Coincidence {
  std::int64_t l, m;
};

/// `pairs`, not empty and of different nodes, are the edges of a graph; its components are the sets of
/// coincident nodes.
Coincidence first_coincidence(const CoincidentPairs& pairs);

}  // namespace pstripack
