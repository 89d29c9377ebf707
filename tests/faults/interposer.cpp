// Interposes between a program and MPI (LD_PRELOAD, MPI's profiling interface) and causes faults of networks,
// schedulers or operators, as requested in the environment:
//
//   FAULT_SEED=n               messages are late: nonblocking sends and receives begin later and in another
//                              order, their completion is reported later, and calls take a random time,
//                              by a generator with seed n + rank
//   FAULT_STOP=rank:k:ms       stops the rank (SIGSTOP) at its k-th call for this number of milliseconds
//   FAULT_KILL=rank:k          kills the rank (SIGKILL) at its k-th call
//   FAULT_COUNT=prefix         each rank writes its number of calls to the file prefix.rank
//
// Only calls that begin something count: sends, receives, collectives. The number of tests for completion
// differs from run to run.
//
// MPI's guarantees are kept. Messages from one rank to another, in one communicator with one tag, match in
// the order in which they were sent and received. All that has begun progresses while the program waits in
// any call.

#include <mpi.h>
#include <signal.h>
#include <time.h>

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <random>
#include <string>

namespace {

struct Fault {
  int rank = -1;
  long call = 0, milliseconds = 0;

  explicit Fault(const char* variable) {
    if (const char* const text = std::getenv(variable))
      std::sscanf(text, "%d:%ld:%ld", &rank, &call, &milliseconds);
  }
};

/// A message that has not begun yet.
struct Message {
  bool is_send = false;
  void* data = nullptr;
  int count = 0;
  MPI_Datatype type = MPI_BYTE;
  int other = 0, tag = 0;
  MPI_Comm comm = MPI_COMM_NULL;
  std::intptr_t number = 0;  ///< the request that the program gets: odd, unlike any handle of MPI
  MPI_Request request = MPI_REQUEST_NULL;  ///< MPI's request, once the message has begun
  bool has_begun = false;

  void begin() {
    if (is_send)
      PMPI_Isend(data, count, type, other, tag, comm, &request);
    else
      PMPI_Irecv(data, count, type, other, tag, comm, &request);
    has_begun = true;
  }
  bool must_precede(const Message& later) const {
    return is_send == later.is_send && comm == later.comm && tag == later.tag && other == later.other;
  }
};

/// Allocates no memory, since the program may test what happens without memory.
class Interposer {
 public:
  /// To be called by every call that begins something.
  void call() {
    ++calls_;
    pause();
    if (is_at(kill_)) raise(SIGKILL);
    if (is_at(stop_)) stop_for(stop_.milliseconds);
  }

  int hold(Message message, MPI_Request* request) {
    if (!is_late_) {
      message.begin();
      *request = message.request;
      return MPI_SUCCESS;
    }
    message.number = last_number_ += 2;
    if (count_ == kMost) std::abort();
    messages_[count_++] = message;
    *request = handle(message);
    return MPI_SUCCESS;
  }

  /// Begins all delayed messages, or some of them, in any allowed order.
  void release(bool all) {
    for (bool more = true; more;) {
      more = false;
      Message* next[kMost];  // messages that may begin next
      Message** end = next;
      for (Message* m = begin(); m != this->end(); ++m)
        if (!m->has_begun && is_first(*m)) *end++ = m;
      std::shuffle(next, end, random_);
      for (Message** m = next; m != end; ++m)
        if (all || random_() % 4 == 0) {
          (*m)->begin();
          more = true;
        }
    }
  }

  /// True if all requests have begun; they are then replaced by MPI's.
  bool resolve(int count, MPI_Request* requests) {
    for (int i = 0; i < count; ++i)
      if (const Message* const m = message_of(requests[i]); m != nullptr && !m->has_begun) return false;
    for (int i = 0; i < count; ++i)
      if (Message* const m = message_of(requests[i])) {
        requests[i] = m->request;
        std::copy(m + 1, end(), m);
        --count_;
      }
    return true;
  }

  /// True at random: a completion is then not reported yet.
  bool denies() { return is_late_ && random_() % 2 == 0; }

  void at_init() {
    PMPI_Comm_rank(MPI_COMM_WORLD, &rank_);
    if (const char* const seed = std::getenv("FAULT_SEED")) {
      is_late_ = true;
      random_.seed(static_cast<unsigned>(std::atoi(seed) + 1000 * rank_));
    }
  }
  void at_finalize() {
    release(true);
    const char* const prefix = std::getenv("FAULT_COUNT");
    if (prefix == nullptr) return;
    std::FILE* const file = std::fopen((std::string(prefix) + "." + std::to_string(rank_)).c_str(), "w");
    if (file == nullptr) return;
    std::fprintf(file, "%ld\n", calls_);
    std::fclose(file);
  }

 private:
  static constexpr std::size_t kMost = 4096;
  /// MPI_Request is a pointer or an integer, depending on the library.
  static MPI_Request handle(const Message& message) { return (MPI_Request)message.number; }
  Message* begin() { return messages_; }
  Message* end() { return messages_ + count_; }
  Message* message_of(MPI_Request request) {
    Message* const found =
        std::find_if(begin(), end(), [&](const Message& m) { return handle(m) == request; });
    return found != end() ? found : nullptr;
  }
  bool is_first(const Message& message) const {
    return std::none_of(messages_, &message,
                        [&](const Message& m) { return !m.has_begun && m.must_precede(message); });
  }
  bool is_at(const Fault& fault) const { return fault.rank == rank_ && fault.call == calls_; }

  void pause() {
    if (!is_late_ || random_() % 8 != 0) return;
    const timespec nap{0, static_cast<long>(random_() % 2000000)};
    nanosleep(&nap, nullptr);
  }

  /// Stops this process. A timer sends SIGCONT, which also reaches a stopped process.
  static void stop_for(long milliseconds) {
    sigevent event{};
    event.sigev_notify = SIGEV_SIGNAL;
    event.sigev_signo = SIGCONT;
    timer_t timer;
    const itimerspec once{{}, {milliseconds / 1000, milliseconds % 1000 * 1000000}};
    if (timer_create(CLOCK_MONOTONIC, &event, &timer) != 0 || timer_settime(timer, 0, &once, nullptr) != 0)
      std::abort();
    raise(SIGSTOP);
    timer_delete(timer);
  }

  const Fault stop_{"FAULT_STOP"}, kill_{"FAULT_KILL"};
  int rank_ = -1;
  long calls_ = 0;
  std::intptr_t last_number_ = -1;
  bool is_late_ = false;
  std::mt19937 random_;
  Message messages_[kMost];  ///< in the order in which the program began them
  std::size_t count_ = 0;
};

Interposer& interposer() {
  static Interposer one;
  return one;
}

}  // namespace

extern "C" {

int MPI_Init(int* argc, char*** argv) {
  const int code = PMPI_Init(argc, argv);
  interposer().at_init();
  return code;
}
int MPI_Init_thread(int* argc, char*** argv, int required, int* provided) {
  const int code = PMPI_Init_thread(argc, argv, required, provided);
  interposer().at_init();
  return code;
}
int MPI_Finalize() {
  interposer().call();
  interposer().at_finalize();
  return PMPI_Finalize();
}

int MPI_Isend(const void* data, int count, MPI_Datatype type, int to, int tag, MPI_Comm comm,
              MPI_Request* request) {
  interposer().call();
  return interposer().hold({true, const_cast<void*>(data), count, type, to, tag, comm}, request);
}
int MPI_Irecv(void* data, int count, MPI_Datatype type, int from, int tag, MPI_Comm comm,
              MPI_Request* request) {
  interposer().call();
  return interposer().hold({false, data, count, type, from, tag, comm}, request);
}

int MPI_Testall(int count, MPI_Request* requests, int* flag, MPI_Status* statuses) {
  interposer().release(false);
  *flag = 0;
  if (interposer().denies() || !interposer().resolve(count, requests)) return MPI_SUCCESS;
  return PMPI_Testall(count, requests, flag, statuses);
}
int MPI_Test(MPI_Request* request, int* flag, MPI_Status* status) {
  interposer().release(false);
  *flag = 0;
  if (interposer().denies() || !interposer().resolve(1, request)) return MPI_SUCCESS;
  return PMPI_Test(request, flag, status);
}
int MPI_Waitall(int count, MPI_Request* requests, MPI_Status* statuses) {
  interposer().release(true);
  interposer().resolve(count, requests);
  return PMPI_Waitall(count, requests, statuses);
}
int MPI_Wait(MPI_Request* request, MPI_Status* status) {
  interposer().release(true);
  interposer().resolve(1, request);
  return PMPI_Wait(request, status);
}

// The other calls of the library and its tests that begin something. Delayed messages must progress while
// they wait.
#define BEFORE_IT(name, parameters, arguments) \
  int MPI_##name parameters {                  \
    interposer().call();                       \
    interposer().release(true);                \
    return PMPI_##name arguments;              \
  }
BEFORE_IT(Send, (const void* data, int count, MPI_Datatype type, int to, int tag, MPI_Comm comm),
          (data, count, type, to, tag, comm))
BEFORE_IT(Recv,
          (void* data, int count, MPI_Datatype type, int from, int tag, MPI_Comm comm, MPI_Status* status),
          (data, count, type, from, tag, comm, status))
BEFORE_IT(Ibcast, (void* data, int count, MPI_Datatype type, int root, MPI_Comm comm, MPI_Request* request),
          (data, count, type, root, comm, request))
BEFORE_IT(Iallreduce,
          (const void* data, void* result, int count, MPI_Datatype type, MPI_Op op, MPI_Comm comm,
           MPI_Request* request),
          (data, result, count, type, op, comm, request))
BEFORE_IT(Bcast, (void* data, int count, MPI_Datatype type, int root, MPI_Comm comm),
          (data, count, type, root, comm))
BEFORE_IT(Allreduce, (const void* data, void* result, int count, MPI_Datatype type, MPI_Op op, MPI_Comm comm),
          (data, result, count, type, op, comm))
BEFORE_IT(Barrier, (MPI_Comm comm), (comm))
BEFORE_IT(Comm_dup, (MPI_Comm comm, MPI_Comm* other), (comm, other))
BEFORE_IT(Comm_split, (MPI_Comm comm, int colour, int key, MPI_Comm* other), (comm, colour, key, other))
BEFORE_IT(Comm_split_type, (MPI_Comm comm, int type, int key, MPI_Info info, MPI_Comm* other),
          (comm, type, key, info, other))
BEFORE_IT(Comm_free, (MPI_Comm * comm), (comm))
}
