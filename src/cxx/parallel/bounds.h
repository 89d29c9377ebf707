#pragma once
// Bounds of the region in which nodes above a triangle can lie.

#include "geometry/point.h"
#include "mesh/delaunay.h"
#include "parallel/partition.h"

namespace pstripack {

constexpr Ball kEverywhere{{0, 0, 0}, 4};

/// Upper bound of |p| / |q|: p a place with |p| <= farthest, q where the ray to p meets the plane of the
/// face. Infinite unless the centre is certainly below the plane. The product of the plane and a unit vector
/// has an error of at most 1.
double stretch_of(const Plane& p, double farthest);

/// The same bound, with farthest = 1 + deviation, from the corners alone. Let no corner be shorter than 1 -
/// deviation and no edge longer than h: a point y of the triangle has |y|^2 >= (1 - deviation)^2 - h^2 / 3.
double stretch_of(const Point& a, const Point& b, const Point& c, double deviation);

/// A ball that holds all places p with |p| <= 1 + deviation and normal.p >= height. The normal is a unit
/// vector with an error of at most `error`. Proof: |p - normal|^2 = |p|^2 + 1 - 2 normal.p.
Ball ball_beyond(const Point& normal, double height, double error, double deviation);

/// A ball that holds all directions above the triangle a, a + e, a + f, whose corners are directions: the
/// ball of its circumcircle. The third edge, f - e, must be the longest, and the centre of the sphere below
/// the plane. Proof: if the plane has distance d >= 0 from the centre, no point of the cap is farther than
/// sqrt(1 - d^2), the radius of the circle, from the circle's centre.
Ball ball_around(const Point& a, Point e, Point f);

}  // namespace pstripack
