// pstripack-run: starts a serial program with a pool of MPI ranks behind it. No MPI in this program.
//
//   pstripack-run --- exec ---> the program, as without pstripack-run: its process, files, terminal and
//   signals
//     supervisor, in a session of its own
//       mpirun
//         rank 0: steward (pool/steward.h) and the other ranks
//
// The supervisor starts mpirun. It ends the ranks after the program, and the program if the ranks end before.

#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <poll.h>
#include <signal.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <string>
#include <utility>
#include <vector>

#include "base/environment.h"
#include "base/system.h"
#include "pool/channel.h"

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

/// In the supervisor: where it tells the process that will be the program to begin or with which code to end.
int to_program = -1;
constexpr int kBegin = -1;

void tell_program(int code) {
  if (to_program >= 0 && write(to_program, &code, sizeof code) < 0) std::perror("pstripack-run: pipe");
}

[[noreturn]] void fail(const std::string& message, int code) {
  std::fprintf(stderr, "pstripack-run: %s\n", message.c_str());
  tell_program(code);
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
  if (access(path.c_str(), X_OK) != 0)
    fail(path + ": " + std::strerror(errno) + ": it must be beside pstripack-run", 127);
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
    fail(mpirun + " --version: exit code " + std::to_string(code) + ": name another in PSTRIPACK_MPIRUN",
         code);
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
  return command;
}

/// A closed descriptor 0, 1 or 2 would become that of a file of ours, and of the model's. After this it
/// cannot be read, or written, either.
void occupy_closed_standard_streams() {
  for (int fd = 0; fd < 3; ++fd)
    if (fcntl(fd, F_GETFD) < 0) open("/dev/null", fd == STDIN_FILENO ? O_WRONLY : O_RDONLY);
}

[[noreturn]] void become_mpirun(std::vector<std::string> words, pid_t supervisor) {
  prctl(PR_SET_PDEATHSIG, SIGTERM);
  if (getppid() != supervisor) _exit(128 + SIGTERM);
  dup2(Descriptor(open("/dev/null", O_RDONLY)).get(), STDIN_FILENO);
  std::vector<char*> command;
  for (std::string& word : words) command.push_back(word.data());
  command.push_back(nullptr);
  run(command.data());
}

/// A batch system has told this process to end, and with it the whole job.
volatile sig_atomic_t is_told_to_end = 0;

void note_signals() {
  for (const int number : {SIGTERM, SIGINT, SIGHUP, SIGQUIT}) signal(number, [](int) { is_told_to_end = 1; });
  for (const int number : {SIGUSR1, SIGUSR2, SIGTSTP}) signal(number, [](int) {});
  signal(SIGCHLD, SIG_DFL);
}

/// False also for a process that has ended and that nobody waits for.
bool is_running(pid_t process) {
  std::ifstream file("/proc/" + std::to_string(process) + "/stat");
  std::string status;
  std::getline(file, status);
  return !status.empty() && status.find(") Z ") == std::string::npos;
}

/// The supervisor, until mpirun and the program have ended.
void supervise(const Arguments& arguments, Descriptor listener, pid_t program) {
  note_signals();
  const std::string path = path_of_mpirun();
  std::vector<std::string> words = mpirun_command(path, is_open_mpi(path), arguments);
  const pid_t me = getpid(), mpirun = fork();
  if (mpirun < 0) fail(std::string("fork: ") + std::strerror(errno), 1);
  if (mpirun == 0) become_mpirun(std::move(words), me);

  Descriptor rank_0;
  bool has_begun = false;  // the program
  int status = 0, next_signal = SIGTERM;
  Clock::time_point end_at = Clock::time_point::max();  // when mpirun gets that signal
  while (waitpid(mpirun, &status, WNOHANG) != mpirun) {
    pollfd event{listener.get(), POLLIN, 0};
    poll(&event, 1, 100);
    const Clock::time_point now = Clock::now();
    if (event.revents != 0 && (rank_0 = pstripack::accept_from(listener))) {
      const char nothing = 0;
      has_begun = pstripack::send_packet(rank_0, &nothing, 1, listener.get());
      if (has_begun) tell_program(kBegin);
      listener.reset();
    }
    if (end_at == Clock::time_point::max() && !is_running(program)) {
      rank_0.reset();  // then it ends the job
      end_at = now + std::chrono::seconds(has_begun ? 10 : 0);
    }
    if (now < end_at) continue;
    kill(mpirun, std::exchange(next_signal, SIGKILL));
    end_at = now + std::chrono::seconds(5);
  }
  if (!has_begun) {
    tell_program(WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status));
  } else if (is_running(program) && is_told_to_end == 0) {  // mpirun says which rank or machine is lost
    kill(program, SIGTERM);
    sleep(2);
    kill(program, SIGKILL);
  }
}

}  // namespace

int main(int, char** argv) {
  const Arguments arguments = read_arguments(argv);
  if (arguments.ranks == 1) run(arguments.program);

  occupy_closed_standard_streams();
  std::string name;
  Descriptor listener = pstripack::listen_under_new_name(&name);
  int ends[2];
  if (!listener || pipe2(ends, O_CLOEXEC) != 0) fail(std::string("no socket: ") + std::strerror(errno), 1);
  setenv("PSTRIPACK_POOL", name.c_str(), 1);
  const pid_t program = getpid(), process = fork();
  if (process < 0) fail(std::string("fork: ") + std::strerror(errno), 1);
  if (process == 0) {
    setsid();
    if (fork() != 0) _exit(0);  // the program may wait for all of its children: the supervisor is none
    to_program = ends[1];
    supervise(arguments, std::move(listener), program);
    return 0;
  }
  close(ends[1]);
  waitpid(process, nullptr, 0);
  int code = 1;
  if (read(ends[0], &code, sizeof code) != sizeof code)
    fail("the ranks could not be started: does mpirun work by itself?", 1);
  if (code != kBegin) return code;
  run(arguments.program);
}
