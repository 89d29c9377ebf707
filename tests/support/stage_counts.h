#pragma once
// Counts of the predicates' stages during a triangulation.

#include <cstdint>
#include <vector>

#include "geometry/predicates.h"
#include "mesh/delaunay.h"

struct StageCounts {
  std::uint64_t asked;  ///< calls of `above` that the kernel's floating point left open
  /// How often each stage was entered, also for `left` and for comparing directions.
  std::uint64_t double_double, integers, big_integers, tie_rule;
};

inline StageCounts stages_of(const pstripack::PredicateCounts& c) {
  return {c.above, c.double_double, c.integers, c.big_integers, c.symbolic};
}

/// The counts for a triangulation of the nodes by the kernel, in this thread.
inline StageCounts stage_counts(const std::vector<pstripack::Point>& nodes) {
  pstripack::Workspace workspace(pstripack::workspace_bytes(nodes.size()));
  pstripack::take_predicate_counts();
  pstripack::delaunay(nodes.data(), nodes.size(), workspace);
  return stages_of(pstripack::take_predicate_counts());
}
