#pragma once
// Differential tests: the same calls to our routines and to the original's, on many sets of nodes. The
// original may hang or crash, so the calls run in child processes.

#include <functional>
#include <string>
#include <vector>

#include "library.h"

namespace differential {

struct NodeSet {
  std::string name;
  std::vector<double> x, y, z;
  int n() const { return static_cast<int>(x.size()); }
};

/// 2400 sets of 3 to 500 nodes, the same in every run: random on the sphere, in a half-sphere, in a small
/// cap, directions of small lattices, global and regional grids, rings with a pole, sets with exact copies.
const std::vector<NodeSet>& node_sets();

/// A triangulation in arrays of its own, with room for `most` nodes. Filled with a mark before use.
struct Lists {
  explicit Lists(int most);
  std::vector<int> list, lptr, lend;
  int lnew;
  static constexpr int mark = -7777;
  bool operator==(const Lists& other) const {
    return list == other.list && lptr == other.lptr && lend == other.lend && lnew == other.lnew;
  }
};

/// A second copy of the original in this process, which draws from random seeds of its own. Its CRLIST has
/// the 17 arguments of STRIPACK.
const legacy_stripack::Library& second_original();

/// The TRMESH of the second copy, so that the seeds of the first are as fresh as ours; the IER in `ier`.
Lists triangulated_by_original(const NodeSet& nodes, int& ier);

/// Result of a comparison over many sets.
struct Result {
  int compared = 0;                       ///< sets on which both sides returned
  std::vector<std::string> not_returned;  ///< sets on which a call hung or crashed: names
  std::vector<std::string> differences;   ///< "set: what differs", the first 20
  int different = 0;
};

/// Calls compare(set) for each set, each in a child process, which is killed after `limit` seconds. It makes
/// the calls and returns what differs, "" if nothing does.
Result compare_all(const std::vector<NodeSet>& sets,
                   const std::function<std::string(const NodeSet&)>& compare, double limit = 2);

/// Google Test's checks of a result: no difference, and at most `most_lost` sets on which something hung.
void expect_equal(const Result& result, int most_lost = 0);

/// True if the two are the same bits, or both NaN.
bool same_bits(double a, double b);
/// Spacings between a and b; large for NaN.
double ulps(double a, double b);

}  // namespace differential
