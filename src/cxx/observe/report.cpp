#include "observe/report.h"

#include <errno.h>
#include <fcntl.h>
#include <pthread.h>
#include <stdarg.h>
#include <stdlib.h>
#include <strings.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <charconv>
#include <climits>
#include <cmath>
#include <cstdio>
#include <cstring>

#include "base/environment.h"

namespace pstripack {
namespace {

constexpr const char* kMode[] = {"threads", "pool", "comm", "distributed", "distributed-gather"};
constexpr const char* kPhase[] = {"divide", "triangulate", "merge", "lists", "gather"};
static_assert(sizeof kMode / sizeof *kMode == CallReport::modes);
static_assert(sizeof kPhase / sizeof *kPhase == ParallelCost::phases);

std::int64_t microseconds(double seconds) { return std::llround(1e6 * seconds); }

/// Lines of text, written by one system call, so that lines of several threads and processes do not mix.
class Text {
 public:
  __attribute__((format(printf, 2, 3))) void add(const char* format, ...) {
    va_list arguments;
    va_start(arguments, format);
    const int length = std::vsnprintf(text_ + size_, sizeof text_ - size_, format, arguments);
    va_end(arguments);
    if (length > 0) size_ = std::min(size_ + static_cast<std::size_t>(length), sizeof text_ - 1);
  }
  /// Formats integers, because the program's locale may have a decimal comma.
  void add_seconds(std::int64_t us, int width = 0) {
    const int before_point = width > 7 ? width - 7 : 0;
    add("%*lld.%06d", before_point, static_cast<long long>(us / 1000000), static_cast<int>(us % 1000000));
  }
  /// To three digits, also without the program's locale.
  void add_number(double value) {
    char digits[32];
    const auto end = std::to_chars(digits, digits + sizeof digits, value, std::chars_format::general, 3).ptr;
    add("%.*s", static_cast<int>(end - digits), digits);
  }
  bool empty() const { return size_ == 0; }
  bool write_to(int file) const {
    for (std::size_t at = 0; at < size_;) {
      const ssize_t written = ::write(file, text_ + at, size_ - at);
      if (written < 0 && errno != EINTR) return false;
      if (written > 0) at += static_cast<std::size_t>(written);
    }
    return true;
  }

 private:
  std::size_t size_ = 0;
  char text_[2048] = "";
};

/// Exists until the process ends. Has no locks: a forked child could inherit a lock that nobody releases.
class Report {
 public:
  /// Reads the environment and the working directory when the library is loaded, because the program may
  /// change both later. Null if no report is asked for.
  static Report* from_environment() {
    const char* const value = environment_variable("PSTRIPACK_REPORT");
    if (value == nullptr || *value == '\0' || std::strcmp(value, "0") == 0) return nullptr;
    for (const char* const word : {"yes", "no", "on", "off", "true", "false"})
      if (strcasecmp(value, word) == 0) {
        std::fprintf(stderr,
                     "pstripack: PSTRIPACK_REPORT=%s: neither 1 nor the path of a file, which would be ./%s; "
                     "there is no report\n",
                     value, value);
        return nullptr;
      }
    static Report report;
    if (std::strcmp(value, "1") != 0) report.set_path(value);
    pthread_atfork(nullptr, nullptr, [] { the_report_->clear(); });  // those calls are the parent's
    std::atexit([] { the_report_->write_table(); });
    return &report;
  }
  static Report* get() { return the_report_; }

  void add(const CallReport& call) {
    std::int64_t us[ParallelCost::phases];
    for (int i = 0; i < ParallelCost::phases; ++i) us[i] = microseconds(call.cost.maximum.seconds[i]);
    const std::int64_t total = microseconds(call.seconds);
    Row& row = rows_[call.mode];
    row.calls += 1;
    row.us += total;
    for (int i = 0; i < ParallelCost::phases; ++i) row.phase_us[i] += us[i];

    const std::int64_t mesh = call.nodes_in_mesh, boundary = call.boundary_nodes;
    const std::int64_t triangles = mesh == 0 ? 0 : 2 * mesh - (boundary == 0 ? 4 : 2 + boundary);  // Euler
    Text line;
    line.add(
        "pstripack: %s n=%lld ranks=%d threads=%d of=%d limit=%s triangles=%lld boundary=%lld ier=%d "
        "seconds=",
        kMode[call.mode], static_cast<long long>(call.n), call.ranks, call.cost.maximum.threads,
        processors_of_mask(), name_of(call.cost.mine.limit), static_cast<long long>(triangles),
        static_cast<long long>(boundary), static_cast<int>(call.ier));
    line.add_seconds(total);
    for (int i = 0; i < ParallelCost::phases; ++i) {
      line.add(" %s=", kPhase[i]);
      line.add_seconds(us[i]);
      if (call.cost.ranks == 1) continue;
      line.add("/");
      line.add_seconds(microseconds(call.cost.total.seconds[i] / call.cost.ranks));
    }
    line.add(" rounds=%d halo=%lld bytes=%lld", call.cost.maximum.rounds,
             static_cast<long long>(call.cost.total.halo),
             static_cast<long long>(call.cost.total.bytes_sent));
    if (call.mode != CallReport::distributed_gather) {
      line.add(" start=%s", call.cost.maximum.flips >= 0 ? "warm" : "cold");
      if (call.cost.maximum.flips >= 0)
        line.add(" flips=%lld", static_cast<long long>(call.cost.total.flips));
    }
    if (call.shortest < 1 - 1e-6 || call.longest > 1 + 1e-6) {
      line.add(" lengths=");
      line.add_number(call.shortest);
      line.add("..");
      line.add_number(call.longest);
    }
    add_order(line, call);
    line.add("\n");
    write(line);
  }

 private:
  struct Row {
    std::atomic<std::int64_t> calls{0}, us{0}, phase_us[ParallelCost::phases] = {};
  };

  /// The last item of the line, because it may be a sentence.
  static void add_order(Text& line, const CallReport& call) {
    const auto node = static_cast<long long>(call.order_node);
    switch (call.order) {
      case OriginalOrder::not_asked:
        break;
      case OriginalOrder::made:
        line.add(" order=original");
        break;
      case OriginalOrder::inexact:
        line.add(" order=original");
        add_difference(line, call.difference);
        break;
      case OriginalOrder::collinear:
        line.add(" order=canonical: STRIPACK rejects node %lld: within rounding it is collinear with every ",
                 node);
        line.add("visible boundary edge");
        break;
      case OriginalOrder::endless:
        line.add(" order=canonical: the original's search for node %lld does not end", node);
        break;
      case OriginalOrder::wrong:
        line.add(" order=canonical: the original's triangulation is not the exact mesh");
        break;
      case OriginalOrder::broken:
        line.add(" order=canonical: the original's lists are no triangulation");
        break;
    }
  }

  static void add_difference(Text& line, const std::optional<ExactDifference>& difference) {
    if (!difference) {
      line.add(": not compared with the exact mesh, out of memory");
    } else if (difference->ier != 0) {
      line.add(": the exact IER is %d", static_cast<int>(difference->ier));
    } else if (const auto [ier, arcs, triangles] = *difference; arcs > 0 || triangles > 0) {
      line.add(": differs from the exact mesh in ");
      if (arcs > 0) line.add("%lld arc%s", static_cast<long long>(arcs), arcs == 1 ? "" : "s");
      if (arcs > 0 && triangles > 0) line.add(" and ");
      if (triangles > 0)
        line.add("%lld boundary triangle%s", static_cast<long long>(triangles), triangles == 1 ? "" : "s");
    }
  }

  /// A path that does not fit is an error: cut off, it would name another file.
  void set_path(const char* path) {
    char folder[PATH_MAX] = "";
    const bool is_relative = *path != '/' && getcwd(folder, sizeof folder) != nullptr;
    const int length = std::snprintf(path_, sizeof path_, "%s%s%s", folder, is_relative ? "/" : "", path);
    if (length >= static_cast<int>(sizeof path_)) fail(path, ENAMETOOLONG);
  }

  void clear() {
    for (Row& row : rows_) {
      row.calls = row.us = 0;
      for (auto& us : row.phase_us) us = 0;
    }
  }

  void write_table() {
    Text table;
    for (int mode = 0; mode < CallReport::modes; ++mode) {
      const Row& row = rows_[mode];
      if (row.calls == 0) continue;
      if (table.empty()) {
        table.add("pstripack: total seconds        calls         call    mean call");
        for (const char* phase : kPhase) table.add(" %12s", phase);
        table.add("\n");
      }
      table.add("pstripack: %-18s %7lld", kMode[mode], static_cast<long long>(row.calls));
      for (const std::int64_t us : {row.us.load(), row.us / row.calls}) {
        table.add(" ");
        table.add_seconds(us, 12);
      }
      for (const auto& us : row.phase_us) {
        table.add(" ");
        table.add_seconds(us, 12);
      }
      table.add("\n");
    }
    if (!table.empty()) write(table);
  }

  /// The file is opened each time, because a program may close descriptors that it does not know. Never waits
  /// for the reader of a pipe.
  void write(const Text& text) {
    if (path_[0] == '\0') {
      text.write_to(STDERR_FILENO);
      return;
    }
    if (has_failed_) return;
    const int file = open(path_, O_WRONLY | O_APPEND | O_CREAT | O_CLOEXEC | O_NOCTTY | O_NONBLOCK, 0666);
    const bool written = file >= 0 && text.write_to(file);
    const int error = errno;
    if (file >= 0) close(file);
    if (!written) fail(path_, error);
  }

  void fail(const char* path, int error) {
    if (!has_failed_.exchange(true))
      std::fprintf(stderr, "pstripack: PSTRIPACK_REPORT: %s: %s; there is no report\n", path,
                   std::strerror(error));
  }

  static Report* const the_report_;
  char path_[PATH_MAX] = "";  ///< empty: stderr
  Row rows_[CallReport::modes];
  std::atomic<bool> has_failed_{false};
};

Report* const Report::the_report_ = Report::from_environment();

}  // namespace

bool report_is_wanted() { return Report::get() != nullptr; }

void add_to_report(const CallReport& call) {
  Report* const report = Report::get();
  if (report == nullptr) return;
  const int error = errno;
  report->add(call);
  errno = error;
}

}  // namespace pstripack
