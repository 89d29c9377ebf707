#include "parallel/partition.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <numeric>
#include <optional>

namespace pstripack {
namespace {

constexpr double kPi = 3.141592653589793;
constexpr double kEverything = 4;  // a margin larger than the sphere

// Largest number of sample nodes in a cell: enough to tell the distance between nodes. Cells of uneven
// density are cut until they have fewer.
constexpr std::size_t kCellSample = 16, kUnevenCellSample = 5;
// The margin of a cell, in distances between its nodes. The circumscribed cap of a triangle of random nodes
// seldom has a larger diameter.
constexpr double kMarginSpacings = 2.2;
// Largest number of levels within a patch. With the 31 levels between 2^31 patches they fit the stack of a
// search.
constexpr int kMostLevels = 90, kStack = 128;

double longitude(const Point& p) {
  const double phi = std::atan2(p.y, p.x);
  return phi < 0 ? phi + 2 * kPi : phi;
}

}  // namespace

// ---- building the tree ------------------------------------------------------------------------------

class Partition::Builder {
 public:
  Builder(Partition& partition, std::vector<Point>& sample, std::size_t nodes)
      : partition_(partition),
        sample_(sample),
        halves_(sample.size()),
        nodes_a_sample_(sample.empty() ? 1
                                       : static_cast<double>(nodes) / static_cast<double>(sample.size())) {}

  void bisect(const Cuts& cuts) {
    bisect(cuts, cuts.all().empty() ? -1 : 0, sample_.data(), sample_.size(), 0, {}, kEverything);
  }

  /// Borders between stripes: stripe k is [border[k], border[k+1]), all in [0, 2 pi), cyclic.
  void stripe(std::vector<double> border) {
    const int patches = static_cast<int>(border.size());
    std::vector<Stripe> stripes;
    for (int k = 0; k < patches; ++k) stripes.push_back({border[k], k});
    std::sort(stripes.begin(), stripes.end(),
              [](const Stripe& a, const Stripe& b) { return a.from < b.from; });
    // The plane y = 0 divides the circle into [0, pi) and [pi, 2 pi); in each half every border is a plane
    // through the axis.
    const Plane half{0, 1, 0, 0};
    Point* const first = sample_.data();
    Point* const last = first + sample_.size();
    Point* const middle = separate(first, last, half);
    const std::int32_t root = new_cell(half);
    const PatchNumber at_zero = stripe_at(stripes, 0), at_pi = stripe_at(stripes, kPi);
    link(root, 1, wedges(middle, last, inside(stripes, 0, kPi, at_zero), kPi, {{half}}));
    link(root, 0, wedges(first, middle, inside(stripes, kPi, 2 * kPi, at_pi), 2 * kPi, {{opposite(half)}}));
    finish(root);
  }

 private:
  struct Stripe {
    double from;
    PatchNumber patch;
  };

  /// The stripe that the meridian `phi` lies in.
  static PatchNumber stripe_at(const std::vector<Stripe>& stripes, double phi) {
    PatchNumber patch = stripes.back().patch;
    for (const Stripe& s : stripes)
      if (s.from <= phi) patch = s.patch;
    return patch;
  }

  static std::vector<Stripe> inside(const std::vector<Stripe>& stripes, double from, double to,
                                    PatchNumber first) {
    std::vector<Stripe> result{{from, first}};
    for (const Stripe& s : stripes)
      if (s.from > from && s.from < to) result.push_back(s);
    return result;
  }

  static Plane opposite(const Plane& p) { return {-p.x, -p.y, -p.z, -p.d}; }
  static Plane meridian(double phi) { return {-std::sin(phi), std::cos(phi), 0, 0}; }

  std::int32_t new_cell(const Plane& split) {
    partition_.cells_.push_back({split, {0, 0}, -1, 0});
    return static_cast<std::int32_t>(partition_.cells_.size()) - 1;
  }
  void link(std::int32_t parent, int side, std::int32_t child) {
    partition_.cells_[parent].child[side] = child;
  }
  /// Sets what a cell knows of those below, its patch and its margin, and returns the cell.
  std::int32_t finish(std::int32_t k) {
    Cell& c = partition_.cells_[k];
    const Cell &a = partition_.cells_[c.child[0]], &b = partition_.cells_[c.child[1]];
    c.patch = a.patch == b.patch ? a.patch : -1;
    c.margin = std::min(a.margin, b.margin);
    c.largest = std::max(a.largest, b.largest);
    return k;
  }

  /// Wedges of a half circle that ends at `to`, by bisection of the list of borders. `path`: the planes above
  /// in the tree; the distance from a patch must be no less than that from any of them, or the search in the
  /// tree would miss it.
  std::int32_t wedges(Point* first, Point* last, const std::vector<Stripe>& stripes, double to,
                      const Piece& path) {
    if (stripes.size() == 1) {
      const double from = stripes[0].from, middle = 0.5 * (from + to);
      const Plane end = meridian(to);
      Piece piece = path;
      for (const Plane& p : {meridian(from), opposite(end), Plane{std::cos(middle), std::sin(middle), 0, 0}})
        piece.planes.push_back(p);
      partition_.regions_[stripes[0].patch].pieces.push_back(std::move(piece));
      return cells_of_patch(first, static_cast<std::size_t>(last - first), stripes[0].patch, kEverything,
                            true);
    }
    const std::size_t k = stripes.size() / 2;
    const Plane border = meridian(stripes[k].from);
    Point* const middle = separate(first, last, border);
    const std::int32_t cell = new_cell(border);
    link(cell, 0,
         wedges(first, middle, {stripes.begin(), stripes.begin() + k}, stripes[k].from,
                with(path, opposite(border))));
    link(cell, 1, wedges(middle, last, {stripes.begin() + k, stripes.end()}, to, with(path, border)));
    return finish(cell);
  }

  /// Boxes for the patches from `first_patch` on that cut k divides. box: the planes around it.
  std::int32_t bisect(const Cuts& cuts, std::int32_t k, Point* p, std::size_t n, PatchNumber first_patch,
                      const Piece& box, double margin) {
    if (k < 0) {
      Region& region = partition_.regions_[first_patch];
      region.pieces = {box};
      region.root = static_cast<std::int32_t>(partition_.cells_.size());
      region.is_box = true;
      for (const Plane& p : box.planes) {
        const int axis = axis_of(p);
        if (p.x + p.y + p.z > 0) {
          region.low[axis] = p.d;
          region.rounded_low[axis] = p.d - rounding_at(p);
        } else {
          region.high[axis] = -p.d;
          region.rounded_high[axis] = -p.d + rounding_at(p);
        }
      }
      return cells_of_patch(p, n, first_patch, margin, false);
    }
    const Cuts::Cut& cut = cuts.all()[k];
    const Plane split = across(cut.axis, cut.height);
    const std::int32_t cell = new_cell(split);
    const double here = margin_of(Extent(p, n), n, margin);
    Point* const middle = separate(p, p + n, split);
    const auto m = static_cast<std::size_t>(middle - p);
    link(cell, 0, bisect(cuts, cut.child[0], p, m, first_patch, with(box, opposite(split)), here));
    link(cell, 1, bisect(cuts, cut.child[1], middle, n - m, first_patch + cut.below, with(box, split), here));
    return finish(cell);
  }

  /// The cells of one patch. Stripes are bisected along their length only.
  std::int32_t cells_of_patch(Point* p, std::size_t n, PatchNumber patch, double margin, bool along_z,
                              int level = 0) {
    const Extent extent(p, n);
    margin = margin_of(extent, n, margin);
    const int axis = along_z ? 2 : extent.longest();
    std::optional<double> height;
    if (extent.length(axis) > 0 && level < kMostLevels) height = split_height(p, n, axis, extent);
    if (height) {
      const Plane split = across(axis, *height);
      Point* const middle = separate(p, p + n, split);
      const auto m = static_cast<std::size_t>(middle - p);
      if (m > 0 && m < n) {
        const std::int32_t cell = new_cell(split);
        link(cell, 0, cells_of_patch(p, m, patch, margin, along_z, level + 1));
        link(cell, 1, cells_of_patch(middle, n - m, patch, margin, along_z, level + 1));
        return finish(cell);
      }
    }
    const std::int32_t leaf = new_cell({0, 0, 0, 0});
    partition_.cells_[leaf].patch = patch;
    partition_.cells_[leaf].margin = partition_.cells_[leaf].largest = margin;
    double& largest = partition_.largest_margin_[patch];
    largest = std::max(largest, margin);
    return leaf;
  }

  /// The margin of a cell, from its size and the number of nodes that its sample stands for; the margin of
  /// the cell around it if the sample is too small to tell.
  double margin_of(const Extent& extent, std::size_t n, double of_parent) const {
    if (n < 4) return of_parent;
    return kMarginSpacings * extent.diagonal() / std::sqrt(static_cast<double>(n) * nodes_a_sample_);
  }

  static Plane across(int axis, double height) {
    return {axis == 0 ? 1.0 : 0.0, axis == 1 ? 1.0 : 0.0, axis == 2 ? 1.0 : 0.0, height};
  }

  /// Where to cut a cell, if at all: between the lower and the upper half. Where the density varies much, so
  /// that the middle of the cell leaves few on one side, some of these are cut off: sparse parts and dense
  /// ones are to have margins of their own.
  std::optional<double> split_height(const Point* p, std::size_t n, int axis, const Extent& extent) {
    const double middle = extent.low[axis] + 0.5 * extent.length(axis);
    std::size_t below = 0;
    for (std::size_t i = 0; i < n; ++i) below += component(p[i], axis) < middle;
    const std::size_t few = std::min(below, n - below);
    const bool is_even = n > kCellSample ? 4 * few >= n : few > n / 8 && few > 1;
    if (n <= kCellSample && (is_even || n < kUnevenCellSample)) return std::nullopt;
    below = is_even ? n / 2 : std::clamp(below, n / 8 + 1, n - n / 8 - 1);
    const std::vector<double> height = halves_.heights(p, n, below - 1, below + 1, axis, extent);
    const double half_gap = 0.5 * (height[1] - height[0]);
    if (is_even) return height[0] + half_gap;
    // Nodes between the sampled ones of both sides belong to the sparse side, if not close to the others.
    const bool is_dense_below = 2 * below > n;
    const double dense = is_dense_below ? height[0] - extent.low[axis] : extent.high[axis] - height[1];
    const double beside = dense > 0 ? std::min(half_gap, dense) : half_gap;
    return is_dense_below ? height[0] + beside : height[1] - beside;
  }

  Point* separate(Point* first, Point* last, const Plane& plane) {
    return halves_.separate(first, last, [&](const Point& x) { return product(plane, x) >= plane.d; });
  }

  /// The box cut by one more plane; of parallel planes only the innermost stays.
  static Piece with(Piece box, const Plane& cut) {
    for (Plane& p : box.planes)
      if (p.x == cut.x && p.y == cut.y && p.z == cut.z) {
        p.d = std::max(p.d, cut.d);
        return box;
      }
    box.planes.push_back(cut);
    return box;
  }

  Partition& partition_;
  std::vector<Point>& sample_;
  Halver halves_;
  double nodes_a_sample_;
};

Partition::Partition(const Cuts& cuts, std::vector<Point> sample, std::size_t nodes)
    : Partition(static_cast<int>(cuts.all().size()) + 1) {
  Builder(*this, sample, nodes).bisect(cuts);
  copy_top(0, 0);
  for (PatchNumber q = 0; q < patches(); ++q) find_beside(q);
}

Partition::Partition(int patches)
    : regions_(static_cast<std::size_t>(patches)), largest_margin_(static_cast<std::size_t>(patches)) {}

Partition::Partition(int patches, Rule rule) : Partition(patches) { rule_ = std::move(rule); }

Partition::Partition(PartitionKind kind, int patches, std::vector<Point> sample, std::size_t nodes)
    : Partition(patches) {
  if (kind == PartitionKind::bisection) {
    *this = Partition(Cuts::of_sample(patches, sample), sample, nodes);
    return;
  }
  Builder builder(*this, sample, nodes);
  std::vector<double> phi;
  for (const Point& p : sample) phi.push_back(longitude(p));
  std::sort(phi.begin(), phi.end());
  // A section of the sphere begins behind the widest gap in longitude and ends in front of it.
  double begin = 0, width = 2 * kPi;
  std::size_t first = 0;
  if (!phi.empty()) {
    double gap = phi.front() + 2 * kPi - phi.back();
    for (std::size_t k = 1; k < phi.size(); ++k)
      if (phi[k] - phi[k - 1] > gap) gap = phi[k] - phi[k - 1], first = k;
    begin = phi[first] - 0.25 * gap;
    width = 2 * kPi - 0.5 * gap;
  }
  std::vector<double> border;
  for (int k = 0; k < patches; ++k) {
    double b = begin + width * k / patches;
    if (kind == PartitionKind::stripes && k > 0 && !phi.empty()) {
      const std::size_t at = phi.size() * static_cast<std::size_t>(k) / static_cast<std::size_t>(patches);
      b = phi[(first + at) % phi.size()];
    }
    b = std::fmod(b + 4 * kPi, 2 * kPi);
    border.push_back(b < 2 * kPi ? b : 0);
  }
  builder.stripe(std::move(border));
  copy_top(0, 0);
}

void Partition::owners(const Point* x, std::size_t n, PatchOfNode* owner, double* nearest_plane) const {
  if (rule_.owner) {
    for (std::size_t i = 0; i < n; ++i) owner[i] = static_cast<PatchOfNode>(rule_.owner(x[i]));
    std::fill_n(nearest_plane, n, 0);
    return;
  }
  // Level by level: one descent would wait for every comparison. On the way down owner[i] is the node
  // reached.
  const Top root = top_[0];  // the same for all
  for (std::size_t i = 0; i < n; ++i) {
    const double height = product(root.split, x[i]) - root.split.d;
    owner[i] = static_cast<PatchOfNode>(height >= 0 ? root.child[1] : root.child[0]);
    nearest_plane[i] = std::fabs(height) - root.rounding;
  }
  for (int level = 1; level < top_depth_; ++level)
    for (std::size_t i = 0; i < n; ++i) {
      const Top& t = top_[owner[i]];
      const double height = product(t.split, x[i]) - t.split.d;
      owner[i] = static_cast<PatchOfNode>(t.child[height >= 0]);
      nearest_plane[i] = std::min(nearest_plane[i], std::fabs(height) - t.rounding);
    }
  for (std::size_t i = 0; i < n; ++i) owner[i] = static_cast<PatchOfNode>(top_[owner[i]].patch);
}

std::size_t Partition::not_deep(PatchNumber patch, const Point* x, std::size_t n,
                                std::uint32_t* which) const {
  const Region& region = regions_[patch];
  if (!region.is_box) {
    std::iota(which, which + n, 0);
    return n;
  }
  const double deep = largest_margin_[patch] + kRounding;
  std::size_t count = 0;
  for (std::size_t i = 0; i < n; ++i) {
    const double depth = std::min({x[i].x - region.low[0], region.high[0] - x[i].x, x[i].y - region.low[1],
                                   region.high[1] - x[i].y, x[i].z - region.low[2], region.high[2] - x[i].z});
    which[count] = static_cast<std::uint32_t>(i);
    count += !(depth > deep);
  }
  return count;
}

/// Appends the cell and those below it down to cells of one patch.
void Partition::copy_top(std::int32_t cell, int depth) {
  const auto k = static_cast<std::int32_t>(top_.size());
  const Cell& c = cells_[cell];
  const Plane split = c.patch >= 0 ? Plane{0, 0, 0, 2 * kEverything} : c.split;
  top_.push_back({split, rounding_at(split), {k, k}, c.patch});
  top_depth_ = std::max(top_depth_, depth);
  if (c.patch >= 0) return;
  for (const int side : {0, 1}) {
    top_[k].child[side] = static_cast<std::int32_t>(top_.size());
    copy_top(c.child[side], depth + 1);
  }
}

// ---- asking it --------------------------------------------------------------------------------------

double Partition::distance(PatchNumber patch, const Point& x) const {
  const Region& region = regions_[patch];
  if (region.is_box)
    return std::max({-4.0, region.low[0] - x.x, x.x - region.high[0], region.low[1] - x.y,
                     x.y - region.high[1], region.low[2] - x.z, x.z - region.high[2]});
  double nearest = 2 * kEverything;  // of a stripe without width
  for (const Piece& piece : region.pieces) {
    double s = -4;
    for (const Plane& p : piece.planes) s = std::max(s, p.d - product(p, x));
    nearest = std::min(nearest, s);
  }
  return nearest;
}

void Partition::margins(const Point* x, const PatchOfNode* owner, const double* nearest_plane,
                        const std::size_t* which, std::size_t n, double* margin) const {
  std::int32_t k[kTogether];
  std::size_t descending[kTogether], count = n;
  for (std::size_t j = 0; j < n; ++j) {
    k[j] = regions_[owner[which[j]]].root;
    descending[j] = j;
  }
  while (count > 0) {
    std::size_t left = 0;
    for (std::size_t m = 0; m < count; ++m) {
      const std::size_t j = descending[m];
      const Cell& c = cells_[k[j]];
      const std::int32_t below = c.child[is_beyond(c, x[which[j]])];
      const bool goes_on = (below != 0) & (nearest_plane[which[j]] <= c.largest);
      k[j] = goes_on ? below : k[j];
      descending[left] = j;
      left += goes_on;
    }
    count = left;
  }
  for (std::size_t j = 0; j < n; ++j) margin[j] = cells_[k[j]].largest;
}

void Partition::find_beside(PatchNumber patch) {
  Region& region = regions_[patch];
  const double margin = largest_margin_[patch];
  std::vector<std::int32_t> stack{0};
  while (!stack.empty()) {
    const Cell& c = cells_[stack.back()];
    stack.pop_back();
    if (c.patch >= 0) {
      if (c.patch != patch) region.beside.push_back(c.patch);
      continue;
    }
    const int axis = axis_of(c.split);
    const double reach = margin + rounding_at(c.split);
    if (region.high[axis] + reach >= c.split.d) stack.push_back(c.child[1]);
    if (region.low[axis] - reach <= c.split.d) stack.push_back(c.child[0]);
  }
}

void Partition::near(const Point& x, double radius, std::vector<PatchNumber>& patches) const {
  std::int32_t stack[kStack];
  int top = 0;
  stack[top++] = 0;
  while (top > 0) {
    const Cell& c = cells_[stack[--top]];
    if (c.patch >= 0) {
      if (std::find(patches.begin(), patches.end(), c.patch) == patches.end()) patches.push_back(c.patch);
      continue;
    }
    const double s = product(c.split, x) - c.split.d, reach = radius + rounding_at(c.split);
    assert(top + 2 <= kStack);
    if (s >= -reach) stack[top++] = c.child[1];
    if (s <= reach) stack[top++] = c.child[0];
  }
}

}  // namespace pstripack
