#pragma once
// Checks of the points that each rank brings to a distributed mesh, and of their global numbers.

#include <cstddef>
#include <cstdint>
#include <optional>

#include "capi/pstripack.h"
#include "mpi/mpi_communicator.h"
#include "parallel/divide.h"
#include "parallel/local_nodes.h"
#include "parallel/node_ranges.h"
#include "parallel/partition.h"

namespace pstripack {

/// A rank must bring fewer points than this.
constexpr std::size_t kMostPoints = std::size_t{1} << 29;

/// 0 if a rank may bring n points, else a result code.
constexpr std::int32_t code_of_rank_count(std::int64_t n) {
  return n < 0                                        ? PSTRIPACK_BAD_SIZE
         : n < static_cast<std::int64_t>(kMostPoints) ? PSTRIPACK_OK
                                                      : PSTRIPACK_TOO_MANY_NODES;
}

/// A wrong argument, and the first rank that has passed it; the same on every rank.
struct WrongArgument {
  int rank = -1;  ///< -1: none is wrong
  std::int64_t value = 0;
};

/// The first rank that passes another value than rank 0, and its value; rank -1 if there is none. Collective.
WrongArgument first_different(std::int64_t value, Communicator& ranks);

/// Properties of all points and their global numbers; the same on every rank, except `check`.
struct Numbering {
  std::int32_t code = 0;         ///< 0; else a result code: there is no mesh
  std::int64_t error_point = 0;  ///< number of the point that the code is about; 0 if none
  WrongArgument wrong_count;
  std::int64_t total = 0;
  NodeRanges ranges;
  std::int64_t low = 0, high = 0;  ///< smallest and largest number
  PartitionKind partition = PartitionKind::bisection;
  bool is_reported = false;  ///< rank 0 wants a report
  NodeCheck check;           ///< of this rank's points

  bool is_dense() const { return low == 1 && high == total; }  ///< the numbers are 1..total
};

/// Counts the points and checks every point and every number. points.count may be wrong (code_of_rank_count).
/// wants_report: used on rank 0 only. numbers_are_known: this rank's numbers are those of the last call,
/// which has found that all are different. Collective. Throws AgreedFailure.
Numbering check_all(const LocalNodes& points, bool wants_report, bool numbers_are_known,
                    MpiCommunicator& ranks);

/// Three points that are not on one great circle, the same on every rank; none if all are. Collective.
/// Throws AgreedFailure.
std::optional<Corners> find_corners(const LocalNodes& points, Communicator& ranks);

}  // namespace pstripack
