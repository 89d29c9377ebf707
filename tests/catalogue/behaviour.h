#pragma once
// The result of a TRMESH for a set of nodes, as one phrase for comparing two runs.

#include <string>

#include "support/lists.h"

/// "-2", "0: 20 triangles, 0 boundary nodes, 3 inverted, 1 arc not Delaunay", ...: the code and, if it is 0,
/// counts by exact signs. In a tie both diagonals count as Delaunay.
std::string behaviour(const Nodes& nodes, int ier, const Lists& lists);

/// The behaviour of pstripack_trmesh.
std::string our_behaviour(const Nodes& nodes);

/// The behaviour of the original, called in its own process; or "does not return", "crashes". Needs an
/// original.
std::string original_behaviour(const Nodes& nodes, double time_limit);
