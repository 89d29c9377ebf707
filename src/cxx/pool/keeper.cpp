#include "pool/keeper.h"

#include <errno.h>
#include <poll.h>
#include <signal.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/signalfd.h>
#include <sys/socket.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <utility>
#include <vector>

#include "base/environment.h"
#include "pool/channel.h"

namespace pstripack {
namespace {

using Clock = std::chrono::steady_clock;

/// A batch system sends a signal to all processes of a job within this time.
constexpr std::chrono::milliseconds kAtOnce{50};
/// From SIGTERM to SIGKILL, where the model must end.
constexpr std::chrono::seconds kPatience{2};

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

[[noreturn]] void become_the_model(char** command, const std::string& pool_name, const Launcher& launcher,
                                   const sigset_t& signals) {
  for (int s = 1; s < NSIG && launcher.socket; ++s)
    signal(s, launcher.greeting.ignores(s) ? SIG_IGN : SIG_DFL);
  sigprocmask(SIG_SETMASK, &signals, nullptr);
  std::vector<char*> environment = environment_in(launcher.files[3]);
  if (environment.empty()) environment = environment_without_mpi();
  std::string pool = "PSTRIPACK_POOL=" + pool_name;
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

/// Waits for the end of the model, as start_keeper() says.
class Keeper {
 public:
  Keeper(pid_t model, const Descriptor& signals, Launcher launcher, Descriptor rank_0)
      : model_(model),
        signals_(signals),
        greeting_(launcher.greeting),
        launcher_(std::move(launcher.socket)),
        rank_0_(std::move(rank_0)),
        has_launcher_(launcher_) {}

  /// Until the model has ended.
  void keep() {
    ModelEnd end;
    while (waitpid(model_, &end.status, WNOHANG) != model_) wait_for_news();
    for (const Descriptor* const socket : {&launcher_, &rank_0_}) send_packet(*socket, &end, sizeof end);
    if (kills_) kill(0, SIGKILL);  // what the model has started
  }

 private:
  void wait_for_news() {
    pollfd events[] = {{signals_.get(), POLLIN, 0}, {launcher_.get(), POLLIN, 0}, {rank_0_.get(), POLLIN, 0}};
    const bool has_plans = waiting_ != 0 || must_end();
    if (poll(events, 3, has_plans ? 10 : -1) < 0) return;
    const Clock::time_point now = Clock::now();
    signalfd_siginfo arrived;
    if (events[0].revents != 0 && read(signals_.get(), &arrived, sizeof arrived) > 0)
      note_arrival(arrived, now);
    SignalForModel sent;
    for (int i : {1, 2}) {
      Descriptor& sender = i == 1 ? launcher_ : rank_0_;
      if (events[i].revents == 0) continue;
      if (receive_packet(sender, &sent, sizeof sent))
        receive(sent.number, now);
      else
        sender.reset();
    }
    if (must_end() && kill_at_ == Clock::time_point::max()) {
      kill_at_ = now + kPatience;
      pass_on_soon(SIGTERM, now);
    }
    if (waiting_ != 0 && now >= pass_at_) pass_on(now);
    if (must_end() && now >= kill_at_) kill_model();
  }

  bool must_end() const { return (has_launcher_ && !launcher_) || (!rank_0_ && !told_); }

  /// Signals to this process: if not from itself, they went to the whole group, session or job.
  void note_arrival(const signalfd_siginfo& arrived, Clock::time_point now) {
    const auto number = static_cast<int>(arrived.ssi_signo);
    if (number == SIGCHLD || static_cast<pid_t>(arrived.ssi_pid) == getpid()) return;
    arrived_[number] = now;
    told_ = told_ || greeting_.tells_to_end(number);
  }

  void receive(int number, Clock::time_point now) {
    told_ = told_ || greeting_.tells_to_end(number);
    if (number == SIGKILL)
      kill_model();
    else
      pass_on_soon(number, now);
  }

  void kill_model() {
    kills_ = true;
    kill(model_, SIGKILL);
  }

  void pass_on_soon(int number, Clock::time_point now) {
    if (number == waiting_) return;
    if (waiting_ != 0) pass_on(now);
    waiting_ = number;
    pass_at_ = now + kAtOnce;
  }

  void pass_on(Clock::time_point now) {
    const Clock::time_point arrived = std::exchange(arrived_[waiting_], Clock::time_point());
    if (arrived + std::chrono::seconds(1) < now) kill(0, waiting_);
    waiting_ = 0;
  }

  const pid_t model_;
  const Descriptor& signals_;
  const Greeting greeting_;
  Descriptor launcher_, rank_0_;
  const bool has_launcher_;
  bool told_ = false;                  ///< the model has been told to end, not by this process
  bool kills_ = false;                 ///< it was killed by this process
  int waiting_ = 0;                    ///< signal to be passed on; 0: none
  Clock::time_point pass_at_;          ///< when it is
  Clock::time_point arrived_[NSIG]{};  ///< when signals have come to the whole group
  Clock::time_point kill_at_ = Clock::time_point::max();
};

}  // namespace

Descriptor start_keeper(char** command, const std::string& pool, Launcher launcher, Descriptor& listener) {
  int ends[2];
  if (socketpair(AF_UNIX, SOCK_SEQPACKET | SOCK_CLOEXEC, 0, ends) != 0) return {};
  Descriptor to_keeper(ends[0]), to_rank_0(ends[1]);
  const pid_t keeper = fork();
  if (keeper < 0) return {};
  if (keeper != 0) return to_keeper;

  to_keeper.reset();
  listener.reset();
  setpgid(0, 0);
  prctl(PR_SET_NAME, "pstripack-keep");
  sigset_t all, before;
  sigfillset(&all);
  sigprocmask(SIG_SETMASK, &all, &before);
  const Descriptor signals(signalfd(-1, &all, SFD_CLOEXEC));
  for (int fd = 0; fd < 3; ++fd)
    if (launcher.files[fd]) dup2(launcher.files[fd].get(), fd);
  const pid_t me = getpid(), model = fork();
  if (model == 0 && (prctl(PR_SET_PDEATHSIG, SIGKILL) != 0 || getppid() != me)) _exit(128 + SIGKILL);
  if (model == 0) become_the_model(command, pool, launcher, before);
  if (model > 0) {
    for (Descriptor& file : launcher.files) file.reset();
    Keeper(model, signals, std::move(launcher), std::move(to_rank_0)).keep();
  } else {
    std::perror("pstripack-run: fork");
  }
  _exit(0);
}

}  // namespace pstripack
