#pragma once
// Centroidal Voronoi tessellations: evaluations, energy and time to a gradient, beside the required ones.

#include <string>

namespace benchmark {

/// Writes to stdout. `quick`: only few generators, none random.
void run_time_of_scvt(bool quick, int repeats);

struct DescentSettings {
  int n = 40000;
  int evaluations = 3000;
  double tolerance = 1e-5;
  std::string csv;
};

/// Gradient and energy on the way, of Lloyd's method and of ours, from several first generators.
void run_descents(const DescentSettings& settings);

}  // namespace benchmark
