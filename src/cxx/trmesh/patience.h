#pragma once

#include <algorithm>
#include <cstddef>

namespace pstripack {

/// With fewer nodes a cold call is so fast that a warm start does not pay.
constexpr std::size_t kFewestForWarmStart = 1000;

/// Decides when to cache a whole mesh for a warm start: after a number of calls in which the sample of stars
/// of the call before fitted. The number is 1 at first; each warm start that fails doubles it, up to 64.
class Patience {
 public:
  /// Counts one more call in which the sample fitted. True if that is enough.
  bool is_enough() { return ++found_ >= needed_; }
  /// A warm start has succeeded: the number is 1 again.
  void succeed() { *this = {}; }
  /// A warm start has failed: the number doubles.
  void fail() {
    constexpr int kMost = 64;
    needed_ = std::min(2 * needed_, kMost);
    found_ = 0;
  }
  /// The larger number of calls of the two, with none of them counted yet.
  friend Patience longest(const Patience& a, const Patience& b) {
    Patience longest;
    longest.needed_ = std::max(a.needed_, b.needed_);
    return longest;
  }

 private:
  int needed_ = 1, found_ = 0;
};

}  // namespace pstripack
