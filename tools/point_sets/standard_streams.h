#pragma once
// stdin, stdout and stderr, which may be closed or full.

#include <fcntl.h>

#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <stdexcept>
#include <string>

/// Gives the numbers of stdin, stdout and stderr, if they are closed, to what stdin cannot be read from and
/// stdout not be written to; stderr goes nowhere. Otherwise the next files would have these numbers. To be
/// called first in main().
inline void fill_standard_streams() {
  constexpr const char* kNames[] = {"/dev/null", "/", "/dev/null"};
  constexpr int kModes[] = {O_WRONLY, O_RDONLY, O_WRONLY};
  for (int number = 0; number < 3; ++number)
    if (fcntl(number, F_GETFD) < 0 && open(kNames[number], kModes[number]) < 0) std::abort();
}

/// Throws std::runtime_error if output could not be written, for example because the disk is full.
inline void expect_printed() {
  errno = 0;
  if (std::fflush(stdout) != 0 || std::ferror(stdout) != 0)
    throw std::runtime_error(std::string("stdout: cannot be written") + (errno != 0 ? ": " : "") +
                             (errno != 0 ? std::strerror(errno) : ""));
}

/// Prints the text on stdout; throws like expect_printed().
inline void print(const std::string& text) {
  std::fwrite(text.data(), 1, text.size(), stdout);
  expect_printed();
}

/// The exit code of a program that has printed --help or --version: `code`, or 1 and a line on stderr.
inline int after_help(const char* program, int code) {
  try {
    expect_printed();
    return code;
  } catch (const std::runtime_error& e) {
    std::fprintf(stderr, "%s: %s\n", program, e.what());
    return 1;
  }
}
