#pragma once
// The packets (channel.h) between a model and rank 0 of its pool.

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

}  // namespace pstripack
