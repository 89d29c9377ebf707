#pragma once
// The exact checks of our results, independent of the original.

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "mesh/triangulation.h"
#include "mesh/validate.h"
#include "our_calls.h"

namespace comparison {

/// A mesh read from the lists that a TRMESH returned with `ier`. In the original's order
/// either diagonal of four cocircular nodes is right.
struct Checked {
  std::size_t nodes = 0;  ///< nodes in the lists: n, or M-1 if node M is a duplicate; 0: there are no lists
  pstripack::Verdict verdict;      ///< of these nodes: is it the exact mesh?
  bool is_mesh = true;             ///< false: the lists are no triangulation at all
  pstripack::Triangles triangles;  ///< canonical; empty if the lists are broken
};
Checked check(const std::vector<pstripack::Point>& points, int ier, const std::vector<std::int32_t>& list,
              const std::vector<std::int32_t>& lptr, const std::vector<std::int32_t>& lend, std::int32_t lnew,
              const Setting& how = {});

/// The number of nodes in lists returned with a code L > 0: M-1, where M > L is the first node that coincides
/// with node L. 0 if there is no such node.
std::size_t nodes_before_duplicate(const std::vector<pstripack::Point>& points, int ier);

/// The promises of docs/differences.md and docs/api/ier.md that our result breaks, one line each; empty if
/// none.
std::vector<std::string> broken_promises(const std::vector<pstripack::Point>& points, const OurRun& run,
                                         const Checked& checked);

}  // namespace comparison
