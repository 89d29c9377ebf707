#include "pool/client.h"

#include <dlfcn.h>
#include <unistd.h>

#include <atomic>
#include <cstdio>
#include <cstdlib>
#include <cstring>

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

/// The connection to the pool, for one call at a time.
class Pool final : public Engine {
 public:
  bool takes(const TrmeshCall& call) noexcept override {
    if (call.by_direction || call.n < settings.fewest_nodes || call.n > most_nodes<std::int32_t>() ||
        getpid() != loaded_in)
      return false;
#ifdef _OPENMP
    if (omp_in_parallel()) return false;
#endif
    // If another thread's call is under way, this one runs on threads instead of waiting.
    if (is_busy_.test_and_set(std::memory_order_acquire)) return false;
    if (!tried_) {
      tried_ = true;
      if (!program_uses_mpi()) socket_ = connect_to(settings.pool);
    }
    if (!socket_) is_busy_.clear(std::memory_order_release);
    return static_cast<bool>(socket_);
  }

  TrmeshResult carry_out(const TrmeshCall& call, CallWay* way) override {
    const struct Claim {
      std::atomic_flag& flag;
      ~Claim() { flag.clear(std::memory_order_release); }
    } claim{is_busy_};
    const AreaLayout layout(call.n, static_cast<std::int32_t>(call.nodes.real_bytes()));
    const PoolReply reply = reply_to(call, layout, way != nullptr);
    if (way != nullptr) way->mode = CallWay::by_pool, way->ranks = reply.ranks, way->cost = reply.cost;
    if (reply.ier >= 0) {
      const auto& [list, lptr, lend, lnew] = layout.call(area_.data(), nullptr).lists;
      const std::size_t slots = static_cast<std::size_t>(reply.lnew) - 1;
      copy(call.lists.list, list, slots * sizeof(std::int32_t));
      copy(call.lists.lptr, lptr, slots * sizeof(std::int32_t));
      // L > 0: the lists of nodes 1..M-1.
      const auto listed = static_cast<std::size_t>(reply.ier > 0 ? reply.other - 1 : call.n);
      copy(call.lists.lend, lend, listed * sizeof(std::int32_t));
      *call.lists.lnew = reply.lnew;
    }
    return {reply.ier, reply.node, reply.other};
  }

 private:
  /// Asks the pool for the lists, which are then in the area. Throws PoolIsGone.
  PoolReply reply_to(const TrmeshCall& call, const AreaLayout& layout, bool wants_cost) {
    int new_area = -1;
    if (area_.size() < layout.size()) {
      area_ = SharedArea();
      area_ = SharedArea::create(layout.size());
      if (area_.data() == nullptr) throw PoolIsGone{};
      new_area = area_.file().get();
    }
    const std::size_t bytes = static_cast<std::size_t>(call.n) * call.nodes.real_bytes();
    for (int axis = 0; axis < 3; ++axis)
      copy(layout.coordinate(area_.data(), axis), call.nodes.array(axis), bytes);

    PoolRequest request;
    request.real_bytes = static_cast<std::int32_t>(call.nodes.real_bytes());
    request.n = call.n;
    request.wants_cost = wants_cost ? 1 : 0;
    PoolReply reply;
    if (!send_packet(socket_, &request, sizeof request, new_area) ||
        !receive_packet(socket_, &reply, sizeof reply) || !fits(reply, call.n)) {
      // The pool has ended, or the model has closed the descriptor. Do not close it: it may be another
      // file's.
      socket_.release();
      reply.done = 0;
    }
    area_.close_file();
    if (reply.done != 0) return reply;
    area_ = SharedArea();
    throw PoolIsGone{};
  }

  bool tried_ = false;
  Descriptor socket_;
  SharedArea area_;  ///< of the largest call so far, because new pages cost as much as copying
  std::atomic_flag is_busy_ = ATOMIC_FLAG_INIT;
};

/// Never freed, because the model may call TRMESH from its exit handlers.
Pool* const pool = settings.pool[0] != '\0' ? new Pool : nullptr;

}  // namespace

Engine* pool_engine() noexcept { return pool; }

}  // namespace pstripack
