#include "distributions.h"

namespace point_sets {

const std::vector<Distribution>& distributions() {
  constexpr double usual = 4, over_more_than_100_decades = 8;
  static const std::vector<Distribution> all{
      // grids of models
      {"latlon", usual},
      {"earth", usual},
      {"rotated-pole:0.7", usual},
      {"reduced-gaussian", usual},
      {"healpix", usual},
      {"cubed-sphere", usual},
      {"icosahedral", usual},
      {"tripolar", usual},
      {"refined:20", usual},
      {"fibonacci", usual},
      {"lattice", usual},
      // coordinates that were rounded
      {"single", usual},
      {"rounded:3", usual},
      {"rounded:5", usual},
      {"rounded:7", usual},
      // instruments
      {"satellite:98.2", usual},
      {"swaths:200", usual},
      {"tracks:50", usual},
      {"rivers:1e-4", usual},
      {"coast:0.3", usual},
      {"earthquakes:1e-4", usual},
      // along curves
      {"ring", usual},
      {"small-circle:1", usual},
      {"small-circle:1e-3", usual},
      {"ellipse:1e-9", usual},
      {"spiral:20", usual},
      {"strip:1e-9", usual},
      {"strip:1e-15", usual},
      {"two-curves:1e-3", usual},
      {"two-curves:1e-9", usual},
      {"crossing:1e-3", usual},
      {"comb:1e-9", usual},
      {"tee:1e-8", usual},
      {"falling-tee:6", usual},
      {"moment:6", usual},
      {"hemisphere-rim", usual},
      // dense places
      {"variable:1e6", usual},
      {"clusters:1e-7", usual},
      {"dense-cap:1e-7", usual},
      {"antipodal:1e-6", usual},
      {"cap:1e-6", usual},
      {"cap:1e-10", usual},
      {"cap:1e-11", usual},
      {"cap:1e-12", usual},
      {"axis-cap:1e-150", usual},
      {"pairs:1e-10", usual},
      {"ulp-groups:2", usual},
      {"ulp-groups:8", usual},
      {"falling:14", usual},
      {"rays:12", usual},
      {"rays:100", over_more_than_100_decades},
      {"nest:150", over_more_than_100_decades},
  };
  return all;
}

}  // namespace point_sets
