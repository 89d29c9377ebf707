#include "base/parallel_for.h"

#ifdef _OPENMP
#include <errno.h>
#include <omp.h>
#include <pthread.h>
#include <time.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <memory>
#include <new>

#include "base/environment.h"
#endif

namespace pstripack {

#ifdef _OPENMP
namespace {

constexpr std::size_t kWorthAThread = 10000;  ///< items

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

/// OpenMP's number as the library was loaded: another one later is the program's choice.
const int first_default = omp_get_max_threads();
const bool variable_is_set = [] {
  const char* const value = environment_variable("OMP_NUM_THREADS");
  return value != nullptr && *value != '\0';
}();
thread_local bool is_chosen = false;

/// The threads that calls of this process have at work. Each thread that is inside TRMESH counts itself.
std::atomic<int> at_work{0};
thread_local int own_at_work = 0;

/// threads_of_others(), read ten times a second: each reading takes some 10 us, and 5 us more a thread of
/// this process. The least of a few, so that what runs for a moment does not count.
int others_running() {
  constexpr std::uint64_t kStaysValid = 100, kCount = std::uint64_t{1} << 20;  // ms; more than systems run
  static std::atomic<std::uint64_t> last{0};                                   // ms * kCount + the number
  timespec now;
  clock_gettime(CLOCK_MONOTONIC, &now);
  const auto ms =
      static_cast<std::uint64_t>(now.tv_sec) * 1000 + static_cast<std::uint64_t>(now.tv_nsec) / 1000000;
  const std::uint64_t known = last.load(std::memory_order_relaxed);
  if (known != 0 && ms - known / kCount < kStaysValid) return static_cast<int>(known % kCount);
  const int error = errno;
  int least = threads_of_others("");
  for (int again = 0; again < 2 && least > 0; ++again) least = std::min(least, threads_of_others(""));
  errno = error;
  last.store(ms * kCount + static_cast<std::uint64_t>(least), std::memory_order_relaxed);
  return least;
}

/// What stays as it is while the process runs.
Processors known_at_start() {
  const int error = errno;
  const Processors machine{0, static_cast<int>(sysconf(_SC_NPROCESSORS_ONLN)), processors_of_parent(),
                           local_ranks(), quota_of_control_groups("")};
  errno = error;
  return machine;
}

ThreadCount most_threads() {
  const int most = omp_get_max_threads();
  if (is_chosen || variable_is_set || most != first_default) return {most, ThreadLimit::asked};
  static const Processors start = known_at_start();
  Processors machine = start;
  machine.usable = std::min(most, omp_get_num_procs());
  if (machine.usable > 1)
    machine.others = others_running() + std::max(0, at_work.load(std::memory_order_relaxed) - own_at_work);
  return free_processors(machine);
}

}  // namespace

int most_threads_for(std::size_t items) noexcept {
  return static_cast<int>(
      std::clamp<std::size_t>(items / kWorthAThread, 1, static_cast<std::size_t>(omp_get_max_threads())));
}

ThreadCount thread_count(std::size_t items) noexcept {
  if (items < 2 * kWorthAThread) return {1, ThreadLimit::size};
  if (omp_in_parallel()) return {1, ThreadLimit::nested};
  const ThreadCount most = most_threads();
  const std::size_t pay = items / kWorthAThread;
  const ThreadCount taken = pay < static_cast<std::size_t>(most.threads)
                                ? ThreadCount{static_cast<int>(pay), ThreadLimit::size}
                                : most;
  if (taken.threads > 1 && (getpid() != loaded_in || !can_start(taken.threads - 1)))
    return {1, ThreadLimit::system};
  return taken;
}

int processors_of_mask() noexcept { return omp_get_num_procs(); }

ChosenThreads::ChosenThreads(int threads) noexcept : saved_(omp_get_max_threads()), was_chosen_(is_chosen) {
  if (threads <= 0) return;
  omp_set_num_threads(threads);
  is_chosen = true;
}
ChosenThreads::~ChosenThreads() {
  omp_set_num_threads(saved_);
  is_chosen = was_chosen_;
}

AtWork::AtWork(int threads) noexcept : threads_(threads) {
  at_work += threads_;
  own_at_work += threads_;
}
AtWork::~AtWork() {
  at_work -= threads_;
  own_at_work -= threads_;
}
#else
int most_threads_for(std::size_t) noexcept { return 1; }
ThreadCount thread_count(std::size_t) noexcept { return {1, ThreadLimit::system}; }
int processors_of_mask() noexcept { return 1; }
ChosenThreads::ChosenThreads(int) noexcept : saved_(1), was_chosen_(false) {}
ChosenThreads::~ChosenThreads() = default;
AtWork::AtWork(int) noexcept : threads_(0) {}
AtWork::~AtWork() = default;
#endif

}  // namespace pstripack
