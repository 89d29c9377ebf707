#pragma once
// The families of point_sets::make: one function a family, in a file of its name.

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

#include "point_sets.h"

namespace point_sets {

using Points = std::vector<pstripack::Point>;

struct Family {
  std::string name;
  std::string parameter;  ///< its default, as written; empty: the family takes none
  std::string nodes;      ///< how many there are when n are asked for
  std::string what;       ///< one line for --help and docs/point-sets.md
  std::function<Points(std::size_t n, double parameter, Random& random)> make;
};

/// All of them, in the order in which they are listed.
const std::vector<Family>& registry();

Family random_family();
Family single_family();
Family fibonacci_family();
Family icosahedral_family();
Family latlon_family();
Family reduced_gaussian_family();
Family healpix_family();
Family cubed_sphere_family();
Family tripolar_family();
Family ring_family();
Family variable_family();
Family clusters_family();
Family dense_cap_family();
Family antipodal_family();
Family cap_family();
Family box_family();
Family strip_family();
Family tee_family();
Family pairs_family();
Family hemisphere_family();
Family hemisphere_rim_family();

}  // namespace point_sets
