#pragma once
// Lawson's insertion. It finds the triangle of a new point in the history of all splits and flips
// (Delaunay tree: Boissonnat & Teillaud 1986; Guibas, Knuth & Sharir 1992).

#include <array>
#include <stdexcept>
#include <vector>

#include "mesh/triangulation.h"
#include "thesis/rounded_tests.h"

namespace thesis {

using pstripack::index_t;
constexpr index_t kNone = -1;

/// Rounding led to a state that the method does not handle, or a limit was exceeded.
struct Failure : std::runtime_error {
  using runtime_error::runtime_error;
};

/// Three vertices, counterclockwise; neighbour[i] lies opposite vertex[i].
///
///                    vertex[0]
///                     /     \                                                                      .
///        neighbour[2]/       \neighbour[1]
///                   /         \                                                                    .
///          vertex[1] --------- vertex[2]
///                  neighbour[0]
struct Tri {
  std::array<index_t, 3> vertex, neighbour;
};

class DelaunayTree {
 public:
  /// Three "huge" vertices on a great circle: two triangles glued along their edges, each a hemisphere. The
  /// first is the one on the left of a -> b -> c. Vertices 0, 1, 2.
  DelaunayTree(const Point& a, const Point& b, const Point& c);

  /// Adds a vertex; the first one has number 3. Throws Failure.
  void insert(const Point& p);

  const std::vector<Tri>& history() const { return history_; }
  bool is_current(index_t t) const { return child_[static_cast<std::size_t>(t)][0] == kNone; }
  static bool is_huge(index_t vertex) { return vertex < 3; }

 private:
  using Children = std::array<index_t, 3>;

  index_t locate(const Point& p);
  double depth_inside(index_t t, const Point& p) const;
  void split(index_t t, index_t p);
  void flip(index_t t, index_t opposite);
  void legalize(index_t p);
  Circle circle_of(index_t t) const;
  index_t add(const Tri& tri);
  /// The index of the corner of t that is not an end of its edge b c.
  std::size_t corner_off(index_t t, index_t b, index_t c) const;
  /// Sets the neighbour of t across its edge b c.
  void set_neighbour(index_t t, index_t b, index_t c, index_t neighbour);

  Tri& tri(index_t t) { return history_[static_cast<std::size_t>(t)]; }
  const Tri& tri(index_t t) const { return history_[static_cast<std::size_t>(t)]; }
  Children& children(index_t t) { return child_[static_cast<std::size_t>(t)]; }
  const Point& point(index_t v) const { return points_[static_cast<std::size_t>(v)]; }

  std::vector<Point> points_;
  std::vector<Tri> history_;       // all triangles so far; a child comes after its parents
  std::vector<Children> child_;    // 3 after a split, 2 after a flip, 0 for a current triangle
  std::vector<index_t> suspects_;  // triangles (p, b, c) whose edge b c is to be tested
};

}  // namespace thesis
