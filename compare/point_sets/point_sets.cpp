#include "point_sets.h"

#include <stdexcept>

#include "families.h"
#include "numbers.h"

namespace point_sets {

const std::vector<Family>& registry() {
  static const std::vector<Family> families{
      // everywhere on the sphere
      random_family(), single_family(), fibonacci_family(),
      // grids of models
      icosahedral_family(), latlon_family(), reduced_gaussian_family(), healpix_family(),
      cubed_sphere_family(), tripolar_family(), ring_family(),
      // uneven
      variable_family(), clusters_family(), dense_cap_family(), antipodal_family(), cap_family(),
      box_family(), strip_family(), tee_family(), pairs_family(), hemisphere_family(),
      hemisphere_rim_family()};
  return families;
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
  for (const std::string& k : families()) known += (known.empty() ? "" : ", ") + k;
  throw std::invalid_argument("unknown point set '" + name + "'; there are: " + known);
}

const std::vector<std::string>& families() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> v;
    for (const Family& f : registry()) v.push_back(f.name);
    return v;
  }();
  return names;
}

}  // namespace point_sets
