#pragma once
// PSTRIPACK_CHECK: every call of TRMESH with its result, as blocks (recorded_block.h), to the end of a file
// (PATH) or to a process that runs the original beside the model (lib:LIBRARY). Safe from any thread and in
// forked children; the model's results, its stdout and errno are as without.

#include <cstdint>

#include "trmesh/trmesh.h"

namespace pstripack {

/// One call: what its two blocks have in common.
struct CheckedCall {
  std::uint32_t real_bytes;
  std::int64_t number, n;
  double start;  ///< seconds, after the input was written
};

/// Null unless the environment asks for it, and where another rank writes the calls.
class Check;
Check* check_of_calls() noexcept;

/// Writes the input block, before anything is computed: a call that crashes or hangs is on record.
CheckedCall check_input(Check& check, const TrmeshCall& call) noexcept;
void check_output(Check& check, const CheckedCall& call, const TrmeshResult& result,
                  const ListArrays& lists) noexcept;

/// In comm mode rank 0 writes the calls, which are the same on all ranks.
void leave_check_to_another_rank(bool leave);

}  // namespace pstripack
