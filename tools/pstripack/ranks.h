#pragma once
// Under mpirun: rank 0 does what the command line says, the others help it triangulate.

#include <functional>

namespace program {

/// The exit code of work(), which runs on rank 0, on every rank. Of `pstripack` (ranks.cpp), which has no
/// MPI: replaces the program by pstripack-mpi if there is more than one rank, and else is rank 0. Of
/// `pstripack-mpi` (ranks_mpi.cpp): collective.
int on_rank_0(int argc, char** argv, const std::function<int()>& work);

}  // namespace program
