// The predicates on four vectors of any bits, against tests/support/reference_predicates.h.

#include "geometry/predicates.h"

#include <algorithm>
#include <array>

#include "input.h"
#include "support/reference_predicates.h"

namespace {

using pstripack::Point;

/// Checks Coordinates or Directions: `above` in all orders of the four nodes, each `left`, and which nodes
/// coincide.
template <class Predicates>
void check(exact::On on, const Predicates& predicates, const std::array<Point, 4>& p) {
  bool different = true;
  for (int i = 0; i < 4; ++i)
    for (int j = 0; j < i; ++j) {
      const bool same = exact::same_direction(p[i], p[j]);
      different = different && !same;
      require(predicates.coincide(i, j) == (on == exact::On::directions ? same : p[i] == p[j]), "coincide");
    }
  std::array<int, 4> v = {0, 1, 2, 3};
  const int sign = exact::orientation(on, p[0], p[1], p[2], p[3]);
  const int with_ties = different ? exact::above(on, p[0], p[1], p[2], p[3]) : 0;
  do {
    int inversions = 0;
    for (int i = 0; i < 4; ++i)
      for (int j = 0; j < i; ++j) inversions += v[j] > v[i];
    const int parity = inversions % 2 == 0 ? 1 : -1;
    require(predicates.left(v[0], v[1], v[2]) == exact::left(p[v[0]], p[v[1]], p[v[2]]), "left of a set");
    require(predicates.strictly_above(v[0], v[1], v[2], v[3]) == (parity * sign > 0), "strictly_above");
    if (different) require(predicates.above(v[0], v[1], v[2], v[3]) == (parity * with_ties > 0), "above");
  } while (std::next_permutation(v.begin(), v.end()));
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  Input input(data, size);
  Nodes nodes;
  bool all_finite = true, all_unit = true;
  while (nodes.size() < 4) {
    const Point p = any_vector(input, nodes);
    nodes.push_back(p);
    const bool finite = std::isfinite(p.x) && std::isfinite(p.y) && std::isfinite(p.z);
    require(has_direction(p) == (finite && (p.x != 0 || p.y != 0 || p.z != 0)), "has_direction");
    all_finite = all_finite && has_direction(p);
    all_unit = all_unit && pstripack::length_is_one(p);
    if (!finite) require(!pstripack::length_is_one(p), "length_is_one of what is not finite");
  }
  if (!all_finite) return 0;
  const std::array<Point, 4> p = {nodes[0], nodes[1], nodes[2], nodes[3]};
  require(pstripack::left(p[0], p[1], p[2]) == exact::left(p[0], p[1], p[2]), "left");
  require(pstripack::orientation(p[0], p[1], p[2], p[3]) ==
              exact::orientation(exact::On::coordinates, p[0], p[1], p[2], p[3]),
          "orientation");
  require(pstripack::same_direction(p[0], p[1]) == exact::same_direction(p[0], p[1]), "same_direction");
  if (all_unit) check(exact::On::coordinates, pstripack::Coordinates(p.data(), 4), p);
  check(exact::On::directions, pstripack::Directions(p.data(), 4), p);
  return 0;
}
