#pragma once
// The packets (channel.h) between a model, rank 0 of its pool and pstripack-run.

#include <cstdint>

#include "parallel/cost.h"

namespace pstripack {

/// What the model asks, with the area's descriptor if the area is a new one.
struct PoolRequest {
  static constexpr std::uint32_t kFormat = 0x50533033;  ///< changes with the messages or the layout
  std::uint32_t format = kFormat;
  std::int32_t real_bytes = 0;  ///< 4 or 8
  std::int32_t n = 0;
  std::int32_t wants_cost = 0;
};

/// The answer; done == 0: not carried out, do it yourself.
struct PoolReply {
  std::int32_t done = 0, ier = 0, lnew = 0;
  std::int64_t node = 0, other = 0;
  std::int32_t ranks = 1;
  GroupCost cost;  ///< if it was asked for
};

/// What rank 0 tells pstripack-run about the model: that it has begun, that it has ended.
struct ModelNews {
  std::int32_t process = 0, has_ended = 0;
  std::int32_t status = 0;  ///< as wait() tells it
};

}  // namespace pstripack
