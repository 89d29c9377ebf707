#pragma once

#include <cstdio>
#include <stdexcept>

/// Throws std::runtime_error unless all output so far could be written: the disk may be full.
inline void expect_printed() {
  if (std::fflush(stdout) != 0 || std::ferror(stdout) != 0)
    throw std::runtime_error("cannot write to the standard output");
}
