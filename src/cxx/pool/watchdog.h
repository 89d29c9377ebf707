#pragma once
// Somebody must be left to say that a rank was killed.

#include <sys/types.h>

namespace pstripack {

/// A child process that waits for the end of this one, a rank of the pool. If the rank ends without having
/// said so, it prints one line that names rank and phase; if what started the rank (mpirun or its daemon)
/// is gone, it ends the rank. It holds nothing open but stderr.
class Watchdog {
 public:
  /// Before MPI_Init. The watchdog cannot be had: the rank does without.
  explicit Watchdog(int rank);
  Watchdog(const Watchdog&) = delete;
  Watchdog& operator=(const Watchdog&) = delete;

  /// Memory that the watchdog reads when the rank is gone: what it points to then must be text that was
  /// there before the watchdog was, such as a literal. Null if there is no such memory.
  const char* volatile* phase() { return page_ != nullptr ? &page_->phase : nullptr; }
  /// The end of the rank is none to talk about.
  void dismiss() {
    if (page_ != nullptr) page_->dismissed = 1;
  }
  pid_t launcher() const { return launcher_; }

 private:
  struct Page {
    const char* volatile phase;
    volatile int dismissed;
  };
  Page* page_ = nullptr;
  pid_t launcher_;
};

}  // namespace pstripack
