#include "observe/check.h"

#include <errno.h>
#include <fcntl.h>
#include <limits.h>
#include <pthread.h>
#include <stdlib.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <atomic>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <exception>
#include <memory>
#include <stdexcept>
#include <string>

#include "base/environment.h"
#include "base/splitmix64.h"
#include "base/transfer.h"
#include "lists/limits.h"
#include "observe/recorded_block.h"
#include "observe/shadow_process.h"
#include "parallel/cost.h"
#include "stripack/original/original_rules.h"

namespace pstripack {
namespace {

/// Appends one block to the file, in one piece even if other processes write to it. The file is opened each
/// time, because a program may close descriptors that it does not know.
void append(const std::string& path, iovec* parts, int count) {
  struct File {
    int number;
    ~File() {
      // close() alone would not unlock the file if a process forked meanwhile has it open, too.
      flock(number, LOCK_UN);
      close(number);
    }
  } const file{open(path.c_str(), O_WRONLY | O_APPEND | O_CREAT | O_CLOEXEC | O_NOCTTY | O_NONBLOCK, 0666)};
  if (file.number < 0) throw std::runtime_error(std::strerror(errno));
  // an open file can be locked, unless a signal interrupts
  while (flock(file.number, LOCK_EX) != 0)
    if (errno != EINTR) throw std::runtime_error(std::strerror(errno));
  struct stat before {};
  // an open file has a state
  if (fstat(file.number, &before) != 0) throw std::runtime_error(std::strerror(errno));
  if (S_ISFIFO(before.st_mode)) throw std::runtime_error("a pipe; a file is needed");
  if (transfer_all(parts, count, [&](iovec* some, int number) { return writev(file.number, some, number); }))
    return;
  const std::string why = std::strerror(errno);
  // Half a block would make later blocks of other processes unreadable.
  // a file that could be made longer can be made shorter
  if (S_ISREG(before.st_mode) && ftruncate(file.number, before.st_size) != 0)
    throw std::runtime_error(why + "; its last block is not complete");
  throw std::runtime_error(why);
}

iovec bytes(const void* begin, std::size_t size) { return {const_cast<void*>(begin), size}; }

}  // namespace

/// Exists until the process ends.
class Check {
 public:
  /// Reads the environment and the working directory when the library is loaded, because the program may
  /// change both later. Null if no check is asked for.
  static Check* from_environment() {
    const char* const value = environment_variable("PSTRIPACK_CHECK");
    if (value == nullptr || *value == '\0') return nullptr;
    try {
      char folder[PATH_MAX];
      auto check = std::make_unique<Check>(value, getcwd(folder, sizeof folder) != nullptr ? folder : "");
      pthread_atfork([] { the_check_->lock(); }, [] { the_check_->unlock(); },
                     [] { the_check_->begin_anew(); });
      std::atexit([] { the_check_->finish(); });
      return check.release();
    } catch (const std::exception& e) {
      std::fprintf(stderr, "pstripack: PSTRIPACK_CHECK: %s; no call is checked\n", e.what());
      return nullptr;
    }
  }

  Check(const std::string& value, const std::string& folder) {
    if (value.rfind("lib:", 0) == 0)
      shadow_ = std::make_unique<ShadowProcess>(value.substr(4), folder);
    else
      path_ = value[0] == '/' ? value : folder + "/" + value;
    draw_process_number();
  }

  std::int64_t next_number() { return ++calls_; }

  /// Writes a block: `header` goes to parts[0], the body is parts[1..count-1].
  void write(BlockHeader& header, iovec* parts, int count) noexcept {
    if (has_ended_) return;
    const int error = errno;
    std::memcpy(header.magic, BlockHeader::kMagic, sizeof header.magic);
    header.process_id = getpid();
    for (int i = 1; i < count; ++i) header.body_bytes += static_cast<std::int64_t>(parts[i].iov_len);
    parts[0] = bytes(&header, sizeof header);
    lock();
    header.process = process_;
    try {
      if (has_ended_) {  // while this thread waited
      } else if (shadow_ != nullptr) {
        shadow_->send(parts, count);
      } else {
        append(path_, parts, count);
      }
    } catch (const std::exception& e) {
      has_ended_ = true;
      std::fprintf(stderr, "pstripack: PSTRIPACK_CHECK: %s%s%s; calls are not checked from here on\n",
                   path_.c_str(), path_.empty() ? "" : ": ", e.what());
    }
    unlock();
    errno = error;
  }

 private:
  void lock() { pthread_mutex_lock(&one_block_at_a_time_); }
  void unlock() { pthread_mutex_unlock(&one_block_at_a_time_); }

  void draw_process_number() {
    const double now = clock_seconds(CLOCK_REALTIME);
    process_ = splitmix64(static_cast<std::uint64_t>(getpid()) << 32 ^ static_cast<std::uint64_t>(1e9 * now));
  }

  /// In a forked child.
  void begin_anew() {
    draw_process_number();
    calls_ = 0;
    if (shadow_ != nullptr) shadow_->leave_to_parent();
    unlock();
  }

  void finish() {
    lock();
    has_ended_ = true;
    if (shadow_ != nullptr && !shadow_->finish())
      std::fputs("pstripack: PSTRIPACK_CHECK: the program has ended, the check of its last calls goes on\n",
                 stderr);
    unlock();
  }

  static Check* const the_check_;
  friend Check* check_of_calls() noexcept;
  friend void leave_check_to_another_rank(bool leave);
  static std::atomic<Check*> writes_here_;

  std::string path_;                       ///< of the file; empty if blocks go to a program
  std::unique_ptr<ShadowProcess> shadow_;  ///< that program; null if blocks go to a file
  std::uint64_t process_ = 0;
  std::atomic<std::int64_t> calls_{0};
  std::atomic<bool> has_ended_{false};
  pthread_mutex_t one_block_at_a_time_ = PTHREAD_MUTEX_INITIALIZER;
};

Check* const Check::the_check_ = Check::from_environment();
std::atomic<Check*> Check::writes_here_{Check::the_check_};

Check* check_of_calls() noexcept { return Check::writes_here_.load(std::memory_order_relaxed); }

namespace {
BlockHeader header_of(BlockHeader::Kind kind, const CheckedCall& call) {
  BlockHeader header;
  header.kind = kind;
  header.routine = call.routine;
  header.real_bytes = call.real_bytes;
  header.integer_bytes = sizeof(std::int32_t);
  header.call = call.number;
  header.n = call.n;
  return header;
}

BlockHeader::Routine routine_of(const TrmeshCall& call) {
  const OriginalRules& rules = original_rules();
  if (call.by_direction) return BlockHeader::delaunay;
  if (!rules.follow) return BlockHeader::trmesh;
  if (rules.single_precision_random) return rules.bitwise ? BlockHeader::bitwise_ngmath : BlockHeader::ngmath;
  return rules.bitwise ? BlockHeader::bitwise : BlockHeader::original;
}
}  // namespace

CheckedCall check_input(Check& check, const TrmeshCall& trmesh) noexcept {
  const NodeArrays& nodes = trmesh.nodes;
  CheckedCall call{routine_of(trmesh), static_cast<std::uint32_t>(nodes.real_bytes()), check.next_number(),
                   trmesh.n, 0};
  BlockHeader header = header_of(BlockHeader::input, call);
  // If n is out of range TRMESH does not read the arrays, which may have any length.
  const bool is_read = trmesh.n >= 3 && trmesh.n <= most_nodes<std::int32_t>();
  const std::size_t size = is_read ? static_cast<std::size_t>(trmesh.n) * nodes.real_bytes() : 0;
  iovec parts[4] = {
      {}, bytes(nodes.array(0), size), bytes(nodes.array(1), size), bytes(nodes.array(2), size)};
  check.write(header, parts, 4);
  call.start = clock_seconds(CLOCK_MONOTONIC);
  return call;
}

void check_output(Check& check, const CheckedCall& call, const TrmeshResult& result,
                  const ListArrays& lists) noexcept {
  const auto& [list, lptr, lend, lnew] = lists;
  const double seconds = clock_seconds(CLOCK_MONOTONIC) - call.start;
  BlockHeader header = header_of(BlockHeader::output, call);
  header.nanoseconds = std::llround(1e9 * seconds);
  header.ier = result.ier;
  if (result.ier >= 0) {
    header.nodes = result.ier > 0 ? result.other - 1 : call.n;
    header.lnew = *lnew;
  }
  const std::size_t slots = header.lnew == 0 ? 0 : (static_cast<std::size_t>(header.lnew) - 1) * sizeof *list;
  iovec parts[4] = {{},
                    bytes(list, slots),
                    bytes(lptr, slots),
                    bytes(lend, static_cast<std::size_t>(header.nodes) * sizeof *lend)};
  check.write(header, parts, 4);
}

void leave_check_to_another_rank(bool leave) { Check::writes_here_ = leave ? nullptr : Check::the_check_; }

}  // namespace pstripack
