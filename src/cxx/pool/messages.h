#pragma once
// The packets (channel.h) between a model, rank 0 of its pool and pstripack-run.

#include <cstdint>

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

/// Sent by rank 0 to pstripack-run when the model has started and when it has ended.
struct ModelNews {
  std::int32_t process = 0, has_ended = 0;
  std::int32_t status = 0;  ///< as returned by wait()
};

}  // namespace pstripack
