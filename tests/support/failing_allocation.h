#pragma once
// Makes memory run out on request, for all code linked statically into the program: new, malloc,
// aligned_alloc, mmap and posix_fallocate (the memory that processes share).

#include <cstddef>

/// During its lifetime allocation number `which` (from 1) fails, on any thread; if `for_good`, all later ones
/// fail as well. 0: none fails.
class FailingAllocation {
 public:
  explicit FailingAllocation(long which, bool for_good = false);
  ~FailingAllocation();
  FailingAllocation(const FailingAllocation&) = delete;
  FailingAllocation& operator=(const FailingAllocation&) = delete;
  /// True if it failed.
  static bool happened();
  /// Number of heap blocks that were allocated during the lifetime of any such object and have not been
  /// freed.
  static std::size_t blocks();
};
