#pragma once
// Interpolation between scattered nodes: linear on triangles, by natural neighbours, or by natural neighbours
// and gradients.

#include <array>
#include <cstdint>
#include <memory>
#include <mutex>
#include <vector>

#include "files/weights.h"
#include "geometry/weights.h"
#include "methods/by_distance.h"
#include "methods/gradients.h"
#include "methods/triangulated.h"

namespace methods {

/// The share of a node's value in the value at a place.
struct Share {
  std::int32_t node;  ///< from 1
  double part;
};

/// A triangulation for interpolation. Several threads may call its members at the same time.
///
/// Places are vectors of any length, and like the nodes they mean their directions. A place outside the
/// triangles counts as on their border, at the nearest point of it, if it is moved inside by 1e-12 of the way
/// to the middle of the nodes and 4e-16 rad. `near` is the node, from 1, at which the search starts; it is
/// set to a node near the place. Keep it between successive places; the shares do not depend on it.
///
/// The shares of a place are positive with sum 1; at a node, that node has the whole share.
/// geometry/weights.h has the bounds of their errors.
class Interpolation {
 public:
  /// `owner` keeps the triangulation alive; without it the triangulation must outlive this object.
  explicit Interpolation(const Triangulated& mesh, std::shared_ptr<const void> owner = nullptr);

  const Triangulated& mesh() const { return mesh_; }

  /// The corners of a triangle, counterclockwise, the smallest first.
  using Corners = std::array<std::int32_t, 3>;
  /// The triangle that contains p. False outside the triangles.
  bool triangle(const Point& p, std::int32_t& near, Corners& corners) const {
    bool is_beyond_border;
    return find(pstripack::direction_of(p), near, corners, is_beyond_border);
  }

  /// The corners of the triangle a, b, c that contains p, with the barycentric coordinates of the point where
  /// the ray to p meets the plane of the corners: det(p,b,c), det(a,p,c), det(a,b,p) over their sum (Renka,
  /// SSRFPACK). The values are continuous, and linear along arcs as seen from the centre. False, without
  /// shares, outside the triangles.
  bool linear(const Point& p, std::int32_t& near, std::vector<Share>& shares) const;
  /// The same for each of the corners that triangle() gives.
  bool barycentric(const Point& p, std::int32_t& near, Corners& corners, double (&weights)[3]) const;

  /// Natural neighbours (Sibson 1981, with areas on the sphere). If p were a node, each neighbour would lose
  /// a part of its Voronoi cell to p; these areas are the shares. The values are continuous, and smooth
  /// except at the nodes. False, without shares, outside the triangles.
  bool natural(const Point& p, std::int32_t& near, std::vector<Share>& shares) const;

  /// A boundary node; 0 if the triangles cover the sphere.
  std::int32_t first_boundary_node() const { return first_boundary_node_; }

  /// The node nearest to p, wherever p is: exactly, of equally near ones that with the smallest number.
  std::int32_t nearest(const Point& p, std::int32_t near) const;

  /// Natural neighbours with gradients (Sibson, A brief description of natural neighbour interpolation, in
  /// Interpreting Multivariate Data, Wiley 1981): with the shares w of natural(), the distances d and the
  /// values v + g.(p-x) that the tangent planes at the neighbours x have at p,
  ///
  ///     zeta = sum w/d (v + g.(p-x)) / sum w/d,   alpha = sum w d / sum w/d,   beta = sum w d^2,
  ///     value = (alpha sum w v + beta zeta) / (alpha + beta).
  ///
  /// Its gradient is continuous, and is that of the node at each node. It may leave the range of the values.
  /// The value is the sum over the shares, which get other parts, of part * v + way.g.
  void cubic_terms(const Point& p, std::vector<Share>& shares, std::vector<Point>& ways) const;
  /// The same with g as sums of values: the shares of more nodes, one for each in increasing order.
  void cubic_shares(const Point& p, const GradientTerms& gradients, std::vector<Share>& shares) const;

  /// `nearest` has the value of the nearest node, at all places.
  enum class Method { linear, natural, cubic, nearest };
  enum class Outside { missing, nearest };
  struct Result {
    std::vector<double> values;  ///< NaN: missing
    std::size_t outside = 0;
  };
  /// The value at each place. Any number of threads gives the same bits. Linear and natural: within the range
  /// of the contributing nodes. Cubic: see cubic_terms.
  Result values_at(const std::vector<Point>& places, const std::vector<double>& values, Method method,
                   Outside outside) const;
  /// The shares of each place. A value is their sum of products in their order; values_at differs only where
  /// rounding has left the range of the nodes, and by rounding for `cubic`.
  files::Weights weights_at(const std::vector<Point>& places, Method method, Outside outside) const;

 private:
  using Direction = pstripack::Direction;
  bool find(const Direction& place, std::int32_t& near, Corners& corners, bool& is_beyond_border) const;
  void find_nearest_on_border(const Direction& place, std::int32_t first, Corners& corners) const;
  int side_of_arc(std::int32_t a, std::int32_t b, const Direction& place) const;
  bool cross_arcs(const Direction& place, Corners& corners) const;
  void weigh(const Direction& place, const Corners& corners, double (&weights)[3]) const;
  static void take(const Corners& corners, const double (&weights)[3], std::vector<Share>& shares);
  /// The corner that the place is; 3: none.
  std::size_t corner_at(const Direction& place, const Corners& corners) const;
  bool dig(const Direction& place, const Corners& corners, std::vector<std::int32_t>& nodes,
           pstripack::Cavity& cavity) const;
  Candidate descend(const ByDistance& order, Candidate node) const;
  /// Calls use(i, shares) for each place i, on several threads; without shares where it has no value. Returns
  /// the number of places outside the triangles.
  template <class Use>
  std::size_t for_each_place(const std::vector<Point>& places, Method method, Outside outside,
                             const Use& use) const;
  Point at(std::int32_t node) const { return mesh_.at(node); }
  /// The directions of the nodes, made when first needed.
  const Direction* directions() const;

  struct Known {
    std::once_flag once;
    std::vector<Direction> directions;
  };
  std::shared_ptr<const void> owner_;
  Triangulated mesh_;
  std::unique_ptr<Known> known_ = std::make_unique<Known>();
  std::int32_t first_boundary_node_;  ///< 0: none
  Point middle_{0, 0, 0};             ///< centre of the nodes, if they lie in a hemisphere
};

}  // namespace methods
