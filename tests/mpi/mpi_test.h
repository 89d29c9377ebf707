#pragma once
// GoogleTest on every rank: all ranks run the same tests in the same order. Ranks other than 0 print only
// failures.

#include <gtest/gtest.h>
#include <mpi.h>

inline int rank_of(MPI_Comm comm = MPI_COMM_WORLD) {
  int rank;
  MPI_Comm_rank(comm, &rank);
  return rank;
}
inline int size_of(MPI_Comm comm = MPI_COMM_WORLD) {
  int size;
  MPI_Comm_size(comm, &size);
  return size;
}

/// Runs the tests; `at_end` is called on every rank before MPI_Finalize. Fails if any rank fails.
template <class Function>
int run_on_every_rank(int argc, char** argv, const Function& at_end) {
  int level;
  MPI_Init_thread(&argc, &argv, MPI_THREAD_FUNNELED, &level);
  if (rank_of() != 0) GTEST_FLAG_SET(brief, true);
  ::testing::InitGoogleTest(&argc, argv);
  const int code = RUN_ALL_TESTS();
  at_end();
  MPI_Finalize();
  return code;
}
