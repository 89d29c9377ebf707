#pragma once
// The triangulation of the Python package, independent of Python. Nodes and triangles count from 0, in the
// lists from 1.

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "base/buffer.h"
#include "files/mesh.h"
#include "lists/adjacency_lists.h"
#include "methods/interpolation.h"
#include "stripack/expressions.h"

namespace bindings {

using pstripack::Buffer;
using pstripack::Point;

/// True if the length of p is 1 up to rounding.
inline bool has_unit_length(const Point& p) { return std::fabs(dot(p, p) - 1) <= 1e-15; }

/// The unit vector in the direction of p; p itself if its length is 1, so that a place at a node equals the
/// node.
inline Point direction(const Point& p) { return has_unit_length(p) ? p : files::unit(p); }

/// The nodes have no triangulation; gives the reason and the nodes in question.
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

/// Nodes and a number of each, weight or distance, for each of several places: those of place i are
/// begin[i] ... begin[i+1]-1.
struct Rows {
  Buffer<std::int32_t> begin, nodes;
  Buffer<double> numbers;
};

/// The closest two nodes, and their straight distance on the unit sphere.
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

/// Called some times a second in long searches, by the thread that has called the member, unless null. What
/// it throws ends the search.
inline void (*between_places)() = nullptr;

/// Several threads may call members at the same time. Members use OpenMP's number of threads of the calling
/// thread and throw std::bad_alloc.
class Triangulation {
 public:
  /// Copies the coordinates. Throws NoTriangulation.
  explicit Triangulation(const Coordinates& given);
  ~Triangulation();

  std::size_t size() const { return n_; }
  /// The coordinates as given: all x, then all y, then all z.
  const double* coordinates() const { return columns_.data(); }
  /// The canonical lists of TRMESH.
  pstripack::ListsView<std::int32_t> lists() const {
    return {n_, list_.data(), lptr_.data(), lend_.data(), lnew_};
  }

  /// The direction of a node.
  Point at(std::int32_t node) const {
    const auto i = static_cast<std::size_t>(node);
    return {direction_[0][i], direction_[1][i], direction_[2][i]};
  }

  /// The three corners of each triangle, counterclockwise, the smallest first, in the order of TRLIST.
  Buffer<std::int32_t> triangles() const;
  /// The triangle opposite each corner, in the same order; -1: none.
  Buffer<std::int32_t> opposite_triangles() const;
  /// The neighbours of each node, counterclockwise.
  Runs neighbours() const;
  /// The boundary nodes, counterclockwise around the triangles; empty if these cover the sphere.
  std::vector<std::int32_t> boundary() const;
  /// The circumcentres and areas of the triangles of the nodes' directions, in the order of triangles().
  Buffer<Point> circumcentres() const;
  Buffer<double> triangle_areas() const;
  /// Radii of the circumscribed circles, in radians.
  Buffer<double> circumradii() const;

  /// The Voronoi cells. If the nodes lie in a hemisphere, the cells of boundary nodes share the rest of the
  /// sphere. `cosine`: see files/mesh.h.
  files::Faces cells(double cosine = -1 + 1e-12) const;
  Buffer<double> cell_areas() const;
  /// The direction of the integral of p over each cell, as files/mesh.h computes it.
  std::vector<Point> cell_centroids() const;
  ClosestPair closest_pair() const;
  /// The gradients that methods/gradients.h estimates. `values` has `columns` consecutive values for each
  /// node, and so has the result.
  std::vector<Point> gradients(const double* values, std::size_t columns) const;
  /// The middle of each arc; arc k joins nodes[2k] and nodes[2k+1].
  Buffer<Point> midpoints(const std::int32_t* nodes, std::size_t arcs) const;

  // Places are vectors of any length. Places up to 1e-12 outside the triangles count as on their border.

  /// The index in triangles(), passed as `corners`, of the triangle that contains each place. -1: there is
  /// none, or the place has no direction. `weights`, unless null: three barycentric ones for each place, NaN
  /// where there is no triangle.
  Buffer<std::int32_t> find(const Point* places, std::size_t count, const std::int32_t* corners,
                            std::size_t triangles, double* weights) const;
  /// The nearest node; -1: the place has no direction.
  Buffer<std::int32_t> nearest(const Point* places, std::size_t count) const;
  /// The k nearest nodes of each place, in the order of methods/by_distance.h, 1 <= k <= size(); -1: the
  /// place has no direction.
  Buffer<std::int32_t> nearest(const Point* places, std::size_t count, std::size_t k) const;
  /// The nodes up to `radius` from each place, in the same order, and their distances in radians.
  Rows within(const Point* places, std::size_t count, double radius) const;
  /// The distance of each place from its k nodes, in radians; NaN: the place has no direction.
  Buffer<double> distances(const Point* places, std::size_t count, const std::int32_t* nodes,
                           std::size_t k) const;
  /// Values at the places by the methods of methods/interpolation.h; NaN outside. `values` has `columns`
  /// consecutive values for each node, the result for each place.
  using Method = methods::Interpolation::Method;
  Buffer<double> interpolate(Method method, const Point* places, std::size_t count, const double* values,
                             std::size_t columns) const;
  /// The weights of the nodes in a value at each place, by Method::linear, natural or cubic; none outside
  /// the triangles.
  Rows weights(Method method, const Point* places, std::size_t count) const;

 private:
  struct Exact;
  const Exact& exact() const;
  /// measure(directions, a, b, c) of each of triangles().
  template <class Measure>
  auto of_triangles(const Measure& measure) const;
  void read(const Coordinates& given);
  void triangulate();
  void make_directions();
  Point given(std::size_t i) const { return {given_[0][i], given_[1][i], given_[2][i]}; }
  methods::Triangulated view() const {
    return {lists(), {given_[0], given_[1], given_[2]}, {direction_[0], direction_[1], direction_[2]}};
  }
  template <class State, class Visit>
  static std::vector<State> visit_places(const Point* places, std::size_t count, const Visit& visit);
  template <class State, class Find>
  static Rows rows(const Point* places, std::size_t count, const Find& find);

  std::size_t n_;
  Buffer<double> columns_, own_directions_;
  const double* given_[3];      ///< given coordinates, column by column
  const double* direction_[3];  ///< coordinates of unit vectors, column by column
  Buffer<std::int32_t> list_, lptr_, lend_;
  std::int32_t lnew_ = 0;
  mutable std::once_flag exact_once_;
  mutable std::unique_ptr<const Exact> exact_;  ///< the directions: 72 bytes per node, made when first needed
  std::optional<methods::Interpolation> interpolation_;  ///< on these lists and directions
};

}  // namespace bindings
