#pragma once
// The library reads environment variables only through this header.

#include <errno.h>
#include <stdlib.h>

#include "base/system.h"

namespace pstripack {

/// Value of an environment variable. Null if it is unset, or if the program has rights that its caller lacks
/// (setuid, setgid, file capabilities): that caller must not choose files to write or programs to start.
inline const char* environment_variable(const char* name) {
#if defined(PSTRIPACK_LINUX)
  return secure_getenv(name);
#else
  return getuid() == geteuid() && getgid() == getegid() ? getenv(name) : nullptr;
#endif
}

/// What read() returns, once. Threads that wait here for each other may find another errno: the program's
/// must stay.
template <class Read>
auto read_once(const Read& read) {
  const int error = errno;
  static const auto value = read();
  errno = error;
  return value;
}

}  // namespace pstripack
