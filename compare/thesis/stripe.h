#pragma once
// The local part of the method: nodes of a process's stripes of longitude, their triangulation, their sides.

#include <array>
#include <string>
#include <vector>

#include "thesis/delaunay_tree.h"
#include "thesis/stitch.h"

namespace thesis {

using pstripack::Triangles;
using Nodes = std::vector<index_t>;  ///< numbers from 0

/// The k with longitude in [k dPhi, (k + 1) dPhi), dPhi = 2 pi / count. The poles have longitude 0.
int stripe_of(const Point& p, int count);

/// The nodes of stripe k of `count`, in the order of `points`.
Nodes pick(const std::vector<Point>& points, int k, int count);

struct Stripe {
  Triangles triangles;
  Chain left, right;    ///< its sides; empty if there are no nodes, or if they surround the huge vertices
  std::string failure;  ///< why the method came to no result; empty if it did
};

/// Three vertices that are not nodes, on a great circle: each of the two triangles between them is a
/// hemisphere. No smaller triangle contains a lune, whose ends are antipodal. The circle is perpendicular to
/// the middle of the stripe except for a small tilt. Without it the poles would lie on the circle, on either
/// side after rounding.
std::array<Point, 3> huge_vertices(double longitude);

/// Triangulates the stripe around the given longitude: inserts the nodes in this order by Lawson's method and
/// removes the triangles with huge vertices.
Stripe triangulate(const std::vector<Point>& points, const Nodes& nodes, double longitude);

/// The longitude of the middle of stripe k.
double middle(int k, int count);

}  // namespace thesis
