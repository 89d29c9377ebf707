#pragma once
// PSTRIPACK_REPORT: one line a call, and a table at exit, on stderr (1) or at the end of a file (PATH). This
// process's own; never on stdout. Safe from any thread, in forked children, and after MPI_Finalize.

#include <cstdint>
#include <optional>

#include "parallel/cost.h"
#include "trmesh/exact_difference.h"
#include "trmesh/trmesh.h"

namespace pstripack {

struct CallReport {
  enum Mode { on_threads, by_pool, by_comm, distributed, distributed_gather, modes };
  Mode mode = on_threads;
  int ranks = 1;
  std::int64_t n = 0;
  std::int64_t nodes_in_mesh = 0;  ///< fewer than n after IER > 0; 0: there is no mesh
  std::int64_t boundary_nodes = 0;
  std::int32_t ier = 0;
  OriginalOrder order = OriginalOrder::not_asked;
  std::int64_t order_node = 0;
  std::optional<ExactDifference> difference;  ///< of an inexact mesh; none: no memory to find it
  double seconds = 0;                         ///< of the whole call
  GroupCost cost;
};

/// Is a report asked for?
bool report_is_wanted();

/// Writes the line and adds the call to the table. Changes nothing that the program can see, not even errno.
void add_to_report(const CallReport& call);

}  // namespace pstripack
