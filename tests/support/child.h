#pragma once
// Runs code that may end the process in its own process.

#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>

/// Ends a child process. If branches are counted (tests/coverage), writes the counts.
[[noreturn]] inline void end_child(int code) {
#ifdef PSTRIPACK_COVERAGE
  std::exit(code);
#else
  _exit(code);
#endif
}

/// The exit code of `body` run in a child process, or minus the signal that ended it (-14: hung for a
/// minute).
template <class Body>
int in_child(Body body) {
  const pid_t child = fork();
  if (child == 0) {
    alarm(60);
    end_child(body());
  }
  int status = 0;
  waitpid(child, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
}
