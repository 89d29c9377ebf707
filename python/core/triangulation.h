#pragma once
// The triangulation behind the Python package, without Python. Nodes and triangles count from 0 except in the
// lists.

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "base/buffer.h"
#include "files/measures.h"
#include "lists/adjacency_lists.h"
#include "methods/interpolation.h"
#include "stripack/expressions.h"

namespace bindings {

using pstripack::Buffer;
using pstripack::Point;

/// Up to rounding.
inline bool has_unit_length(const Point& p) { return std::fabs(dot(p, p) - 1) <= 1e-15; }

/// The unit vector in the direction of p: p itself if it is one, so that a node's place is that node's.
inline Point direction(const Point& p) { return has_unit_length(p) ? p : files::unit(p); }

/// Why nodes have no triangulation, and which nodes are to blame.
struct NoTriangulation : std::runtime_error {
  enum class Cause { too_few, too_many, bad_coordinate, coincident, collinear };
  NoTriangulation(Cause c, const std::string& message, std::vector<std::int64_t> n = {})
      : std::runtime_error(message), cause(c), nodes(std::move(n)) {}
  Cause cause;
  std::vector<std::int64_t> nodes;
};

/// Runs of integers: run k is values[begin[k]] ... values[begin[k+1]-1].
struct Runs {
  Buffer<std::int32_t> begin, values;
};

/// A Voronoi diagram of the whole sphere.
struct Cells {
  Buffer<Point> vertices;  ///< on the unit sphere
  Runs corners;            ///< of each cell, counterclockwise: vertices
};

/// The two nodes nearest to each other, and how far they are on the unit sphere, in a straight line.
struct ClosestPair {
  double distance;
  std::int64_t first, second;
};

/// Coordinates of n nodes: x, y, z of node i are axis[0][i*stride], axis[1][i*stride], axis[2][i*stride].
struct Coordinates {
  std::size_t n;
  const double* axis[3];
  std::ptrdiff_t stride;
};

/// Members may be called by any number of threads at a time. They use OpenMP's number of threads of the
/// calling thread, and throw std::bad_alloc.
class Triangulation {
 public:
  /// Throws NoTriangulation. With stride 1 the coordinates are read in place and must outlive this.
  explicit Triangulation(const Coordinates& given);

  std::size_t size() const { return n_; }
  /// Canonical lists, as from TRMESH.
  pstripack::ListsView<std::int32_t> lists() const {
    return {n_, list_.data(), lptr_.data(), lend_.data(), lnew_};
  }

  /// Three corners of each triangle, counterclockwise, smallest first, in the order of TRLIST.
  Buffer<std::int32_t> triangles() const;
  /// In the same order the triangle opposite each corner, or -1.
  Buffer<std::int32_t> opposite_triangles() const;
  /// Of each node, counterclockwise.
  Runs neighbours() const;
  /// Counterclockwise round the triangles; empty if they cover the sphere.
  std::vector<std::int32_t> boundary() const;
  /// In the same order the centres of their circumscribed caps, and their areas.
  Buffer<Point> circumcentres() const;
  Buffer<double> triangle_areas() const;

  /// Where nodes lie in a hemisphere, the cells of boundary nodes share the rest of the sphere.
  Cells cells() const;
  Buffer<double> cell_areas() const;
  ClosestPair closest_pair() const;

  // Places are vectors of any length, results in their order. Places up to 1e-12 outside the triangles count
  // as on their border.

  /// The triangle that contains each place, by its row in triangles(), which `corners` is; -1: none, or the
  /// place has no direction.
  Buffer<std::int32_t> find(const Point* places, std::size_t count, const std::int32_t* corners,
                            std::size_t triangles) const;
  /// The nearest node; -1: the place has no direction.
  Buffer<std::int32_t> nearest(const Point* places, std::size_t count) const;
  /// Values at the places by the methods of methods/interpolation.h. `values`: `columns` of each node, side
  /// by side; so are the results. NaN outside.
  using Method = methods::Interpolation::Method;
  Buffer<double> interpolate(Method method, const Point* places, std::size_t count, const double* values,
                             std::size_t columns) const;

 private:
  void read(const Coordinates& given);
  void triangulate();
  void triangulate_in_another_order();
  void make_directions();
  Point given(std::size_t i) const { return {given_[0][i], given_[1][i], given_[2][i]}; }
  Point at(std::int32_t node) const {  ///< the direction of a node that counts from 0
    const auto i = static_cast<std::size_t>(node);
    return {direction_[0][i], direction_[1][i], direction_[2][i]};
  }
  pstripack::Nodes<double> nodes() const { return {direction_[0], direction_[1], direction_[2]}; }
  template <class Visit>
  void visit_places(const Point* places, std::size_t count, const Visit& visit) const;

  std::size_t n_;
  Buffer<double> own_columns_, own_directions_;
  const double* given_[3];      ///< as given, column by column
  const double* direction_[3];  ///< of unit length
  Buffer<std::int32_t> list_, lptr_, lend_;
  std::int32_t lnew_ = 0;
  std::optional<methods::Interpolation> interpolation_;  ///< on these lists and directions
};

}  // namespace bindings
