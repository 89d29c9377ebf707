#include "failing_allocation.h"

#include <errno.h>
#include <sys/mman.h>
#include <sys/types.h>

#include <algorithm>
#include <atomic>
#include <cstdlib>
#include <mutex>
#include <new>

namespace {

std::atomic<bool> armed{false}, every_later_one{false}, failed{false};
std::atomic<long> left{0};  // allocations until the one that fails

bool fails_now() {
  if (!armed || left == 0) return false;
  if (failed) return every_later_one;
  return --left == 0 && !failed.exchange(true);
}

/// The blocks in use. Its own memory does not come from the wrapped functions.
class Blocks {
 public:
  void add(void* block) {
    if (block == nullptr || !armed) return;
    const std::lock_guard lock(mutex_);
    if (count_ == kMost) std::abort();
    block_[count_++] = block;
  }
  void remove(void* block) {
    if (block == nullptr || count_ == 0) return;
    const std::lock_guard lock(mutex_);
    void** const end = block_ + count_;
    void** const found = std::find(block_, end, block);
    if (found == end) return;
    *found = end[-1];
    --count_;
  }
  std::size_t count() const { return count_; }

 private:
  static constexpr std::size_t kMost = 1 << 14;
  std::mutex mutex_;
  std::atomic<std::size_t> count_{0};
  void* block_[kMost];
} in_use;

}  // namespace

FailingAllocation::FailingAllocation(long which, bool for_good) {
  left = which;
  every_later_one = for_good;
  failed = false;
  armed = true;
}
FailingAllocation::~FailingAllocation() { armed = false; }
bool FailingAllocation::happened() { return failed; }
std::size_t FailingAllocation::blocks() { return in_use.count(); }

extern "C" {
void* __real_malloc(std::size_t);
void* __real_aligned_alloc(std::size_t, std::size_t);
void __real_free(void*);
void* __real_mmap(void*, std::size_t, int, int, int, off_t);
int __real_posix_fallocate(int, off_t, off_t);

void* __wrap_malloc(std::size_t size) {
  void* const block = fails_now() ? nullptr : __real_malloc(size);
  in_use.add(block);
  return block;
}
void* __wrap_aligned_alloc(std::size_t alignment, std::size_t size) {
  void* const block = fails_now() ? nullptr : __real_aligned_alloc(alignment, size);
  in_use.add(block);
  return block;
}
void __wrap_free(void* block) {
  in_use.remove(block);
  __real_free(block);
}
void* __wrap_mmap(void* place, std::size_t size, int protection, int flags, int file, off_t offset) {
  if (!fails_now()) return __real_mmap(place, size, protection, flags, file, offset);
  errno = ENOMEM;
  return MAP_FAILED;
}
int __wrap_posix_fallocate(int file, off_t offset, off_t size) {
  return fails_now() ? ENOSPC : __real_posix_fallocate(file, offset, size);
}
}

void* operator new(std::size_t size) {
  void* const block = __wrap_malloc(size > 0 ? size : 1);
  if (block == nullptr) throw std::bad_alloc();
  return block;
}
void operator delete(void* block) noexcept { __wrap_free(block); }
void operator delete(void* block, std::size_t) noexcept { __wrap_free(block); }
