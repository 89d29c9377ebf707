#pragma once
// Runs work that may hang or crash in a child process; memory shared with that process.

#include <sys/mman.h>

#include <cstddef>
#include <functional>
#include <new>
#include <type_traits>

namespace legacy_stripack {

enum class Outcome {
  returned,   ///< the work finished
  timed_out,  ///< it exceeded the time limit and was killed
  crashed,    ///< a signal ended it
  stopped     ///< it ended the process itself: STOP, exit, or an exception (reported on stderr)
};

struct Ended {
  Outcome outcome;
  int signal;  ///< of a crash, else 0
};

/// Runs `work` in a child process. Its stdout goes to stderr; results come back in Shared memory. Do not use
/// several OpenMP threads in both the parent and `work`. The limit is that of the processor time of all
/// threads, so that a busy machine does not look like a hang. Work that sleeps is killed at most a minute
/// later.
Ended run_in_child(const std::function<void()>& work, double time_limit_seconds);

/// `count` objects of a trivial type, initially zero, shared with children that are started later.
template <class T>
class Shared {
 public:
  explicit Shared(std::size_t count = 1) : bytes_(count * sizeof(T)) {
    void* p = mmap(nullptr, bytes_, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
    if (p == MAP_FAILED) throw std::bad_alloc();
    data_ = static_cast<T*>(p);
  }
  ~Shared() { munmap(const_cast<std::remove_cv_t<T>*>(data_), bytes_); }
  Shared(const Shared&) = delete;
  Shared& operator=(const Shared&) = delete;

  T* data() const { return data_; }
  T& operator[](std::size_t i) const { return data_[i]; }
  T* operator->() const { return data_; }

 private:
  std::size_t bytes_;
  T* data_;
};

}  // namespace legacy_stripack
