#include "base/workspace.h"

#include <sys/mman.h>

#include <atomic>
#include <cstdio>
#include <mutex>

#include "base/cached.h"
#include "base/environment.h"
#include "base/system.h"

namespace pstripack {
namespace {

constexpr std::size_t kSmallest = std::size_t{64} << 10;  // malloc itself reuses smaller blocks

/// Upper bound, in bytes, of all cached blocks together. PSTRIPACK_KEEP sets it. Without: half of the memory,
/// because clearing fresh pages takes longer than filling them, and the system can take cached pages back.
std::size_t most_cached() {
  return read_once([] {
#ifdef MADV_FREE
    const std::size_t most = memory_limit() / 2;
#else
    const std::size_t most = std::min(std::size_t{1} << 30, memory_limit() / 2);
#endif
    const char* const value = environment_variable("PSTRIPACK_KEEP");
    if (value == nullptr || *value == '\0') return most;
    char* end;
    errno = 0;
    const unsigned long long bytes = strtoull(value, &end, 10);
    if (*value >= '0' && *value <= '9' && *end == '\0' && errno == 0) return static_cast<std::size_t>(bytes);
    std::fprintf(stderr, "pstripack: PSTRIPACK_KEEP=%s: not a number of bytes; %zu is used\n", value, most);
    return most;
  });
}

constexpr std::size_t kCount = 16;  // number of cached blocks; a call on threads uses five
/// The blocks between two calls, the newest first. Never destroyed: destructors of static objects and other
/// threads may call while the program ends.
union NeverDestroyed {
  constexpr NeverDestroyed() : block() {}
  ~NeverDestroyed() {}
  Buffer<unsigned char> block[kCount];
} cache;
Buffer<unsigned char> (&cached)[kCount] = cache.block;
/// Bytes of CacheReservations. They count towards most_cached(). The system cannot take their pages
/// back, so at most a quarter of most_cached() is allowed.
std::atomic<std::size_t> reserved{0};
std::mutex mutex;  // only try_lock: in a forked child it may stay locked for ever

/// Rounds up by at most a sixteenth, so that calls of similar size share blocks.
std::size_t rounded_up(std::size_t bytes) {
  std::size_t step = 1;
  while (step < bytes / 32) step *= 2;
  return (bytes + step - 1) / step * step;
}

}  // namespace

CacheReservation::CacheReservation(std::size_t bytes) : bytes_(bytes) {
  if (reserved.fetch_add(bytes) + bytes <= most_cached() / 4) return;
  reserved -= bytes;
  throw std::bad_alloc();
}

CacheReservation::~CacheReservation() { reserved -= bytes_; }

bool free_idle_blocks() noexcept {
  bool any = false;
  if (const std::unique_lock lock(mutex, std::try_to_lock); lock)
    for (auto& block : cached) {
      any = any || block.size() > 0;
      block = {};
    }
  return any;
}

bool free_cached_blocks() noexcept {
  const bool any = free_cached_things();
  return free_idle_blocks() || any;
}

Block::Block(std::size_t bytes, std::size_t freed) {
  if (bytes >= kSmallest) bytes = rounded_up(bytes);
  if (bytes >= kSmallest && bytes <= most_cached()) {
    if (const std::unique_lock lock(mutex, std::try_to_lock); lock) {
      // Take the smallest that fits: a larger one may be needed next.
      Buffer<unsigned char>* best = nullptr;
      for (auto& block : cached)
        if (block.size() >= bytes && block.size() - bytes <= bytes / 16 &&
            (best == nullptr || block.size() < best->size()))
          best = &block;
      if (best != nullptr) {
        memory_ = std::exchange(*best, {});
        is_reused_ = true;
        return;
      }
    }
  }
  // The system promises more memory than there is, and kills the process where a page is missing later.
  constexpr std::size_t kWorthAsking = std::size_t{1} << 30;
  const auto fits = [&] { return bytes < kWorthAsking + freed || bytes - freed <= available_memory(); };
  if (!fits() && (!free_cached_blocks() || !fits())) throw std::bad_alloc();
  try {
    memory_ = Buffer<unsigned char>(bytes);
  } catch (const std::bad_alloc&) {
    if (!free_cached_blocks()) throw;
    memory_ = Buffer<unsigned char>(bytes);
  }
}

void give_back_pages(void* begin, void* end) noexcept {
  const auto bytes = static_cast<unsigned char*>(end) - static_cast<unsigned char*>(begin);
  advise_on_huge_pages(begin, static_cast<std::size_t>(bytes), MADV_DONTNEED);
}

Block::~Block() {
  if (memory_.size() < kSmallest || memory_.size() > most_cached()) return;
#ifdef MADV_FREE
  // Where a hypervisor keeps page tables of its own, the next call pays 1 us a page for this.
  constexpr std::size_t kWorthASystemCall = std::size_t{32} << 20;
  if (memory_.size() >= kWorthASystemCall)
    madvise(memory_.data(), memory_.size(), MADV_FREE);  // if refused, the pages stay with the process
#endif
  const std::unique_lock lock(mutex, std::try_to_lock);
  if (!lock) return;
  // Drop the oldest blocks if there are too many or their sum is too large.
  std::size_t last = 0, total = memory_.size() + reserved;
  while (last + 1 < kCount && cached[last].size() > 0) ++last;
  for (; last > 0; --last) cached[last] = std::move(cached[last - 1]);
  cached[0] = std::move(memory_);
  for (std::size_t k = 1; k < kCount; ++k)
    if ((total += cached[k].size()) > most_cached()) cached[k] = {};
}

}  // namespace pstripack
