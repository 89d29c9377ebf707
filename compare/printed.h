#pragma once

#include <cstdio>
#include <stdexcept>

/// Throws std::runtime_error if output could not be written, for example because the disk is full.
inline void expect_printed() {
  if (std::fflush(stdout) != 0 || std::ferror(stdout) != 0)
    throw std::runtime_error("cannot write to the standard output");
}
