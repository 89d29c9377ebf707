#pragma once
// Limits for a library that reads a file that may be damaged.

#include <sys/resource.h>

#include <csignal>
#include <cstddef>
#include <string>

namespace files {

/// While it exists, a crash or an endless loop of the library that reads `file` ends the program, with a line
/// on stderr and this exit code; unfinished output is removed. Calls within Limits cannot fill the memory.
/// libnetcdf and libhdf5 do not survive every damaged file, and no list of checks is complete. A child
/// process would be no safer, and would read each file twice or send what it reads. Only one object may exist
/// at a time.
class ReadingGuard {
 public:
  explicit ReadingGuard(const std::string& file, int exit_code = 1, int seconds = 10);
  ~ReadingGuard();
  ReadingGuard(const ReadingGuard&) = delete;
  ReadingGuard& operator=(const ReadingGuard&) = delete;

  /// The next calls read this many bytes: each may take four times as much memory, besides 256 MB, and all
  /// calls together get 100 ns of processor time for each byte, besides the seconds of the constructor.
  void grant(std::size_t bytes);

  /// Exists during one call of the library: the program's own work has no limits.
  class Limits {
   public:
    explicit Limits(ReadingGuard& guard);
    ~Limits();
    Limits(const Limits&) = delete;
    Limits& operator=(const Limits&) = delete;

   private:
    ReadingGuard& guard_;
    rlimit before_;
    double begin_;
  };

 private:
  static constexpr int kSignals[] = {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT, SIGPROF};
  struct sigaction before_[sizeof kSignals / sizeof *kSignals];
  stack_t stack_before_;
  std::size_t bytes_ = 0;
  double seconds_left_;
};

}  // namespace files
