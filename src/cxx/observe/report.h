#pragma once
// PSTRIPACK_REPORT: one line per call and a table at exit, for this process, on stderr (1) or at the end of
// a file (PATH), never on stdout. May be used from any thread, in forked children, and after MPI_Finalize.

#include <cstdint>
#include <optional>

#include "trmesh/exact_difference.h"
#include "trmesh/trmesh.h"

namespace pstripack {

struct CallReport : CallWay {
  std::int64_t n = 0;
  std::int64_t nodes_in_mesh = 0;  ///< fewer than n if IER > 0; 0 if there is no mesh
  std::int64_t boundary_nodes = 0;
  std::int32_t ier = 0;
  double shortest = 1, longest = 1;  ///< lengths of the nodes, as far as known
  OriginalOrder order = OriginalOrder::not_asked;
  std::int64_t order_node = 0;
  std::optional<ExactDifference> difference;  ///< of an inexact mesh; none if memory did not suffice
  double seconds = 0;                         ///< of the whole call
};

/// True if PSTRIPACK_REPORT asks for a report.
bool report_is_wanted();

/// Writes the line of the call and adds the call to the table. Does not change errno.
void add_to_report(const CallReport& call);

}  // namespace pstripack
