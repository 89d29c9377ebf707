#pragma once
// PSTRIPACK_CHECK: writes every call of TRMESH with its result, as blocks (recorded_block.h), to the end of
// a file (PATH) or to a process that runs the original beside the model (lib:LIBRARY). May be used from any
// thread and in forked children. Does not change the model's results, its stdout or errno.

#include <cstdint>

#include "trmesh/trmesh.h"

namespace pstripack {

/// What the input block and the output block of a call have in common.
struct CheckedCall {
  std::uint32_t routine, real_bytes;
  std::int64_t number, n;
  double start;  ///< seconds, after the input was written
};

/// Null if the environment does not ask for it, or if another rank writes the calls.
class Check;
Check* check_of_calls() noexcept;

/// Writes the input block. To be called before the computation, so that a call that crashes or hangs is
/// recorded.
CheckedCall check_input(Check& check, const TrmeshCall& call) noexcept;
void check_output(Check& check, const CheckedCall& call, const TrmeshResult& result,
                  const ListArrays& lists) noexcept;

/// In comm mode rank 0 writes the calls, which are the same on all ranks. true on the other ranks when comm
/// mode begins, false when it ends.
void leave_check_to_another_rank(bool leave);

}  // namespace pstripack
