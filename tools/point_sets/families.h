#pragma once
// The families of point_sets::make: one function per family, in a file of its name.

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

Family small_circle_family();
Family two_curves_family();
Family crossing_family();
Family ellipse_family();
Family spiral_family();
Family comb_family();
Family falling_tee_family();
Family moment_family();
Family falling_family();
Family ulp_groups_family();
Family axis_cap_family();
Family nest_family();
Family mirrored_nest_family();
Family rays_family();
Family lattice_family();
Family earth_family();
Family rounded_family();
Family rotated_pole_family();
Family refined_family();
Family satellite_family();
Family swaths_family();
Family tracks_family();
Family rivers_family();
Family coast_family();
Family earthquakes_family();

}  // namespace point_sets
