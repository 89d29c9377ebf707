#include "observe/shadow_process.h"

#include <dlfcn.h>
#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <poll.h>
#include <signal.h>
#include <spawn.h>
#include <stdlib.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cstring>
#include <iterator>
#include <stdexcept>
#include <vector>

#include "base/environment.h"
#include "base/system.h"
#include "base/transfer.h"
#include "parallel/cost.h"

namespace pstripack {
namespace {

constexpr double kPatience = 10;  // seconds to wait for the end of the log, beyond one call's timeout

[[noreturn]] void fail(const std::string& what, int error) {
  throw std::runtime_error(what + ": " + std::strerror(error));
}

/// The program to start: PSTRIPACK_COMPARE; else that beside this library (lib/../bin,
/// lib/<machine>/../../bin); else the name alone, which is looked up in PATH.
std::string program() {
  const std::string name = "stripack-compare";
  if (const char* const given = environment_variable("PSTRIPACK_COMPARE")) return given;
  Dl_info library;
  char file[PATH_MAX];
  if (dladdr(reinterpret_cast<const void*>(&program), &library) != 0 &&
      realpath(library.dli_fname, file) != nullptr) {
    const std::string path = file, folder = path.substr(0, path.rfind('/'));
    for (const char* bin : {"/../bin/", "/../../bin/"})
      if (const std::string candidate = folder + bin + name; access(candidate.c_str(), X_OK) == 0)
        return candidate;
  }
  return name;
}

/// The model's environment without the variables of MPI launchers (Open MPI, Slurm, MPICH, Intel MPI) and of
/// this library, and without LD_PRELOAD (macOS: DYLD_INSERT_LIBRARIES): the program is not a rank of the
/// model's job.
std::vector<char*> environment_of_program() {
  constexpr const char* kOfModel[] = {"OMPI_",
                                      "ORTE_",
                                      "PMIX_",
                                      "PMI_",
                                      "HYDI_",
                                      "MPI_LOCALRANKID=",
                                      "MPI_LOCALNRANKS=",
                                      "PSTRIPACK_",
                                      "LD_PRELOAD=",
                                      "DYLD_INSERT_LIBRARIES="};
  std::vector<char*> variables;
  for (char** variable = all_environment_variables(); *variable != nullptr; ++variable)
    if (std::none_of(std::begin(kOfModel), std::end(kOfModel), [variable](const char* beginning) {
          return std::strncmp(*variable, beginning, std::strlen(beginning)) == 0;
        }))
      variables.push_back(*variable);
  variables.push_back(nullptr);
  return variables;
}

/// Moves a descriptor above 0, 1 and 2, which it may be if the model has closed its standard files.
int away_from_standard_files(int file) {
  if (file < 0 || file > 2) return file;
  const int other = fcntl(file, F_DUPFD_CLOEXEC, 3);
  close(file);
  return other;
}

/// Owns the two objects of posix_spawn.
struct SpawnOptions {
  SpawnOptions() {
    posix_spawn_file_actions_init(&files);
    posix_spawnattr_init(&attributes);
  }
  ~SpawnOptions() {
    posix_spawn_file_actions_destroy(&files);
    posix_spawnattr_destroy(&attributes);
  }
  SpawnOptions(const SpawnOptions&) = delete;
  SpawnOptions& operator=(const SpawnOptions&) = delete;

  posix_spawn_file_actions_t files;
  posix_spawnattr_t attributes;
};

}  // namespace

ShadowProcess::ShadowProcess(const std::string& settings, const std::string& folder) {
  const auto absolute = [&folder](const std::string& path) {
    return path.empty() || path[0] == '/' ? path : folder + "/" + path;
  };
  std::size_t end = settings.find(',');
  library_ = absolute(settings.substr(0, end));
  while (end != std::string::npos) {
    const std::size_t begin = end + 1;
    end = settings.find(',', begin);
    const std::string setting = settings.substr(begin, end == std::string::npos ? end : end - begin);
    const std::size_t equals = setting.find('=');
    const std::string key = setting.substr(0, equals);
    const std::string value = equals == std::string::npos ? "" : setting.substr(equals + 1);
    std::string* const place = key == "abi"       ? &abi_
                               : key == "timeout" ? &timeout_
                               : key == "show"    ? &show_
                               : key == "log"     ? &log_
                                                  : nullptr;
    if (place == nullptr || value.empty())
      throw std::invalid_argument("'" + setting + "': expected abi=, timeout=, show= or log=");
    *place = key == "log" ? absolute(value) : value;
  }
  char* rest = nullptr;
  if (!(std::strtod(timeout_.c_str(), &rest) > 0) || *rest != '\0')
    throw std::invalid_argument("'timeout=" + timeout_ + "': expected seconds");
}

void ShadowProcess::start() {
  const std::string path = program();
  std::vector<std::string> words{path, "replay", "-", "--timeout", timeout_};
  const auto add = [&words](const char* option, const std::string& value) {
    if (!value.empty()) words.insert(words.end(), {option, value});
  };
  add("--original", library_);
  add("--original-abi", abi_);
  add("--show", show_);
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);

  int log = STDERR_FILENO;
  if (!log_.empty()) {
    log = away_from_standard_files(open(log_.c_str(), O_WRONLY | O_APPEND | O_CREAT | O_CLOEXEC, 0666));
    if (log < 0) fail(log_, errno);
  }
  int ends[2];
  if (!open_stream(ends)) fail("socketpair", errno);
  for (int& end : ends) end = away_from_standard_files(end);

  SpawnOptions options;
  posix_spawn_file_actions_adddup2(&options.files, ends[1], STDIN_FILENO);
  posix_spawn_file_actions_adddup2(&options.files, log, STDOUT_FILENO);
  posix_spawn_file_actions_adddup2(&options.files, log, STDERR_FILENO);
#ifdef __GLIBC_PREREQ
#if __GLIBC_PREREQ(2, 34)
  posix_spawn_file_actions_addclosefrom_np(&options.files, 3);  // the model's files and sockets
#endif
#endif
  // A process group of its own, so that Ctrl-C reaches the model only. The program ends with the stream.
  sigset_t none, all;
  sigemptyset(&none);
  sigfillset(&all);
  posix_spawnattr_setsigmask(&options.attributes, &none);
  posix_spawnattr_setsigdefault(&options.attributes, &all);
  posix_spawnattr_setpgroup(&options.attributes, 0);
  posix_spawnattr_setflags(&options.attributes,
                           POSIX_SPAWN_SETPGROUP | POSIX_SPAWN_SETSIGMASK | POSIX_SPAWN_SETSIGDEF);
  pid_t process;
  const int error = posix_spawnp(&process, path.c_str(), &options.files, &options.attributes,
                                 arguments.data(), environment_of_program().data());
  close(ends[1]);
  if (!log_.empty()) close(log);
  struct stat status {};
  if (error == 0 && fstat(ends[0], &status) == 0) {
    socket_ = ends[0];
    inode_ = status.st_ino;
    return;
  }
  close(ends[0]);
  fail("cannot run " + path + " (set PSTRIPACK_COMPARE to its path)", error);
}

bool ShadowProcess::socket_is_open() const noexcept {
  struct stat status {};
  return socket_ >= 0 && fstat(socket_, &status) == 0 && S_ISSOCK(status.st_mode) && status.st_ino == inode_;
}

void ShadowProcess::send(iovec* parts, int count) {
  if (socket_ < 0) start();
  const bool sent = socket_is_open() && transfer_all(parts, count, [this](iovec* some, int number) {
                      msghdr message{};
                      message.msg_iov = some;
                      message.msg_iovlen = static_cast<decltype(message.msg_iovlen)>(number);
                      return send_without_signal(socket_, message);
                    });
  if (!sent) throw std::runtime_error("stripack-compare has ended");
}

bool ShadowProcess::finish() noexcept {
  if (!socket_is_open()) return true;
  shutdown(socket_, SHUT_WR);
  // The program's end of the socket is closed when it ends.
  const double end = clock_seconds(CLOCK_MONOTONIC) + std::strtod(timeout_.c_str(), nullptr) + kPatience;
  bool has_ended = false;
  for (double left = kPatience; !has_ended && left > 0; left = end - clock_seconds(CLOCK_MONOTONIC)) {
    pollfd answer{socket_, POLLIN, 0};
    has_ended = poll(&answer, 1, static_cast<int>(1000 * (left < 1000 ? left : 1000)) + 1) > 0;
  }
  close(socket_);
  socket_ = -1;
  return has_ended;
}

void ShadowProcess::leave_to_parent() noexcept {
  if (socket_is_open()) close(socket_);
  socket_ = -1;
}

}  // namespace pstripack
