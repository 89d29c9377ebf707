#pragma once
// What a TRMESH made of a set of nodes, in one phrase that two runs can be compared by.

#include <string>

#include "support/lists.h"

/// "-2", "0: 20 triangles, 0 boundary nodes, 3 inverted, 1 arc not Delaunay", ...: the code and, where it is
/// 0, the counts that exact signs give. Ties are not judged: either diagonal is Delaunay.
std::string behaviour(const Nodes& nodes, int ier, const Lists& lists);

/// Of a call of pstripack_trmesh.
std::string our_behaviour(const Nodes& nodes);

/// Of a call of the original in a process of its own; or "does not return", "crashes". There must be one.
std::string original_behaviour(const Nodes& nodes, double time_limit);
