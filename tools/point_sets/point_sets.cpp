#include "point_sets.h"

#include <initializer_list>
#include <stdexcept>

#include "families.h"
#include "numbers.h"

namespace point_sets {

namespace {

std::vector<Family> joined(std::initializer_list<std::vector<Family>> tables) {
  std::vector<Family> all;
  for (const std::vector<Family>& table : tables) all.insert(all.end(), table.begin(), table.end());
  return all;
}

std::vector<Family> usual() { return joined({even_families(), uneven_families()}); }
std::vector<Family> hard() {
  return joined({curves_families(), close_families(), lattices_families(), instruments_families()});
}

std::vector<std::string> names_of(const std::vector<Family>& some) {
  std::vector<std::string> names;
  for (const Family& f : some) names.push_back(f.name);
  return names;
}

}  // namespace

const std::vector<Family>& registry() {
  static const std::vector<Family> all = joined({usual(), hard()});
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
