#include "distributions.h"

namespace point_sets {

const std::vector<Distribution>& distributions() {
  static const std::vector<const char*> names{
      // grids of models
      "latlon", "earth", "rotated-pole:0.7", "reduced-gaussian", "healpix", "cubed-sphere", "icosahedral",
      "tripolar", "refined:20", "fibonacci", "lattice",
      // coordinates that were rounded
      "single", "rounded:3", "rounded:5", "rounded:7",
      // instruments
      "satellite:98.2", "swaths:200", "tracks:50", "rivers:1e-4", "coast:0.3", "earthquakes:1e-4",
      // along curves
      "ring", "small-circle:1", "small-circle:1e-3", "ellipse:1e-9", "spiral:20", "strip:1e-9", "strip:1e-15",
      "two-curves:1e-3", "two-curves:1e-9", "crossing:1e-3", "comb:1e-9", "tee:1e-8", "falling-tee:6",
      "moment:6", "hemisphere-rim",
      // dense places
      "variable:1e6", "clusters:1e-7", "dense-cap:1e-7", "antipodal:1e-6", "cap:1e-6", "cap:1e-10",
      "cap:1e-11", "cap:1e-12", "axis-cap:1e-150", "pairs:1e-10", "ulp-groups:2", "ulp-groups:8",
      "falling:14", "rays:12", "rays:100", "nest:150"};
  static const std::vector<Distribution> all = [] {
    std::vector<Distribution> made;
    for (const std::string name : names) {
      const bool spans_more_than_100_decades = name == "rays:100" || name == "nest:150";
      made.push_back({name, spans_more_than_100_decades ? 8.0 : 4.0});
    }
    return made;
  }();
  return all;
}

}  // namespace point_sets
