#pragma once
// Independent geometry for judging the library's: big integers throughout, no filter, no code shared with
// src/. Points are finite and not zero.

#include <boost/multiprecision/cpp_int.hpp>

#include "geometry/point.h"

namespace exact {

using pstripack::Point;
using Integer = boost::multiprecision::cpp_int;
using Rational = boost::multiprecision::cpp_rational;

/// Meaning of a node: the vector as given, or its direction p/|p|.
enum class On { coordinates, directions };

/// The sign of det(a,b,c).
int left(const Point& a, const Point& b, const Point& c);

/// The sign of det(b-a,c-a,d-a), of the vectors or of their directions, without tie rule.
int orientation(On on, const Point& a, const Point& b, const Point& c, const Point& d);

/// The same with zeros decided by the tie rule; 0 only for four nodes on one great circle.
int above(On on, const Point& a, const Point& b, const Point& c, const Point& d);

bool same_direction(const Point& a, const Point& b);

/// True if a comes before b in the order (x,y,z) that ranks the nodes.
bool lower_rank(const Point& a, const Point& b);

/// The sign of c[0] sqrt(q[0]) + ... + c[3] sqrt(q[3]), q >= 0.
int sign_of_root_sum(const Integer (&c)[4], const Integer (&q)[4]);

}  // namespace exact
