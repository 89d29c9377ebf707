#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace files {

/// Weights of nodes in values at places: place i, from 0, has the entries begin[i] to begin[i + 1] - 1.
struct Weights {
  std::vector<std::size_t> begin;
  std::vector<std::int32_t> node;  ///< from 1
  std::vector<double> part;
  std::size_t outside = 0;  ///< number of places outside the nodes
};

}  // namespace files
