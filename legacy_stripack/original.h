#pragma once
// Runs the original STRIPACK and always returns: every call runs in a child process with a time limit.

#include <optional>
#include <string>
#include <vector>

#include "child_process.h"
#include "library.h"

namespace legacy_stripack {

/// The original that the build found; empty if it found none.
struct Location {
  std::string name;  ///< name for messages
  std::string file;
  Abi abi;
};
std::optional<Location> configured_original();

/// Result of one call of TRMESH. The other members are valid only if it returned.
struct Triangulation {
  Outcome outcome = Outcome::returned;
  int signal = 0;
  int ier = 0;
  int lnew = 0;                       ///< 0: unknown (8-argument ABI, coincident nodes)
  std::vector<int> list, lptr, lend;  ///< 6n-12, 6n-12, n entries; 0 if not written
  double seconds = 0;                 ///< median of the calls, around TRMESH alone
};

class Original {
 public:
  Original(const std::string& file, Abi abi) : library_(file, abi) {}
  explicit Original(const Location& where) : Original(where.file, where.abi) {}

  /// Calls TRMESH `calls` times, fewer if the calls have taken 10 s; returns the lists of the first call.
  /// Nodes are any type with members x, y, z. The time limit (seconds) is for all calls together. A later
  /// call that hangs does not change the result of the first.
  template <class Node>
  Triangulation triangulate(const std::vector<Node>& nodes, double time_limit, int calls = 1) const {
    std::vector<double> x, y, z;
    for (const Node& p : nodes) {
      x.push_back(p.x);
      y.push_back(p.y);
      z.push_back(p.z);
    }
    return triangulate(x, y, z, time_limit, calls);
  }
  Triangulation triangulate(const std::vector<double>& x, const std::vector<double>& y,
                            const std::vector<double>& z, double time_limit, int calls = 1) const;

  /// The distance from 1 to the next larger number in the original's arithmetic.
  double epsilon() const { return library_.abi().real_bytes == 4 ? 0x1p-23 : 0x1p-52; }

  /// The routines themselves, for use inside run_in_child.
  const Library& library() const { return library_; }

 private:
  Library library_;
};

/// "returned", "did not return within 10 s", "crashed (signal 11, Segmentation fault)", "stopped the
/// program".
std::string describe(const Triangulation& result, double time_limit);

}  // namespace legacy_stripack
