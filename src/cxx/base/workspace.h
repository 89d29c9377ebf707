#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <new>
#include <stdexcept>
#include <type_traits>
#include <utility>

#include "base/buffer.h"

namespace pstripack {

/// A block of memory. It reuses a block that an earlier call of this process has left, if one is large
/// enough and at most a sixteenth too large; otherwise it is new. The destructor caches the block for the
/// next call; the system may take the pages of cached blocks when it needs them. Small and very large blocks
/// are freed.
class Block {
 public:
  Block() = default;
  /// Allocates at least `bytes`. Throws std::bad_alloc if there is no memory even after the cached blocks are
  /// freed. `freed`: so many bytes of others are freed before the whole block is used.
  explicit Block(std::size_t bytes, std::size_t freed = 0);
  Block(Block&& other) noexcept = default;
  Block& operator=(Block&& other) noexcept {
    std::swap(memory_, other.memory_);
    std::swap(is_reused_, other.is_reused_);
    return *this;
  }
  ~Block();

  unsigned char* data() { return memory_.data(); }
  const unsigned char* data() const { return memory_.data(); }
  std::size_t size() const { return memory_.size(); }
  /// True if the pages that a call does not need any more should go back to the system, so that the caller's
  /// lists fit beside it: for new blocks of 4 GiB or more, 26 million nodes. In later calls the lists have
  /// their pages already.
  bool gives_back_pages() const { return size() >= std::size_t{4} << 30 && !is_reused_; }

 private:
  Buffer<unsigned char> memory_;
  bool is_reused_ = false;
};

/// Gives the pages between two addresses of a block back; what they hold is lost.
void give_back_pages(void* begin, void* end) noexcept;

/// Frees all cached blocks and the things of base/cached.h. False if nothing was freed.
bool free_cached_blocks() noexcept;

/// Frees the cached blocks alone: for a caller whose next calls need less. False if there were none.
bool free_idle_blocks() noexcept;

/// An uninitialised array in its own block.
template <class T>
class BlockArray {
 public:
  BlockArray() = default;
  /// Throws std::bad_alloc.
  explicit BlockArray(std::size_t n) : block_(bytes_of(n)), size_(n) {}

  std::size_t size() const { return size_; }
  T* data() { return reinterpret_cast<T*>(block_.data()); }
  const T* data() const { return reinterpret_cast<const T*>(block_.data()); }
  T& operator[](std::size_t i) { return data()[i]; }
  const T& operator[](std::size_t i) const { return data()[i]; }
  T* begin() { return data(); }
  T* end() { return data() + size_; }

 private:
  static_assert(std::is_trivially_copyable_v<T>);
  static std::size_t bytes_of(std::size_t n) {
    // no number of nodes that is let in asks for so much
    if (n > static_cast<std::size_t>(PTRDIFF_MAX) / sizeof(T)) throw std::bad_alloc();
    return n * sizeof(T);
  }
  Block block_;
  std::size_t size_ = 0;
};

/// One block of memory for all arrays of a call: clearing fresh pages costs time, and the next call can
/// reuse one block whole. Arrays that live until the end of the call are laid out from the front, those of
/// one phase from the back; next_phase() releases the latter.
///
///     | order | sorted nodes | faces ->            <- planes |
///     | of the call                            of this phase |
class Workspace {
 public:
  static constexpr std::size_t kSlack = 2048;  ///< covers rounding and small extras

  explicit Workspace(std::size_t bytes) : Workspace(Block(bytes + kSlack)) {}
  /// In memory owned by the caller.
  Workspace(unsigned char* begin, std::size_t bytes) : begin_(begin), size_(bytes), back_(bytes) { align(); }
  Workspace(const Workspace&) = delete;
  Workspace& operator=(const Workspace&) = delete;

  /// An uninitialised array of n items that stays until clear().
  template <class T>
  T* for_call(std::size_t n) {
    T* const array = reinterpret_cast<T*>(begin_ + front_);
    front_ += rounded_up(n * sizeof(T));
    check();
    return array;
  }

  /// An uninitialised array of n items for this phase: valid until next_phase().
  template <class T>
  T* for_phase(std::size_t n) {
    const std::size_t bytes = rounded_up(n * sizeof(T));
    back_ = bytes < back_ ? (back_ - bytes) / kAlignment * kAlignment : 0;
    check();
    return reinterpret_cast<T*>(begin_ + back_);
  }

  void next_phase() { back_ = size_; }
  /// To be called when the arrays of this phase are the last that are needed.
  void keep_only_this_phase() {
    if (block_.gives_back_pages()) give_back_pages(begin_, begin_ + back_);
    front_ = 0;
  }
  void clear() { front_ = 0, back_ = size_; }

 private:
  /// A cache line: faces and planes have half its length and must not straddle two lines. Of two patches, the
  /// badly aligned one would be slower and keep the other waiting.
  static constexpr std::size_t kAlignment = 64;
  static std::size_t rounded_up(std::size_t bytes) {
    return (bytes + kAlignment - 1) / kAlignment * kAlignment;
  }
  void check() const {
    // a bug in our own reckoning
    if (front_ > back_ || back_ == 0) throw std::length_error("pstripack: a workspace is too small");
  }

  explicit Workspace(Block block)
      : block_(std::move(block)), begin_(block_.data()), size_(block_.size()), back_(size_) {
    align();
  }
  void align() {
    const std::size_t beyond = reinterpret_cast<std::uintptr_t>(begin_) % kAlignment;
    const std::size_t skipped = std::min(size_, (kAlignment - beyond) % kAlignment);
    begin_ += skipped;
    back_ = size_ -= skipped;
  }

  Block block_;
  unsigned char* begin_;
  std::size_t size_, front_ = 0, back_;
};

}  // namespace pstripack
