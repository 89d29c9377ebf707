#pragma once
// What ranks find out about the points that each of them brings, before they make a mesh of them.

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "mpi/mpi_communicator.h"
#include "parallel/local_nodes.h"
#include "parallel/partition.h"
#include "parallel/record.h"

namespace pstripack {

/// Result codes of capi/pstripack_mpi.h.
constexpr std::int32_t kTooFew = -1, kCollinear = -2, kEmpty = -3, kTooMany = -4, kBadCoordinate = -5,
                       kRanksDisagree = -7, kNoSuchRank = -8, kCoincident = -9, kBadNumber = -10;

/// A rank brings fewer points.
constexpr std::size_t kMostPoints = std::size_t{1} << 29;

/// What is known of the global numbers, the same on every rank but for `look`.
struct Numbering {
  std::int32_t code = 0;         ///< 0, or why there is no mesh
  std::int64_t error_point = 0;  ///< which it is about
  std::int64_t total = 0;
  std::int64_t low = 0, high = 0;  ///< smallest and largest
  PartitionKind partition = PartitionKind::bisection;
  bool is_reported = false;  ///< rank 0 wants a report
  Look look;                 ///< at this rank's points

  bool is_dense() const { return low == 1 && high == total; }  ///< they are 1..total
  bool fits_32_bits() const { return high <= INT32_MAX; }
};

/// Counts, and the codes that a look at each point and each number tells. points.count == kMostPoints: too
/// many. `wants_report`: rank 0's counts. Collective. Throws AgreedFailure.
Numbering look_at_all(const LocalNodes& points, bool wants_report, MpiCommunicator& ranks);

/// Finds three points that are not on one great circle.
class CornerSearch {
 public:
  /// Not collective. Throws std::bad_alloc.
  explicit CornerSearch(int ranks);

  /// The same on every rank; none if all points are on one great circle. Collective. Throws AgreedFailure.
  std::optional<std::array<Record, 3>> run(const LocalNodes& points, MpiCommunicator& ranks);

 private:
  // Room for three points of each rank, in the order of the ranks; number 0: none.
  std::vector<Record> sample_;
  std::vector<std::size_t> begin_;  ///< bytes
};

}  // namespace pstripack
