#pragma once
// Memory that runs out when a test wants it to, for the code that is linked statically into the program.

/// While it lives, the allocation number `which` of this thread (from 1) fails, and all later ones if
/// `for_good`.
class FailingAllocation {
 public:
  explicit FailingAllocation(long which, bool for_good = false);
  ~FailingAllocation();
  FailingAllocation(const FailingAllocation&) = delete;
  FailingAllocation& operator=(const FailingAllocation&) = delete;
  /// True if it did.
  static bool happened();
};
