#include "child_process.h"

#include <poll.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <exception>
#include <system_error>

namespace legacy_stripack {
namespace {

using Clock = std::chrono::steady_clock;

[[noreturn]] void child(const std::function<void()>& work, int finished) {
  prctl(PR_SET_PDEATHSIG, SIGKILL);  // nothing is left hanging if the parent is killed
  const rlimit no_core{0, 0};
  setrlimit(RLIMIT_CORE, &no_core);
  dup2(STDERR_FILENO, STDOUT_FILENO);
  try {
    work();
    const char byte = 1;
    if (write(finished, &byte, 1) != 1) _exit(1);
    _exit(0);  // not exit(): what the parent registered with atexit is the parent's
  } catch (const std::exception& e) {
    std::fprintf(stderr, "%s\n", e.what());
  }
  _exit(1);
}

// Waits until the pipe is readable, or closed by the end of the child. False if the time is over.
bool wait_for(int pipe, double time_limit) {
  const auto end = Clock::now() + std::chrono::duration<double>(time_limit);
  for (;;) {
    const double left = std::chrono::duration<double>(end - Clock::now()).count();
    if (left <= 0) return false;
    pollfd poll_one{pipe, POLLIN, 0};
    // An hour at a time: poll counts milliseconds in an int.
    const int ready = poll(&poll_one, 1, static_cast<int>(std::ceil(std::fmin(left, 3600) * 1000)));
    if (ready > 0) return true;
    if (ready < 0 && errno != EINTR) throw std::system_error(errno, std::generic_category(), "poll");
  }
}

}  // namespace

Ended run_in_child(const std::function<void()>& work, double time_limit_seconds) {
  int ends[2];
  if (pipe(ends) != 0) throw std::system_error(errno, std::generic_category(), "pipe");
  std::fflush(nullptr);  // or a STOP in the child would write our buffers a second time
  const pid_t pid = fork();
  if (pid < 0) {
    const int error = errno;
    close(ends[0]);
    close(ends[1]);
    throw std::system_error(error, std::generic_category(), "fork");
  }
  if (pid == 0) {
    close(ends[0]);
    child(work, ends[1]);
  }
  close(ends[1]);

  const bool in_time = wait_for(ends[0], time_limit_seconds);
  char byte;
  const bool finished = in_time && read(ends[0], &byte, 1) == 1;
  close(ends[0]);
  if (!in_time) kill(pid, SIGKILL);
  int status = 0;
  while (waitpid(pid, &status, 0) < 0 && errno == EINTR) {
  }
  if (finished) return {Outcome::returned, 0};
  if (!in_time) return {Outcome::timed_out, 0};
  if (WIFSIGNALED(status)) return {Outcome::crashed, WTERMSIG(status)};
  return {Outcome::stopped, 0};
}

}  // namespace legacy_stripack
