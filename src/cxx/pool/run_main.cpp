// pstripack-run: starts a serial model with a pool of MPI ranks behind it. No MPI in this program.
//
// The model should run as if it had been started here. So this program sends rank 0, over a local socket,
// what mpirun would not pass on unchanged: stdout and stderr, stdin if it is a file, and the environment.
// Rank 0 sends back how the model ended.

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
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>
#include <utility>
#include <vector>

#include "base/environment.h"
#include "pool/channel.h"
#include "pool/messages.h"

namespace {

using pstripack::Descriptor;

constexpr const char* kHelp =
    "usage: pstripack-run -n P [mpirun option... --] program [argument...]\n"
    "\n"
    "Runs a serial program that calls STRIPACK's trmesh from libstripack. P MPI ranks carry out its larger\n"
    "calls together; everything else is as without pstripack-run: standard input and output, the exit code.\n"
    "\n"
    "  -n P, -np P   number of ranks, the one that serves the program included; 1: none\n"
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
  char self[PATH_MAX];
  const ssize_t length = readlink("/proc/self/exe", self, sizeof self - 1);
  std::string path(self, length > 0 ? static_cast<std::size_t>(length) : 0);
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
  int ends[2];
  if (pipe2(ends, O_CLOEXEC) != 0) fail(std::string("pipe: ") + std::strerror(errno), 1);
  const pid_t child = fork();
  if (child < 0) fail(std::string("fork: ") + std::strerror(errno), 1);
  if (child == 0) {
    dup2(ends[1], STDOUT_FILENO);
    const Descriptor nothing(open("/dev/null", O_RDWR));
    dup2(nothing.get(), STDIN_FILENO);
    dup2(nothing.get(), STDERR_FILENO);
    execlp(mpirun.c_str(), mpirun.c_str(), "--version", nullptr);
    _exit(127);
  }
  close(ends[1]);
  const Descriptor version(ends[0]);
  std::string text;
  char piece[256];
  for (ssize_t size; (size = read(version.get(), piece, sizeof piece)) > 0;)
    text.append(piece, static_cast<std::size_t>(size));
  waitpid(child, nullptr, 0);
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

/// True if stdin is a file. Then the model gets it directly, so that it can rewind it and mpirun does not
/// move its position. Open MPI forwards any other stdin; Hydra must not, because it ends the job if the model
/// does not read at once.
bool stdin_is_a_file() {
  struct stat status;
  return fstat(STDIN_FILENO, &status) == 0 && S_ISREG(status.st_mode);
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

/// Forwards mpirun's stderr to ours. When a rank is lost, Hydra kills all others by SIGKILL, and the
/// watchdogs report each as lost. Only the first of these lines is forwarded, which is nearly always the
/// right one.
class ErrorLines {
 public:
  bool open() { return pipe2(ends_, O_CLOEXEC) == 0 && fcntl(ends_[0], F_SETFL, O_NONBLOCK) == 0; }
  int from() const { return ends_[0]; }
  void become_stderr() const { dup2(ends_[1], STDERR_FILENO); }
  void leave_to_mpirun() { close(ends_[1]); }
  /// True if a line has named the rank because of which the job ends.
  bool has_named_rank() const { return has_named_rank_; }
  /// True if Open MPI has refused to start more ranks than there are processors.
  bool lack_of_slots() const { return lack_of_slots_; }

  /// Forwards what has arrived so far. False at the end of the stream.
  bool pass_on() {
    char piece[4096];
    ssize_t size;
    while ((size = read(ends_[0], piece, sizeof piece)) > 0) {
      text_.append(piece, static_cast<std::size_t>(size));
      for (std::size_t end; (end = text_.find('\n')) != std::string::npos; text_.erase(0, end + 1))
        pass_on_line(text_.substr(0, end + 1));
      // Hold back the beginning of a line only if the line may name a rank.
      if (text_.compare(0, kRank.size(), kRank, 0, text_.size()) != 0) write_all(std::exchange(text_, {}));
    }
    return size < 0 && (errno == EAGAIN || errno == EINTR);
  }

  /// After the end of mpirun. Does not wait for the end of the stream, which other processes may have open.
  void finish() {
    pass_on();
    write_all(text_);
  }

 private:
  void pass_on_line(const std::string& line) {
    const bool names_rank = line.compare(0, kRank.size(), kRank) == 0;
    const bool is_another_loss =
        names_rank && has_named_rank_ && line.find(" was lost ") != std::string::npos;
    if (!is_another_loss) write_all(line);
    has_named_rank_ = has_named_rank_ || names_rank;
    lack_of_slots_ = lack_of_slots_ || line.find("not enough slots available") != std::string::npos;
  }
  static void write_all(const std::string& text) { std::fwrite(text.data(), 1, text.size(), stderr); }

  const std::string kRank = "pstripack: rank ";
  int ends_[2] = {-1, -1};
  std::string text_;
  bool has_named_rank_ = false, lack_of_slots_ = false;
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

}  // namespace

int main(int, char** argv) {
  const Arguments arguments = read_arguments(argv);
  if (arguments.ranks == 1) run(arguments.program);

  const Descriptor environment = environment_file();
  std::string name;
  const Descriptor listener = pstripack::listen_under_new_name(&name);
  if (!listener) fail(std::string("no socket: ") + std::strerror(errno), 1);
  setenv("PSTRIPACK_POOL_LAUNCHER", name.c_str(), 1);
  const std::string path = path_of_mpirun();
  const bool open_mpi = is_open_mpi(path);
  std::vector<std::string> words = mpirun_command(path, open_mpi, arguments);

  sigset_t signals, before;
  sigemptyset(&signals);
  const int forwarded[] = {SIGTERM, SIGINT, SIGHUP, SIGQUIT, SIGUSR1, SIGUSR2};
  for (const int signal : forwarded) sigaddset(&signals, signal);
  sigaddset(&signals, SIGCHLD);
  sigprocmask(SIG_BLOCK, &signals, &before);
  const Descriptor signal_file(signalfd(-1, &signals, SFD_CLOEXEC));

  ErrorLines errors;
  if (!errors.open()) fail(std::string("pipe: ") + std::strerror(errno), 1);
  const pid_t mpirun = fork();
  if (mpirun < 0) fail(std::string("fork: ") + std::strerror(errno), 1);
  if (mpirun == 0) {
    prctl(PR_SET_PDEATHSIG, SIGTERM);
    sigprocmask(SIG_SETMASK, &before, nullptr);
    errors.become_stderr();
    if (!open_mpi)
      dup2(Descriptor(open("/dev/null", O_RDONLY)).get(), STDIN_FILENO);
    else if (stdin_is_a_file())
      give_mpirun_its_own_input();
    std::vector<char*> command;
    for (std::string& word : words) command.push_back(word.data());
    command.push_back(nullptr);
    run(command.data());
  }

  errors.leave_to_mpirun();

  Descriptor steward;  // rank 0
  pstripack::ModelNews model, news;
  int mpirun_status = 0;
  bool told_to_end = false, errors_are_open = true;
  for (;;) {
    pollfd events[] = {{signal_file.get(), POLLIN, 0},
                       {steward ? -1 : listener.get(), POLLIN, 0},
                       {steward.get(), POLLIN, 0},
                       {errors_are_open ? errors.from() : -1, POLLIN, 0}};
    if (poll(events, 4, -1) < 0) continue;
    if (events[3].revents != 0) errors_are_open = errors.pass_on();
    if (events[1].revents != 0) {
      steward = pstripack::accept_from(listener);
      const int descriptors[4] = {!open_mpi || stdin_is_a_file() ? STDIN_FILENO : -1, STDOUT_FILENO,
                                  STDERR_FILENO, environment.get()};
      const char hello = 0;
      if (steward && !pstripack::send_packet(steward, &hello, 1, descriptors, 4)) steward.reset();
    }
    if (events[2].revents != 0) {
      if (pstripack::receive_packet(steward, &news, sizeof news))
        model = news;
      else
        steward.reset();
    }
    signalfd_siginfo signal;
    if (events[0].revents == 0 || read(signal_file.get(), &signal, sizeof signal) < 0) continue;
    const auto number = static_cast<int>(signal.ssi_signo);
    if (number != SIGCHLD && number != SIGUSR1 && number != SIGUSR2) told_to_end = true;
    // A signal sent to this process is meant for the model. A terminal sends its signals to mpirun, too.
    if (number != SIGCHLD && signal.ssi_code <= 0 && !model.has_ended)
      kill(model.process > 0 ? model.process : mpirun, number);
    if (waitpid(mpirun, &mpirun_status, WNOHANG) == mpirun) break;
  }
  errors.finish();
  while (steward && !model.has_ended && pstripack::receive_packet(steward, &news, sizeof news)) model = news;
  // If mpirun failed without being told to end, a rank was lost, whatever the status of the model is.
  if (model.has_ended && (mpirun_status == 0 || told_to_end)) end_like(model.status);
  if (WIFSIGNALED(mpirun_status) && !told_to_end)
    std::fprintf(stderr, "pstripack-run: mpirun was ended by signal %d, and the model with it\n",
                 WTERMSIG(mpirun_status));
  else if (errors.lack_of_slots())
    std::fprintf(stderr, "pstripack-run: more ranks than processors: pstripack-run -n %d --oversubscribe -- COMMAND\n",
                 arguments.ranks);
  else if ((model.process > 0 || model.has_ended) && !told_to_end && !errors.has_named_rank())
    std::fprintf(stderr,
                 "pstripack-run: mpirun has ended the job with exit code %d: a machine is lost, or a rank, "
                 "and the model with it\n",
                 WEXITSTATUS(mpirun_status));
  end_like(mpirun_status);
}
