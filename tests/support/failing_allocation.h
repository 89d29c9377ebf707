#pragma once
// Memory that runs out when a test wants it to, for all code that is linked statically into the program:
// new, malloc, aligned_alloc, mmap and posix_fallocate (the memory that processes share).

#include <cstddef>

/// While it lives, the allocation number `which` (from 1) fails, on whatever thread, and all later ones if
/// `for_good`; 0: none does.
class FailingAllocation {
 public:
  explicit FailingAllocation(long which, bool for_good = false);
  ~FailingAllocation();
  FailingAllocation(const FailingAllocation&) = delete;
  FailingAllocation& operator=(const FailingAllocation&) = delete;
  /// True if it did.
  static bool happened();
  /// Blocks of the heap that were taken while one lived, the last one or those before, and are not given
  /// back.
  static std::size_t blocks();
};
