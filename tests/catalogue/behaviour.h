#pragma once
// The result of a TRMESH for a set of nodes, as one phrase for comparing two runs.

#include <string>

#include "support/lists.h"

/// "-2", "0: 20 triangles, 0 boundary nodes, 3 inverted, 1 arc not Delaunay", ...: the code and, if it is 0,
/// counts by exact signs. Ties are not judged: each diagonal is Delaunay.
std::string behaviour(const Nodes& nodes, int ier, const Lists& lists);

/// Of a call of pstripack_trmesh.
std::string our_behaviour(const Nodes& nodes);

/// Of a call of the original in its own process; or "does not return", "crashes". There must be an original.
std::string original_behaviour(const Nodes& nodes, double time_limit);
