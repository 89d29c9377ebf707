#pragma once
// Arrays between inaccessible pages, which detect any access outside.

#include <sys/mman.h>
#include <unistd.h>

#include <cstddef>
#include <new>
#include <vector>

/// `count` entries directly before (Edge::end) or after (Edge::begin) an inaccessible page.
enum class Edge { begin, end };

template <class T>
class Guarded {
 public:
  Guarded(std::size_t count, Edge edge) : count_(count) {
    const std::size_t page = static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
    inner_ = (count * sizeof(T) + page - 1) / page * page;
    size_ = inner_ + 2 * page;
    memory_ = static_cast<char*>(mmap(nullptr, size_, PROT_NONE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0));
    if (memory_ == MAP_FAILED) throw std::bad_alloc();
    begin_ = memory_ + page;
    if (inner_ > 0 && mprotect(begin_, inner_, PROT_READ | PROT_WRITE) != 0) throw std::bad_alloc();
    data_ = reinterpret_cast<T*>(edge == Edge::begin ? begin_ : begin_ + inner_ - count * sizeof(T));
  }
  Guarded(const std::vector<T>& values, Edge edge) : Guarded(values.size(), edge) {
    for (std::size_t i = 0; i < count_; ++i) data_[i] = values[i];
  }
  ~Guarded() { munmap(memory_, size_); }
  Guarded(const Guarded&) = delete;
  Guarded& operator=(const Guarded&) = delete;

  /// From now on any write ends the program.
  void make_read_only() { mprotect(begin_, inner_, PROT_READ); }

  T* data() { return data_; }
  std::size_t size() const { return count_; }
  T& operator[](std::size_t i) { return data_[i]; }

 private:
  std::size_t count_, inner_, size_;
  char *memory_, *begin_;
  T* data_;
};
