# How tests and measuring programs start ranks, with any MPI:
#   mpiexec             command and options: more ranks than processors, bound to none
#   mpiexec_words       the same as words for a shell
#   mpi_environment     for tests: without it Open MPI refuses to run as root
#   mpi_is_open_mpi     Hydra, the launcher of MPICH and Intel MPI, has other options, and needs none of these
#   mpi_patience        factor of the time limits of tests: MPICH's ranks spin while they wait, on processors that
# others need
set(mpi_environment OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1)
if(NOT PSTRIPACK_WITH_MPI)
  return()
endif()
execute_process(COMMAND ${MPIEXEC_EXECUTABLE} --version OUTPUT_VARIABLE mpiexec_version ERROR_QUIET)
set(mpiexec ${MPIEXEC_EXECUTABLE})
set(mpi_is_open_mpi FALSE)
set(mpi_patience 10)
if(mpiexec_version MATCHES "Open MPI|OpenRTE")
  set(mpi_is_open_mpi TRUE)
  set(mpi_patience 1)
  list(APPEND mpiexec --oversubscribe --bind-to none)
endif()
list(JOIN mpiexec " " mpiexec_words)
