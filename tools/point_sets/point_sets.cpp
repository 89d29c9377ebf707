#include "point_sets.h"

#include <stdexcept>

#include "families.h"
#include "numbers.h"

namespace point_sets {

namespace {

std::vector<Family> usual() {
  return {// everywhere on the sphere
          random_family(), single_family(), fibonacci_family(),
          // grids of models
          icosahedral_family(), latlon_family(), reduced_gaussian_family(), healpix_family(),
          cubed_sphere_family(), tripolar_family(), ring_family(),
          // uneven
          variable_family(), clusters_family(), dense_cap_family(), antipodal_family(), cap_family(),
          box_family(), strip_family(), tee_family(), pairs_family(), hemisphere_family(),
          hemisphere_rim_family()};
}

std::vector<Family> hard() {
  return {// along curves
          small_circle_family(), two_curves_family(), crossing_family(), ellipse_family(), spiral_family(),
          comb_family(), falling_tee_family(), moment_family(),
          // over many decades, and as close as doubles can be
          falling_family(), ulp_groups_family(), axis_cap_family(), nest_family(), mirrored_nest_family(),
          rays_family(),
          // lattices
          lattice_family(), earth_family(), rounded_family(), rotated_pole_family(), refined_family(),
          // of instruments
          satellite_family(), swaths_family(), tracks_family(), rivers_family(), coast_family(),
          earthquakes_family()};
}

std::vector<std::string> names_of(const std::vector<Family>& some) {
  std::vector<std::string> names;
  for (const Family& f : some) names.push_back(f.name);
  return names;
}

}  // namespace

const std::vector<Family>& registry() {
  static const std::vector<Family> all = [] {
    std::vector<Family> v = usual();
    for (Family& f : hard()) v.push_back(std::move(f));
    return v;
  }();
  return all;
}

std::vector<pstripack::Point> make(const std::string& family, std::size_t n, std::uint64_t seed) {
  const std::size_t colon = family.find(':');
  const std::string name = family.substr(0, colon);
  for (const Family& f : registry()) {
    if (f.name != name) continue;
    double parameter = 0;
    if (!f.parameter.empty()) parse(f.parameter, parameter);
    if (colon != std::string::npos) {
      const double least = name == "variable" ? 1 : 0;
      if (f.parameter.empty()) throw std::invalid_argument("point set '" + name + "' takes no parameter");
      if (!parse(family.substr(colon + 1), parameter) || parameter <= least)
        throw std::invalid_argument("point set '" + family + "': the parameter must be a number above " +
                                    (least == 0 ? "0" : "1"));
    }
    Random random(seed);
    return f.make(n, parameter, random);
  }
  std::string known;
  for (const Family& f : registry()) known += (known.empty() ? "" : ", ") + f.name;
  throw std::invalid_argument("unknown point set '" + name + "'; there are: " + known);
}

const std::vector<std::string>& families() {
  static const std::vector<std::string> names = names_of(usual());
  return names;
}

const std::vector<std::string>& hard_families() {
  static const std::vector<std::string> names = names_of(hard());
  return names;
}

}  // namespace point_sets
