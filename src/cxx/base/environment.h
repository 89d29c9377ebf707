#pragma once
// The library reads environment variables only through this header.

#include <errno.h>
#include <stdlib.h>
#include <string.h>

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

/// True if NAME=VALUE is a variable that mpirun (Open MPI, Slurm, MPICH, Intel) sets for the ranks it starts.
inline bool is_from_mpi_launcher(const char* variable) {
  constexpr const char* kPrefixes[] = {
      "OMPI_", "ORTE_", "PMIX_", "PMI_", "HYDI_", "MPI_LOCALRANKID=", "MPI_LOCALNRANKS="};
  for (const char* const prefix : kPrefixes)
    if (strncmp(variable, prefix, strlen(prefix)) == 0) return true;
  return false;
}

}  // namespace pstripack
