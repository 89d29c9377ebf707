#pragma once
// Centroidal Voronoi tessellations: evaluations, energy and time until the gradient reaches a bound.

namespace benchmark {

/// Writes to stdout.
void run_time_of_scvt();

struct DescentSettings {
  int n = 40000;
  int evaluations = 3000;
  double tolerance = 1e-5;
};

/// Prints gradient and energy on the way, by Lloyd's method and by ours, from several first generators.
void run_descents(const DescentSettings& settings);

}  // namespace benchmark
