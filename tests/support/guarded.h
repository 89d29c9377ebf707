#pragma once
// Arrays between inaccessible pages, which detect any access outside.

#include <sys/mman.h>
#include <unistd.h>

#include <cstddef>
#include <cstring>
#include <map>
#include <mutex>
#include <new>
#include <vector>

/// Memory between two inaccessible pages. What is given back is kept for the next call, because the system
/// takes longer to map pages than most tests to call a routine.
class GuardedMemory {
 public:
  static std::size_t page() { return static_cast<std::size_t>(sysconf(_SC_PAGESIZE)); }
  /// `size` bytes, whole pages, with zeros.
  static char* get(std::size_t size) {
    const std::lock_guard lock(mutex_);
    std::vector<char*>& kept = kept_[size];
    if (kept.empty()) return map(size);
    char* const memory = kept.back();
    kept.pop_back();
    std::memset(memory, 0, size);
    return memory;
  }
  static void give_back(char* memory, std::size_t size) {
    const std::lock_guard lock(mutex_);
    kept_[size].push_back(memory);
  }

 private:
  static char* map(std::size_t size) {
    void* const all = mmap(nullptr, size + 2 * page(), PROT_NONE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    if (all == MAP_FAILED) throw std::bad_alloc();
    char* const memory = static_cast<char*>(all) + page();
    if (size > 0 && mprotect(memory, size, PROT_READ | PROT_WRITE) != 0) throw std::bad_alloc();
    return memory;
  }

  static inline std::mutex mutex_;
  static inline std::map<std::size_t, std::vector<char*>> kept_;
};

/// `count` entries directly before (Edge::end) or after (Edge::begin) an inaccessible page.
enum class Edge { begin, end };

template <class T>
class Guarded {
 public:
  Guarded(std::size_t count, Edge edge) : count_(count) {
    const std::size_t page = GuardedMemory::page();
    size_ = (count * sizeof(T) + page - 1) / page * page;
    memory_ = GuardedMemory::get(size_);
    data_ = reinterpret_cast<T*>(edge == Edge::begin ? memory_ : memory_ + size_ - count * sizeof(T));
  }
  Guarded(const std::vector<T>& values, Edge edge) : Guarded(values.size(), edge) {
    for (std::size_t i = 0; i < count_; ++i) data_[i] = values[i];
  }
  ~Guarded() {
    if (read_only_) mprotect(memory_, size_, PROT_READ | PROT_WRITE);
    GuardedMemory::give_back(memory_, size_);
  }
  Guarded(const Guarded&) = delete;
  Guarded& operator=(const Guarded&) = delete;

  /// From now on any write ends the program.
  void make_read_only() { read_only_ = mprotect(memory_, size_, PROT_READ) == 0; }

  T* data() { return data_; }
  std::size_t size() const { return count_; }
  T& operator[](std::size_t i) { return data_[i]; }

 private:
  std::size_t count_, size_;
  char* memory_;
  bool read_only_ = false;
  T* data_;
};
