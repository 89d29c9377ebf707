#include "mpi/world.h"

#include <time.h>

#include <algorithm>
#include <chrono>
#include <cstdlib>

namespace pstripack {

World::World() {
  int provided = 0;
  MPI_Init_thread(nullptr, nullptr, MPI_THREAD_FUNNELED, &provided);
}

World::~World() { MPI_Finalize(); }

void World::abort() const {
  MPI_Abort(MPI_COMM_WORLD, 1);
  std::abort();  // does not return either, but MPI's declaration does not say so
}

void tell_others(const void* message, std::size_t size) {
  int ranks = 1;
  MPI_Comm_size(MPI_COMM_WORLD, &ranks);
  for (int r = 1; r < ranks; ++r) MPI_Send(message, static_cast<int>(size), MPI_BYTE, r, 0, MPI_COMM_WORLD);
}

void wait_for_rank_0(void* message, std::size_t size) {
  using Clock = std::chrono::steady_clock;
  constexpr double kSpin = 50e-6, kLongestNap = 1e-3;
  int arrived = 0;
  MPI_Request request;
  MPI_Irecv(message, static_cast<int>(size), MPI_BYTE, 0, 0, MPI_COMM_WORLD, &request);
  const auto start = Clock::now();
  for (;;) {
    MPI_Test(&request, &arrived, MPI_STATUS_IGNORE);
    if (arrived) return;
    const double waited = std::chrono::duration<double>(Clock::now() - start).count();
    if (waited < kSpin) continue;
    const timespec nap{0, static_cast<long>(1e9 * std::min(waited / 8, kLongestNap))};
    nanosleep(&nap, nullptr);
  }
}

}  // namespace pstripack
