#pragma once
// Stages shared by both sets of predicates. Internal to the layer.

#include "geometry/predicates.h"

namespace pstripack {

extern thread_local PredicateCounts stages;

/// True if the nodes lie on one coordinate plane, so that every determinant is 0. Common: nodes on the
/// equator.
template <class... Points>
bool in_coordinate_plane(const Points&... p) {
  return ((p.x == 0) && ...) || ((p.y == 0) && ...) || ((p.z == 0) && ...);
}

/// `left` without its first stage, the filter in doubles.
int left_of_vectors(const Point& a, const Point& b, const Point& c);

/// `left` in double-double: 0 if undecided.
int fine_left(const Point& a, const Point& b, const Point& c);

inline bool lower_rank(const Point& a, const Point& b) {
  if (a.x != b.x) return a.x < b.x;
  if (a.y != b.y) return a.y < b.y;
  return a.z < b.z;
}

/// The tie rule of predicates.h for four nodes whose volume is zero. No two may coincide. left(p,q,r): the
/// exact sign of det(p,q,r), where r is d if d is one of them.
template <class Left>
bool symbolic_above(const Point& a, const Point& b, const Point& c, const Point& d, const Left& left) {
  ++stages.symbolic;
  struct Term {
    const Point *node, *p, *q, *r;  // pushing `node` outwards gives the sign of sign * [pqr]
    int sign;
  };
  Term terms[4] = {{&d, &a, &b, &c, 1}, {&c, &a, &b, &d, -1}, {&b, &a, &c, &d, 1}, {&a, &b, &c, &d, -1}};
  for (int remaining = 4; remaining > 0; --remaining) {
    Term* highest = terms;
    for (Term* t = terms + 1; t < terms + remaining; ++t)
      if (lower_rank(*highest->node, *t->node)) highest = t;
    if (const int bracket = left(*highest->p, *highest->q, *highest->r)) return highest->sign * bracket > 0;
    *highest = terms[remaining - 1];
  }
  return false;  // all four on one great circle
}
bool symbolic_above(const Point& a, const Point& b, const Point& c, const Point& d);

}  // namespace pstripack
