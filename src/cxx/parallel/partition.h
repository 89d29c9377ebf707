#pragma once
// How the sphere is cut into patches, and what a patch knows of the nodes beyond its border.
//
// A partition is a binary tree of planes, first those between the patches (cuts.h). Its leaves are cells that
// hold a few nodes of a sample; every cell belongs to one patch. The same tree on every rank makes the same
// decisions on every rank.
//
//     +-------+-------+      A patch q knows its own nodes and its margin: all nodes x of another cell that
//     are |   :   |   .   |      no farther from q than that cell's reach, a few distances between nodes
//     there:
//     |...:...|.q.....|          distance(q, x) <= reach(cell of x).
//     |   :   |   :   |      So the margin is thin where nodes are dense.
//     +-------+-------+

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

#include "geometry/point.h"
#include "parallel/cuts.h"
#include "parallel/local_numbers.h"

namespace pstripack {

/// How the sphere is cut into patches. All kinds give the same triangulation, bit for bit.
enum class PartitionKind {
  bisection,  ///< boxes with equal numbers of nodes, by recursive bisection along x, y, z
  stripes,    ///< stripes of longitude with equal numbers of nodes
};

/// All of them in this order, and what pictures call them.
struct NamedPartition {
  PartitionKind kind;
  const char* name;
};
inline constexpr NamedPartition kPartitions[] = {{PartitionKind::bisection, "bisection"},
                                                 {PartitionKind::stripes, "stripes"}};
inline const char* name_of(PartitionKind kind) { return kPartitions[static_cast<int>(kind)].name; }

class Partition {
 public:
  /// Patches 0..patches-1 for `nodes` nodes of which `sample` is a sample: vectors of about length 1.
  Partition(PartitionKind kind, int patches, std::vector<Point> sample, std::size_t nodes);
  /// Bisection by these cuts; sorts their sample.
  Partition(const Cuts& cuts, std::size_t nodes);

  /// Patches of any shape with any margins, for tests.
  struct Rule {
    std::function<PatchNumber(const Point&)> owner;
    std::function<bool(PatchNumber, const Point&)> is_in_margin;  ///< of any patch but the owner
  };
  Partition(int patches, Rule rule);
  int patches() const { return static_cast<int>(regions_.size()); }

  /// The patches that n places belong to. nearest_plane[i] is the distance of x[i] from the nearest plane
  /// that it was compared with: a lower bound of its distance from any other patch.
  void owners(const Point* x, std::size_t n, PatchOfNode* owner, double* nearest_plane) const;
  /// The patch that x belongs to.
  PatchNumber owner(const Point& x) const {
    if (rule_.owner) return rule_.owner(x);
    std::int32_t k = 0;
    while (cells_[k].patch < 0) k = cells_[k].child_of(x);
    return cells_[k].patch;
  }

  /// Calls visit(i, q) for each of n places and each patch q that has x[i] in its margin. `owner` and
  /// `nearest_plane` are those of owners().
  template <class Visit>
  void for_each_margin(const Point* x, std::size_t n, const PatchOfNode* owner, const double* nearest_plane,
                       const Visit& visit) const {
    for (std::size_t i = 0; i < n; ++i) {
      const auto home = static_cast<PatchNumber>(owner[i]);
      if (rule_.owner) {
        for (PatchNumber q = 0; q < patches(); ++q)
          if (q != home && rule_.is_in_margin(q, x[i])) visit(i, q);
      } else if (nearest_plane[i] <= regions_[home].reach) {
        const double reach = reach_at(x[i], regions_[home].root, nearest_plane[i]);
        if (nearest_plane[i] <= reach) for_each_near(home, x[i], reach, [&](PatchNumber q) { visit(i, q); });
      }
    }
  }

  // What for_each_margin() goes by: x is in the margin of each patch, but its own, that is within the reach
  // of the cell of x.
  double reach(const Point& x) const { return reach_at(x, 0, 0); }
  /// A lower bound of the distance of x from a patch that it does not belong to.
  double distance(PatchNumber patch, const Point& x) const;

 private:
  struct Plane {
    double x, y, z, d;  // beyond: the product is at least d
  };
  static double product(const Plane& p, const Point& x) { return p.x * x.x + p.y * x.y + p.z * x.z; }
  /// A patch. Between these heights across x, y and z, if it is a box.
  struct Region {
    double low[3] = {-8, -8, -8}, high[3] = {8, 8, 8};
    std::int32_t root = 0;            // all its cells are below this one
    double reach = 0;                 // the largest of its cells
    std::vector<PatchNumber> beside;  // of a box: patches that may have nodes of this one in their margin
  };
  /// A node of the tree.
  struct Cell {
    Plane split;
    std::int32_t child[2];  // below and beyond; 0: a leaf
    PatchNumber patch;      // of all leaves below, if it is one patch; else -1
    double reach;           // of a leaf; otherwise the largest below
    std::int32_t child_of(const Point& x) const { return child[product(split, x) >= split.d]; }
  };

  /// The reach of the cell of x, which is below cell k; or any value less than `enough`, if it is less.
  double reach_at(const Point& x, std::int32_t k, double enough) const {
    while (cells_[k].child[1] != 0 && cells_[k].reach >= enough) k = cells_[k].child_of(x);
    return cells_[k].reach;
  }
  /// Calls visit(q) for each patch q but the owner of x that is no farther than the reach. Stripes are met
  /// counterclockwise, then clockwise: the first one that is too far hides the others.
  template <class Visit>
  void for_each_near(PatchNumber owner, const Point& x, double reach, const Visit& visit) const {
    if (borders_.empty()) {
      for (const PatchNumber q : regions_[owner].beside)
        if (distance(q, x) <= reach) visit(q);
      return;
    }
    const int n = patches();
    int met = 1;
    for (const int step : {1, n - 1})
      for (int q = (owner + step) % n; met < n && distance(q, x) <= reach; q = (q + step) % n, ++met)
        visit(q);
  }

  int levels_of(std::int32_t k) const;
  explicit Partition(int patches) : regions_(static_cast<std::size_t>(patches)) {}
  class Builder;
  std::vector<Cell> cells_;
  int levels_ = 0;  // of the tree above the cells of one patch
  std::vector<Region> regions_;
  std::vector<Plane> borders_;  // of stripes: where each begins, a plane through the axis
  Rule rule_;
};

}  // namespace pstripack
