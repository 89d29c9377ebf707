#include "mpi/mpi_communicator.h"

#include <sched.h>
#include <time.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <stdexcept>

#include "base/system.h"
#include "capi/pstripack.h"
#include "parallel/agreement.h"
#include "parallel/cost.h"

namespace pstripack {
namespace {

/// While an object of this class exists, MPI returns errors about invalid communicators instead of ending
/// the job. Such errors are raised on MPI_COMM_WORLD, from MPI 4 on on MPI_COMM_SELF.
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
  // If handles are pointers, a freed communicator is no longer in the table of Fortran handles.
  if (MPI_Comm_f2c(MPI_Comm_c2f(comm)) != comm) return false;
  const NoAbort no_abort;
  int is_inter = 0;
  return MPI_Comm_test_inter(comm, &is_inter) == MPI_SUCCESS && !is_inter;
}

std::size_t size_of(const Parcels& parcels, std::size_t r) { return parcels.begin[r + 1] - parcels.begin[r]; }

double processor_seconds() { return clock_seconds(CLOCK_THREAD_CPUTIME_ID); }

/// The pauses between polls of one wait: none at first, because most waits are short; then yields; then
/// sleeps of an eighth of the time waited so far, which hardly prolong the wait; the longest after a second,
/// as workers of the pool wait. If ranks share processors: no spinning and more yields, because the awaited
/// rank may need the processor.
class BackOff {
 public:
  explicit BackOff(bool crowded) : spin_(crowded ? 0 : 50e-6), yield_(crowded ? 1e-3 : 200e-6) {}

  void pause() {
    const double waited = std::chrono::duration<double>(Clock::now() - start_).count();
    if (waited < spin_) return;
    if (waited < yield_) {
      sched_yield();
      return;
    }
    const double longest = waited < 1 ? 200e-6 : 1e-3;
    const timespec nap{0, static_cast<long>(1e9 * std::min(waited / 8, longest))};
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
  if (!is_usable(comm)) throw Failure(PSTRIPACK_BAD_COMM);
  {
    const NoAbort no_abort;
    if (MPI_Comm_dup(comm, &comm_) != MPI_SUCCESS) throw Failure(PSTRIPACK_BAD_COMM);
  }
  MPI_Comm_set_errhandler(comm_, MPI_ERRORS_RETURN);
  MPI_Comm_rank(comm_, &rank_);
  MPI_Comm_size(comm_, &size_);
  try {
    crowded_ = ranks_outnumber_processors();
    in_agreement(*this, [this, code] {
      if (code != 0) throw Failure(code);
      const auto ranks = static_cast<std::size_t>(size_);
      sizes_.resize(ranks);
      other_sizes_.resize(ranks);
      moving_.resize(ranks);
      leaving_.resize(ranks + 1);
      arriving_.resize(ranks + 1);
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
  if (finalised) return;
  finish();
  MPI_Comm_free(&comm_);
}

/// True if this machine has more ranks of the communicator than processors that any of them may use.
bool MpiCommunicator::ranks_outnumber_processors() {
  MPI_Comm machine;
  check(MPI_Comm_split_type(comm_, MPI_COMM_TYPE_SHARED, rank_, MPI_INFO_NULL, &machine));
  int ranks = 1;
  check(MPI_Comm_size(machine, &ranks));
  ProcessorSet processors = usable_processors();
  MPI_Request request;
  check(MPI_Iallreduce(MPI_IN_PLACE, processors.data(), sizeof processors, MPI_BYTE, MPI_BOR, machine,
                       &request));
  wait(request);
  check(MPI_Comm_free(&machine));
  int count = 0;
  for (std::uint64_t word : processors)
    for (; word != 0; word &= word - 1) ++count;
  return ranks > count;
}

void MpiCommunicator::abort(const char* kind, const char* text) const {
  std::fprintf(stderr, "pstripack: rank %d: %s: %s\n", rank_, kind, text);
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

/// Of the processor time of a wait, one second per 10^9 bytes is taken to be that of the transfer; the rest
/// was spent polling and is counted as idle.
void MpiCommunicator::wait(MPI_Request* requests, int count, std::size_t bytes) {
  const double start = processor_seconds();
  BackOff back_off(crowded_);
  for (;;) {
    int done = 0;
    check(MPI_Testall(count, requests, &done, MPI_STATUSES_IGNORE));
    if (done) break;
    back_off.pause();
  }
  idle_cpu_seconds += std::max(0.0, processor_seconds() - start - 1e-9 * static_cast<double>(bytes));
}

/// Sends and receives at once, in messages of at most longest_message_ bytes. Both sides cut at the same
/// places.
void MpiCommunicator::send_and_receive(const void* out, std::size_t out_size, int to, void* in,
                                       std::size_t in_size, int from) {
  const auto* const outgoing = static_cast<const unsigned char*>(out);
  auto* const incoming = static_cast<unsigned char*>(in);
  for (std::size_t at = 0; at < std::max(out_size, in_size); at += longest_message_) {
    MPI_Request requests[2];
    int count = 0;
    std::size_t bytes = 0;
    const auto part = [&](std::size_t size) {
      const std::size_t length = std::min(longest_message_, size - at);
      bytes += length;
      return static_cast<int>(length);
    };
    if (at < in_size)
      check(MPI_Irecv(incoming + at, part(in_size), MPI_BYTE, from, tag_, comm_, &requests[count++]));
    if (at < out_size)
      check(MPI_Isend(outgoing + at, part(out_size), MPI_BYTE, to, tag_, comm_, &requests[count++]));
    wait(requests, count, bytes);
  }
}

// The collectives take about log2(ranks) steps; in step k a rank communicates with those 2^k away (Bruck,
// Ho, Kipnis, Upfal & Weathersby 1997; all_min: Hensgen, Finkel & Manber 1988). MPI's own are slower: the
// nonblocking ones send to every rank, or more often, and the blocking ones spin.

void MpiCommunicator::all_min(std::int64_t* values, std::size_t count) {
  std::int64_t others[kMostValues];
  if (count > kMostValues) throw std::length_error("all_min of too many values");
  for (int distance = 1; distance < size_; distance *= 2) {
    send_and_receive(values, count * sizeof *values, above(distance), others, count * sizeof *values,
                     below(distance));
    for (std::size_t i = 0; i < count; ++i) values[i] = std::min(values[i], others[i]);
  }
}

/// By MPI's own, because it is seldom called. Each rank counts as sent what it adds.
void MpiCommunicator::all_sum(std::int64_t* values, std::size_t count) {
  if (size_ == 1) return;
  constexpr std::size_t kTogether = std::size_t{1} << 20;  // MPI counts in int
  for (std::size_t at = 0; at < count; at += kTogether) {
    MPI_Request request;
    check(MPI_Iallreduce(MPI_IN_PLACE, values + at, static_cast<int>(std::min(kTogether, count - at)),
                         MPI_INT64_T, MPI_SUM, comm_, &request));
    wait(request);
  }
  bytes_sent += static_cast<std::int64_t>(count * sizeof *values);
}

const std::int64_t* MpiCommunicator::all_gather_one(std::int64_t value) {
  sizes_[static_cast<std::size_t>(rank_)] = value;
  gather_blocks(sizes_.data(), [](int r) { return static_cast<std::size_t>(r) * sizeof value; });
  return sizes_.data();
}

/// Rank r has block r of `all`, the bytes [begin(r), begin(r+1)); afterwards every rank has all blocks. In
/// each step a rank has the blocks of `distance` ranks from its own on, and gets as many that follow.
template <class Begin>
void MpiCommunicator::gather_blocks(void* all, const Begin& begin) {
  auto* const bytes = static_cast<unsigned char*>(all);
  struct Piece {
    std::size_t begin, end;
  };
  // The blocks of `count` ranks from `first` on are two pieces: up to the last rank, and from rank 0 on.
  const auto piece = [&](int first, int count, bool second) {
    const int last = first + count;
    if (second) return Piece{0, last > size_ ? begin(last - size_) : 0};
    return Piece{begin(first), begin(std::min(last, size_))};
  };
  for (int distance = 1; distance < size_; distance *= 2) {
    const int count = std::min(distance, size_ - distance);
    for (const bool second : {false, true}) {
      const Piece out = piece(rank_, count, second), in = piece(above(distance), count, second);
      send_and_receive(bytes + out.begin, out.end - out.begin, below(distance), bytes + in.begin,
                       in.end - in.begin, above(distance));
    }
  }
}

/// out[r] is for rank r; sizes_[r] becomes the value that rank r had for this rank. A value for the rank j
/// above its sender travels in steps of 2^k for the bits k of j, with those that go the same way (the crystal
/// router: Fox et al. 1988). Most ranks have nothing for each other, and a value of 0 does not travel. So a
/// rank sends log2(ranks) messages, of about as many values as it has neighbours.
void MpiCommunicator::exchange_sizes(const std::int64_t* out) {
  const auto ranks = static_cast<std::size_t>(size_), me = static_cast<std::size_t>(rank_);
  std::size_t count = 0;
  for (std::size_t j = 0; j < ranks; ++j)
    if (const std::int64_t value = out[(me + j) % ranks]; value != 0)
      moving_[count++] = {static_cast<std::int64_t>(j), value};
  for (std::size_t distance = 1; distance < ranks; distance *= 2) {
    std::size_t staying = 0, leaving = 0;
    for (std::size_t i = 0; i < count; ++i) {
      if ((static_cast<std::size_t>(moving_[i].above) & distance) != 0)
        leaving_[++leaving] = moving_[i];
      else
        moving_[staying++] = moving_[i];
    }
    // The first one tells the number of the others. No rank ever has two for one j, so the memory suffices.
    leaving_[0] = {static_cast<std::int64_t>(leaving), 0};
    const std::size_t bytes = (1 + leaving) * sizeof(Routed);
    MPI_Request requests[2];
    check(MPI_Irecv(arriving_.data(), static_cast<int>(arriving_.size() * sizeof(Routed)), MPI_BYTE,
                    below(static_cast<int>(distance)), tag_, comm_, &requests[0]));
    check(MPI_Isend(leaving_.data(), static_cast<int>(bytes), MPI_BYTE, above(static_cast<int>(distance)),
                    tag_, comm_, &requests[1]));
    wait(requests, 2, bytes);
    const auto arrived = static_cast<std::size_t>(arriving_[0].above);
    std::copy_n(arriving_.data() + 1, arrived, moving_.data() + staying);
    count = staying + arrived;
  }
  std::fill(sizes_.begin(), sizes_.end(), 0);
  for (std::size_t i = 0; i < count; ++i)
    sizes_[(me + ranks - static_cast<std::size_t>(moving_[i].above)) % ranks] = moving_[i].value;
}

void MpiCommunicator::all_gather_in_place(void* all, const std::vector<std::size_t>& begin) {
  const auto ranks = static_cast<std::size_t>(size_), me = static_cast<std::size_t>(rank_);
  bytes_sent += static_cast<std::int64_t>((begin[me + 1] - begin[me]) * (ranks - 1));
  gather_blocks(all, [&](int r) { return begin[static_cast<std::size_t>(r)]; });
}

Parcels MpiCommunicator::exchange(const Parcels& outgoing, std::int32_t code) {
  const auto ranks = static_cast<std::size_t>(size_);
  for (std::size_t r = 0; r < ranks; ++r)
    other_sizes_[r] = code != 0 ? code : static_cast<std::int64_t>(size_of(outgoing, r));
  exchange_sizes(other_sizes_.data());
  const std::int64_t least = *std::min_element(sizes_.begin(), sizes_.end());
  if (least < 0) throw AgreedFailure(static_cast<std::int32_t>(least));

  Parcels incoming;
  in_agreement(*this, [&] {
    incoming.begin.resize(ranks + 1);
    for (std::size_t r = 0; r < ranks; ++r)
      incoming.begin[r + 1] = incoming.begin[r] + static_cast<std::size_t>(sizes_[r]);
    make_room(outgoing, incoming);
  });
  start(outgoing, incoming);
  finish();
  return incoming;
}

void MpiCommunicator::make_room(const Parcels& outgoing, Parcels& incoming) {
  std::size_t messages = under_way_.size();
  for (std::size_t r = 0; r < sizes_.size(); ++r)
    messages += messages_for(size_of(outgoing, r)) + messages_for(size_of(incoming, r));
  Communicator::make_room(outgoing, incoming);
  under_way_.reserve(messages);
}

void MpiCommunicator::start(const Parcels& outgoing, Parcels& incoming) {
  const auto ranks = static_cast<std::size_t>(size_), me = static_cast<std::size_t>(rank_);
  auto* const out = const_cast<unsigned char*>(outgoing.bytes.data());
  for (std::size_t step = 1; step < ranks; ++step) {
    const std::size_t from = (me + ranks - step) % ranks;
    post(Way::in, incoming.bytes.data() + incoming.begin[from], size_of(incoming, from),
         static_cast<int>(from));
  }
  for (std::size_t step = 1; step < ranks; ++step) {  // each rank begins with another one, to spread the load
    const std::size_t to = (me + step) % ranks;
    post(Way::out, out + outgoing.begin[to], size_of(outgoing, to), static_cast<int>(to));
  }
  if (size_of(outgoing, me) > 0)
    std::memcpy(incoming.bytes.data() + incoming.begin[me], out + outgoing.begin[me], size_of(outgoing, me));
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

/// Posts messages to or from another rank. If the capacity of under_way_ is used up, waits for the messages
/// under way first. That happens in scatter and gather only, where both sides have the same order of
/// messages: no deadlock.
void MpiCommunicator::post(Way way, void* bytes, std::size_t size, int other) {
  if (way == Way::out) bytes_sent += static_cast<std::int64_t>(size);
  bytes_under_way_ += size;
  for (std::size_t at = 0; at < size; at += longest_message_) {
    if (under_way_.size() == under_way_.capacity()) finish();
    auto* const begin = static_cast<unsigned char*>(bytes) + at;
    const auto length = static_cast<int>(std::min(longest_message_, size - at));
    MPI_Request* const request = &under_way_.emplace_back();
    check(way == Way::out ? MPI_Isend(begin, length, MPI_BYTE, other, tag_, comm_, request)
                          : MPI_Irecv(begin, length, MPI_BYTE, other, tag_, comm_, request));
  }
}

void MpiCommunicator::finish() {
  wait(under_way_.data(), static_cast<int>(under_way_.size()), bytes_under_way_);
  under_way_.clear();
  bytes_under_way_ = 0;
}

void MpiCommunicator::start(Way way_of_root, void* all, const std::vector<std::size_t>& begin, void* mine,
                            std::size_t size, int root) {
  if (rank_ != root) return post(way_of_root == Way::out ? Way::in : Way::out, mine, size, root);
  for (int r = 0; r < size_; ++r) {
    const std::size_t from = begin[static_cast<std::size_t>(r)], to = begin[static_cast<std::size_t>(r) + 1];
    if (r != root) post(way_of_root, static_cast<unsigned char*>(all) + from, to - from, r);
  }
}

}  // namespace pstripack
