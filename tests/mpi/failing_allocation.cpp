#include "failing_allocation.h"

#include <cstddef>
#include <cstdlib>
#include <new>

namespace {

thread_local long left = 0;  // allocations until the one that fails; 0: none will
thread_local bool every_later_one = false, failed = false;

bool fails_now() {
  if (failed && every_later_one) return true;
  if (left == 0 || --left > 0) return false;
  return failed = true;
}

}  // namespace

FailingAllocation::FailingAllocation(long which, bool for_good) {
  left = which;
  every_later_one = for_good;
  failed = false;
}
FailingAllocation::~FailingAllocation() { left = 0, every_later_one = false; }
bool FailingAllocation::happened() { return failed; }

extern "C" {
void* __real_malloc(std::size_t);
void* __real_aligned_alloc(std::size_t, std::size_t);
void* __wrap_malloc(std::size_t size) { return fails_now() ? nullptr : __real_malloc(size); }
void* __wrap_aligned_alloc(std::size_t alignment, std::size_t size) {
  return fails_now() ? nullptr : __real_aligned_alloc(alignment, size);
}
}

void* operator new(std::size_t size) {
  void* const memory = fails_now() ? nullptr : __real_malloc(size > 0 ? size : 1);
  if (memory == nullptr) throw std::bad_alloc();
  return memory;
}
void operator delete(void* memory) noexcept { std::free(memory); }
void operator delete(void* memory, std::size_t) noexcept { std::free(memory); }
