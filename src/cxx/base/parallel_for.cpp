#include "base/parallel_for.h"

#ifdef _OPENMP
#include <omp.h>
#include <pthread.h>
#include <unistd.h>

#include <algorithm>
#include <memory>
#include <new>
#endif

namespace pstripack {

#ifdef _OPENMP
namespace {

/// The process that loaded the library. A forked child has one thread only, but OpenMP's run-time library
/// would wait for ever for the parent's threads.
const pid_t loaded_in = getpid();

/// True if the system can start `count` more threads now. OpenMP's run-time library ends the program if it
/// cannot start its threads, so this is tested first. A success is remembered per calling thread, because
/// OpenMP keeps the threads it has started.
bool can_start(int count) {
  thread_local int started = 0;
  if (count <= started) return true;
  const std::unique_ptr<pthread_t[]> threads(new (std::nothrow) pthread_t[static_cast<std::size_t>(count)]);
  if (threads == nullptr) return false;
  int running = 0;
  const auto nothing = [](void*) -> void* { return nullptr; };
  while (running < count &&
         pthread_create(&threads[static_cast<std::size_t>(running)], nullptr, nothing, nullptr) == 0)
    ++running;
  for (int i = 0; i < running; ++i) pthread_join(threads[static_cast<std::size_t>(i)], nullptr);
  if (running == count) started = count;
  return running == count;
}

}  // namespace

int threads_for(std::size_t items) noexcept {
  constexpr std::size_t kWorthAThread = 10000;
  if (items < 2 * kWorthAThread || omp_in_parallel()) return 1;
  const auto most = static_cast<std::size_t>(omp_get_max_threads());
  const int threads = static_cast<int>(std::min(items / kWorthAThread, most));
  return threads > 1 && getpid() == loaded_in && can_start(threads - 1) ? threads : 1;
}
#else
int threads_for(std::size_t) noexcept { return 1; }
#endif

}  // namespace pstripack
