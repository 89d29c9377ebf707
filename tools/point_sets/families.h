#pragma once
// The families of point_sets::make. To add one: a function and a line in the table of a file in families.

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "point_sets.h"

namespace point_sets {

using Points = std::vector<pstripack::Point>;

struct Family {
  std::string name;
  std::string parameter;  ///< default parameter as written; empty: the family has no parameter
  std::string nodes;      ///< the number of nodes if n are requested
  std::string what;       ///< one line for --help
  std::function<Points(std::size_t n, double parameter, Random& random)> make;
};

/// All families in the order of the lists: families(), then hard_families().
const std::vector<Family>& registry();

// The table of each file.
std::vector<Family> even_families();
std::vector<Family> uneven_families();
std::vector<Family> curves_families();
std::vector<Family> close_families();
std::vector<Family> lattices_families();
std::vector<Family> instruments_families();

}  // namespace point_sets
