#pragma once
// Number of threads for an amount of work, decided in one place.

#include <cstddef>
#include <exception>
#include <vector>

#include "base/floating_point.h"

namespace pstripack {

/// Threads for `items` pieces of work of some 10 ns each: one inside a parallel region, for few items, in
/// a forked child (where OpenMP's threads are gone), and where the system gives no threads.
int threads_for(std::size_t items) noexcept;

/// Calls body(first, last, piece) for a partition of [0,n) into `threads` contiguous pieces, in the order of
/// the pieces, one per thread. `threads` must come from threads_for. body must not throw.
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

/// Calls body(k) for k = 0..tasks-1, each once, on up to `threads` threads, which take the next one as they
/// become free. `threads` must come from threads_for. body must not throw.
template <class Body>
void parallel_tasks(int tasks, int threads, const Body& body) {
#ifdef _OPENMP
  if (threads > 1 && tasks > 1) {
#pragma omp parallel for schedule(dynamic, 1) num_threads(threads)
    for (int k = 0; k < tasks; ++k) in_default_floating_point([&] { body(k); });
    return;
  }
#endif
  for (int k = 0; k < tasks; ++k) body(k);
}

/// What bodies of the above throw, one for each piece or task: they must not let it out themselves.
class ErrorsOfThreads {
 public:
  /// Throws std::bad_alloc.
  explicit ErrorsOfThreads(std::size_t bodies) : errors_(bodies) {}

  /// In the k-th body: runs part(), and keeps what it throws.
  template <class Part>
  void keep(std::size_t k, const Part& part) noexcept {
    try {
      part();
    } catch (...) {
      errors_[k] = std::current_exception();
    }
  }
  /// After all bodies: throws the first error in their order, if there is any.
  void rethrow() const {
    for (const auto& e : errors_)
      if (e) std::rethrow_exception(e);
  }

 private:
  std::vector<std::exception_ptr> errors_;
};

}  // namespace pstripack
