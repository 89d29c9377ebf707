#pragma once
// Values between scattered nodes: linear on triangles, and by natural neighbours.

#include <cstdint>
#include <vector>

#include "files/mesh.h"

namespace methods {

using files::Point;

/// The part that the value at a node has in the value at a place.
struct Share {
  std::int32_t node;  ///< from 1
  double part;
};

/// A triangulation in which places are looked up. All members may be called by many threads at a time.
///
/// `near` is the node that a search starts at, from 1, and becomes one near the place: whoever looks up one
/// place after the other keeps it. Places are unit vectors. Those up to 1e-12 outside the triangles count as
/// on their border.
///
/// The shares of a place are positive, add up to 1, and a node in the very place has all.
class Interpolation {
 public:
  /// Throws files::NoMesh, with indices into `nodes`. Only the directions of the nodes count.
  explicit Interpolation(const std::vector<Point>& nodes);

  /// The corners of the triangle a, b, c that p lies in, by the barycentric coordinates of where the ray to p
  /// meets the plane of the corners: det(p,b,c), det(a,p,c), det(a,b,p) over their sum. (Renka's, SSRFPACK.)
  /// Continuous; linear along arcs as seen from the centre. False, and no shares, outside the triangles.
  bool linear(const Point& p, std::int32_t& near, std::vector<Share>& shares) const;

  /// Natural neighbours (Sibson 1981, with areas on the sphere): if p were a node as well, the part of its
  /// Voronoi cell that each neighbour would have lost to it. Continuous, and smooth but at the nodes. False,
  /// and no shares, outside the triangles.
  bool natural(const Point& p, std::int32_t& near, std::vector<Share>& shares) const;

  /// The node nearest to p, wherever p is.
  std::int32_t nearest(const Point& p, std::int32_t near) const;

  enum class Method { linear, natural };
  enum class Outside { missing, nearest };
  struct Result {
    std::vector<double> values;  ///< NaN: missing
    std::size_t outside = 0;
  };
  /// The value at each place, which lies between those of the nodes that have a share. The same bits for any
  /// number of threads.
  Result values_at(const std::vector<Point>& places, const std::vector<double>& values, Method method,
                   Outside outside) const;

 private:
  struct Corners;
  bool find(Point& p, std::int32_t& near, Corners& corners) const;
  bool is_above(std::int32_t a, std::int32_t b, std::int32_t c, const Point& p) const;
  bool natural_ring(const Point& p, const Corners& corners, std::vector<std::int32_t>& ring) const;
  double lost_area(const Point& p, std::int32_t before, std::int32_t node, std::int32_t after) const;
  std::int32_t descend(const Point& p, std::int32_t node) const;
  const Point& at(std::int32_t node) const { return mesh_.points[static_cast<std::size_t>(node) - 1]; }

  files::Mesh mesh_;
  std::vector<double> x_, y_, z_;
  Point middle_;
};

}  // namespace methods
