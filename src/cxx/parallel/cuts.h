#pragma once
// Where recursive bisection cuts the sphere into boxes with equal numbers of nodes. Level by level: each box
// is cut at the median of a sample, the same on every rank. Then all ranks count many more nodes near the
// cut, and it moves to where these counts say.
//
//          |    |   | | ||| | |   |    |        Each cut has bins of height around it, between nodes of the
//     <----+  : | : | | |||:| | | : |  +---->   sample, so that all have about as many nodes. The outermost
//          |    |   | | ||| | |   |    |        have what lies farther off, too.
//                        cut

#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "base/workspace.h"
#include "geometry/point.h"
#include "parallel/local_numbers.h"

namespace pstripack {

inline double component(const Point& p, int axis) { return axis == 0 ? p.x : axis == 1 ? p.y : p.z; }

/// Points in an array of another's, which is sorted in place.
struct Points {
  Point *first, *last;
  std::size_t size() const { return static_cast<std::size_t>(last - first); }
};

/// The box around some points.
struct Extent {
  explicit Extent(const Points& p);
  double low[3] = {4, 4, 4}, high[3] = {-4, -4, -4};
  double length(int axis) const { return high[axis] - low[axis]; }
  /// The axis along which the box is longest. A later axis must be longer by 10 %, so that cuts stay where
  /// they are if nodes move a little.
  int longest() const;
  double diagonal() const;
};

/// The coordinates along `axis` of the points at places [first, last) of the sorted order, sorted; first <
/// last <= the number of points.
std::vector<double> heights(const Points& p, std::size_t first, std::size_t last, int axis);

/// The cuts between the patches of a bisection, a binary tree.
class Cuts {
 public:
  static constexpr std::size_t kBins = 16, kEdges = kBins - 1;
  struct Cut {
    int axis;
    double height;          ///< what is not lower lies beyond
    double edge[kEdges];    ///< between the bins, from below
    int patches, below;     ///< to cut apart, and how many of them lie below
    std::int32_t child[2];  ///< below and beyond; -1: one patch
    std::size_t sample;     ///< number of sample nodes that it cuts apart
    double diagonal;        ///< of the box around these
  };

  /// No cuts yet. Points have a length of about 1. The sample is the same on every rank; `counted` are nodes
  /// of this rank.
  Cuts(int patches, std::vector<Point> sample, BlockArray<Point> counted)
      : sample_(std::move(sample)),
        counted_(std::move(counted)),
        of_patch_(static_cast<std::size_t>(patches)) {}
  Cuts(Cuts&&) = default;  // boxes point into the arrays
  /// All cuts, at the medians of the sample, moved by the counts of this rank alone.
  static Cuts of_sample(int patches, std::vector<Point> sample, const std::vector<Point>& counted = {});

  /// The number of levels of cuts.
  static int levels(int patches);
  /// Cuts all boxes at the medians of the sample. The call after the last level only divides the nodes of the
  /// boxes among the patches. Throws std::bad_alloc.
  void cut();
  /// Upper bound of the number of counters for the cuts of one level, from 0.
  static std::size_t counters(int level) { return kBins << level; }
  /// Adds the counted nodes to the counters of the cuts of this level.
  void count(std::int64_t* counter) const;
  /// Moves the cuts of this level so that each side has its share of the nodes. `counter` are the sums of the
  /// counters of all ranks. A cut moves no farther than its outermost edges, and stays if nothing was
  /// counted.
  void move(const std::int64_t* counter);

  /// The first cut is the root. Empty if there is one patch.
  const std::vector<Cut>& all() const { return cuts_; }
  /// The sample nodes of each patch, which may be sorted.
  const std::vector<Points>& of_patch() const { return of_patch_; }
  std::size_t sample_size() const { return sample_.size(); }

 private:
  struct Box {
    Points sample, counted;
    PatchNumber first;
    std::int32_t cut;
  };
  void cut(const Points& sample, const Points& counted, PatchNumber first, int patches);

  std::vector<Point> sample_;
  BlockArray<Point> counted_;
  std::vector<Cut> cuts_;
  std::vector<Box> boxes_;  ///< of this level
  std::vector<Points> of_patch_;
};

}  // namespace pstripack
