#include "mpi/mpi_communicator.h"

#include <sched.h>
#include <time.h>

#include <algorithm>
#include <chrono>
#include <climits>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <thread>

namespace pstripack {
namespace {

constexpr std::int32_t kOutOfMemory = -6, kBadCommunicator = -8;
constexpr int kTag = 0;

/// While it lives, MPI returns errors about handles that are no communicators instead of ending the job: it
/// reports them to MPI_COMM_WORLD, from MPI 4 on to MPI_COMM_SELF.
class NoAbort {
 public:
  NoAbort() {
    for (int i = 0; i < 2; ++i) {
      MPI_Comm_get_errhandler(comm_[i], &saved_[i]);
      MPI_Comm_set_errhandler(comm_[i], MPI_ERRORS_RETURN);
    }
  }
  ~NoAbort() {
    for (int i = 0; i < 2; ++i) {
      MPI_Comm_set_errhandler(comm_[i], saved_[i]);
      MPI_Errhandler_free(&saved_[i]);
    }
  }
  NoAbort(const NoAbort&) = delete;
  NoAbort& operator=(const NoAbort&) = delete;

 private:
  MPI_Comm comm_[2] = {MPI_COMM_WORLD, MPI_COMM_SELF};
  MPI_Errhandler saved_[2];
};

bool is_usable(MPI_Comm comm) {
  int initialised = 0, finalised = 0;
  MPI_Initialized(&initialised);
  MPI_Finalized(&finalised);
  if (!initialised || finalised || comm == MPI_COMM_NULL) return false;
  // Where handles are pointers, that of a freed communicator is no longer in the table of handles.
  if (MPI_Comm_f2c(MPI_Comm_c2f(comm)) != comm) return false;
  const NoAbort no_abort;
  int is_inter = 0;
  return MPI_Comm_test_inter(comm, &is_inter) == MPI_SUCCESS && !is_inter;
}

double processor_seconds() {
  timespec t;
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

/// How to pass the time until the next look: spin first, because most waits are short; then let others run;
/// then sleep, an eighth of the time waited so far at most, so that a wait is hardly prolonged. Where ranks
/// share processors there is no spinning, but more of letting others run: the one waited for is among them.
class Patience {
 public:
  explicit Patience(bool crowded) : spin_(crowded ? 0 : 50e-6), yield_(crowded ? 1e-3 : 200e-6) {}

  void pause() {
    const double waited = std::chrono::duration<double>(Clock::now() - start_).count();
    if (waited < spin_) return;
    if (waited < yield_) {
      sched_yield();
      return;
    }
    constexpr double kLongest = 200e-6;
    const timespec nap{0, static_cast<long>(1e9 * std::min(waited / 8, kLongest))};
    nanosleep(&nap, nullptr);
  }

 private:
  using Clock = std::chrono::steady_clock;
  const double spin_, yield_;
  const Clock::time_point start_ = Clock::now();
};

}  // namespace

MpiCommunicator::MpiCommunicator(MPI_Comm comm, std::size_t longest_message, std::int32_t code)
    : longest_message_(longest_message) {
  if (!is_usable(comm)) throw Failure(kBadCommunicator);
  {
    const NoAbort no_abort;
    if (MPI_Comm_dup(comm, &comm_) != MPI_SUCCESS) throw Failure(kBadCommunicator);
  }
  MPI_Comm_set_errhandler(comm_, MPI_ERRORS_RETURN);
  MPI_Comm_rank(comm_, &rank_);
  MPI_Comm_size(comm_, &size_);
  try {
    crowded_ = ranks_outnumber_processors();
    agreed(*this, [this, code] {
      if (code != 0) throw Failure(code);
      const auto ranks = static_cast<std::size_t>(size_);
      sizes_.resize(ranks);
      other_sizes_.resize(ranks);
      counts_.resize(ranks);
      displacements_.resize(ranks);
      under_way_.reserve(4 * ranks + 16);
    });
  } catch (...) {
    MPI_Comm_free(&comm_);
    throw;
  }
}

MpiCommunicator::~MpiCommunicator() {
  int finalised = 0;
  MPI_Finalized(&finalised);
  if (!finalised) MPI_Comm_free(&comm_);
}

/// More ranks of this communicator on this machine than processors that any of them may use.
bool MpiCommunicator::ranks_outnumber_processors() {
  MPI_Comm machine;
  check(MPI_Comm_split_type(comm_, MPI_COMM_TYPE_SHARED, rank_, MPI_INFO_NULL, &machine));
  int ranks = 1;
  check(MPI_Comm_size(machine, &ranks));
  cpu_set_t processors;
  CPU_ZERO(&processors);
  if (sched_getaffinity(0, sizeof processors, &processors) != 0)  // more processors than the set has bits
    for (unsigned i = 0; i < std::thread::hardware_concurrency() && i < CPU_SETSIZE; ++i)
      CPU_SET(i, &processors);
  MPI_Request request;
  check(MPI_Iallreduce(MPI_IN_PLACE, &processors, sizeof processors, MPI_BYTE, MPI_BOR, machine, &request));
  wait(request);
  check(MPI_Comm_free(&machine));
  return ranks > CPU_COUNT(&processors);
}

void MpiCommunicator::abort(const char* kind, const char* text) const {
  std::fprintf(stderr, "pstripack: rank %d: %s in phase %s: %s\n", rank_, kind, phase_, text);
  std::fflush(stderr);
  MPI_Abort(comm_, 1);
  std::abort();
}

void MpiCommunicator::check(int code) const {
  if (code == MPI_SUCCESS) return;
  char text[MPI_MAX_ERROR_STRING] = "";
  int length = 0;
  MPI_Error_string(code, text, &length);
  abort("MPI error", text);
}

/// The processor time of a wait is the messages' as far as they can have needed it, a second for 10^9 bytes;
/// what is more was spent looking whether they are there.
void MpiCommunicator::wait(MPI_Request* requests, int count, std::size_t bytes) {
  const double start = processor_seconds();
  Patience patience(crowded_);
  for (;;) {
    int done = 0;
    check(MPI_Testall(count, requests, &done, MPI_STATUSES_IGNORE));
    if (done) break;
    patience.pause();
  }
  idle_cpu_seconds += std::max(0.0, processor_seconds() - start - 1e-9 * static_cast<double>(bytes));
}

void MpiCommunicator::all_min(std::int64_t* values, std::size_t count) {
  MPI_Request request;
  check(MPI_Iallreduce(MPI_IN_PLACE, values, static_cast<int>(count), MPI_INT64_T, MPI_MIN, comm_, &request));
  wait(request);
}

const std::int64_t* MpiCommunicator::all_gather_one(std::int64_t value) {
  MPI_Request request;
  check(MPI_Iallgather(&value, 1, MPI_INT64_T, sizes_.data(), 1, MPI_INT64_T, comm_, &request));
  wait(request);
  return sizes_.data();
}

Parcels MpiCommunicator::all_gather(const void* bytes, std::size_t size) {
  const auto ranks = static_cast<std::size_t>(size_), me = static_cast<std::size_t>(rank_);
  all_gather_one(static_cast<std::int64_t>(size));
  Parcels all;
  agreed(*this, [&] {
    all.begin.resize(ranks + 1);
    for (std::size_t r = 0; r < ranks; ++r)
      all.begin[r + 1] = all.begin[r] + static_cast<std::size_t>(sizes_[r]);
    all.bytes = Buffer<unsigned char>(all.begin[ranks]);
  });
  if (size > 0) std::memcpy(all.bytes.data() + all.begin[me], bytes, size);
  all_gather_in_place(all.bytes.data(), all.begin);
  return all;
}

void MpiCommunicator::all_gather_in_place(void* all, const std::vector<std::size_t>& begin) {
  const auto ranks = static_cast<std::size_t>(size_), me = static_cast<std::size_t>(rank_);
  bytes_sent += static_cast<std::int64_t>((begin[me + 1] - begin[me]) * (ranks - 1));
  if (begin[ranks] == begin[0]) return;
  if (begin[ranks] > std::min<std::size_t>(longest_message_, INT_MAX)) {
    all_gather_around_the_ring(static_cast<unsigned char*>(all), begin);
    return;
  }
  for (std::size_t r = 0; r < ranks; ++r) {
    counts_[r] = static_cast<int>(begin[r + 1] - begin[r]);
    displacements_[r] = static_cast<int>(begin[r]);
  }
  MPI_Request request;
  check(MPI_Iallgatherv(MPI_IN_PLACE, 0, MPI_BYTE, all, counts_.data(), displacements_.data(), MPI_BYTE,
                        comm_, &request));
  wait(&request, 1, begin[ranks] - begin[0]);
}

/// In step s each rank hands on to its right what it got in step s-1 from its left, in lengths that MPI can
/// count; both cut at the same places.
void MpiCommunicator::all_gather_around_the_ring(unsigned char* all, const std::vector<std::size_t>& begin) {
  const int right = (rank_ + 1) % size_, left = (rank_ + size_ - 1) % size_;
  for (int step = 0; step + 1 < size_; ++step) {
    const auto out = static_cast<std::size_t>((rank_ - step + size_) % size_);
    const auto in = static_cast<std::size_t>((rank_ - step - 1 + 2 * size_) % size_);
    const std::size_t out_size = begin[out + 1] - begin[out], in_size = begin[in + 1] - begin[in];
    for (std::size_t at = 0; at < std::max(out_size, in_size); at += longest_message_) {
      MPI_Request requests[2];
      int count = 0;
      if (at < in_size)
        check(MPI_Irecv(all + begin[in] + at, static_cast<int>(std::min(longest_message_, in_size - at)),
                        MPI_BYTE, left, kTag, comm_, &requests[count++]));
      if (at < out_size)
        check(MPI_Isend(all + begin[out] + at, static_cast<int>(std::min(longest_message_, out_size - at)),
                        MPI_BYTE, right, kTag, comm_, &requests[count++]));
      wait(requests, count, in_size + out_size);
    }
  }
}

Parcels MpiCommunicator::exchange(const Parcels& outgoing) {
  const auto ranks = static_cast<std::size_t>(size_), me = static_cast<std::size_t>(rank_);
  for (std::size_t r = 0; r < ranks; ++r)
    other_sizes_[r] = static_cast<std::int64_t>(outgoing.begin[r + 1] - outgoing.begin[r]);
  MPI_Request request;
  check(MPI_Ialltoall(other_sizes_.data(), 1, MPI_INT64_T, sizes_.data(), 1, MPI_INT64_T, comm_, &request));
  wait(request);

  Parcels incoming;
  agreed(*this, [&] {
    std::size_t messages = 0;
    incoming.begin.resize(ranks + 1);
    for (std::size_t r = 0; r < ranks; ++r) {
      incoming.begin[r + 1] = incoming.begin[r] + static_cast<std::size_t>(sizes_[r]);
      messages += messages_for(static_cast<std::size_t>(sizes_[r])) +
                  messages_for(static_cast<std::size_t>(other_sizes_[r]));
    }
    incoming.bytes = Buffer<unsigned char>(incoming.begin[ranks]);
    under_way_.reserve(messages);
  });

  const auto part = [&](std::size_t r) { return static_cast<std::size_t>(other_sizes_[r]); };
  for (std::size_t step = 1; step < ranks; ++step) {
    const std::size_t from = (me + ranks - step) % ranks;
    post_receive(incoming.bytes.data() + incoming.begin[from],
                 incoming.begin[from + 1] - incoming.begin[from], static_cast<int>(from));
  }
  for (std::size_t step = 1; step < ranks; ++step) {  // each rank begins elsewhere: nobody is asked by all
    const std::size_t to = (me + step) % ranks;
    post_send(outgoing.bytes.data() + outgoing.begin[to], part(to), static_cast<int>(to));
  }
  if (part(me) > 0)
    std::memcpy(incoming.bytes.data() + incoming.begin[me], outgoing.bytes.data() + outgoing.begin[me],
                part(me));
  finish();
  return incoming;
}

void MpiCommunicator::broadcast(void* bytes, std::size_t size, int root) {
  auto* const begin = static_cast<unsigned char*>(bytes);
  for (std::size_t at = 0; at < size; at += longest_message_) {
    MPI_Request request;
    check(MPI_Ibcast(begin + at, static_cast<int>(std::min(longest_message_, size - at)), MPI_BYTE, root,
                     comm_, &request));
    wait(request);
  }
  if (rank_ == root) bytes_sent += static_cast<std::int64_t>(size) * (size_ - 1);
}

/// Where no place was reserved for a further message, those under way are waited for first. That happens in
/// scatter and gather only, where the root and each other rank meet in one order: no deadlock.
void MpiCommunicator::post_send(const void* bytes, std::size_t size, int to) {
  const auto* const begin = static_cast<const unsigned char*>(bytes);
  bytes_sent += static_cast<std::int64_t>(size);
  bytes_under_way_ += size;
  for (std::size_t at = 0; at < size; at += longest_message_) {
    if (under_way_.size() == under_way_.capacity()) finish();
    under_way_.emplace_back();
    check(MPI_Isend(begin + at, static_cast<int>(std::min(longest_message_, size - at)), MPI_BYTE, to, kTag,
                    comm_, &under_way_.back()));
  }
}

void MpiCommunicator::post_receive(void* bytes, std::size_t size, int from) {
  auto* const begin = static_cast<unsigned char*>(bytes);
  bytes_under_way_ += size;
  for (std::size_t at = 0; at < size; at += longest_message_) {
    if (under_way_.size() == under_way_.capacity()) finish();
    under_way_.emplace_back();
    check(MPI_Irecv(begin + at, static_cast<int>(std::min(longest_message_, size - at)), MPI_BYTE, from, kTag,
                    comm_, &under_way_.back()));
  }
}

void MpiCommunicator::finish() {
  wait(under_way_.data(), static_cast<int>(under_way_.size()), bytes_under_way_);
  under_way_.clear();
  bytes_under_way_ = 0;
}

void MpiCommunicator::start_scatter(const void* all, const std::vector<std::size_t>& begin, void* mine,
                                    std::size_t size, int root) {
  if (rank_ != root) {
    post_receive(mine, size, root);
    return;
  }
  const auto* const bytes = static_cast<const unsigned char*>(all);
  for (int r = 0; r < size_; ++r) {
    const std::size_t from = begin[static_cast<std::size_t>(r)], to = begin[static_cast<std::size_t>(r) + 1];
    if (r != root)
      post_send(bytes + from, to - from, r);
    else if (mine != nullptr && to > from)
      std::memcpy(mine, bytes + from, to - from);
  }
}

void MpiCommunicator::start_gather(const void* mine, std::size_t size, void* all,
                                   const std::vector<std::size_t>& begin, int root) {
  if (rank_ != root) {
    post_send(mine, size, root);
    return;
  }
  auto* const bytes = static_cast<unsigned char*>(all);
  for (int r = 0; r < size_; ++r) {
    const std::size_t from = begin[static_cast<std::size_t>(r)], to = begin[static_cast<std::size_t>(r) + 1];
    if (r != root)
      post_receive(bytes + from, to - from, r);
    else if (mine != nullptr && size > 0)
      std::memcpy(bytes + from, mine, size);
  }
}

}  // namespace pstripack
