#include "mpi.h"

#include <sys/mman.h>
#include <ucontext.h>

#include <algorithm>
#include <cstdlib>
#include <cstring>
#include <deque>
#include <stdexcept>
#include <vector>

namespace {

/// Memory of messages under way, by the binary logarithm of its size: malloc would find that of all ranks
/// mixed.
class Pool {
 public:
  unsigned char* take(std::size_t size) {
    std::vector<unsigned char*>& free = free_[log2(size)];
    if (free.empty()) return static_cast<unsigned char*>(std::malloc(std::size_t{1} << log2(size)));
    unsigned char* const bytes = free.back();
    free.pop_back();
    return bytes;
  }
  void give_back(unsigned char* bytes, std::size_t size) { free_[log2(size)].push_back(bytes); }

 private:
  static int log2(std::size_t size) { return 64 - __builtin_clzll(size | 63); }
  std::vector<unsigned char*> free_[65];
};

struct Message {
  int from;
  unsigned char* bytes;
  std::size_t size;
};
struct Request {
  enum Kind { sent, receive, broadcast } kind;
  void* bytes;
  std::size_t size;
  int other;  ///< the sender, or the root
};
struct Rank {
  ucontext_t context;
  void* stack = nullptr;
  std::vector<Message> arrived;
  int waits_for = -1;  ///< a message of this rank
  std::vector<Request> requests;
  many_ranks::Traffic sent;
};

constexpr std::size_t kStack = std::size_t{1} << 20;
std::vector<Rank> ranks;
std::deque<int> ready;
Pool pool;
int current = 0, unfinished = 0;
ucontext_t scheduler;
const std::function<void()>* body_of_rank = nullptr;

Rank& me() { return ranks[static_cast<std::size_t>(current)]; }

void send(int to, const void* bytes, std::size_t size) {
  Rank& other = ranks[static_cast<std::size_t>(to)];
  other.arrived.push_back({current, pool.take(size), size});
  std::memcpy(other.arrived.back().bytes, bytes, size);
  ++me().sent.messages;
  me().sent.bytes += static_cast<std::int64_t>(size);
  if (other.waits_for != current) return;
  other.waits_for = -1;
  ready.push_back(to);
}

void receive(int from, void* bytes, std::size_t size) {
  for (;;) {
    std::vector<Message>& all = me().arrived;
    const auto m = std::find_if(all.begin(), all.end(), [&](const Message& a) { return a.from == from; });
    if (m != all.end()) {
      std::memcpy(bytes, m->bytes, std::min(size, m->size));
      pool.give_back(m->bytes, m->size);
      all.erase(m);
      return;
    }
    me().waits_for = from;
    swapcontext(&me().context, &scheduler);
  }
}

/// Down a binomial tree.
void broadcast(void* bytes, std::size_t size, int root) {
  const int count = static_cast<int>(ranks.size()), place = (current + count - root) % count;
  int bit = 1;
  while (bit < count && (place & bit) == 0) bit *= 2;
  if (place != 0) receive((place - bit + root) % count, bytes, size);
  for (bit /= 2; bit > 0; bit /= 2)
    if (place + bit < count) send((place + bit + root) % count, bytes, size);
}

int post(const Request& request) {
  me().requests.push_back(request);
  return static_cast<int>(me().requests.size()) - 1;
}

void start() {
  (*body_of_rank)();
  --unfinished;
  swapcontext(&me().context, &scheduler);
}

}  // namespace

int MPI_Comm_rank(MPI_Comm comm, int* rank) { return *rank = comm == MPI_COMM_SELF ? 0 : current, 0; }
int MPI_Comm_size(MPI_Comm comm, int* size) {
  return *size = comm == MPI_COMM_SELF ? 1 : static_cast<int>(ranks.size()), 0;
}
int MPI_Isend(const void* bytes, int size, int, int to, int, MPI_Comm, MPI_Request* request) {
  send(to, bytes, static_cast<std::size_t>(size));
  return *request = post({Request::sent, nullptr, 0, 0}), 0;
}
int MPI_Irecv(void* bytes, int size, int, int from, int, MPI_Comm, MPI_Request* request) {
  return *request = post({Request::receive, bytes, static_cast<std::size_t>(size), from}), 0;
}
int MPI_Ibcast(void* bytes, int size, int, int root, MPI_Comm, MPI_Request* request) {
  return *request = post({Request::broadcast, bytes, static_cast<std::size_t>(size), root}), 0;
}
/// `requests` are all that this rank has posted.
int MPI_Testall(int, MPI_Request*, int* done, std::nullptr_t) {
  for (const Request& r : me().requests) {
    if (r.kind == Request::receive) receive(r.other, r.bytes, r.size);
    if (r.kind == Request::broadcast) broadcast(r.bytes, r.size, r.other);
  }
  me().requests.clear();
  return *done = 1, 0;
}
int MPI_Abort(MPI_Comm, int code) { std::exit(code); }

namespace many_ranks {

Traffic sent() { return me().sent; }

void run(int count, const std::function<void()>& body) {
  ranks = std::vector<Rank>(static_cast<std::size_t>(count));
  body_of_rank = &body;
  unfinished = count;
  for (int r = 0; r < count; ++r) {
    Rank& rank = ranks[static_cast<std::size_t>(r)];
    rank.stack =
        mmap(nullptr, kStack, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE, -1, 0);
    if (rank.stack == MAP_FAILED) throw std::bad_alloc();
    getcontext(&rank.context);
    rank.context.uc_stack.ss_sp = rank.stack;
    rank.context.uc_stack.ss_size = kStack;
    rank.context.uc_link = nullptr;
    makecontext(&rank.context, start, 0);
    ready.push_back(r);
  }
  while (!ready.empty()) {
    current = ready.front();
    ready.pop_front();
    swapcontext(&scheduler, &me().context);
  }
  if (unfinished > 0) throw std::runtime_error("ranks wait for each other");
  for (Rank& rank : ranks) munmap(rank.stack, kStack);
}

}  // namespace many_ranks
