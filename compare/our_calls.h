#pragma once
// Calls the drop-in libraries as a Fortran program does: by their symbol trmesh_, in a process of their own,
// on threads, or on MPI ranks by pstripack-run.

#include <cstdint>
#include <string>
#include <vector>

#include "geometry/point.h"

namespace comparison {

/// The output of a call; slots that it did not write hold kUntouched.
struct Lists {
  std::vector<std::int32_t> list, lptr, lend;
  std::int32_t lnew = 0;
};
constexpr std::int32_t kUntouched = -987654321;

/// How TRMESH is called. No setting but the order may change a byte of the result.
struct Setting {
  std::string abi = "r8";  ///< ABI of the library: r8, r4, 8arg, i8
  int threads = 1;         ///< threads of each rank
  int ranks = 1;
  std::string partition = "bisection";
  std::string order = "canonical";  ///< PSTRIPACK_ORDER; "delaunay": a recorded call of pstripack_delaunay

  bool is_bitwise() const { return order == "bitwise" || order == "bitwise-ngmath"; }
  bool is_canonical() const { return order == "canonical" || order == "delaunay"; }
};

/// "r8, 2 threads, 4 ranks, stripes"
std::string describe(const Setting& setting);

struct OurRun : Setting {
  std::string failure;  ///< why the call did not return; the other members are then empty
  int ier = 0;
  double seconds = 0;  ///< median of the repeats
  Lists lists;
};

/// Calls TRMESH `repeats` times, fewer if the calls have taken 10 s; at least 3 nodes. Only stripack-compare
/// can call this: it starts itself again. Throws std::runtime_error if there is no MPI or no library.
OurRun run_ours(const std::vector<pstripack::Point>& points, const Setting& setting, int repeats,
                double time_limit = 600);

/// True if IER, LIST, LPTR, LEND and LNEW are equal.
bool same_bytes(const OurRun& a, const OurRun& b);

/// Runs `stripack-compare call-trmesh FILE` in the started process. Returns the exit code.
constexpr const char* kCallCommand = "call-trmesh";
int call_trmesh(const char* file);

}  // namespace comparison
