#pragma once

#include <algorithm>
#include <cmath>

#include "geometry/point.h"
#include "geometry/predicates.h"

namespace pstripack {

/// Where the predicates place a node: the vector as given, or its direction.
class Places {
 public:
  /// deviation: the largest difference of a length from 1, for Lengths::as_given.
  Places(Lengths lengths, double deviation) : lengths_(lengths), deviation_(deviation) {}
  Lengths lengths() const { return lengths_; }
  /// No place is farther from the centre than 1 + deviation().
  double deviation() const { return lengths_ == Lengths::as_given ? deviation_ : 0x1p-50; }
  Point operator()(const Point& p) const {
    if (lengths_ == Lengths::as_given) return p;
    Point q = p;
    const double largest = std::max({std::fabs(p.x), std::fabs(p.y), std::fabs(p.z)});
    if (!(largest > 0x1p-400 && largest < 0x1p400)) {  // squares must not overflow or vanish
      int e;
      std::frexp(largest, &e);
      q = {std::ldexp(p.x, -e), std::ldexp(p.y, -e), std::ldexp(p.z, -e)};
    }
    const double r = 1 / std::sqrt(q.x * q.x + q.y * q.y + q.z * q.z);
    return {q.x * r, q.y * r, q.z * r};
  }

 private:
  Lengths lengths_;
  double deviation_;
};

}  // namespace pstripack
