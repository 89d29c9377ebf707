#pragma once
// Bounds of where the places of nodes can be that lie above a triangle.

#include "geometry/point.h"
#include "mesh/delaunay.h"
#include "parallel/partition.h"

namespace pstripack {

constexpr Ball kEverywhere{{0, 0, 0}, 4};

/// How many times as far from the centre as the plane of a face a place in its direction can be, no place
/// being farther than `farthest`. Infinite unless the centre is certainly below the plane, whose product with
/// a unit vector is known to 1.
double stretch_of(const Plane& p, double farthest);

/// The same for a triangle, whatever its plane: a mean y of places no shorter than 1 - deviation, whose
/// distances are at most h, has |y|^2 >= (1 - deviation)^2 - h^2 / 3.
double stretch_of(const Point& a, const Point& b, const Point& c, double deviation);

/// A ball around the places p with |p| <= 1 + deviation and normal.p >= height, the normal a unit vector
/// known to `error`: |p - normal|^2 = |p|^2 + 1 - 2 normal.p.
Ball ball_beyond(const Point& normal, double height, double error, double deviation);

/// A ball around all directions above the triangle a, a + e, a + f of directions, the longest edge of which
/// is the third, with the centre below it: that of its circle. The cap above a plane at height d >= 0 is no
/// farther from the point where the plane is nearest to the centre than the circle, sqrt(1 - d^2).
Ball ball_around(const Point& a, Point e, Point f);

}  // namespace pstripack
