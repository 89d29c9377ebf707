#pragma once
// Loops on threads, and the one function that decides how many threads.

#include <cstddef>
#include <exception>
#include <vector>

#include "base/floating_point.h"
#include "base/free_processors.h"

namespace pstripack {

/// Number of threads to use for `items` pieces of work of about 10 ns each, and why no more. It is 1 for
/// fewer than 20,000 items, inside a parallel region, in a forked child (OpenMP's threads are gone), and if
/// the system cannot start threads. Where neither OMP_NUM_THREADS nor the program says how many, it is at
/// most the number of processors that nobody else uses (free_processors.h), which may change during a call:
/// who needs the same number twice keeps it.
ThreadCount thread_count(std::size_t items) noexcept;
inline int threads_for(std::size_t items) noexcept { return thread_count(items).threads; }

/// Upper bound of threads_for(items), as long as the program does not ask for more threads.
int most_threads_for(std::size_t items) noexcept;

/// Number of processors in the affinity mask.
int processors_of_mask() noexcept;

/// While an object exists, calls of its thread take `threads` threads, on a busy machine, too. 0: OpenMP's
/// number.
class ChosenThreads {
 public:
  explicit ChosenThreads(int threads) noexcept;
  ~ChosenThreads();
  ChosenThreads(const ChosenThreads&) = delete;
  ChosenThreads& operator=(const ChosenThreads&) = delete;

 private:
  const int saved_;
  const bool was_chosen_;
};

/// While an object exists, calls on other threads of this process leave it so many processors.
class AtWork {
 public:
  explicit AtWork(int threads) noexcept;
  ~AtWork();
  AtWork(const AtWork&) = delete;
  AtWork& operator=(const AtWork&) = delete;

 private:
  const int threads_;
};

/// Cuts [0,n) into `threads` contiguous pieces and calls body(first, last, piece) for each, every piece on
/// a thread of its own, the same in each loop: what a thread has written is in its processor's cache. Pieces
/// are numbered in order. `threads` must come from threads_for. body must not
/// throw.
template <class Body>
void parallel_pieces(std::size_t n, int threads, const Body& body) {
  if (threads <= 1) {
    body(std::size_t{0}, n, 0);
    return;
  }
#ifdef _OPENMP
  const AtWork others(threads - 1);
  const auto pieces = static_cast<std::size_t>(threads);
  const auto begin = [&](std::size_t t) { return n / pieces * t + n % pieces * t / pieces; };
#pragma omp parallel for schedule(static, 1) num_threads(threads)
  for (int t = 0; t < threads; ++t)
    in_default_floating_point(
        [&] { body(begin(static_cast<std::size_t>(t)), begin(static_cast<std::size_t>(t) + 1), t); });
#endif
}

/// Calls body(i) for i = 0, ..., n-1, on threads: threads_for(items).
template <class Body>
void parallel_for(std::size_t n, std::size_t items, const Body& body) {
  parallel_pieces(n, threads_for(items), [&](std::size_t first, std::size_t last, int) {
    for (std::size_t i = first; i < last; ++i) body(i);
  });
}

/// Carries exceptions out of the loops above, whose bodies must not throw: one place for each piece, or part
/// of one.
class ErrorsOfThreads {
 public:
  /// Throws std::bad_alloc.
  explicit ErrorsOfThreads(std::size_t bodies) : errors_(bodies) {}

  /// To be called in body k: runs part() and keeps what it throws.
  template <class Part>
  void keep(std::size_t k, const Part& part) noexcept {
    try {
      part();
    } catch (...) {
      errors_[k] = std::current_exception();
    }
  }
  /// To be called after the loop: throws the exception of the lowest body that threw, if any.
  void rethrow() const {
    for (const auto& e : errors_)
      if (e) std::rethrow_exception(e);
  }

 private:
  std::vector<std::exception_ptr> errors_;
};

}  // namespace pstripack
