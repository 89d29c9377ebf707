#include "files/output_file.h"

#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <stdexcept>
#include <vector>

namespace files {
namespace {

namespace fs = std::filesystem;

constexpr int kSignals[] = {SIGHUP, SIGINT, SIGPIPE, SIGQUIT, SIGTERM, SIGXCPU};
char names_to_remove[2][4096] = {"", ""};  // a signal handler must not allocate; empty: no file

void remove_and_end(int signal) {
  remove_unfinished_output();
  std::signal(signal, SIG_DFL);
  raise(signal);
}

/// True for `-`, /dev/stdout and other names of the file that is open as stdout: others may have written to
/// it, or may go on.
bool is_stdout(const std::string& name) {
  struct stat named, open;
  return name == "-" || (stat(name.c_str(), &named) == 0 && fstat(STDOUT_FILENO, &open) == 0 &&
                         named.st_dev == open.st_dev && named.st_ino == open.st_ino);
}

}  // namespace

void remove_unfinished_output() {
  for (const char* const name : names_to_remove)
    if (name[0] != '\0') unlink(name);
}

void OutputFile::fail(int error) const {
  throw std::runtime_error(name_ + ": cannot be written: " + std::strerror(error));
}

OutputFile::OutputFile(const std::string& name)
    : name_(name == "-" ? "stdout" : name),
      target_(is_stdout(name) ? "-" : name),
      out_(nullptr, std::fclose) {
  std::error_code error;
  const fs::file_status status = fs::status(name, error);
  if (fs::is_directory(status)) fail(EISDIR);
  copies_ = target_ == "-" || (fs::exists(status) && !fs::is_regular_file(status));
  if (!copies_) {
    const fs::path real = fs::weakly_canonical(name, error);  // symlinks
    // An open file without a name, as /dev/fd/5 may be: the link must not be renamed over.
    copies_ = fs::exists(status) && (error || !fs::equivalent(name, real, error));
    if (!copies_ && !error) target_ = real.string();
    if (fs::exists(status) && access(target_.c_str(), W_OK) != 0) fail(errno);
    // access() allows root everything.
    constexpr auto kWriting = fs::perms::owner_write | fs::perms::group_write | fs::perms::others_write;
    if (!copies_ && fs::exists(status) && (status.permissions() & kWriting) == fs::perms::none) fail(EACCES);
  }
  const fs::path folder = copies_ ? fs::temp_directory_path() : fs::path(target_).parent_path();
  // A name has at most 255 bytes.
  const std::string last = target_ == "-" ? "stdout" : fs::path(target_).filename().string();
  temporary_ = (folder / fmt::format(".{}.unfinished.{}.XXXXXX", last.substr(0, 200), getpid())).string();
  const int descriptor = mkstemp(temporary_.data());
  if (descriptor < 0) fail(errno);
  out_.reset(fdopen(descriptor, "wb"));
  for (char(&name)[4096] : names_to_remove)
    if (to_remove_ == nullptr && name[0] == '\0' && temporary_.size() < sizeof name)
      to_remove_ = std::strcpy(name, temporary_.c_str());
  for (const int signal : kSignals)  // ignored ones, and those that the command handles, stay so
    if (const auto before = std::signal(signal, remove_and_end); before != SIG_DFL)
      std::signal(signal, before);
}

OutputFile::~OutputFile() {
  if (!temporary_.empty()) unlink(temporary_.c_str());
  if (to_remove_ != nullptr) to_remove_[0] = '\0';
}

void OutputFile::write(const void* bytes, std::size_t size) {
  if (std::fwrite(bytes, 1, size, out_.get()) != size) fail(errno);
}

void OutputFile::flush() {
  write(text_.data(), text_.size());
  text_.clear();
}

void OutputFile::commit() {
  flush();
  if (std::fclose(out_.release()) != 0) fail(errno);
  if (copies_) {
    copy_to_target();
    return;
  }
  set_permissions();
  if (std::rename(temporary_.c_str(), target_.c_str()) != 0) fail(errno);
  temporary_.clear();
}

/// The permissions of the file that is replaced, and its owner and group if possible; else those of a new
/// file.
void OutputFile::set_permissions() const {
  struct stat replaced;
  const char* const name = temporary_.c_str();
  if (stat(target_.c_str(), &replaced) != 0) {
    const mode_t mask = umask(0);
    umask(mask);
    chmod(name, 0666 & ~mask);
    return;
  }
  mode_t mode = replaced.st_mode & 0777;
  if (chown(name, replaced.st_uid, replaced.st_gid) != 0 &&
      chown(name, static_cast<uid_t>(-1), replaced.st_gid) != 0)
    mode = (mode & 0707) | (mode & 07) << 3;  // another group may do what everybody may
  chmod(name, mode);
}

void OutputFile::copy_to_target() const {
  using Stream = std::unique_ptr<std::FILE, int (*)(std::FILE*)>;
  const Stream in(std::fopen(temporary_.c_str(), "rb"), std::fclose);
  Stream opened(target_ == "-" ? nullptr : std::fopen(target_.c_str(), "wb"), std::fclose);
  std::FILE* const out = target_ == "-" ? stdout : opened.get();
  if (in == nullptr || out == nullptr) fail(errno);
  std::vector<char> bytes(std::size_t{1} << 20);
  for (std::size_t got; (got = std::fread(bytes.data(), 1, bytes.size(), in.get())) > 0;)
    if (std::fwrite(bytes.data(), 1, got, out) != got) fail(errno);
  if (std::fflush(out) != 0) fail(errno);
}

}  // namespace files
