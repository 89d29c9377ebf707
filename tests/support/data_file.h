#pragma once

#include <cstdlib>
#include <fstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "geometry/point.h"

/// The nodes of a point file of tests/data: lines of x y z, and comments that begin with #. Throws
/// std::runtime_error.
inline std::vector<pstripack::Point> nodes_in(const std::string& file) {
  std::ifstream in(file);
  std::vector<pstripack::Point> nodes;
  for (std::string line; std::getline(in, line);) {
    if (line.empty() || line[0] == '#') continue;
    char* at = line.data();
    double x[3];
    for (double& value : x) {
      char* const word = at;
      value = std::strtod(word, &at);
      if (at == word) throw std::runtime_error(file + ": not x y z: " + line);
    }
    nodes.push_back({x[0], x[1], x[2]});
  }
  if (nodes.empty()) throw std::runtime_error(file + ": no nodes");
  return nodes;
}
