#pragma once
// Something that may end the process, in a process of its own.

#include <sys/wait.h>
#include <unistd.h>

/// Where branches are counted (tests/coverage): writes the counts, which _exit leaves out.
extern "C" [[gnu::weak]] void __gcov_dump();

/// The exit code of `body` run in a child process, or minus the signal that ended it (-14: hung for a
/// minute).
template <class Body>
int in_child(Body body) {
  const pid_t child = fork();
  if (child == 0) {
    alarm(60);
    const int code = body();
    if (__gcov_dump != nullptr) __gcov_dump();
    _exit(code);
  }
  int status = 0;
  waitpid(child, &status, 0);
  return WIFEXITED(status) ? WEXITSTATUS(status) : -WTERMSIG(status);
}
