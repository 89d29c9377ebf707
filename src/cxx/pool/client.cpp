#include "pool/client.h"

#include <dlfcn.h>
#include <unistd.h>

#include <atomic>
#include <cstdio>
#include <cstdlib>
#include <cstring>

#include "observe/report.h"
#include "pool/area_layout.h"

#ifdef _OPENMP
#include <omp.h>
#endif

#include "base/environment.h"
#include "base/parallel_for.h"
#include "base/shared_area.h"
#include "lists/limits.h"
#include "pool/channel.h"
#include "pool/messages.h"
#include "trmesh/trmesh.h"

namespace pstripack {
namespace {

/// Calls with fewer nodes stay on the model's own threads: waking the workers and copying nodes and lists
/// would take as long as the triangulation itself.
constexpr std::int32_t kFewestNodes = 50000;

/// The process that the pool serves. A forked child must not use the connection, which it shares with its
/// parent.
const pid_t loaded_in = getpid();

/// Settings from the environment, read when the library is loaded, because the model may change it later.
struct Settings {
  char pool[100] = "";
  std::int32_t fewest_nodes = kFewestNodes;

  Settings() {
    const char* const name = environment_variable("PSTRIPACK_POOL");
    if (name != nullptr && std::strlen(name) < sizeof pool) std::strcpy(pool, name);
    // Only for tests, whose calls are small.
    if (const char* const fewest = environment_variable("PSTRIPACK_POOL_MIN_NODES"))
      fewest_nodes = std::atoi(fewest) < 3 ? 3 : std::atoi(fewest);
  }
};
const Settings settings;

/// True, with a message, if the program uses MPI itself: then its calls run on threads, unless it uses comm
/// mode.
bool program_uses_mpi() {
  if (dlsym(RTLD_DEFAULT, "MPI_Init") == nullptr && dlsym(RTLD_DEFAULT, "mpi_init_") == nullptr) return false;
  std::fputs(
      "pstripack: pool: this program uses MPI itself, so its trmesh runs on threads; for ranks call "
      "pstripack_set_comm\n",
      stderr);
  return true;
}

/// The connection to the pool, for one call at a time.
class Pool {
 public:
  /// False if the call was not carried out; then nothing is written.
  bool trmesh(const pstripack_trmesh_arguments& call, PoolReply& reply);

 private:
  bool is_open() {
    if (!tried_) {
      tried_ = true;
      if (!program_uses_mpi()) socket_ = connect_to(settings.pool);
    }
    return static_cast<bool>(socket_);
  }

  bool tried_ = false;
  Descriptor socket_;
  SharedArea area_;  ///< kept from the largest call so far, because new pages cost as much as copying
};

void copy(void* to, const void* from, std::size_t size) {
  constexpr std::size_t kBytesIn10Nanoseconds = 64;
  parallel_pieces(
      size, threads_for(size / kBytesIn10Nanoseconds), [&](std::size_t begin, std::size_t end, int) {
        std::memcpy(static_cast<char*>(to) + begin, static_cast<const char*>(from) + begin, end - begin);
      });
}

/// True if the lengths in the reply are possible for n nodes.
bool fits(const PoolReply& reply, std::int32_t n) {
  return reply.done == 0 || reply.ier < 0 ||
         (1 <= reply.lnew && reply.lnew - 1 <= 6 * (n - 2) &&  // 6n itself may overflow
          (reply.ier == 0 || (1 <= reply.other && reply.other <= n)));
}

bool Pool::trmesh(const pstripack_trmesh_arguments& call, PoolReply& reply) {
  if (!is_open()) return false;
  const AreaLayout layout(call.n, call.real_bytes);
  int new_area = -1;
  if (area_.size() < layout.size()) {
    area_ = SharedArea();
    area_ = SharedArea::create(layout.size());
    if (area_.data() == nullptr) return false;
    new_area = area_.file().get();
  }
  void* const area = area_.data();
  const auto n = static_cast<std::size_t>(call.n);
  const void* const xyz[] = {call.x, call.y, call.z};
  const std::size_t bytes = n * static_cast<std::size_t>(call.real_bytes);
  for (int axis = 0; axis < 3; ++axis) copy(layout.coordinate(area, axis), xyz[axis], bytes);

  PoolRequest request;
  request.real_bytes = call.real_bytes;
  request.n = call.n;
  request.wants_cost = call.report != nullptr ? 1 : 0;
  if (!send_packet(socket_, &request, sizeof request, &new_area, 1) ||
      !receive_packet(socket_, &reply, sizeof reply) || !fits(reply, call.n)) {
    // The pool has ended, or the model has closed the descriptor. Do not close it: it may be another file's.
    socket_.release();
    area_ = SharedArea();
    return false;
  }
  area_.close_file();
  if (reply.done == 0) {
    area_ = SharedArea();
    return false;
  }
  if (reply.ier >= 0) {
    const std::size_t slots = static_cast<std::size_t>(reply.lnew) - 1;
    const ListArrays lists = layout.call(area, nullptr).lists;
    copy(call.list, lists.list, slots * sizeof(std::int32_t));
    copy(call.lptr, lists.lptr, slots * sizeof(std::int32_t));
    // L > 0: the lists of nodes 1..M-1.
    const std::size_t listed = reply.ier > 0 ? static_cast<std::size_t>(reply.other) - 1 : n;
    copy(call.lend, lists.lend, listed * sizeof(std::int32_t));
    *call.lnew = reply.lnew;
  }
  return true;
}

/// Never freed, because the model may call TRMESH from its exit handlers.
Pool* const pool = settings.pool[0] != '\0' ? new Pool : nullptr;
std::atomic_flag pool_is_busy = ATOMIC_FLAG_INIT;

}  // namespace

int pool_trmesh(const pstripack_trmesh_arguments* call, int32_t* ier, int64_t* node, int64_t* other) {
  if (pool == nullptr || call->n < settings.fewest_nodes || call->n > most_nodes<std::int32_t>() ||
      getpid() != loaded_in)
    return PSTRIPACK_ENGINE_DECLINES;
#ifdef _OPENMP
  if (omp_in_parallel()) return PSTRIPACK_ENGINE_DECLINES;
#endif
  // If another thread's call is under way, this one runs on threads instead of waiting.
  if (pool_is_busy.test_and_set(std::memory_order_acquire)) return PSTRIPACK_ENGINE_DECLINES;
  PoolReply reply;
  const bool done = pool->trmesh(*call, reply);
  pool_is_busy.clear(std::memory_order_release);
  if (!done) return PSTRIPACK_ENGINE_DECLINES;
  if (call->report != nullptr) {
    call->report->mode = CallReport::by_pool;
    call->report->ranks = reply.ranks;
    call->report->cost = reply.cost;
  }
  *ier = reply.ier;
  *node = reply.node;
  *other = reply.other;
  return PSTRIPACK_ENGINE_DID_IT;
}

}  // namespace pstripack
