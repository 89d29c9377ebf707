// pstripack-run: starts a serial model with a pool of MPI ranks behind it. No MPI in this program.
//
// The model should run as if it had been started here. So this program sends rank 0, over a local socket,
// what mpirun would not pass on unchanged: stdout and stderr, stdin if it is a file, and the environment.
// Signals go the same way, and the end of the model comes back (keeper.h).

#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <poll.h>
#include <signal.h>
#include <sys/mman.h>
#include <sys/prctl.h>
#include <sys/resource.h>
#include <sys/signalfd.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "base/environment.h"
#include "base/system.h"
#include "pool/channel.h"
#include "pool/messages.h"

namespace {

using pstripack::Descriptor;
using Clock = std::chrono::steady_clock;

constexpr const char* kHelp =
    "usage: pstripack-run -n P [mpirun option... --] program [argument...]\n"
    "\n"
    "Runs a serial program that calls STRIPACK's trmesh from libstripack. P MPI ranks carry out its larger\n"
    "calls together; everything else is as without pstripack-run: standard input and output, the exit code.\n"
    "\n"
    "  -n P, -np P   number of ranks, including the one that serves the program; 1: the program runs alone\n"
    "  options       handed to mpirun, for example --oversubscribe or --hostfile FILE; then -- is needed\n"
    "  --help, --version\n"
    "\n"
    "mpirun may be that of Open MPI, MPICH or Intel MPI.\n"
    "PSTRIPACK_* and OMP_* variables reach all ranks. PSTRIPACK_MPIRUN names another mpirun than\n"
    "  " PSTRIPACK_MPIRUN
    "\n"
    "\n"
    "example: pstripack-run -n 4 --oversubscribe -- ./model input.nml < data > output\n";

[[noreturn]] void fail(const std::string& message, int code) {
  std::fprintf(stderr, "pstripack-run: %s\n", message.c_str());
  std::exit(code);
}

[[noreturn]] void run(char** command) {
  execvp(command[0], command);
  const int error = errno;
  fail(std::string(command[0]) + ": " + std::strerror(error), error == ENOENT ? 127 : 126);
}

struct Arguments {
  int ranks = 0;
  std::vector<char*> mpirun_options;
  char** program = nullptr;
};

Arguments read_arguments(char** argv) {
  Arguments arguments;
  ++argv;
  const auto is = [&argv](const char* option) { return std::strcmp(*argv, option) == 0; };
  for (; *argv != nullptr && **argv == '-' && !is("--"); ++argv) {
    if (is("--help") || is("-h")) {
      std::fputs(kHelp, stdout);
      std::exit(0);
    }
    if (is("--version")) {
      std::puts("pstripack-run " PSTRIPACK_VERSION);
      std::exit(0);
    }
    if (!is("-n") && !is("-np")) break;
    char* end = nullptr;
    const char* const value = argv[1];
    const long ranks = value != nullptr ? std::strtol(value, &end, 10) : 0;
    if (value == nullptr || end == value || *end != '\0' || ranks < 1 || ranks > INT_MAX)
      fail(std::string(*argv) + " needs a number of ranks, 1 or more (--help shows how)", 2);
    arguments.ranks = static_cast<int>(ranks);
    ++argv;
  }
  if (*argv != nullptr && **argv == '-') {
    for (; *argv != nullptr && !is("--"); ++argv) {
      if (is("-n") || is("-np")) fail("-n must come before the options for mpirun (--help shows how)", 2);
      arguments.mpirun_options.push_back(*argv);
    }
    if (*argv == nullptr) fail("options for mpirun end with --, before the program (--help shows how)", 2);
    ++argv;
  }
  if (arguments.ranks == 0) fail("no number of ranks: give -n P before the program (--help shows how)", 2);
  if (*argv == nullptr) fail("no program to run: give it after the options (--help shows how)", 2);
  arguments.program = argv;
  return arguments;
}

/// pstripack-worker is in the same folder as this program.
std::string path_of_worker() {
  std::string path = pstripack::path_of_this_program();
  if (path.empty())
    fail("/proc/self/exe cannot be read, so pstripack-worker cannot be found: mount /proc", 127);
  path = path.substr(0, path.rfind('/') + 1) + "pstripack-worker";
  if (access(path.c_str(), X_OK) != 0) fail(path + ": " + std::strerror(errno), 127);
  return path;
}

std::string path_of_mpirun() {
  if (const char* const path = pstripack::environment_variable("PSTRIPACK_MPIRUN")) return path;
  return access(PSTRIPACK_MPIRUN, X_OK) == 0 ? PSTRIPACK_MPIRUN : "mpirun";
}

/// True if `mpirun --version` names Open MPI. The other supported launcher is Hydra, of MPICH and Intel MPI.
bool is_open_mpi(const std::string& mpirun) {
  setenv("PSTRIPACK_MPIRUN", mpirun.c_str(), 1);  // as a variable, its blanks need no quotes
  std::FILE* const version = popen("\"$PSTRIPACK_MPIRUN\" --version < /dev/null", "r");
  if (version == nullptr) fail(std::string("popen: ") + std::strerror(errno), 1);
  std::string text;
  char piece[256];
  while (std::fgets(piece, sizeof piece, version) != nullptr) text += piece;
  const int status = pclose(version);
  if (status != 0) {  // the child has said why
    const int code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
    fail(mpirun + " --version: exit code " + std::to_string(code), code);
  }
  return text.find("Open MPI") != std::string::npos || text.find("OpenRTE") != std::string::npos;
}

/// Makes Open MPI notice a lost machine after 40 seconds instead of 8 minutes: after 20 seconds of silence it
/// probes four times, every 5 seconds. Values set by the user take precedence.
void let_open_mpi_notice_lost_machines() {
  setenv("OMPI_MCA_oob_tcp_keepalive_time", "20", 0);
  setenv("OMPI_MCA_oob_tcp_keepalive_intvl", "5", 0);
  setenv("OMPI_MCA_oob_tcp_keepalive_probes", "4", 0);
}

/// Options that Open MPI needs and Hydra does not: do not bind a rank to one core, to which its OpenMP
/// threads would be confined; and pass environment variables on to other machines.
std::vector<std::string> open_mpi_options(const Arguments& arguments) {
  std::vector<std::string> options;
  bool binds = false;
  for (const char* const option : arguments.mpirun_options)
    binds = binds || std::strstr(option, "-bind-to") != nullptr;
  if (!binds) options = {"--bind-to", "none"};
  for (char** at = environ; *at != nullptr; ++at) {
    const std::string name(*at, strcspn(*at, "="));
    bool travels = name == "LD_LIBRARY_PATH";
    for (const char* const prefix : {"PSTRIPACK_", "OMP_", "GOMP_"})
      travels = travels || name.find(prefix) == 0;
    if (travels) options.insert(options.end(), {"-x", name});
  }
  return options;
}

std::vector<std::string> mpirun_command(const std::string& mpirun, bool open_mpi,
                                        const Arguments& arguments) {
  std::vector<std::string> command{mpirun};
  if (open_mpi) {
    let_open_mpi_notice_lost_machines();
    const std::vector<std::string> options = open_mpi_options(arguments);
    command.insert(command.end(), options.begin(), options.end());
  }
  command.insert(command.end(), {"-n", std::to_string(arguments.ranks)});
  for (const char* const option : arguments.mpirun_options)
    if (open_mpi || std::strcmp(option, "--oversubscribe") != 0) command.push_back(option);
  command.push_back(path_of_worker());
  for (char** at = arguments.program; *at != nullptr; ++at) command.push_back(*at);
  return command;
}

/// The environment as a file in memory, each variable closed by a zero.
Descriptor environment_file() {
  Descriptor file(memfd_create("environment", MFD_CLOEXEC));
  std::FILE* const stream = fdopen(dup(file.get()), "w");
  if (stream == nullptr) return {};
  for (char** at = environ; *at != nullptr; ++at) std::fwrite(*at, 1, std::strlen(*at) + 1, stream);
  return std::fclose(stream) == 0 ? std::move(file) : Descriptor();
}

/// A closed descriptor 0, 1 or 2 would become that of a file of ours, and of the model's. After this it
/// cannot be read, or written, either.
void occupy_closed_standard_streams() {
  for (int fd = 0; fd < 3; ++fd)
    if (fcntl(fd, F_GETFD) < 0) open("/dev/null", fd == STDIN_FILENO ? O_WRONLY : O_RDONLY);
}

/// mpirun and the model are not in the foreground of the terminal, and must not read it. So they get a pipe,
/// and a thread writes into it what it reads from the terminal.
void put_pipe_before_terminal() {
  int ends[2];
  if (!isatty(STDIN_FILENO) || pipe2(ends, O_CLOEXEC) != 0) return;
  const int terminal = fcntl(STDIN_FILENO, F_DUPFD_CLOEXEC, 0);
  dup2(ends[0], STDIN_FILENO);
  close(ends[0]);
  std::thread([terminal, to = ends[1]] {
    char piece[4096];
    for (;;) {
      const ssize_t size = read(terminal, piece, sizeof piece);
      if (size < 0 && (errno == EIO || errno == EINTR)) {  // EIO: this process is in the background
        const timespec nap{0, 100000000};
        nanosleep(&nap, nullptr);
      } else if (size <= 0 || write(to, piece, static_cast<std::size_t>(size)) != size) {
        break;
      }
    }
    close(to);
  }).detach();
}

/// True if stdin is a file. Then the model gets it directly, so that it can rewind it and mpirun does not
/// move its position. Open MPI forwards any other stdin; Hydra must not, because it ends the job if the model
/// does not read at once.
bool stdin_is_a_file() {
  struct stat status;
  return fstat(STDIN_FILENO, &status) == 0 && S_ISREG(status.st_mode);
}

bool stdin_can_be_read() {
  const int mode = fcntl(STDIN_FILENO, F_GETFL);
  return mode >= 0 && (mode & O_ACCMODE) != O_WRONLY;
}

/// Open MPI reads all of stdin to forward it. With its own file description it does not move the model's
/// position.
void give_mpirun_its_own_input() {
  const off_t position = lseek(STDIN_FILENO, 0, SEEK_CUR);
  const Descriptor file(open("/proc/self/fd/0", O_RDONLY));
  if (!file) return;
  lseek(file.get(), position, SEEK_SET);
  dup2(file.get(), STDIN_FILENO);
}

/// mpirun, a child process.
class Mpirun {
 public:
  explicit Mpirun(pid_t process) : process_(process) {}
  void send(int signal) const {
    if (process_ > 0) kill(process_, signal);
  }
  /// From now on it has this time to end. Then it gets SIGTERM, and 5 s later SIGKILL; if this is called
  /// again, sooner.
  void end_in(std::chrono::seconds time) { next_ = std::max(soonest_, std::min(next_, Clock::now() + time)); }
  /// To be called after every tick(). True if mpirun has ended.
  bool has_ended() {
    if (process_ > 0 && waitpid(process_, &status_, WNOHANG) == process_) process_ = -1;
    if (process_ > 0 && Clock::now() >= next_) {
      send(std::exchange(signal_, SIGKILL));
      soonest_ = Clock::now() + std::chrono::seconds(1);
      next_ = Clock::now() + std::chrono::seconds(5);
    }
    return process_ < 0;
  }
  /// In milliseconds; -1: for ever.
  int tick() const { return process_ > 0 && next_ != Clock::time_point::max() ? 50 : -1; }
  int status() const { return status_; }

 private:
  pid_t process_;
  int status_ = 0, signal_ = SIGTERM;
  Clock::time_point next_ = Clock::time_point::max(), soonest_;
};

/// Ends this process as the model ended: with the same exit code or by the same signal.
[[noreturn]] void end_like(int status) {
  if (WIFSIGNALED(status)) {
    const rlimit no_core{0, 0};
    setrlimit(RLIMIT_CORE, &no_core);
    sigset_t all;
    sigfillset(&all);
    signal(WTERMSIG(status), SIG_DFL);
    sigprocmask(SIG_UNBLOCK, &all, nullptr);
    raise(WTERMSIG(status));
    std::exit(128 + WTERMSIG(status));
  }
  std::exit(WEXITSTATUS(status));
}

/// What the keeper has to know of this process.
pstripack::Greeting greeting_of_this_process() {
  pstripack::Greeting greeting;
  for (int s = 1; s < NSIG; ++s)
    if (struct sigaction action; sigaction(s, nullptr, &action) == 0 && action.sa_handler == SIG_IGN)
      greeting.ignored |= std::uint64_t{1} << (s - 1);
  greeting.ignored |= std::uint64_t{1} << (SIGTTOU - 1);  // a process in the background may write
  return greeting;
}

/// Signals of the terminal, of batch systems and of the end of mpirun arrive in the file that is returned.
Descriptor signals_as_file(sigset_t* before) {
  sigset_t signals;
  sigemptyset(&signals);
  for (const int signal : {SIGTERM, SIGINT, SIGHUP, SIGQUIT, SIGUSR1, SIGUSR2, SIGTSTP, SIGCONT, SIGCHLD})
    sigaddset(&signals, signal);
  sigprocmask(SIG_BLOCK, &signals, before);
  signal(SIGTTIN, SIG_IGN);
  signal(SIGPIPE, SIG_IGN);
  return Descriptor(signalfd(-1, &signals, SFD_CLOEXEC));
}

/// In the child: runs mpirun. `signals`: those blocked before.
[[noreturn]] void become_mpirun(std::vector<std::string> words, bool open_mpi, const sigset_t& signals) {
  // What a terminal or timeout(1) sends to our group is for the model, not for mpirun.
  setpgid(0, 0);
  signal(SIGTTIN, SIG_DFL);
  signal(SIGPIPE, SIG_DFL);
  signal(SIGTTOU, SIG_IGN);
  sigprocmask(SIG_SETMASK, &signals, nullptr);
  if (!open_mpi || !stdin_can_be_read())
    dup2(Descriptor(open("/dev/null", O_RDONLY)).get(), STDIN_FILENO);
  else if (stdin_is_a_file())
    give_mpirun_its_own_input();
  std::vector<char*> command;
  for (std::string& word : words) command.push_back(word.data());
  command.push_back(nullptr);
  run(command.data());
}

/// Watches mpirun and the keeper, and passes on signals, until both have ended.
class Supervisor {
 public:
  Supervisor(pid_t mpirun, bool open_mpi) : mpirun_(mpirun), model_gets_stdin_(!open_mpi) {}

  void run(const Descriptor& signals, const Descriptor& listener, const Descriptor& environment,
           const pstripack::Greeting& greeting) {
    while (!mpirun_.has_ended() || keeper_) {
      pollfd events[] = {{signals.get(), POLLIN, 0},
                         {has_begun_ ? -1 : listener.get(), POLLIN, 0},
                         {keeper_.get(), POLLIN, 0}};
      if (poll(events, 3, mpirun_.tick()) < 0) continue;
      if (events[1].revents != 0) greet(listener, environment, greeting);
      if (events[2].revents != 0) note_end_of_model();
      signalfd_siginfo arrived;
      if (events[0].revents != 0 && read(signals.get(), &arrived, sizeof arrived) > 0 &&
          arrived.ssi_signo != SIGCHLD)
        pass_on(static_cast<int>(arrived.ssi_signo), greeting);
    }
  }

  /// After run(): ends this process as the model ended, or says why the job did.
  [[noreturn]] void end() const {
    const int status = mpirun_.status();
    // If mpirun failed without being told to end, a rank was lost, whatever the status of the model is.
    if (has_ended_ && (status == 0 || told_to_end_ != 0)) end_like(model_.status);
    if (told_to_end_ != 0) end_like(told_to_end_);
    if (WIFSIGNALED(status))
      std::fprintf(stderr, "pstripack-run: mpirun was ended by signal %d, and the model with it\n",
                   WTERMSIG(status));
    else if (has_begun_)
      std::fprintf(stderr,
                   "pstripack-run: mpirun has ended the job with exit code %d: a machine is lost, or a rank, "
                   "and the model with it\n",
                   WEXITSTATUS(status));
    end_like(status);
  }

 private:
  /// The keeper has come: it gets what mpirun would not pass on unchanged.
  void greet(const Descriptor& listener, const Descriptor& environment, const pstripack::Greeting& greeting) {
    keeper_ = pstripack::accept_from(listener);
    if (!keeper_) return;
    const bool gets_stdin = model_gets_stdin_ || stdin_is_a_file() || !stdin_can_be_read();
    const int descriptors[4] = {gets_stdin ? STDIN_FILENO : -1, STDOUT_FILENO, STDERR_FILENO,
                                environment.get()};
    has_begun_ = pstripack::send_packet(keeper_, &greeting, sizeof greeting, descriptors, 4);
    if (!has_begun_) keeper_.reset();
  }

  void note_end_of_model() {
    has_ended_ = pstripack::receive_packet(keeper_, &model_, sizeof model_);
    keeper_.reset();
    if (told_to_end_ != 0) mpirun_.end_in(std::chrono::seconds(10));
  }

  void pass_on(int number, const pstripack::Greeting& greeting) {
    pstripack::SignalForModel signal{number};
    const bool tells_to_end = greeting.tells_to_end(number);
    if (tells_to_end) {
      const Clock::time_point before_now = std::exchange(told_at_, Clock::now());
      // timeout(1) sends its signal to this process, and then to its group.
      if (number == told_to_end_ && told_at_ < before_now + std::chrono::milliseconds(200)) return;
      told_to_end_ = number;
      if (number == SIGINT && ++interrupts_ > 1) signal.number = SIGKILL;
    }
    if (signal.number == SIGKILL) mpirun_.end_in(std::chrono::seconds(2));
    if (keeper_)
      pstripack::send_packet(keeper_, &signal, sizeof signal);
    else if (tells_to_end)
      mpirun_.end_in(std::chrono::seconds(0));
    else if (number == SIGUSR1 || number == SIGUSR2)
      mpirun_.send(number);
    if (number == SIGTSTP) raise(SIGSTOP);
  }

  Mpirun mpirun_;
  const bool model_gets_stdin_;  ///< whatever it is
  Descriptor keeper_;
  pstripack::ModelEnd model_;
  int told_to_end_ = 0;  ///< by which signal
  int interrupts_ = 0;
  Clock::time_point told_at_;
  bool has_begun_ = false, has_ended_ = false;  ///< the model
};

}  // namespace

int main(int, char** argv) {
  const Arguments arguments = read_arguments(argv);
  if (arguments.ranks == 1) run(arguments.program);

  occupy_closed_standard_streams();
  const pstripack::Greeting greeting = greeting_of_this_process();
  const Descriptor environment = environment_file();
  std::string name;
  const Descriptor listener = pstripack::listen_under_new_name(&name);
  if (!listener) fail(std::string("no socket: ") + std::strerror(errno), 1);
  setenv("PSTRIPACK_POOL_LAUNCHER", name.c_str(), 1);
  const std::string path = path_of_mpirun();
  const bool open_mpi = is_open_mpi(path);
  std::vector<std::string> words = mpirun_command(path, open_mpi, arguments);

  sigset_t before;
  const Descriptor signals = signals_as_file(&before);
  put_pipe_before_terminal();
  const pid_t me = getpid(), process = fork();
  if (process < 0) fail(std::string("fork: ") + std::strerror(errno), 1);
  if (process == 0) {
    prctl(PR_SET_PDEATHSIG, SIGTERM);
    if (getppid() != me) _exit(128 + SIGTERM);
    become_mpirun(std::move(words), open_mpi, before);
  }
  Supervisor supervisor(process, open_mpi);
  supervisor.run(signals, listener, environment, greeting);
  supervisor.end();
}
