#pragma once
// An independent judge of triangulations, on tests/support/reference_predicates.h alone.

#include <string>

#include "lists.h"
#include "reference_predicates.h"

/// Empty if `rings` is the Delaunay triangulation of the nodes; else the first defect. Checks the symmetry of
/// the arcs, the exact sign of every triangle, the exact local Delaunay test of every arc with the tie rule,
/// how often each star winds, convexity at the boundary, Euler number and connectedness.
std::string fault(const Nodes& nodes, const Rings& rings, exact::On on);

/// The same on coordinates if all lengths are within 1e-6 of 1; otherwise, or if that fails, on directions.
std::string fault(const Nodes& nodes, const Rings& rings);

/// All triples with a positive determinant and no other node above, by trying all: O(n^4).
Faces brute_force(const Nodes& nodes, exact::On on);

/// The code that trmesh must return: -1, -2, L > 0 for coinciding directions, 0.
int expected_ier(const Nodes& nodes);

/// The predicates that the lengths select (a hidden node may still require directions).
exact::On lengths_call_for(const Nodes& nodes);
