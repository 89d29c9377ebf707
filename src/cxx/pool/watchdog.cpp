#include "pool/watchdog.h"

#include <errno.h>
#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <stdio.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <unistd.h>

#include <new>

namespace pstripack {

Watchdog::Watchdog(int rank) : launcher_(getppid()) {
  void* const memory = mmap(nullptr, sizeof(Page), PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
  int alive[2];  // a pipe whose write end closes when the rank ends
  if (memory == MAP_FAILED) return;
  page_ = new (memory) Page{"the start of MPI", 0};
  if (pipe2(alive, O_CLOEXEC) != 0) return;
  const pid_t rank_process = getpid();
  const pid_t watchdog = fork();
  if (watchdog != 0) {
    close(alive[0]);
    pipe_ = alive[1];  // stays open until the rank ends
    return;
  }

  setsid();  // signals to the rank's process group are not for this process
  prctl(PR_SET_NAME, "pstripack-watch");
  close(alive[1]);
  close(STDIN_FILENO);
  close(STDOUT_FILENO);
  pollfd end_of_rank{alive[0], POLLIN, 0};
  while (poll(&end_of_rank, 1, 1000) <= 0)
    if (kill(launcher_, 0) != 0 && errno == ESRCH) {
      dismiss();
      kill(rank_process, SIGKILL);
    }
  if (!page_->dismissed) {
    dprintf(STDERR_FILENO, "pstripack: rank %d was lost during %s; the job ends\n", rank, page_->phase);
  }
  _exit(0);
}

}  // namespace pstripack
