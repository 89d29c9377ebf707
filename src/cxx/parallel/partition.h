#pragma once
// How the sphere is cut into patches, and what a patch knows of the nodes beyond its border.
//
// A partition is a binary tree of planes, first those between the patches (cuts.h). Its leaves are cells that
// hold a few nodes of a sample; every cell belongs to one patch. The same tree on every rank makes the same
// decisions on every rank.
//
//     +-------+-------+      A patch q knows its own nodes and its halo: all nodes x of another cell that are
//     |   :   |   .   |      no farther from q than that cell's margin, a few distances between nodes there:
//     |...:...|.q.....|          distance(q, x) <= margin(cell of x).
//     |   :   |   :   |      So the halo is thin where nodes are dense.
//     +-------+-------+

#include <algorithm>
#include <cmath>
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
  bisection,         ///< boxes with equal numbers of nodes, by recursive bisection along x, y, z
  stripes,           ///< stripes of longitude with equal numbers of nodes
  stripes_of_width,  ///< stripes of longitude of equal width, as published
};

/// All of them in this order, and what pictures call them.
struct NamedPartition {
  PartitionKind kind;
  const char* name;
};
inline constexpr NamedPartition kPartitions[] = {{PartitionKind::bisection, "bisection"},
                                                 {PartitionKind::stripes, "stripes"},
                                                 {PartitionKind::stripes_of_width, "stripes_of_width"}};
inline const char* name_of(PartitionKind kind) { return kPartitions[static_cast<int>(kind)].name; }

class Partition {
 public:
  /// Patches 0..patches-1 for `nodes` nodes of which `sample` is a sample: vectors of about length 1.
  Partition(PartitionKind kind, int patches, std::vector<Point> sample, std::size_t nodes);
  /// Bisection by these cuts.
  Partition(const Cuts& cuts, std::vector<Point> sample, std::size_t nodes);

  /// Patches of any shape with any halos, for tests.
  struct Rule {
    std::function<PatchNumber(const Point&)> owner;
    std::function<bool(PatchNumber, const Point&)> is_in_halo;  ///< of any patch but the owner
  };
  Partition(int patches, Rule rule);
  int patches() const { return static_cast<int>(regions_.size()); }

  /// The patches that n places belong to. nearest_plane[i] is the distance of x[i] from the nearest plane
  /// that it was compared with, less rounding: a lower bound of its distance from any other patch.
  void owners(const Point* x, std::size_t n, PatchOfNode* owner, double* nearest_plane) const;
  /// The patch that x belongs to.
  PatchNumber owner(const Point& x) const {
    if (rule_.owner) return rule_.owner(x);
    std::int32_t k = 0;
    while (cells_[k].patch < 0) k = cells_[k].child[is_beyond(cells_[k], x)];
    return cells_[k].patch;
  }

  /// Writes the indices of those of n places that may be another patch's own or in its halo, in increasing
  /// order, and returns their number. The other places are deep in this patch.
  std::size_t not_deep(PatchNumber patch, const Point* x, std::size_t n, std::uint32_t* which) const;

  /// A lower bound of the distance of x from the patch; 0 or less inside. If x moves by d, it changes by at
  /// most d.
  double distance(PatchNumber patch, const Point& x) const;

  /// Calls visit(i, q) for each of n places and each patch q that has x[i] in its halo. `owner` and
  /// `nearest_plane` are those of owners().
  template <class Visit>
  void for_each_halo(const Point* x, std::size_t n, const PatchOfNode* owner, const double* nearest_plane,
                     const Visit& visit) const {
    if (rule_.owner) {
      for (std::size_t i = 0; i < n; ++i)
        for (PatchNumber q = 0; q < patches(); ++q)
          if (q != static_cast<PatchNumber>(owner[i]) && rule_.is_in_halo(q, x[i])) visit(i, q);
      return;
    }
    double margin[kTogether];  // exact where it is at least nearest_plane
    std::vector<PatchNumber> patches;
    const auto examine = [&](const std::size_t* candidate, std::size_t candidates) {
      margins(x, owner, nearest_plane, candidate, candidates, margin);
      for (std::size_t j = 0; j < candidates; ++j) {
        const std::size_t i = candidate[j];
        if (nearest_plane[i] > margin[j]) continue;
        const Region& region = regions_[owner[i]];
        if (!region.is_box) {
          patches.clear();
          near(x[i], margin[j], patches);
        }
        for (const PatchNumber q : region.is_box ? region.beside : patches)
          if (q != static_cast<PatchNumber>(owner[i]) && is_within(margin[j], q, x[i])) visit(i, q);
      }
    };
    const double* const largest_margin = largest_margin_.data();
    for (std::size_t i = 0; i < n;) {
      std::size_t candidate[kTogether], candidates = 0;  // not seen by examine(): a count in a register
      for (; i < n && candidates < kTogether; ++i) {
        candidate[candidates] = i;
        candidates += nearest_plane[i] <= largest_margin[owner[i]];
      }
      examine(candidate, candidates);
    }
  }

  /// True if x is patch q's own or in its halo.
  bool knows(PatchNumber q, const Point& x) const {
    if (rule_.owner) return owner(x) == q || rule_.is_in_halo(q, x);
    return owner(x) == q || is_within(margin_at(x), q, x);
  }

 private:
  struct Plane {
    double x, y, z, d;  // inside: the product is at least d
  };
  struct Piece {
    std::vector<Plane> planes;
  };
  struct Region {
    std::vector<Piece> pieces;
    std::int32_t root = 0;  // all its cells are below this one
    bool is_box = false;    // between these heights across x, y and z
    double low[3] = {-8, -8, -8}, high[3] = {8, 8, 8};
    double rounded_low[3] = {-8, -8, -8}, rounded_high[3] = {8, 8, 8};  // the same, wider by rounding
    std::vector<PatchNumber> beside;  // of a box: patches that may have nodes of this one in their halo
  };
  /// A node of the tree.
  struct Cell {
    Plane split;             // child[1] has what is inside
    std::int32_t child[2];   // 0: a leaf
    PatchNumber patch = -1;  // of all leaves below, if it is one patch
    double margin = 0;       // of a leaf; otherwise the smallest below
    double largest = 0;      // margin of the leaves below
  };

  /// Number of descents in the tree that run side by side, level by level: a single one would wait for each
  /// of its comparisons.
  static constexpr std::size_t kTogether = 16;

  /// Rounding of places: relative to the height of a plane across an axis; absolute for planes through the
  /// centre.
  static constexpr double kRounding = 0x1p-48;
  static double rounding_at(const Plane& p) { return kRounding * (p.d != 0 ? std::fabs(p.d) : 1); }

  static double product(const Plane& p, const Point& x) { return p.x * x.x + p.y * x.y + p.z * x.z; }
  /// The axis that a plane is across.
  static int axis_of(const Plane& p) { return p.x != 0 ? 0 : p.y != 0 ? 1 : 2; }
  static bool is_beyond(const Cell& cell, const Point& x) { return product(cell.split, x) >= cell.split.d; }

  /// True if x is no farther from the patch than the margin, up to rounding.
  bool is_within(double margin, PatchNumber patch, const Point& x) const {
    const Region& r = regions_[patch];
    if (!r.is_box) return distance(patch, x) <= margin + kRounding;
    return std::max({r.rounded_low[0] - x.x, x.x - r.rounded_high[0], r.rounded_low[1] - x.y,
                     x.y - r.rounded_high[1], r.rounded_low[2] - x.z, x.z - r.rounded_high[2]}) <= margin;
  }

  /// The cell of x.
  std::size_t leaf(const Point& x) const {
    std::int32_t k = 0;
    while (cells_[k].child[1] != 0) k = cells_[k].child[is_beyond(cells_[k], x)];
    return static_cast<std::size_t>(k);
  }
  double margin_at(const Point& x) const { return cells_[leaf(x)].margin; }
  /// The margins of the cells of x[which[0..n-1]], n <= kTogether; any value less than nearest_plane if the
  /// margin is less.
  void margins(const Point* x, const PatchOfNode* owner, const double* nearest_plane,
               const std::size_t* which, std::size_t n, double* margin) const;
  /// The patches within `radius` of x, each once.
  void near(const Point& x, double radius, std::vector<PatchNumber>& patches) const;

  /// A node of the top of the tree, which ends at cells of one patch. Such a cell is its own child.
  struct Top {
    Plane split;
    double rounding;
    std::int32_t child[2];
    PatchNumber patch;
  };
  void copy_top(std::int32_t cell, int depth);
  void find_beside(PatchNumber patch);

  explicit Partition(int patches);
  class Builder;
  std::vector<Top> top_;
  int top_depth_ = 0;
  std::vector<Cell> cells_;
  std::vector<Region> regions_;
  std::vector<double> largest_margin_;  // of the cells of each patch
  Rule rule_;
};

}  // namespace pstripack
