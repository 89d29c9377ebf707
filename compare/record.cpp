// stripack-compare record: runs a model with PSTRIPACK_CHECK=FILE.

#include <fcntl.h>
#include <fmt/format.h>
#include <signal.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <filesystem>
#include <sstream>
#include <stdexcept>
#include <string>
#include <system_error>
#include <vector>

#include "base/system.h"
#include "calls.h"
#include "commands.h"

namespace comparison {
namespace {

constexpr int kNotFound = 127;  // the shell's exit code for a command that is not found

/// errno if exec cannot start the command; 0: it can. Checked before an older recording is overwritten.
int error_of(const std::string& command) {
  if (command.find('/') != command.npos) return access(command.c_str(), X_OK) == 0 ? 0 : errno;
  const char* const path = std::getenv("PATH");
  std::istringstream folders(path == nullptr ? "/bin:/usr/bin" : path);
  for (std::string folder; std::getline(folders, folder, ':');)
    if (access(((folder.empty() ? "." : folder) + "/" + command).c_str(), X_OK) == 0) return 0;
  return ENOENT;
}

int cannot_start(const std::string& command, int error) {
  fmt::print(stderr, "stripack-compare: {}: {}\n", command, std::strerror(error));
  return kNotFound;
}

/// Returns the exit code, or 128 + signal if a signal ended the model. ^C only interrupts the model.
int run(std::vector<std::string> command) {
  std::vector<char*> arguments;
  for (std::string& word : command) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  pid_t process;
  if (const int error = posix_spawnp(&process, arguments[0], nullptr, nullptr, arguments.data(),
                                     pstripack::all_environment_variables()))
    return cannot_start(command[0], error);
  signal(SIGINT, SIG_IGN);
  signal(SIGQUIT, SIG_IGN);
  int status = 0;
  while (waitpid(process, &status, 0) < 0 && errno == EINTR) {
  }
  return WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
}

void tell_what_is_in(const std::string& file) {
  std::size_t calls = 0, lost = 0;
  std::int64_t smallest = 0, largest = 0;
  CallReader reader(file);
  while (const auto call = reader.next()) {
    smallest = calls == 0 ? call->n : std::min(smallest, call->n);
    largest = std::max(largest, call->n);
    ++calls;
    if (!call->has_returned) ++lost;
  }
  if (calls == 0)
    throw std::runtime_error(
        "no call of TRMESH was recorded: is the program linked with a library of PSTRIPACK?");
  fmt::print(stderr, "stripack-compare: {} call{} of TRMESH in {}, n = {}", calls, calls == 1 ? "" : "s",
             file, smallest);
  if (largest > smallest) fmt::print(stderr, " to {}", largest);
  if (lost > 0) fmt::print(stderr, "; {} did not return", lost);
  fmt::print(stderr, "\n");
}

}  // namespace

int record(const RecordOptions& options) {
  if (!CallReader::looks_like_recording(options.file))
    throw std::runtime_error(options.file + " exists and is no recording: give another --output");
  if (const int error = error_of(options.command[0])) return cannot_start(options.command[0], error);
  const int file = open(options.file.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
  if (file < 0)
    throw std::runtime_error(fmt::format("cannot write {}: {}", options.file, std::strerror(errno)));
  close(file);
  setenv("PSTRIPACK_CHECK", std::filesystem::absolute(options.file).c_str(), 1);
  const int code = run(options.command);
  if (code == kNotFound) {
    std::error_code ignored;
    if (std::filesystem::is_empty(options.file, ignored)) std::filesystem::remove(options.file, ignored);
    return code;
  }
  try {
    tell_what_is_in(options.file);
  } catch (const std::exception& e) {
    fmt::print(stderr, "stripack-compare: {}\n", e.what());
  }
  return code;
}

}  // namespace comparison
