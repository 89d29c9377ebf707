#pragma once

#include <vector>

#include "median.h"
#include "parallel/cost.h"

/// The costs of this rank and of its group: the last call's, but for the processor time of each phase, which
/// is the rank's median over the calls, since other ranks on the same processor disturb single calls.
/// Collective.
inline pstripack::GroupCost usual_cost(pstripack::Communicator& ranks,
                                       const std::vector<pstripack::ParallelCost>& calls) {
  pstripack::ParallelCost usual = calls.back();
  for (int phase = 0; phase < pstripack::ParallelCost::phases; ++phase) {
    std::vector<double> spent;
    for (const pstripack::ParallelCost& call : calls) spent.push_back(call.cpu_seconds[phase]);
    usual.cpu_seconds[phase] = median(spent);
  }
  return pstripack::group_cost(ranks, usual);
}
