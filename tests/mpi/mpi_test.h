#pragma once
// GoogleTest on every rank: all ranks run the same tests in the same order. Ranks other than 0 print only
// failures.

#include <gtest/gtest.h>
#include <mpi.h>

#include <string>

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

/// Expects that call() writes these lines to stderr, each behind "pstripack: ", on rank 0, and nothing
/// elsewhere.
template <class Call>
void expect_lines_of_rank_0(const std::string& lines, const Call& call) {
  ::testing::internal::CaptureStderr();
  call();
  const std::string written = ::testing::internal::GetCapturedStderr();
  EXPECT_EQ(written, rank_of() == 0 && lines != "" ? "pstripack: " + lines + "\n" : "");
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
