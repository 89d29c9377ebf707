#include "pool/steward.h"

#include <errno.h>
#include <fcntl.h>
#include <poll.h>
#include <signal.h>
#include <stdlib.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/signalfd.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <cstring>
#include <string>
#include <utility>

#ifdef _OPENMP
#include <omp.h>
#endif

#include "base/environment.h"
#include "mpi/collective_trmesh.h"
#include "pool/area_layout.h"

namespace pstripack {
namespace {

/// Sent by rank 0 to the workers: a call of TRMESH, or the end.
struct Order {
  std::int32_t real_bytes = 0;  ///< 4 or 8, the size of the nodes' reals; 0: the end
  std::int32_t n = 0;
  std::int64_t area = 0;    ///< number of the area that holds the arrays
  SharedArea::Name name{};  ///< its name, if it is new
};

void tell_workers(const Order& order) { tell_others(&order, sizeof order); }

/// Collective. True if every rank has mapped the area: then all read and write the arrays there, and none
/// are sent.
bool all_share(MpiCommunicator& ranks, const SharedArea& area, const Order& order) {
  std::int64_t seen = area.size() >= AreaLayout(order.n, order.real_bytes).size() ? 1 : 0;
  ranks.all_min(&seen, 1);
  return seen != 0;
}

/// Carries out one call, on any rank. `area`: null if this rank has not mapped it.
TrmeshResult carry_out(MpiCommunicator& ranks, Arrays arrays, const Order& order, void* area, LastCall& last,
                       std::int32_t* lnew = nullptr, GroupCost* cost = nullptr) {
  TrmeshCall call;
  call.nodes = NodeArrays(static_cast<std::size_t>(order.real_bytes), nullptr, nullptr, nullptr);
  if (area != nullptr) call = AreaLayout(order.n, order.real_bytes).call(area, lnew);
  return collective_trmesh(ranks, arrays, call, cost, &last);
}

/// The environment of pstripack-run, from the file that it sent: NAME=VALUE, each closed by a zero. It has no
/// variables of MPI, so a model that uses MPI itself is a single process, as without the pool.
std::vector<char*> environment_in(const Descriptor& file) {
  std::vector<char*> all;
  struct stat status;
  if (fstat(file.get(), &status) != 0 || status.st_size == 0) return all;
  const auto size = static_cast<std::size_t>(status.st_size);
  void* const text = mmap(nullptr, size, PROT_READ, MAP_PRIVATE, file.get(), 0);
  if (text == MAP_FAILED) return all;
  for (char* at = static_cast<char*>(text); at < static_cast<char*>(text) + size; at += strlen(at) + 1)
    all.push_back(at);
  return all;
}

/// Used if that file is missing: this process's environment without the variables that mpirun added.
std::vector<char*> environment_without_mpi() {
  std::vector<char*> all;
  for (char** at = environ; *at != nullptr; ++at)
    if (!is_from_mpi_launcher(*at)) all.push_back(*at);
  return all;
}

}  // namespace

Steward::Steward(char** command) {
  Descriptor from_launcher[4];
  if (const char* const name = environment_variable("PSTRIPACK_POOL_LAUNCHER")) {
    launcher_ = connect_to(name);
    char hello = 0;
    if (launcher_ && !receive_packet(launcher_, &hello, 1, from_launcher, 4)) launcher_.reset();
  }
  listener_ = listen_under_new_name(&name_);
  if (!listener_) std::perror("pstripack: pool: no socket, trmesh runs on threads");

  sigset_t child, before;
  sigemptyset(&child);
  sigaddset(&child, SIGCHLD);
  sigprocmask(SIG_BLOCK, &child, &before);
  child_signals_.reset(signalfd(-1, &child, SFD_CLOEXEC));
  const pid_t me = getpid();
  model_ = fork();
  if (model_ == 0 && (prctl(PR_SET_PDEATHSIG, SIGKILL) != 0 || getppid() != me)) _exit(128 + SIGKILL);
  if (model_ == 0) become_the_model(command, from_launcher, before);
  if (model_ < 0) {
    std::perror("pstripack-worker: fork");
    status_ = 126 << 8;
  }
  const ModelNews news{static_cast<std::int32_t>(model_), 0, 0};
  if (launcher_ && model_ > 0) send_packet(launcher_, &news, sizeof news);
}

void Steward::become_the_model(char** command, Descriptor (&from_launcher)[4],
                               const sigset_t& signals) const {
  for (const int signal : {SIGUSR1, SIGUSR2, SIGTERM}) ::signal(signal, SIG_DFL);
  sigprocmask(SIG_SETMASK, &signals, nullptr);
  for (int fd = 0; fd < 3; ++fd)
    if (from_launcher[fd]) dup2(from_launcher[fd].get(), fd);
  std::vector<char*> environment = environment_in(from_launcher[3]);
  if (environment.empty()) environment = environment_without_mpi();
  std::string pool = "PSTRIPACK_POOL=" + name_;
  const auto is_ours = [](const char* variable) {
    return strncmp(variable, "PSTRIPACK_POOL=", 15) == 0 ||
           strncmp(variable, "PSTRIPACK_POOL_LAUNCHER=", 24) == 0;
  };
  environment.erase(std::remove_if(environment.begin(), environment.end(), is_ours), environment.end());
  environment.push_back(pool.data());
  environment.push_back(nullptr);
  execvpe(command[0], command, environment.data());
  const int error = errno;
  std::fprintf(stderr, "pstripack-run: %s: %s\n", command[0], strerror(error));
  _exit(error == ENOENT ? 127 : 126);
}

bool Steward::model_has_ended() {
  if (model_ < 0) return true;
  if (waitpid(model_, &status_, WNOHANG) != model_) return false;
  model_ = -1;
  const ModelNews news{0, 1, status_};
  told_ = launcher_ && send_packet(launcher_, &news, sizeof news);
  return true;
}

void Steward::see_the_model_end() {
  const timespec nap{0, 1000000};
  while (!model_has_ended()) nanosleep(&nap, nullptr);
}

int Steward::serve(MpiCommunicator& ranks) {
  std::vector<pollfd> events;
  while (!model_has_ended()) {
    ranks.set_phase("its wait for a call");
    events = {{child_signals_.get(), POLLIN, 0}, {listener_.get(), POLLIN, 0}};
    for (const Client& client : clients_) events.push_back({client.socket.get(), POLLIN, 0});
    if (poll(events.data(), events.size(), -1) < 0) continue;

    signalfd_siginfo ignored;
    if (events[0].revents != 0 && read(child_signals_.get(), &ignored, sizeof ignored) < 0) continue;
    for (std::size_t i = clients_.size(); i-- > 0;)
      if (events[i + 2].revents != 0 && !serve(clients_[i], ranks))
        clients_.erase(clients_.begin() + static_cast<std::ptrdiff_t>(i));
    if (events[1].revents != 0)
      if (Descriptor socket = accept_from(listener_)) clients_.push_back({std::move(socket), {}});
  }
  clients_.clear();
  tell_workers({});
  if (told_) return 0;
  return WIFEXITED(status_) ? WEXITSTATUS(status_) : 128 + WTERMSIG(status_);
}

bool Steward::serve(Client& client, MpiCommunicator& ranks) {
  PoolRequest request;
  Descriptor new_area;
  if (!receive_packet(client.socket, &request, sizeof request, &new_area, 1)) return false;
  if (new_area) {
    client.area = SharedArea();
    client.area = SharedArea::map(std::move(new_area));
    client.area_number = ++areas_;
  }
  PoolReply reply;
  if (request.format != PoolRequest::kFormat || (request.real_bytes != 4 && request.real_bytes != 8) ||
      request.n < 3 || client.area.size() < AreaLayout(request.n, request.real_bytes).size())
    return send_packet(client.socket, &reply, sizeof reply);

  ranks.set_phase("the start of a call");
  Order order{request.real_bytes, request.n, client.area_number, client.area.name()};
  tell_workers(order);
  TrmeshResult result{0};
  try {
    const Arrays arrays = all_share(ranks, client.area, order) ? Arrays::shared : Arrays::on_one_rank;
    client.area.close_file();  // every rank that can map it has done so
    result = carry_out(ranks, arrays, order, client.area.data(), last_call_, &reply.lnew,
                       request.wants_cost != 0 ? &reply.cost : nullptr);
  } catch (const AgreedFailure& failure) {
    result = {failure.code};
  }
  ranks.set_phase("the answer to a call");
  reply.done = 1;
  reply.ranks = ranks.size();
  reply.ier = result.ier;
  reply.node = result.node;
  reply.other = result.other;
  return send_packet(client.socket, &reply, sizeof reply);
}

void serve_as_worker(MpiCommunicator& ranks, bool beside_rank_0) {
  SharedArea area;
  std::int64_t area_number = 0;
  LastCall last_call;
  for (;;) {
    ranks.set_phase("its wait for a call");
    Order order;
    wait_for_rank_0(&order, sizeof order);
    if (order.real_bytes == 0) return;
    if (order.area != area_number) {
      area = SharedArea();
      if (beside_rank_0) area = SharedArea::map(order.name.text);
      area.close_file();
      area_number = order.area;
    }
    try {
      const bool shared = all_share(ranks, area, order);
      carry_out(ranks, shared ? Arrays::shared : Arrays::on_one_rank, order, shared ? area.data() : nullptr,
                last_call);
    } catch (const AgreedFailure&) {
      // Rank 0 tells the model; the next call may succeed.
    }
  }
}

void share_processors([[maybe_unused]] const RanksOfMachine& here) {
#ifdef _OPENMP
  if (environment_variable("OMP_NUM_THREADS") == nullptr)
    omp_set_num_threads(std::max(1, omp_get_num_procs() / here.count));
#endif
}

}  // namespace pstripack
