#include "child_process.h"

#include <poll.h>
#include <signal.h>
#if defined(__linux__)
#include <sys/prctl.h>
#endif
#include <sys/resource.h>
#include <sys/wait.h>
#include <time.h>
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
#if defined(__linux__)
  prctl(PR_SET_PDEATHSIG, SIGKILL);  // the child ends if the parent is killed
#endif
  const rlimit no_core{0, 0};
  setrlimit(RLIMIT_CORE, &no_core);
  dup2(STDERR_FILENO, STDOUT_FILENO);
  try {
    work();
    const char byte = 1;
    if (write(finished, &byte, 1) != 1) _exit(1);
    _exit(0);  // not exit(), which would run the parent's atexit functions
  } catch (const std::exception& e) {
    std::fprintf(stderr, "%s\n", e.what());
  }
  _exit(1);
}

// Limit in clock seconds for a child that neither ends nor computes, for example because it waits for input.
double longest_wait(double time_limit) { return time_limit + 30 * std::fmin(time_limit, 2); }

// 0 if the child has ended, and where the system does not tell (macOS): then clock seconds are the limit.
double processor_seconds([[maybe_unused]] pid_t pid) {
#if defined(__APPLE__) || defined(PSTRIPACK_ONLY_POSIX)
  return 0;
#else
  clockid_t clock;
  timespec t;
  if (clock_getcpuclockid(pid, &clock) != 0 || clock_gettime(clock, &t) != 0) return 0;
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
#endif
}

// Waits until the pipe is readable, or closed because the child has ended. False if the child exceeds its
// limit.
bool wait_for(int pipe, pid_t pid, double time_limit) {
  const auto start = Clock::now();
  for (;;) {
    const double waited = std::chrono::duration<double>(Clock::now() - start).count();
    const double left = std::fmin(time_limit - processor_seconds(pid), longest_wait(time_limit) - waited);
    pollfd poll_one{pipe, POLLIN, 0};
    // At most an hour at a time: poll takes milliseconds in an int.
    const int ready =
        poll(&poll_one, 1, static_cast<int>(std::ceil(std::fmin(std::fmax(left, 0), 3600) * 1000)));
    if (ready > 0) return true;
    if (ready < 0 && errno != EINTR) throw std::system_error(errno, std::generic_category(), "poll");
    if (left <= 0) return false;
  }
}

}  // namespace

Ended run_in_child(const std::function<void()>& work, double time_limit_seconds) {
  int ends[2];
  if (pipe(ends) != 0) throw std::system_error(errno, std::generic_category(), "pipe");
  std::fflush(nullptr);  // otherwise a STOP in the child would write these buffers again
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

  const bool in_time = wait_for(ends[0], pid, time_limit_seconds);
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
