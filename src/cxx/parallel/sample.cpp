#include "parallel/sample.h"

#include <algorithm>

#include "base/splitmix64.h"

namespace pstripack {

std::size_t sample_size(std::size_t nodes, std::size_t patches) {
  constexpr std::size_t kMany = 4096;  // on many ranks, the work on the sample is more than that on the nodes
  const std::size_t enough = std::max(std::min(64 * patches, kMany), 16 * patches);
  return std::min(nodes, std::max(enough, std::clamp<std::size_t>(nodes / 64, 256, kMany)));
}

std::size_t share_of_sample(std::size_t before, std::size_t of_rank, std::size_t wanted, std::size_t nodes) {
  return wanted * (before + of_rank) / nodes - wanted * before / nodes;
}

void write_share(const LocalNodes& mine, std::size_t share, SentNode* sample) {
  for (std::size_t k = 0; k < share; ++k) {
    const std::size_t begin = mine.count * k / share, end = mine.count * (k + 1) / share;
    const std::size_t i = begin + splitmix64(k + 0x9e3779b97f4a7c15u) % (end - begin);
    sample[k] = {mine.points[i], mine.number(i)};
  }
}

BlockArray<Point> places_to_count(const LocalNodes& mine, std::size_t nodes, std::size_t patches,
                                  const Places& places) {
  constexpr std::size_t kEnough = 8192;  // counted nodes a patch; more would hardly make patches more equal
  const std::size_t step = nodes / (kEnough * patches) + 1;
  BlockArray<Point> counted((mine.count + step - 1) / step);
  for (std::size_t k = 0; k < counted.size(); ++k) {
    const std::size_t first = k * step, choice = std::min(step, mine.count - first);
    counted[k] = places(mine.points[first + ((splitmix64(first) >> 32) * choice >> 32)]);
  }
  return counted;
}

Partition partition_over_ranks(PartitionKind kind, int ranks, const std::vector<Point>& nodes) {
  const std::size_t n = nodes.size(), size = static_cast<std::size_t>(ranks), wanted = sample_size(n, size);
  const auto nodes_of = [&](RankNumber r) {
    const std::size_t first = slice_begin(n, r, size);
    return LocalNodes{nodes.data() + first, slice_begin(n, r + 1, size) - first};
  };
  std::vector<SentNode> sample;
  for (RankNumber r = 0; r < size; ++r) {
    const std::size_t share = share_of_sample(slice_begin(n, r, size), nodes_of(r).count, wanted, n);
    sample.resize(sample.size() + share);
    write_share(nodes_of(r), share, sample.data() + sample.size() - share);
  }
  std::vector<Point> points;
  for (const SentNode& record : sample) points.push_back(record.point);
  if (kind != PartitionKind::bisection) return Partition(kind, ranks, points, n);
  std::vector<Point> counted;
  for (RankNumber r = 0; r < size; ++r) {
    const BlockArray<Point> of_rank = places_to_count(nodes_of(r), n, size, Places(Lengths::as_given, 0));
    counted.insert(counted.end(), of_rank.data(), of_rank.data() + of_rank.size());
  }
  return Partition(Cuts::of_sample(ranks, points, counted), n);
}

}  // namespace pstripack
