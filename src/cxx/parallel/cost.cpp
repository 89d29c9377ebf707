#include "parallel/cost.h"

#include <algorithm>

namespace pstripack {
namespace {

template <class Combine>
void combine_into(ParallelCost& to, const ParallelCost& from, const Combine& combine) {
  for (int i = 0; i < ParallelCost::phases; ++i) {
    combine(to.seconds[i], from.seconds[i]);
    combine(to.cpu_seconds[i], from.cpu_seconds[i]);
  }
  // A new field is to be combined below, too; but for `limit`, which stays.
  static_assert(sizeof(ParallelCost) == (2 * ParallelCost::phases + 3) * sizeof(double) + 4 * sizeof(int));
  combine(to.threads, from.threads);
  combine(to.rounds, from.rounds);
  combine(to.in_one_patch, from.in_one_patch);
  combine(to.halo, from.halo);
  combine(to.bytes_sent, from.bytes_sent);
  combine(to.flips, from.flips);
}

}  // namespace

void GroupCost::add(const ParallelCost& rank) {
  ++ranks;
  combine_into(maximum, rank, [](auto& to, auto from) { to = std::max(to, from); });
  combine_into(total, rank, [](auto& to, auto from) { to += from; });
}

GroupCost group_cost(Communicator& ranks, const ParallelCost& mine) {
  GroupCost group(mine);
  if (ranks.size() == 1) return group;
  try {
    const Parcels all = ranks.all_gather(&mine, sizeof mine);
    for (int r = 0; r < ranks.size(); ++r)
      if (r != ranks.rank()) group.add(Items<ParallelCost>(all).begin()[r]);
    // memory that ends on a rank while a report is gathered: mpi_allocation_test, which needs MPI
  } catch (const AgreedFailure&) {
    group = GroupCost(mine);  // a report is no reason to fail
  }
  return group;
}

}  // namespace pstripack
