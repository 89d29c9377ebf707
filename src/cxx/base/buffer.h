#pragma once

#include <sys/mman.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <new>
#include <type_traits>
#include <utility>

namespace pstripack {

constexpr std::size_t kHugePage = std::size_t{1} << 21;

/// Gives the system this advice on the whole huge pages of this memory. A hint: failure is harmless.
inline void advise_on_huge_pages(void* begin, std::size_t bytes, int advice) {
  const auto first = reinterpret_cast<std::uintptr_t>(begin),
             skipped = (kHugePage - first % kHugePage) % kHugePage;
  if (bytes >= skipped + kHugePage)
    madvise(static_cast<unsigned char*>(begin) + skipped, (bytes - skipped) / kHugePage * kHugePage, advice);
}

/// Asks the system to back the whole huge pages of this memory as such: one page fault for 512.
inline void ask_for_huge_pages(void* begin, std::size_t bytes) {
#ifdef MADV_HUGEPAGE
  advise_on_huge_pages(begin, bytes, MADV_HUGEPAGE);
#endif
}

/// An uninitialised array on the heap. Arrays from 1 MiB on ask for huge pages, because the kernel visits its
/// arrays at random. The constructor throws std::bad_alloc.
template <class T>
class Buffer {
  static_assert(std::is_trivially_copyable_v<T>);

 public:
  Buffer() = default;
  explicit Buffer(std::size_t n) : size_(n) {
    // no number of nodes that is let in asks for so much
    if (n > static_cast<std::size_t>(PTRDIFF_MAX) / sizeof(T)) throw std::bad_alloc();
    const std::size_t bytes = n * sizeof(T);
    if (bytes < kHugePage / 2) {
      data_ = static_cast<T*>(std::malloc(bytes + 1));
    } else {
      data_ = static_cast<T*>(std::aligned_alloc(kHugePage, (bytes / kHugePage + 1) * kHugePage));
      if (data_ != nullptr) ask_for_huge_pages(data_, std::max(bytes, kHugePage));
    }
    if (data_ == nullptr) throw std::bad_alloc();
  }
  Buffer(Buffer&& other) noexcept { swap(other); }
  Buffer& operator=(Buffer&& other) noexcept {
    Buffer(std::move(other)).swap(*this);
    return *this;
  }
  ~Buffer() { std::free(data_); }

  void swap(Buffer& other) noexcept {
    std::swap(data_, other.data_);
    std::swap(size_, other.size_);
  }
  std::size_t size() const { return size_; }
  T* data() { return data_; }
  const T* data() const { return data_; }
  T& operator[](std::size_t i) { return data_[i]; }
  const T& operator[](std::size_t i) const { return data_[i]; }
  T* begin() { return data_; }
  T* end() { return data_ + size_; }
  const T* begin() const { return data_; }
  const T* end() const { return data_ + size_; }

 private:
  T* data_ = nullptr;
  std::size_t size_ = 0;
};

}  // namespace pstripack
