#pragma once
// Calls of the drop-in libraries as a Fortran program makes them: by their symbol trmesh_, in their own
// process, on threads, or on MPI ranks behind pstripack-run.

#include <cstdint>
#include <string>
#include <vector>

#include "geometry/point.h"

namespace comparison {

/// What one call wrote; slots that it did not write hold kUntouched.
struct Lists {
  std::vector<std::int32_t> list, lptr, lend;
  std::int32_t lnew = 0;
};
constexpr std::int32_t kUntouched = -987654321;

/// How TRMESH is called. None of this may change a byte of the result.
struct Setting {
  std::string abi = "r8";  ///< of the library: r8, r4, 8arg, i8
  int threads = 1;         ///< on each rank
  int ranks = 1;
  std::string partition = "bisection";
};

/// "r8, 2 threads, 4 ranks, stripes"
std::string describe(const Setting& setting);

struct OurRun : Setting {
  std::string failure;  ///< why the call did not return; the rest is then empty
  int ier = 0;
  double seconds = 0;  ///< median of the repeats
  Lists lists;
};

/// Calls TRMESH `repeats` times, fewer once they have taken 10 s; at least 3 nodes. The program that calls
/// this must be stripack-compare. Throws std::runtime_error if such a call cannot be made here: no MPI, no
/// library.
OurRun run_ours(const std::vector<pstripack::Point>& points, const Setting& setting, int repeats,
                double time_limit = 600);

/// Equal codes, LIST, LPTR, LEND, LNEW.
bool same_bytes(const OurRun& a, const OurRun& b);

/// The program of that process: `stripack-compare call-trmesh FILE`. Returns its exit code.
constexpr const char* kCallCommand = "call-trmesh";
int call_trmesh(const char* file);

}  // namespace comparison
