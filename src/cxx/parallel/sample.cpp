#include "parallel/sample.h"

#include <algorithm>
#include <cstdint>

#include "parallel/scattered.h"

namespace pstripack {

std::size_t sample_size(std::size_t nodes, std::size_t patches) {
  return std::min(nodes, std::max(64 * patches, std::clamp<std::size_t>(nodes / 64, 256, 4096)));
}

std::size_t share_of_sample(std::size_t of_rank, std::size_t wanted, std::size_t nodes) {
  return (wanted * of_rank + nodes - 1) / nodes;
}

void write_share(const LocalNodes& mine, std::size_t share, Record* sample) {
  for (std::size_t k = 0; k < share; ++k) {
    const std::size_t begin = mine.count * k / share, end = mine.count * (k + 1) / share;
    const std::size_t i = begin + scattered(k + 0x9e3779b97f4a7c15u) % (end - begin);
    sample[k] = {mine.points[i], mine.number(i)};
  }
}

Partition partition_over_ranks(PartitionKind kind, int ranks, const std::vector<Point>& nodes) {
  const std::size_t n = nodes.size(), size = static_cast<std::size_t>(ranks), wanted = sample_size(n, size);
  std::vector<Record> sample;
  for (std::size_t r = 0; r < size; ++r) {
    const std::size_t first = slice_begin(n, r, size), last = slice_begin(n, r + 1, size);
    const std::size_t share = share_of_sample(last - first, wanted, n);
    sample.resize(sample.size() + share);
    write_share({nodes.data() + first, last - first}, share, sample.data() + sample.size() - share);
  }
  std::vector<Point> points;
  for (const Record& record : sample) points.push_back(record.point);
  return Partition(kind, ranks, points, n);
}

}  // namespace pstripack
