#pragma once
// Weights of nodes at a place, for interpolation: barycentric ones, and those of natural neighbours. All are
// those of the directions of the nodes and of the place, from 1e-150 rad apart to hemispheres. Bounds of
// their errors, by the analysis in weights.cpp, with u = 2^-53:
//   barycentric         512u of the weight and 2^-80
//   natural neighbours  2^-40 of the sum of all, which is 1 (seen: 1u in the median, 2^-48 in 99.9 % of
//   places),
//                       and 2^-32 of the weight. Nodes that hardly are neighbours have small weights: to be
//                       right up to some u relative to themselves, they would cost too much time; in a value
//                       they count as little.

#include <array>
#include <cstdint>
#include <vector>

#include "geometry/measures.h"

namespace pstripack {

using Corners = std::array<const Direction*, 3>;

/// The barycentric weights of a place in a counterclockwise triangle: det(place, next corner, last corner)
/// for each corner, over their sum. On an arc, or beyond it, the opposite corner has the weight 0, and the
/// others have those of the arc: the same bits in both of its triangles. Beyond an end of the arc, that end
/// has the weight 1.
void barycentric_weights(const Direction& place, const Corners& corner, double (&weight)[3]);

/// The determinants, if doubles suffice: then the place lies strictly in the triangle. They do not if it sees
/// two corners at an angle below 4 or above 176 degrees, or if one is very near.
inline bool find_ordinary_determinants(const Direction& place, const Corners& corner, double (&det)[3]) {
  Point side[3];
  double square[3];
  bool all = true;
  for (int k = 0; k < 3; ++k) side[k] = difference(*corner[k], place), square[k] = dot(side[k], side[k]);
  for (int k = 0; k < 3; ++k) {
    const int next = (k + 1) % 3, last = (k + 2) % 3;
    det[k] = dot(place.high, cross(side[next], side[last]));
    const bool is_ordinary = (det[k] > 0) & (det[k] * det[k] >= 0x1p-8 * (square[next] * square[last])) &
                             (square[next] >= 0x1p-90) & (square[last] >= 0x1p-90);
    if (!is_ordinary) all = false, det[k] = -1;
  }
  return all;
}
/// True if the place is beyond b on the arc from `from` to b: if the angle at b is at least 90 degrees.
bool is_beyond(const Direction& place, const Direction& b, const Direction& from);
inline void divide_by_sum(double (&weight)[3]) {
  const double sum = weight[0] + weight[1] + weight[2];
  for (double& w : weight) w /= sum;
}

/// The triangles of a Delaunay mesh whose circumscribed caps contain a place. Their corners are its natural
/// neighbours, which form a ring around it.
struct Cavity {
  struct Node {
    const Direction* direction;
    std::uint32_t next;      ///< in the ring, counterclockwise
    std::uint32_t triangle;  ///< the one on the side to the next node
  };
  struct Arc {  ///< between two triangles
    std::uint32_t from, to, left, right;
  };
  std::vector<Node> nodes;
  std::vector<std::array<std::uint32_t, 3>>
      triangles;  ///< corners, counterclockwise, as indices into `nodes`
  std::vector<Arc> arcs;
  std::vector<double> weights, errors;
};

/// Sets cavity.weights: the areas that the Voronoi cells of the nodes would lose to the place, over their
/// sum.
void find_natural_weights(const Direction& place, Cavity& cavity);

}  // namespace pstripack
