#include "files/reading_guard.h"

#include <fmt/format.h>
#include <sys/time.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <ctime>
#include <fstream>
#include <iterator>

#include "base/system.h"
#include "files/output_file.h"

namespace files {
namespace {

// For the signal handler, which must not allocate memory.
std::string crashed, did_not_end;
int exit_code_of_crash = 1;
alignas(16) char stack[1 << 16];  // a recursion without end leaves no other one

void end_program(int signal) {
  remove_unfinished_output();
  const std::string& what = signal == SIGPROF ? did_not_end : crashed;
  [[maybe_unused]] const auto written = write(STDERR_FILENO, what.data(), what.size());
  _exit(exit_code_of_crash);
}

/// Bytes of address space that the process has; 0: unknown.
rlim_t used_memory() {
  std::size_t pages = 0;
  std::ifstream("/proc/self/statm") >> pages;
  return static_cast<rlim_t>(pages) * static_cast<rlim_t>(sysconf(_SC_PAGESIZE));
}

/// Seconds of all threads.
double processor_time() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// SIGPROF after so many seconds of processor time; 0: never.
void set_timer(double seconds) {
  itimerval timer{};
  timer.it_value.tv_sec = static_cast<time_t>(seconds);
  timer.it_value.tv_usec = static_cast<suseconds_t>(1e6 * (seconds - std::floor(seconds)));
  setitimer(ITIMER_PROF, &timer, nullptr);
}

}  // namespace

ReadingGuard::ReadingGuard(const std::string& file, int exit_code, int seconds) : seconds_left_(seconds) {
  exit_code_of_crash = exit_code;
  crashed = fmt::format("{}: {}: cannot be read: the NetCDF library crashed: the file is damaged\n",
                        pstripack::name_of_this_program(), file);
  did_not_end = fmt::format("{}: {}: cannot be read: the NetCDF library does not end: the file is damaged\n",
                            pstripack::name_of_this_program(), file);
  stack_t own{};
  own.ss_sp = stack;
  own.ss_size = sizeof stack;
  sigaltstack(&own, &stack_before_);
  struct sigaction action {};
  action.sa_handler = end_program;
  action.sa_flags = SA_ONSTACK | static_cast<int>(SA_RESETHAND);
  for (std::size_t i = 0; i < std::size(kSignals); ++i) sigaction(kSignals[i], &action, &before_[i]);
}

ReadingGuard::~ReadingGuard() {
  for (std::size_t i = 0; i < std::size(kSignals); ++i) sigaction(kSignals[i], &before_[i], nullptr);
  sigaltstack(&stack_before_, nullptr);
}

void ReadingGuard::grant(std::size_t bytes) {
  bytes_ = bytes;
  seconds_left_ += 1e-7 * static_cast<double>(bytes);
}

ReadingGuard::Limits::Limits(ReadingGuard& guard) : guard_(guard), begin_(processor_time()) {
  getrlimit(RLIMIT_AS, &before_);
  rlimit memory = before_;
  if (const rlim_t used = used_memory(); used > 0)
    memory.rlim_cur =
        std::min<rlim_t>(memory.rlim_cur, used + (rlim_t{256} << 20) + 4 * rlim_t{guard.bytes_});
  setrlimit(RLIMIT_AS, &memory);
  if (guard.seconds_left_ <= 0) raise(SIGPROF);
  set_timer(std::max(guard.seconds_left_, 1e-6));
}

ReadingGuard::Limits::~Limits() {
  set_timer(0);
  guard_.seconds_left_ -= processor_time() - begin_;  // the timer itself counts ticks, and rounds up
  setrlimit(RLIMIT_AS, &before_);
}

}  // namespace files
