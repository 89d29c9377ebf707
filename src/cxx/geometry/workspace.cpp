#include "geometry/workspace.h"

#include <mutex>

namespace pstripack {
namespace {

constexpr std::size_t kSmallest = std::size_t{4} << 20;  // below, the allocator keeps blocks itself
constexpr std::size_t kLargest = std::size_t{1} << 30;

Buffer<unsigned char> kept;  // the one block between two calls
std::mutex mutex;            // never waited for: another thread may hold it, or held it when we were forked

}  // namespace

Buffer<unsigned char> borrow_block(std::size_t bytes) {
  if (bytes >= kSmallest && bytes <= kLargest) {
    Buffer<unsigned char> block;
    if (const std::unique_lock lock(mutex, std::try_to_lock); lock) block.swap(kept);
    if (block.size() >= bytes && block.size() - bytes <= bytes / 16) return block;
  }  // here a block of another size is freed, before a new one is asked for
  return Buffer<unsigned char>(bytes);
}

void give_back_block(Buffer<unsigned char> block) noexcept {
  if (block.size() < kSmallest || block.size() > kLargest) return;
#ifdef MADV_FREE
  madvise(block.data(), block.size(), MADV_FREE);  // refused: the pages stay ours
#endif
  if (const std::unique_lock lock(mutex, std::try_to_lock); lock) block.swap(kept);
}

}  // namespace pstripack
