#include "beside_random.h"

#include <algorithm>
#include <stdexcept>
#include <utility>

#include "geometry/predicates.h"

namespace benchmark {
namespace {

using legacy_stripack::Outcome;

Measurement seconds_of_trmesh(const Nodes& nodes, double time_limit) {
  return measure(
      [&] {
        Lists lists(nodes.n());
        const Stripack library = ours();
        return seconds_a_call([&] { library.trmesh(nodes, lists); }, std::max(1, 200000 / nodes.n()));
      },
      time_limit);
}

/// False if it exceeded the time limit.
bool add(Samples& samples, const Nodes& nodes, double time_limit) {
  const Measurement m = seconds_of_trmesh(nodes, time_limit);
  if (m.outcome == Outcome::timed_out) return false;
  if (m.outcome != Outcome::returned)
    throw std::runtime_error("a measurement of TRMESH crashed or exceeded its time limit");
  samples.add(m.seconds / nodes.n());
  return true;
}

}  // namespace

Nodes with_a_triangle_first(std::vector<pstripack::Point> points) {
  for (std::size_t other = points.size(); other > 3; --other) {
    if (pstripack::left(points[0], points[1], points[2]) != 0) return Nodes(points);
    std::swap(points[2], points[other - 1]);
  }
  throw std::runtime_error("all nodes are collinear");
}

BesideRandom measure_beside_random(const Nodes& nodes, const Nodes& random, int repeats, double time_limit) {
  BesideRandom result;
  while (result.in_time && !result.own.enough(repeats))
    result.in_time = add(result.own, nodes, time_limit) && add(result.random, random, time_limit);
  return result;
}

}  // namespace benchmark
