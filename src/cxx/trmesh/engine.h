#pragma once

#include <exception>

#include "parallel/cost.h"
#include "trmesh/call.h"

namespace pstripack {

/// How a call was carried out, for reports.
struct CallWay {
  enum Mode { on_threads, by_pool, by_comm, distributed, distributed_gather, modes };
  Mode mode = on_threads;
  int ranks = 1;
  GroupCost cost;
};

/// Other processes that can carry out a call: a pool, or the ranks of a communicator.
class Engine {
 public:
  /// True if it takes the call. Then the same thread calls carry_out() next.
  virtual bool takes(const TrmeshCall& call) noexcept = 0;
  /// way: null if no report is wanted. Throws PoolIsGone, having written nothing.
  virtual TrmeshResult carry_out(const TrmeshCall& call, CallWay* way) = 0;

 protected:
  ~Engine() = default;
};

/// The pool has ended, or has refused a call.
struct PoolIsGone : std::exception {
  const char* what() const noexcept override { return "the pool is gone"; }
};

}  // namespace pstripack
