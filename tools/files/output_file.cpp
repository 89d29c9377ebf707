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

constexpr int kSignals[] = {SIGHUP, SIGINT, SIGTERM};
char name_to_remove[4096] = "";  // a signal handler must not allocate; empty: no file

void remove_and_end(int signal) {
  if (name_to_remove[0] != '\0') unlink(name_to_remove);
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

void fail_to_write(const std::string& name, int error) {
  throw std::runtime_error(name + ": cannot be written: " + std::strerror(error));
}

OutputFile::OutputFile(const std::string& name)
    : name_(name == "-" ? "stdout" : name), target_(is_stdout(name) ? "-" : name) {
  std::error_code error;
  const fs::file_status status = fs::status(name, error);
  if (fs::is_directory(status)) fail_to_write(name_, EISDIR);
  copies_ = target_ == "-" || (fs::exists(status) && !fs::is_regular_file(status));
  if (!copies_) {
    const fs::path real = fs::weakly_canonical(name, error);  // symlinks
    // An open file without a name, as /dev/fd/5 may be: the link must not be renamed over.
    copies_ = fs::exists(status) && (error || !fs::equivalent(name, real, error));
    if (!copies_ && !error) target_ = real.string();
    if (fs::exists(status) && access(target_.c_str(), W_OK) != 0) fail_to_write(name_, errno);
  }
  const fs::path folder = copies_ ? fs::temp_directory_path() : fs::path(target_).parent_path();
  temporary_ = (folder / ("." + fs::path(target_).filename().string() + ".XXXXXX")).string();
  const int descriptor = mkstemp(temporary_.data());
  if (descriptor < 0) fail_to_write(name_, errno);
  const mode_t mask = umask(0);
  umask(mask);
  fchmod(descriptor, 0666 & ~mask);
  close(descriptor);
  if (temporary_.size() < sizeof name_to_remove) std::strcpy(name_to_remove, temporary_.c_str());
  for (const int signal : kSignals)
    if (std::signal(signal, remove_and_end) == SIG_IGN) std::signal(signal, SIG_IGN);
}

OutputFile::~OutputFile() {
  if (is_shared_) return;
  if (!temporary_.empty()) unlink(temporary_.c_str());
  name_to_remove[0] = '\0';
}

void OutputFile::commit() {
  if (copies_) {
    copy_to_target();
    return;
  }
  if (std::rename(temporary_.c_str(), target_.c_str()) != 0) fail_to_write(name_, errno);
  temporary_.clear();
}

void OutputFile::copy_to_target() const {
  using Stream = std::unique_ptr<std::FILE, int (*)(std::FILE*)>;
  const Stream in(std::fopen(temporary_.c_str(), "rb"), std::fclose);
  Stream opened(target_ == "-" ? nullptr : std::fopen(target_.c_str(), "wb"), std::fclose);
  std::FILE* const out = target_ == "-" ? stdout : opened.get();
  if (in == nullptr || out == nullptr) fail_to_write(name_, errno);
  std::vector<char> bytes(std::size_t{1} << 20);
  for (std::size_t got; (got = std::fread(bytes.data(), 1, bytes.size(), in.get())) > 0;)
    if (std::fwrite(bytes.data(), 1, got, out) != got) fail_to_write(name_, errno);
  if (std::fflush(out) != 0) fail_to_write(name_, errno);
}

TextWriter::TextWriter(const OutputFile& file)
    : name_(file.name()), out_(std::fopen(file.path().c_str(), file.is_begun() ? "ab" : "wb"), std::fclose) {
  if (out_ == nullptr) fail_to_write(name_, errno);
}

void TextWriter::write(const void* bytes, std::size_t size) {
  flush();
  if (std::fwrite(bytes, 1, size, out_.get()) != size) fail_to_write(name_, errno);
}

void TextWriter::flush() {
  if (std::fwrite(buffer_.data(), 1, buffer_.size(), out_.get()) != buffer_.size())
    fail_to_write(name_, errno);
  buffer_.clear();
}

void TextWriter::close() {
  flush();
  if (std::fclose(out_.release()) != 0) fail_to_write(name_, errno);
}

}  // namespace files
