#pragma once
// Nodes in the order of their distances from a place.

#include <cstdint>

#include "geometry/measures.h"
#include "geometry/predicates.h"
#include "methods/triangulated.h"

namespace methods {

/// A node, from 1, and the square of its straight distance from a place on the unit sphere.
struct Candidate {
  std::int32_t node;
  double square;
};

/// The order of nodes by their distances from a place, exactly, and of equally near ones by their numbers.
class ByDistance {
 public:
  ByDistance(const Triangulated& mesh, const Point& p) : mesh_(mesh), place_(pstripack::direction_of(p)) {}

  const pstripack::Direction& place() const { return place_; }
  Candidate at(std::int32_t node) const {
    const Point d = minus(mesh_.unit_at(node), place_.high);
    if (const double square = dot(d, d); square > kFar) return {node, square};
    const Point fine = accurate_difference(mesh_.direction(node), place_);
    return {node, dot(fine, fine)};
  }
  bool operator()(const Candidate& a, const Candidate& b) const {
    if (is_farther(a, b) || is_farther(b, a)) return a.square < b.square;
    if (is_nearer(a, b)) return true;
    return a.node < b.node && !is_nearer(b, a);
  }
  bool are_as_near(const Candidate& a, const Candidate& b) const {
    return !is_farther(a, b) && !is_farther(b, a) && !is_nearer(a, b) && !is_nearer(b, a);
  }
  /// Whether the squares tell that a is farther. Those above kFar are of unit vectors that are wrong by less
  /// than 1e-15 each, so they are right up to 2e-12 of themselves. Below kTiny they may underflow.
  static bool is_farther(const Candidate& a, const Candidate& b) {
    return a.square > (1 + 8e-12) * b.square + kTiny;
  }
  static constexpr double kTiny = 1e-290;

 private:
  static constexpr double kFar = 1e-6;
  bool is_nearer(const Candidate& a, const Candidate& b) const {
    return pstripack::is_nearer(place_.given, mesh_.at(a.node), mesh_.at(b.node));
  }

  const Triangulated& mesh_;
  pstripack::Direction place_;
};

}  // namespace methods
