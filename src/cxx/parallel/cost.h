#pragma once
// What a triangulation costs, for reports.

#include <time.h>

#include <cstdint>

#include "base/parallel_for.h"
#include "parallel/communicator.h"

namespace pstripack {

inline double clock_seconds(clockid_t clock) {
  timespec t;
  clock_gettime(clock, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

/// What a triangulation cost on this rank. Seconds of the clock, and of this rank's processors.
struct ParallelCost {
  enum Phase { divide, triangulate, merge, lists, gather, phases };
  double seconds[phases] = {}, cpu_seconds[phases] = {};
  int threads = 1;
  ThreadLimit limit = ThreadLimit::size;  ///< why no more threads
  int rounds = 0;         ///< how often lists of patches did not match; of a warm call, exchanges of flips
  int in_one_patch = 0;   ///< 1: at last one rank had to triangulate all
  std::int64_t halo = 0;  ///< nodes in the margins of this rank's patches; of a warm call, outside
  std::int64_t bytes_sent = 0;
  std::int64_t flips = -1;  ///< of a call that began with an earlier mesh; -1: it did not

  void set_threads(ThreadCount count) { threads = count.threads, limit = count.limit; }
};

/// The costs of this rank and of its group: the largest of each, and their sums.
struct GroupCost {
  GroupCost() = default;
  explicit GroupCost(const ParallelCost& of_single) : mine(of_single), maximum(of_single), total(of_single) {}
  void add(const ParallelCost& rank);

  int ranks = 1;  ///< that were added up
  ParallelCost mine, maximum, total;
};

/// Collective. The cost of this rank alone if there is no memory for that of all.
GroupCost group_cost(Communicator& ranks, const ParallelCost& mine);

/// Adds the time of its life to one phase: clock time, and processor time less what the rank spent waiting.
/// Does nothing if `cost` is null.
class PhaseTimer {
 public:
  PhaseTimer(ParallelCost* cost, ParallelCost::Phase phase, const Communicator* ranks = nullptr)
      : cost_(cost), phase_(phase), ranks_(ranks) {
    add(-1);
  }
  ~PhaseTimer() { add(1); }
  PhaseTimer(const PhaseTimer&) = delete;
  PhaseTimer& operator=(const PhaseTimer&) = delete;

 private:
  void add(int sign) {
    if (cost_ == nullptr) return;
    cost_->seconds[phase_] += sign * clock_seconds(CLOCK_MONOTONIC);
    const double idle = ranks_ != nullptr ? ranks_->idle_cpu_seconds : 0;
    cost_->cpu_seconds[phase_] += sign * (clock_seconds(CLOCK_PROCESS_CPUTIME_ID) - idle);
  }
  ParallelCost* const cost_;
  const ParallelCost::Phase phase_;
  const Communicator* const ranks_;
};

}  // namespace pstripack
