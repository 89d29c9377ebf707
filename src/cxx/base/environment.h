#pragma once
// Every environment variable is read here.

#include <stdlib.h>
#include <string.h>

namespace pstripack {

/// Its value; null if there is none, and in a program that has rights which its caller has not (setuid,
/// setgid, file capabilities): there the caller shall not name files to write to or programs to start.
inline const char* environment_variable(const char* name) { return secure_getenv(name); }

/// Whether NAME=VALUE is what mpirun or the like tells the ranks that it starts: Open MPI, Slurm, MPICH,
/// Intel.
inline bool is_from_mpi_launcher(const char* variable) {
  constexpr const char* kPrefixes[] = {
      "OMPI_", "ORTE_", "PMIX_", "PMI_", "HYDI_", "MPI_LOCALRANKID=", "MPI_LOCALNRANKS="};
  for (const char* const prefix : kPrefixes)
    if (strncmp(variable, prefix, strlen(prefix)) == 0) return true;
  return false;
}

}  // namespace pstripack
