#pragma once

#include <algorithm>
#include <cstddef>

namespace pstripack {

/// Nodes: below, a cold call takes less time than a warm start would be worth.
constexpr std::size_t kFewestForWarmStart = 1000;

/// How many calls must find that the stars of the call before fit before those of one are kept as a whole:
/// one, and twice as many each time that such stars turned out not to fit in the end.
class Patience {
 public:
  /// One call more has found that they fit. True: so have enough.
  bool is_enough() { return ++found_ >= needed_; }
  void succeed() { *this = {}; }
  void fail() {
    constexpr int kMost = 64;
    needed_ = std::min(2 * needed_, kMost);
    found_ = 0;
  }
  /// The more patient one, of which no call has found anything yet.
  friend Patience longest(const Patience& a, const Patience& b) {
    Patience longest;
    longest.needed_ = std::max(a.needed_, b.needed_);
    return longest;
  }

 private:
  int needed_ = 1, found_ = 0;
};

}  // namespace pstripack
