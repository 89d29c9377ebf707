#include "parallel/partition.h"

#include <optional>
#include <utility>

namespace pstripack {
namespace {

constexpr double kEverything = 4;  // a reach larger than the sphere

// Largest number of sample nodes in a cell: enough to tell the distance between nodes. Cells of uneven
// density are cut until they have fewer.
constexpr std::size_t kCellSample = 16, kUnevenCellSample = 5;
// The reach of a cell, in distances between its nodes. The circumscribed cap of a triangle of random nodes
// seldom has a larger diameter.
constexpr double kReachSpacings = 2.2;
constexpr int kMostLevels = 90;  // within a patch

/// Grows with the longitude: -1 at -90 degrees, 0 at 0, 1 at 90, 3 at 270.
double turn(const Point& p) {
  const double sum = std::fabs(p.x) + std::fabs(p.y);
  if (sum == 0) return 0;
  return p.x >= 0 ? p.y / sum : 2 - p.y / sum;
}

}  // namespace

// ---- building the tree ------------------------------------------------------------------------------

class Partition::Builder {
 public:
  Builder(Partition& partition, std::size_t sample, std::size_t nodes)
      : partition_(partition),
        nodes_a_sample_(static_cast<double>(nodes) / static_cast<double>(std::max<std::size_t>(sample, 1))) {}

  void bisect(const Cuts& cuts) {
    boxes(cuts, cuts.all().empty() ? -1 : 0, 0, {}, kEverything);
    for (PatchNumber q = 0; q < partition_.patches(); ++q) find_beside(partition_.regions_[q], q, 0);
  }

  void stripe(const Points& sample) {
    choose_borders(sample);
    const Plane& half = partition_.borders_[0];
    const auto last = static_cast<PatchNumber>(partition_.patches() - 1);
    PatchNumber k = 0;  // the stripe in which the half circle from the first border on ends
    while (k < last && product(half, vector_of(partition_.borders_[k + 1])) >= 0) ++k;
    Point* const middle = separate(half, sample);
    cut(half, [&](bool beyond) {
      return beyond ? wedges(0, k, {middle, sample.last}) : wedges(k, last, {sample.first, middle});
    });
  }

 private:
  // -- planes

  static Plane across(int axis, double height) {
    return {axis == 0 ? 1.0 : 0.0, axis == 1 ? 1.0 : 0.0, axis == 2 ? 1.0 : 0.0, height};
  }
  /// The plane of a meridian; what is east of it lies beyond.
  static Plane meridian(const Point& p) {
    const double sum = std::fabs(p.x) + std::fabs(p.y);
    if (sum == 0) return {0, 1, 0, 0};
    const double x = p.x / sum, y = p.y / sum, r = std::sqrt(x * x + y * y);
    return {-y / r, x / r, 0, 0};
  }
  static Point vector_of(const Plane& meridian) { return {meridian.y, -meridian.x, 0}; }

  /// The first of those beyond.
  static Point* separate(const Plane& plane, const Points& p) {
    return std::partition(p.first, p.last, [&](const Point& x) { return product(plane, x) < plane.d; });
  }

  // -- cells

  /// A cell that is cut: child(beyond) makes the cell of each side.
  template <class MakeChild>
  std::int32_t cut(const Plane& split, const MakeChild& child) {
    std::vector<Cell>& cells = partition_.cells_;
    const auto k = static_cast<std::int32_t>(cells.size());
    cells.push_back({split, {0, 0}, -1, 0});
    const std::int32_t below = child(false), beyond = child(true);
    const Cell &a = cells[below], &b = cells[beyond];
    cells[k] = {split, {below, beyond}, a.patch == b.patch ? a.patch : -1, std::max(a.reach, b.reach)};
    return k;
  }

  /// The cells of one patch. Stripes are bisected along their length only.
  std::int32_t cells_of_patch(const Points& p, PatchNumber patch, double reach, bool along_z, int level = 0) {
    const Extent extent(p);
    reach = reach_of(extent.diagonal(), p.size(), reach);
    const int axis = along_z ? 2 : extent.longest();
    if (extent.length(axis) > 0 && level < kMostLevels)
      if (const std::optional<double> height = split_height(p, axis, extent)) {
        const Plane split = across(axis, *height);
        Point* const middle = separate(split, p);
        if (middle != p.first && middle != p.last)
          return cut(split, [&](bool beyond) {
            return cells_of_patch(beyond ? Points{middle, p.last} : Points{p.first, middle}, patch, reach,
                                  along_z, level + 1);
          });
      }
    partition_.cells_.push_back({{0, 0, 0, 2 * kEverything}, {0, 0}, patch, reach});
    double& largest = partition_.regions_[patch].reach;
    largest = std::max(largest, reach);
    return static_cast<std::int32_t>(partition_.cells_.size()) - 1;
  }

  /// The reach of a cell, from its size and the number of nodes that its sample stands for; the reach of
  /// the cell around it if the sample is too small to tell.
  double reach_of(double diagonal, std::size_t n, double of_parent) const {
    if (n < 4) return of_parent;
    return kReachSpacings * diagonal / std::sqrt(static_cast<double>(n) * nodes_a_sample_);
  }

  /// Where to cut a cell, if at all: between the lower and the upper half. Where the density varies much, so
  /// that the middle of the cell leaves few on one side, some of these are cut off: sparse parts and dense
  /// ones are to have reaches of their own.
  static std::optional<double> split_height(const Points& p, int axis, const Extent& extent) {
    const std::size_t n = p.size();
    const double middle = extent.low[axis] + 0.5 * extent.length(axis);
    auto below = static_cast<std::size_t>(
        std::count_if(p.first, p.last, [=](const Point& x) { return component(x, axis) < middle; }));
    const std::size_t few = std::min(below, n - below);
    const bool is_even = n > kCellSample ? 4 * few >= n : few > n / 8 && few > 1;
    if (n <= kCellSample && (is_even || n < kUnevenCellSample)) return std::nullopt;
    below = is_even ? n / 2 : std::clamp(below, n / 8 + 1, n - n / 8 - 1);
    const std::vector<double> height = heights(p, below - 1, below + 1, axis);
    const double half_gap = 0.5 * (height[1] - height[0]);
    if (is_even) return height[0] + half_gap;
    // Nodes between the sampled ones of both sides belong to the sparse side, if not close to the others.
    const bool is_dense_below = 2 * below > n;
    const double dense = is_dense_below ? height[0] - extent.low[axis] : extent.high[axis] - height[1];
    const double beside = dense > 0 ? std::min(half_gap, dense) : half_gap;
    return is_dense_below ? height[0] + beside : height[1] - beside;
  }

  // -- patches

  /// Boxes for the patches from `patch` on that cut k divides, inside `box`.
  std::int32_t boxes(const Cuts& cuts, std::int32_t k, PatchNumber patch, const Region& box, double reach) {
    if (k < 0) {
      partition_.regions_[patch] = box;
      partition_.regions_[patch].root = static_cast<std::int32_t>(partition_.cells_.size());
      return cells_of_patch(cuts.of_patch()[static_cast<std::size_t>(patch)], patch, reach, false);
    }
    const Cuts::Cut& c = cuts.all()[k];
    const double here = reach_of(c.diagonal, c.sample, reach);
    return cut(across(c.axis, c.height), [&](bool beyond) {
      Region part = box;
      (beyond ? part.low : part.high)[c.axis] = c.height;
      return boxes(cuts, c.child[beyond], beyond ? patch + c.below : patch, part, here);
    });
  }

  /// Finds the patches below cell k that may have nodes of the region of `patch` in their margin.
  void find_beside(Region& region, PatchNumber patch, std::int32_t k) {
    const Cell& c = partition_.cells_[k];
    if (c.patch >= 0) {
      if (c.patch != patch) region.beside.push_back(c.patch);
      return;
    }
    const int axis = c.split.x != 0 ? 0 : c.split.y != 0 ? 1 : 2;
    if (region.high[axis] + region.reach >= c.split.d) find_beside(region, patch, c.child[1]);
    if (region.low[axis] - region.reach <= c.split.d) find_beside(region, patch, c.child[0]);
  }

  /// Stripe k begins at a node of the sample, the first one behind the widest gap in longitude: there a
  /// section of the sphere begins.
  void choose_borders(const Points& sample) {
    std::vector<Point> sorted(sample.first, sample.last);
    std::sort(sorted.begin(), sorted.end(), [](const Point& a, const Point& b) { return turn(a) < turn(b); });
    if (sorted.empty()) sorted.push_back({1, 0, 0});
    const std::size_t n = sorted.size(), patches = partition_.regions_.size();
    std::size_t first = 0;
    double gap = turn(sorted[0]) + 4 - turn(sorted[n - 1]);
    for (std::size_t k = 1; k < n; ++k)
      if (const double here = turn(sorted[k]) - turn(sorted[k - 1]); here > gap) gap = here, first = k;
    for (std::size_t k = 0; k < patches; ++k)
      partition_.borders_.push_back(meridian(sorted[(first + n * k / patches) % n]));
  }

  /// Wedges for the stripes first..last, in one half of the circle, by bisection of the list of borders.
  std::int32_t wedges(PatchNumber first, PatchNumber last, const Points& p) {
    if (first == last) return cells_of_patch(p, first, kEverything, true);
    const PatchNumber k = (first + last + 1) / 2;
    const Plane& border = partition_.borders_[k];
    Point* const middle = separate(border, p);
    return cut(border, [&](bool beyond) {
      return beyond ? wedges(k, last, {middle, p.last}) : wedges(first, k - 1, {p.first, middle});
    });
  }

  Partition& partition_;
  const double nodes_a_sample_;
};

Partition::Partition(const Cuts& cuts, std::size_t nodes)
    : Partition(static_cast<int>(cuts.of_patch().size())) {
  Builder(*this, cuts.sample_size(), nodes).bisect(cuts);
  levels_ = levels_of(0);
}

Partition::Partition(int patches, Rule rule) : Partition(patches) { rule_ = std::move(rule); }

Partition::Partition(PartitionKind kind, int patches, std::vector<Point> sample, std::size_t nodes)
    : Partition(patches) {
  if (kind == PartitionKind::bisection) {
    *this = Partition(Cuts::of_sample(patches, std::move(sample)), nodes);
    return;
  }
  Builder(*this, sample.size(), nodes).stripe({sample.data(), sample.data() + sample.size()});
  levels_ = levels_of(0);
}

int Partition::levels_of(std::int32_t k) const {
  const Cell& c = cells_[k];
  return c.patch >= 0 ? 0 : 1 + std::max(levels_of(c.child[0]), levels_of(c.child[1]));
}

// ---- asking it --------------------------------------------------------------------------------------

void Partition::owners(const Point* x, std::size_t n, PatchOfNode* owner, double* nearest_plane) const {
  if (rule_.owner) {
    for (std::size_t i = 0; i < n; ++i) owner[i] = static_cast<PatchOfNode>(rule_.owner(x[i]));
    std::fill_n(nearest_plane, n, 0);
    return;
  }
  // Level by level: one descent would wait for every comparison. On the way down owner[i] is the cell
  // reached.
  const Cell root = cells_[0];  // the same for all
  for (std::size_t i = 0; i < n; ++i) {
    const double height = product(root.split, x[i]) - root.split.d;
    owner[i] = static_cast<PatchOfNode>(height >= 0 ? root.child[1] : root.child[0]);
    nearest_plane[i] = std::fabs(height);
  }
  for (int level = 1; level < levels_; ++level)
    for (std::size_t i = 0; i < n; ++i) {
      const Cell& c = cells_[owner[i]];
      const double height = product(c.split, x[i]) - c.split.d;
      const bool goes_on = c.patch < 0;
      owner[i] = goes_on ? static_cast<PatchOfNode>(c.child[height >= 0]) : owner[i];
      nearest_plane[i] = goes_on ? std::min(nearest_plane[i], std::fabs(height)) : nearest_plane[i];
    }
  for (std::size_t i = 0; i < n; ++i) owner[i] = static_cast<PatchOfNode>(cells_[owner[i]].patch);
}

double Partition::distance(PatchNumber patch, const Point& x) const {
  if (borders_.empty()) {
    const Region& r = regions_[patch];
    return std::max(
        {r.low[0] - x.x, x.x - r.high[0], r.low[1] - x.y, x.y - r.high[1], r.low[2] - x.z, x.z - r.high[2]});
  }
  // From the half plane of the meridian at each end.
  double nearest = 2 * kEverything;
  for (const Plane& end : {borders_[patch], borders_[(patch + 1) % patches()]}) {
    const bool is_before = end.y * x.x - end.x * x.y >= 0;
    nearest = std::min(nearest, is_before ? std::fabs(product(end, x)) : std::sqrt(x.x * x.x + x.y * x.y));
  }
  return nearest;
}

}  // namespace pstripack
