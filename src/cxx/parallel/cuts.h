#pragma once
// Where recursive bisection cuts the sphere into boxes with equal numbers of nodes. Level by level: each box
// is cut at the median of a sample, the same on every rank. Then all ranks count many more nodes near the
// cut, and it moves to where these counts say.
//
//          |    |   | | ||| | |   |    |        Each cut has bins of height around it, between nodes of the
//     <----+  : | : | | |||:| | | : |  +---->   sample, so that all have about as many nodes. The outermost
//          |    |   | | ||| | |   |    |        have what lies farther off, too.
//                        cut

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/workspace.h"
#include "geometry/point.h"

namespace pstripack {

inline double component(const Point& p, int axis) { return axis == 0 ? p.x : axis == 1 ? p.y : p.z; }

/// The box around some points.
struct Extent {
  Extent(const Point* p, std::size_t n);
  double low[3] = {4, 4, 4}, high[3] = {-4, -4, -4};
  double length(int axis) const { return high[axis] - low[axis]; }
  /// The axis along which the box is longest. A later axis must be longer by 10 %, so that cuts stay where
  /// they are if nodes move a little.
  int longest() const;
  double diagonal() const;
};

/// Cuts points in two, again and again, in place.
class Halver {
 public:
  explicit Halver(std::size_t most_points) : others_(most_points) {}

  /// The coordinates along `axis` of the points at places [first, last) of the sorted order, sorted; first <
  /// last <= n.
  std::vector<double> heights(const Point* p, std::size_t n, std::size_t first, std::size_t last, int axis,
                              const Extent& extent);

  /// Moves the points that are not beyond to the front and returns the first of the others; both keep their
  /// order. Writes each point to both sides and advances on one: no branch.
  template <class IsBeyond>
  Point* separate(Point* first, Point* last, const IsBeyond& is_beyond) {
    Point *below = first, *others = others_.data();
    for (Point* p = first; p < last; ++p) {
      const Point q = *p;
      const bool beyond = is_beyond(q);
      *below = *others = q;
      below += !beyond;
      others += beyond;
    }
    std::copy(others_.data(), others, below);
    return below;
  }

 private:
  BlockArray<Point> others_;
  std::vector<double> height_;
};

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
  };

  /// No cuts yet. Points have a length of about 1. The sample is the same on every rank; `counted` are nodes
  /// of this rank.
  Cuts(int patches, std::vector<Point> sample, BlockArray<Point> counted);
  Cuts(Cuts&&) = default;  // boxes point into the arrays
  /// All cuts, at the medians of the sample, moved by the counts of this rank alone.
  static Cuts of_sample(int patches, std::vector<Point> sample, const std::vector<Point>& counted = {});

  /// The number of levels of cuts.
  static int levels(int patches);
  /// Cuts all boxes at the medians of the sample. Throws std::bad_alloc.
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

 private:
  struct Points {
    Point *first, *last;
    std::size_t size() const { return static_cast<std::size_t>(last - first); }
  };
  struct Box {
    Points sample, counted;
    std::int32_t cut;
  };
  void cut(const Points& sample, const Points& counted, int patches);

  const int patches_;
  std::vector<Point> sample_;
  BlockArray<Point> counted_;
  Halver halves_;
  std::vector<Cut> cuts_;
  std::vector<Box> boxes_;  ///< of this level
};

}  // namespace pstripack
