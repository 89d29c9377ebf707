#pragma once
// The packets (channel.h) between a model, rank 0 of its pool and pstripack-run.

#include <signal.h>

#include <cstdint>
#include <type_traits>

#include "parallel/cost.h"

namespace pstripack {

/// The model's request. The area's descriptor is sent with it if the area is new.
struct PoolRequest {
  static constexpr std::uint32_t kFormat = 0x50533033;  ///< changes whenever messages or layout change
  std::uint32_t format = kFormat;
  std::int32_t real_bytes = 0;  ///< 4 or 8
  std::int32_t n = 0;
  std::int32_t wants_cost = 0;
};

/// The reply. If done is 0 the call was not executed, and the model computes it itself.
struct PoolReply {
  std::int32_t done = 0, ier = 0, lnew = 0;
  std::int64_t node = 0, other = 0;
  std::int32_t ranks = 1;
  GroupCost cost;  ///< if requested
};

// Packets are sent as they stand in memory.
static_assert(std::is_trivially_copyable_v<PoolRequest> && std::is_trivially_copyable_v<PoolReply>);

// Between pstripack-run and the keeper (keeper.h).

/// The first packet from pstripack-run, with the model's stdin, stdout, stderr and environment.
struct Greeting {
  std::uint64_t ignored = 0;  ///< bit S-1: the model shall find signal S ignored

  bool ignores(int signal) const { return (ignored >> (signal - 1) & 1) != 0; }
  bool tells_to_end(int signal) const {
    return (signal == SIGTERM || signal == SIGINT || signal == SIGHUP || signal == SIGQUIT) &&
           !ignores(signal);
  }
};

/// A signal for the model and the processes that it has started. SIGKILL: it must end now.
struct SignalForModel {
  std::int32_t number = 0;
};

/// From the keeper.
struct ModelEnd {
  std::int32_t status = 0;  ///< as returned by wait()
};

}  // namespace pstripack
