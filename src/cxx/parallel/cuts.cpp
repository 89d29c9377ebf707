#include "parallel/cuts.h"

#include <cmath>
#include <numeric>

namespace pstripack {

// ---- of a sample ------------------------------------------------------------------------------------

Extent::Extent(const Points& p) {
  for (const Point* at = p.first; at < p.last; ++at)
    for (int axis = 0; axis < 3; ++axis) {
      low[axis] = std::min(low[axis], component(*at, axis));
      high[axis] = std::max(high[axis], component(*at, axis));
    }
}

int Extent::longest() const {
  constexpr double kClearly = 1.1;
  const int axis = length(1) > kClearly * length(0) ? 1 : 0;
  return length(2) > kClearly * length(axis) ? 2 : axis;
}

double Extent::diagonal() const { return std::hypot(length(0), length(1), length(2)); }

std::vector<double> heights(const Points& p, std::size_t first, std::size_t last, int axis) {
  std::vector<double> all(p.size());
  std::transform(p.first, p.last, all.begin(), [=](const Point& x) { return component(x, axis); });
  const auto begin = all.begin() + static_cast<std::ptrdiff_t>(first),
             end = all.begin() + static_cast<std::ptrdiff_t>(last);
  std::nth_element(all.begin(), begin, all.end());
  std::nth_element(begin, end - 1, all.end());
  std::sort(begin, end - 1);
  return {begin, end};
}

// ---- level by level ---------------------------------------------------------------------------------

Cuts Cuts::of_sample(int patches, std::vector<Point> sample, const std::vector<Point>& counted) {
  BlockArray<Point> block(counted.size());
  std::copy(counted.begin(), counted.end(), block.begin());
  Cuts cuts(patches, std::move(sample), std::move(block));
  for (int level = 0; level < levels(patches); ++level) {
    std::vector<std::int64_t> counter(counters(level));
    cuts.cut();
    cuts.count(counter.data());
    cuts.move(counter.data());
  }
  cuts.cut();
  return cuts;
}

int Cuts::levels(int patches) {
  int levels = 0;
  while ((std::int64_t{1} << levels) < patches) ++levels;
  return levels;
}

void Cuts::cut() {
  const std::vector<Box> above = std::move(boxes_);
  boxes_.clear();
  if (cuts_.empty())
    cut({sample_.data(), sample_.data() + sample_.size()},
        {counted_.data(), counted_.data() + counted_.size()}, 0, static_cast<int>(of_patch_.size()));
  for (const Box& box : above) {
    const Cut c = cuts_[box.cut];
    const auto separate = [&](const Points& p) {
      return std::partition(p.first, p.last, [&](const Point& x) { return component(x, c.axis) < c.height; });
    };
    Point* const sample = separate(box.sample);
    Point* const counted = c.patches > 2 ? separate(box.counted) : nullptr;  // no cut follows inside patches
    const auto next = [&](int patches) { return patches > 1 ? static_cast<std::int32_t>(cuts_.size()) : -1; };
    const int beyond = c.patches - c.below;
    cuts_[box.cut].child[0] = next(c.below);
    cut({box.sample.first, sample}, {box.counted.first, counted}, box.first, c.below);
    cuts_[box.cut].child[1] = next(beyond);
    cut({sample, box.sample.last}, {counted, box.counted.last}, box.first + c.below, beyond);
  }
}

void Cuts::cut(const Points& sample, const Points& counted, PatchNumber first, int patches) {
  if (patches == 1) {
    of_patch_[static_cast<std::size_t>(first)] = sample;
    return;
  }
  const std::size_t n = sample.size();
  const Extent extent(sample);
  Cut cut{extent.longest(), 0, {}, patches, patches / 2, {-1, -1}, n, extent.diagonal()};
  if (n > 0) {
    // The median of a sample is off by about sqrt(n) / 2 places in the sorted order, and by four times as
    // much once in thousands of cuts.
    const auto reach = static_cast<std::size_t>(2 * std::sqrt(static_cast<double>(n)) + 1);
    const std::size_t middle = n * static_cast<std::size_t>(cut.below) / static_cast<std::size_t>(patches);
    const std::size_t begin = std::max(middle, reach) - reach, end = std::min(n, middle + reach);
    const std::vector<double> height = heights(sample, begin, end, cut.axis);
    for (std::size_t e = 0; e < kEdges; ++e) cut.edge[e] = height[e * (height.size() - 1) / (kEdges - 1)];
    cut.height = 0.5 * (height[std::max(middle, begin + 1) - 1 - begin] + height[middle - begin]);
  }
  boxes_.push_back({sample, counted, first, static_cast<std::int32_t>(cuts_.size())});
  cuts_.push_back(cut);
}

void Cuts::count(std::int64_t* counter) const {
  for (const Box& box : boxes_) {
    const Cut& c = cuts_[box.cut];
    for (const Point* p = box.counted.first; p < box.counted.last; ++p) {
      const double height = component(*p, c.axis);
      std::size_t bin = 0;  // number of edges that are not above the node
      for (std::size_t half = kBins / 2; half > 0; half /= 2)
        bin += height >= c.edge[bin + half - 1] ? half : 0;
      ++counter[bin];
    }
    counter += kBins;
  }
}

void Cuts::move(const std::int64_t* counter) {
  for (const Box& box : boxes_) {
    const std::int64_t* const count = counter;
    counter += kBins;
    const std::int64_t total = std::accumulate(count, count + kBins, std::int64_t{0});
    if (total == 0) continue;
    Cut& c = cuts_[box.cut];
    const double wanted = static_cast<double>(total) * c.below / c.patches;
    double before = 0;
    std::size_t bin = 0;
    while (bin < kBins - 1 && before + static_cast<double>(count[bin]) <= wanted)
      before += static_cast<double>(count[bin++]);
    if (bin == 0 || bin == kBins - 1) {
      c.height = c.edge[std::min(bin, kEdges - 1)];
    } else {
      const double share = (wanted - before) / static_cast<double>(count[bin]);
      c.height = c.edge[bin - 1] + (c.edge[bin] - c.edge[bin - 1]) * share;
    }
  }
}

}  // namespace pstripack
