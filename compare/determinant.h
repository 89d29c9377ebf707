#pragma once
// The comparison's own exact arithmetic with integers of any length. It shares no code with the predicates
// that it judges.

#include <boost/multiprecision/cpp_int.hpp>
#include <string>

#include "geometry/point.h"

namespace comparison {

using pstripack::Point;

/// An exact determinant of finite coordinates, and the rounding of the original's own evaluation of it.
class Determinant {
 public:
  using Integer = boost::multiprecision::cpp_int;

  int sign() const { return value_.sign(); }

  /// True if the original's floating-point test may give either sign: |exact| <= bound.
  bool within_rounding(double epsilon) const;

  std::string value() const;                ///< "-1.27e-19"
  std::string bound(double epsilon) const;  ///< the bound in the same format

 private:
  friend Determinant left_test(const Point&, const Point&, const Point&);
  friend Determinant swap_test(const Point&, const Point&, const Point&, const Point&);

  Integer value_;      // times 2^exponent_
  Integer permanent_;  // the same sum with absolute values, times 2^exponent_
  int exponent_;
  int roundings_;
};

/// det(a,b,c), which the original computes in LEFT as
///   D = (c1 (a2 b3 - b2 a3) - c2 (a1 b3 - b1 a3)) + c3 (a1 b2 - b1 a2).
/// A term passes at most 5 roundings on its way into the sum: product, difference, product, two sums.
/// So |computed - exact| <= g P with g = 5u/(1-5u), u = epsilon/2, P = the sum of the terms' absolute values.
Determinant left_test(const Point& a, const Point& b, const Point& c);

/// det(b-a, c-a, d-a), positive where d is above the plane of a,b,c. The original computes it in SWPTST as
///   S = (d3x (d2y d1z - d1y d2z) - d3y (d2x d1z - d1x d2z)) + d3z (d2x d1y - d1x d2y),  di = pi - p4.
/// The differences add three roundings: g = 8u/(1-8u). P depends on which node is p4, which depends on the
/// history of the arc: the bound takes the largest of the four values.
Determinant swap_test(const Point& a, const Point& b, const Point& c, const Point& d);

}  // namespace comparison
