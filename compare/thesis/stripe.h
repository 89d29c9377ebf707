#pragma once
// What one process does by itself: the nodes of its stripes of longitude, their triangulation, their sides.

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

/// The nodes of the stripes first, first + 1, ..., first + stripes - 1 of `count`, in their order.
std::vector<Nodes> pick(const std::vector<Point>& points, int first, int stripes, int count);

struct Stripe {
  Triangles triangles;  ///< of the stripe, or of the stripes inside it
  Triangles stitched;   ///< between the stripes inside it
  Chain left, right;    ///< its sides; none without nodes, or where they surround the huge vertices
  TreeCounts counts;
  std::string failure;  ///< why the method came to no result; empty if it did
};

/// Three vertices that are not nodes, on a great circle, so that each of the two triangles between them is a
/// hemisphere. A lune has two antipodal ends, so no triangle around it is smaller. The circle lies at right
/// angles to the middle of the stripe but for a small tilt: without it the poles lie on the circle, and
/// rounding puts them anywhere.
std::array<Point, 3> huge_vertices(double longitude);

/// The stripe around the given longitude: Lawson's insertion of the nodes in this order, removal of the
/// triangles with huge vertices.
Stripe triangulate(const std::vector<Point>& points, const Nodes& nodes, double longitude);

/// The middle of stripe k.
double middle(int k, int count);

struct StripeSeconds {
  double triangulate = 0;  ///< processor time of the slowest thread
  double stitch = 0;
};

/// The hybrid variant: a thread for each of the stripes first, first + 1, ... of `count`, which are then
/// stitched from west to east.
Stripe triangulate(const std::vector<Point>& points, const std::vector<Nodes>& nodes, int first, int count,
                   StripeSeconds& seconds);

}  // namespace thesis
