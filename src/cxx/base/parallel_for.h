#pragma once
// Loops on threads, and the one function that decides how many threads.

#include <cstddef>
#include <exception>
#include <vector>

#include "base/floating_point.h"

namespace pstripack {

/// Number of threads to use for `items` pieces of work of about 10 ns each. It is 1 for fewer than 20,000
/// items, inside a parallel region, in a forked child (OpenMP's threads are gone), and if the system cannot
/// start threads.
int threads_for(std::size_t items) noexcept;

/// Cuts [0,n) into `threads` contiguous pieces and calls body(first, last, piece) for each, every piece on
/// a thread of its own. Pieces are numbered in order. `threads` must come from threads_for. body must not
/// throw.
template <class Body>
void parallel_pieces(std::size_t n, int threads, const Body& body) {
  if (threads <= 1) {
    body(std::size_t{0}, n, 0);
    return;
  }
#ifdef _OPENMP
  const auto pieces = static_cast<std::size_t>(threads);
  const auto begin = [&](std::size_t t) { return n / pieces * t + n % pieces * t / pieces; };
#pragma omp parallel for schedule(static, 1) num_threads(threads)
  for (int t = 0; t < threads; ++t)
    in_default_floating_point(
        [&] { body(begin(static_cast<std::size_t>(t)), begin(static_cast<std::size_t>(t) + 1), t); });
#endif
}

/// Calls body(k) once for each k = 0..tasks-1, on up to `threads` threads; a thread that becomes free takes
/// the next k. `threads` must come from threads_for. body must not throw.
template <class Body>
void parallel_tasks(int tasks, [[maybe_unused]] int threads, const Body& body) {
#ifdef _OPENMP
  if (threads > 1 && tasks > 1) {
#pragma omp parallel for schedule(dynamic, 1) num_threads(threads)
    for (int k = 0; k < tasks; ++k) in_default_floating_point([&] { body(k); });
    return;
  }
#endif
  for (int k = 0; k < tasks; ++k) body(k);
}

/// Carries exceptions out of the loops above, whose bodies must not throw: one place for each piece or task.
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
