#pragma once
// Differential tests make the same calls of our routines and of the original's on many sets of nodes. The
// original may hang or crash, so the calls run in child processes.

#include <functional>
#include <string>
#include <vector>

#include "library.h"
#include "support/cases.h"

namespace differential {

struct NodeSet {
  std::string name;
  std::vector<double> x, y, z;
  int n() const { return static_cast<int>(x.size()); }
};

/// 10 times `each` sets of 3 to 500 nodes, the same in every run: random on the sphere, in a hemisphere or in
/// a small cap, directions of small lattices, global and regional grids, rings with a pole, sets with exact
/// copies.
const std::vector<NodeSet>& node_sets(int each = cases(240));

/// The arrays of a triangulation, with room for `most` nodes, initially filled with a mark.
struct Lists {
  explicit Lists(int most);
  std::vector<int> list, lptr, lend;
  int lnew;
  static constexpr int mark = -7777;
  bool operator==(const Lists& other) const {
    return list == other.list && lptr == other.lptr && lend == other.lend && lnew == other.lnew;
  }
};

/// A second copy of the original in this process, with random seeds of its own. Its CRLIST has the 17
/// arguments of STRIPACK.
const legacy_stripack::Library& second_original();

/// Calls TRMESH of the second copy, so that the seeds of the first copy are as fresh as ours. Sets `ier`.
Lists triangulated_by_original(const NodeSet& nodes, int& ier);

/// Result of a comparison over many sets.
struct Result {
  int compared = 0;                       ///< sets on which both sides returned
  std::vector<std::string> not_returned;  ///< names of sets on which a call hung or crashed
  std::vector<std::string> differences;   ///< the first 20, as "set: what differs"
  int different = 0;
};

/// Calls compare(set) for each set in a child process, which is killed after `limit` seconds of processor
/// time; a set takes milliseconds. compare makes the calls and returns what differs, or "". A child compares
/// 50 sets, with the random seeds that the last set has left; if it does not return, each set has a child of
/// its own.
Result compare_all(const std::vector<NodeSet>& sets,
                   const std::function<std::string(const NodeSet&)>& compare, double limit = 0.5);

/// Expects no difference, and at most `most_lost` sets on which a call hung or crashed.
void expect_equal(const Result& result, int most_lost = 0);

/// True if the bits are equal, or if both are NaN.
bool same_bits(double a, double b);
/// The number of doubles between a and b; large for NaN.
double ulps(double a, double b);

}  // namespace differential
