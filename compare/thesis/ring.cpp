#include "thesis/ring.h"

#include <mpi.h>
#include <unistd.h>

#include <cstdint>

namespace thesis {
namespace {

/// Waits without using the processor: ranks share processors, and their processor time is measured.
template <int count>
void wait(MPI_Request (&requests)[count]) {
  for (int done = 0;;) {
    MPI_Testall(count, requests, &done, MPI_STATUSES_IGNORE);
    if (done) return;
    usleep(50);
  }
}

}  // namespace

Ring::Ring() {
  int level;
  MPI_Init_thread(nullptr, nullptr, MPI_THREAD_FUNNELED, &level);
  MPI_Comm_rank(MPI_COMM_WORLD, &rank_);
  MPI_Comm_size(MPI_COMM_WORLD, &size_);
}

Ring::~Ring() { MPI_Finalize(); }

void Ring::barrier() const {
  MPI_Request requests[1];
  MPI_Ibarrier(MPI_COMM_WORLD, &requests[0]);
  wait(requests);
}

Chain Ring::from_left(const Chain& right) const {
  const int to = (rank_ + 1) % size_, from = (rank_ + size_ - 1) % size_;
  const auto pass = [&](const void* out, std::size_t out_size, void* in, std::size_t in_size) {
    MPI_Request requests[2];
    MPI_Irecv(in, static_cast<int>(in_size), MPI_INT32_T, from, 0, MPI_COMM_WORLD, &requests[0]);
    MPI_Isend(out, static_cast<int>(out_size), MPI_INT32_T, to, 0, MPI_COMM_WORLD, &requests[1]);
    wait(requests);
  };
  const auto out_size = static_cast<std::int32_t>(right.size());
  std::int32_t in_size = 0;
  pass(&out_size, 1, &in_size, 1);
  Chain left(static_cast<std::size_t>(in_size));
  pass(right.data(), right.size(), left.data(), left.size());
  return left;
}

std::vector<std::size_t> Ring::gather_sizes(std::size_t mine) const {
  std::vector<std::uint64_t> sizes(is_root() ? static_cast<std::size_t>(size_) : 0);
  const std::uint64_t size = mine;
  MPI_Request requests[1];
  MPI_Igather(&size, 1, MPI_UINT64_T, sizes.data(), 1, MPI_UINT64_T, 0, MPI_COMM_WORLD, &requests[0]);
  wait(requests);
  std::vector<std::size_t> begin;
  if (is_root()) begin.push_back(0);
  for (const std::uint64_t s : sizes) begin.push_back(begin.back() + s);
  return begin;
}

void Ring::gather(const void* mine, std::size_t size, void* all, const std::vector<std::size_t>& begin,
                  std::size_t item_size) const {
  MPI_Datatype item;
  MPI_Type_contiguous(static_cast<int>(item_size), MPI_BYTE, &item);
  MPI_Type_commit(&item);
  std::vector<int> sizes, offsets;
  for (std::size_t r = 0; r + 1 < begin.size(); ++r) {
    sizes.push_back(static_cast<int>(begin[r + 1] - begin[r]));
    offsets.push_back(static_cast<int>(begin[r]));
  }
  MPI_Request requests[1];
  MPI_Igatherv(mine, static_cast<int>(size), item, all, sizes.data(), offsets.data(), item, 0, MPI_COMM_WORLD,
               &requests[0]);
  wait(requests);
  MPI_Type_free(&item);
}

}  // namespace thesis
