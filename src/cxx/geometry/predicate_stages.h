#pragma once
// What the two sets of predicates share. Internal to the layer.

#include "geometry/predicates.h"

namespace pstripack {

extern thread_local PredicateCounts stages;

/// A zero that needs no arithmetic: nodes on the equator. They are common.
template <class... Points>
bool in_coordinate_plane(const Points&... p) {
  return ((p.x == 0) && ...) || ((p.y == 0) && ...) || ((p.z == 0) && ...);
}

/// `left` in integers, or what decides before them, without the filter in doubles.
int left_of_vectors(const Point& a, const Point& b, const Point& c);

/// `left` in double-double: 0 where it cannot tell.
int fine_left(const Point& a, const Point& b, const Point& c);

/// The tie rule of predicates.h for four nodes whose volume is zero. No two may coincide.
bool symbolic_above(const Point& a, const Point& b, const Point& c, const Point& d);

}  // namespace pstripack
