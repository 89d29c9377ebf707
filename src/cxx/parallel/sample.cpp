#include "parallel/sample.h"

#include <algorithm>
#include <cstdint>

#include "parallel/scattered.h"

namespace pstripack {

std::size_t sample_size(std::size_t nodes, std::size_t patches) {
  return std::min(nodes, std::max(64 * patches, std::clamp<std::size_t>(nodes / 64, 256, 4096)));
}

void add_share(const LocalNodes& mine, std::size_t wanted, std::size_t nodes, std::vector<Record>& sample) {
  const std::size_t share = (wanted * mine.count + nodes - 1) / nodes;
  for (std::size_t k = 0; k < share; ++k) {
    const std::size_t begin = mine.count * k / share, end = mine.count * (k + 1) / share;
    const std::size_t i = begin + scattered(k + 0x9e3779b97f4a7c15u) % (end - begin);
    sample.push_back({mine.points[i], mine.number(i)});
  }
}

Partition partition_over_ranks(PartitionKind kind, int ranks, const std::vector<Point>& nodes) {
  const std::size_t n = nodes.size(), size = static_cast<std::size_t>(ranks), wanted = sample_size(n, size);
  std::vector<Record> sample;
  for (std::size_t r = 0; r < size; ++r) {
    const std::size_t first = slice_begin(n, r, size), last = slice_begin(n, r + 1, size);
    add_share({nodes.data() + first, last - first}, wanted, n, sample);
  }
  std::vector<Point> points;
  for (const Record& record : sample) points.push_back(record.point);
  return Partition(kind, ranks, points, n);
}

}  // namespace pstripack
