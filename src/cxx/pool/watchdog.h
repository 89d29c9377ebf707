#pragma once
// Reports that a rank of the pool was killed.

#include <sys/types.h>
#include <unistd.h>

namespace pstripack {

/// A child process that waits for the end of this process, a rank of the pool. If the rank ends without
/// dismiss(), it prints one line that names rank and phase. If the process that started the rank (mpirun or
/// its daemon) is gone, it kills the rank. It keeps no descriptor open but stderr.
class Watchdog {
 public:
  /// To be called before MPI_Init. If the watchdog cannot be started, the rank runs without it.
  explicit Watchdog(int rank);
  Watchdog(const Watchdog&) = delete;
  Watchdog& operator=(const Watchdog&) = delete;

  /// Shared memory for a pointer to the name of the phase, which must be a literal: the watchdog reads it
  /// when the rank is gone. Null if there is no such memory.
  const char* volatile* phase() { return page_ != nullptr ? &page_->phase : nullptr; }
  /// From now on the end of the rank is not reported.
  void dismiss() {
    if (page_ != nullptr) page_->dismissed = 1;
  }
  pid_t launcher() const { return launcher_; }
  /// In a child process, which must not look like the rank to the watchdog.
  void close_pipe() const { close(pipe_); }

 private:
  struct Page {
    const char* volatile phase;
    volatile int dismissed;
  };
  Page* page_ = nullptr;
  pid_t launcher_;
  int pipe_ = -1;  ///< its end closes with the rank
};

}  // namespace pstripack
