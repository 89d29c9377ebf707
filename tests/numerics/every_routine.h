#pragma once
// Calls every routine of one of the libraries libstripack*, the one that is linked, on sets of nodes that
// reach all its paths.

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "geometry/point.h"
#include "support/guarded.h"

struct NamedNodes {
  std::string name;
  std::vector<pstripack::Point> nodes;
};

/// Sets that reach every stage of the predicates, both kinds of meshes, all ways to add a node, and threads;
/// also sets that TRMESH refuses.
std::vector<NamedNodes> spread_of_nodes();

/// Calls a routine, given by its name and a function without arguments.
using CallRoutine = std::function<void(const char* routine, const std::function<void()>& call)>;

/// Calls every routine by `call_routine`. Arrays have exactly the documented sizes and lie beside
/// inaccessible pages; input arrays are read-only. Returns a hash of all results, arrays and printed texts.
std::uint64_t fingerprint_of_every_routine(const std::vector<pstripack::Point>& nodes, Edge edge,
                                           const CallRoutine& call_routine);
