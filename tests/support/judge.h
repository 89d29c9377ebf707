#pragma once
// An independent judge of triangulations, on tests/support/exact.h alone.

#include <string>

#include "exact.h"
#include "lists.h"

/// Empty if `rings` is the Delaunay triangulation of the nodes; else what is wrong first. Looks at
/// symmetry of the arcs, the exact sign of every triangle, the exact local Delaunay test of every arc with
/// the tie rule, how often each star winds, convexity at the boundary, Euler number and connectedness.
std::string fault(const Nodes& nodes, const Rings& rings, exact::On on);

/// The same on coordinates where all lengths are within 1e-6 of 1, otherwise or failing that on directions.
std::string fault(const Nodes& nodes, const Rings& rings);

/// All triples with a positive determinant that no other node lies above: O(n^4), no algorithm to be wrong.
Faces brute_force(const Nodes& nodes, exact::On on);

/// What trmesh must return: -1, -2, L > 0 for coinciding directions, 0.
int expected_ier(const Nodes& nodes);

/// What lengths call for (a hidden node may still call for directions).
exact::On lengths_call_for(const Nodes& nodes);
