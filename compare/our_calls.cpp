#include "our_calls.h"

#include <dlfcn.h>
#include <fcntl.h>
#include <fmt/format.h>
#include <string.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <cstddef>
#include <cstdlib>
#include <functional>
#include <new>
#include <stdexcept>
#include <system_error>
#include <utility>

#include "base/shared_area.h"
#include "base/system.h"
#include "child_process.h"
#include "median.h"
#include "pool/area_layout.h"

namespace comparison {
namespace {

using pstripack::Point;

constexpr double kEnoughSeconds = 10;

using pstripack::SharedArea;

/// A temporary file that disappears when this process ends, however that happens.
SharedArea new_area(std::size_t size) {
  SharedArea area = SharedArea::create(size);
  if (area.data() == nullptr) throw std::bad_alloc();
  return area;
}

/// The path by which a child of this process can open the area.
std::string path_of(const SharedArea& area) {
  const int file = area.file().get();
#if defined(__linux__)  // also for a child that pstripack-run starts
  return fmt::format("/proc/{}/fd/{}", getpid(), file);
#else
  fcntl(file, F_SETFD, 0);  // the child inherits it
  return fmt::format("/dev/fd/{}", file);
#endif
}

/// The data that the two processes exchange, before the arrays.
struct Call {
  char abi[8];
  std::int32_t n, repeats;
  std::int32_t started, returned;  // set to true by the other process
  std::int32_t ier, lnew;
  double seconds;
};

/// The arrays follow the call in the file.
struct Arrays {
  static constexpr std::size_t kFirst = 4096;  // a page, as in AreaLayout
  static_assert(sizeof(Call) <= kFirst);

  explicit Arrays(Call* call) : n(static_cast<std::size_t>(call->n)), slots(6 * n - 12) {
    const pstripack::AreaLayout layout(call->n, sizeof(double));
    void* const area = reinterpret_cast<unsigned char*>(call) + kFirst;
    double** const coordinates[] = {&x, &y, &z};
    for (int axis = 0; axis < 3; ++axis)
      *coordinates[axis] = static_cast<double*>(layout.coordinate(area, axis));
    const pstripack::ListArrays lists = layout.call(area, nullptr).lists;
    list = lists.list, lptr = lists.lptr, lend = lists.lend;
  }
  static std::size_t bytes(std::size_t n) {
    return kFirst + pstripack::AreaLayout(static_cast<std::int32_t>(n), sizeof(double)).size();
  }

  std::size_t n, slots;
  double *x, *y, *z;
  std::int32_t *list, *lptr, *lend;
};

std::string beside_this_program(const std::string& name) {
  const std::string path = pstripack::path_of_this_program();
  return name.empty() ? path : path.substr(0, path.rfind('/') + 1) + name;
}

/// The program installed beside this one, else that of the build.
std::string path_of_pstripack_run() {
#ifdef PSTRIPACK_RUN
  const std::string installed = beside_this_program("pstripack-run");
  for (const std::string& path : {installed, std::string(PSTRIPACK_RUN)})
    if (access(path.c_str(), X_OK) == 0) return path;
  throw std::runtime_error("--ranks: there is no " + installed);
#else
  throw std::runtime_error(
      "--ranks: this build has no pstripack-run (PSTRIPACK_WITH_MPI or PSTRIPACK_WITH_POOL is OFF)");
#endif
}

/// Removes PSTRIPACK's variables from the call's environment, except those for mpirun and the report.
void set_environment(const Setting& setting, const std::string& report) {
  std::vector<std::string> others;
  for (char** at = pstripack::all_environment_variables(); *at != nullptr; ++at) {
    const std::string name(*at, strcspn(*at, "="));
    if (name.rfind("PSTRIPACK_", 0) == 0 && name != "PSTRIPACK_MPIRUN" && name != "PSTRIPACK_REPORT")
      others.push_back(name);
  }
  for (const std::string& name : others) unsetenv(name.c_str());
  setenv("OMP_NUM_THREADS", std::to_string(setting.threads).c_str(), 1);
  setenv("PSTRIPACK_PARTITION", setting.partition.c_str(), 1);
  setenv("PSTRIPACK_ORDER", setting.order.c_str(), 1);
  if (setting.ranks == 1) return;
  setenv("PSTRIPACK_POOL_MIN_NODES", "3", 1);
  setenv("PSTRIPACK_REPORT", report.c_str(), 1);
}

[[noreturn]] void become(std::vector<std::string> words) {
  std::vector<char*> arguments;
  for (std::string& word : words) arguments.push_back(word.data());
  arguments.push_back(nullptr);
  const int nothing = open("/dev/null", O_RDONLY);
  dup2(nothing, STDIN_FILENO);
  execv(arguments[0], arguments.data());
  throw std::system_error(errno, std::generic_category(), words[0]);
}

/// Reports are appended to a file that has one byte at first.
constexpr off_t kReportBegins = 1;

/// True if the report's line says that a pool of `ranks` ranks carried out the call.
bool done_by_ranks(const SharedArea& report, int ranks) {
  char text[200] = "";
  if (pread(report.file().get(), text, sizeof text - 1, kReportBegins) < 0) return false;
  return std::string(text).rfind("pstripack: pool ", 0) == 0 &&
         strstr(text, fmt::format(" ranks={} ", ranks).c_str()) != nullptr;
}

template <class Real, class Int>
using Trmesh12 = void(const Int*, const Real*, const Real*, const Real*, Int*, Int*, Int*, Int*, Int*, Int*,
                      Real*, Int*);
using Trmesh8 = void(const std::int32_t*, const double*, const double*, const double*, std::int32_t*,
                     std::int32_t*, std::int32_t*, std::int32_t*);

void* load_trmesh(const std::string& abi) {
  const std::string library =
      abi == "r8" ? "libstripack" PSTRIPACK_LIBRARY_SUFFIX : "libstripack_" + abi + PSTRIPACK_LIBRARY_SUFFIX;
  void* const handle = dlopen(library.c_str(), RTLD_NOW | RTLD_LOCAL);
  void* const routine = handle != nullptr ? dlsym(handle, "trmesh_") : nullptr;
  if (routine == nullptr) throw std::runtime_error(dlerror());
  return routine;
}

/// Copies of the arrays in the library's kind of integers.
template <class Int>
struct Output {
  std::vector<Int> list, lptr, lend;
  Int lnew, ier;
};

template <class Int>
using CallOfTrmesh = std::function<void(Output<Int>&)>;

/// Calls the 12-argument TRMESH with the work arrays that Fortran programs pass.
template <class Real, class Int>
CallOfTrmesh<Int> call_of_12(void* routine, const Arrays& arrays) {
  const std::size_t n = arrays.n;
  return [routine, n, x = std::vector<Real>(arrays.x, arrays.x + n),
          y = std::vector<Real>(arrays.y, arrays.y + n), z = std::vector<Real>(arrays.z, arrays.z + n),
          near = std::vector<Int>(n), next = std::vector<Int>(n),
          dist = std::vector<Real>(n)](Output<Int>& out) mutable {
    const auto count = static_cast<Int>(n);
    reinterpret_cast<Trmesh12<Real, Int>*>(routine)(&count, x.data(), y.data(), z.data(), out.list.data(),
                                                    out.lptr.data(), out.lend.data(), &out.lnew, near.data(),
                                                    next.data(), dist.data(), &out.ier);
  };
}

/// LNEW of canonical lists, which the 8-argument TRMESH does not return: the slot after the last one of the
/// last node.
std::int32_t lnew_of(const std::vector<std::int32_t>& lend) {
  const auto last =
      std::find_if(lend.rbegin(), lend.rend(), [](std::int32_t slot) { return slot != kUntouched; });
  return last == lend.rend() ? kUntouched : *last + 1;
}

CallOfTrmesh<std::int32_t> call_of_8(void* routine, const Arrays& arrays) {
  return [routine, &arrays](Output<std::int32_t>& out) {
    const auto count = static_cast<std::int32_t>(arrays.n);
    reinterpret_cast<Trmesh8*>(routine)(&count, arrays.x, arrays.y, arrays.z, out.list.data(),
                                        out.lptr.data(), out.lend.data(), &out.ier);
    out.lnew = lnew_of(out.lend);
  };
}

/// Calls TRMESH `repeats` times and measures; keeps the output of the last call.
template <class Int>
void make_calls(const CallOfTrmesh<Int>& trmesh, Call& call, const Arrays& arrays) {
  using Clock = std::chrono::steady_clock;
  call.started = 1;
  Output<Int> out;
  std::vector<double> seconds;
  double total = 0;
  for (int repeat = 0; repeat < call.repeats && total < kEnoughSeconds; ++repeat) {
    out.list.assign(arrays.slots, kUntouched);
    out.lptr.assign(arrays.slots, kUntouched);
    out.lend.assign(arrays.n, kUntouched);
    out.lnew = out.ier = kUntouched;
    const auto start = Clock::now();
    trmesh(out);
    seconds.push_back(std::chrono::duration<double>(Clock::now() - start).count());
    total += seconds.back();
  }
  call.seconds = median(seconds);
  const auto narrow = [](Int value) { return static_cast<std::int32_t>(value); };
  call.ier = narrow(out.ier);
  call.lnew = narrow(out.lnew);
  std::transform(out.list.begin(), out.list.end(), arrays.list, narrow);
  std::transform(out.lptr.begin(), out.lptr.end(), arrays.lptr, narrow);
  std::transform(out.lend.begin(), out.lend.end(), arrays.lend, narrow);
  call.returned = 1;
}

}  // namespace

std::string describe(const Setting& setting) {
  std::string text = setting.abi;
  for (const auto& [count, what] : {std::pair(setting.threads, "thread"), std::pair(setting.ranks, "rank")})
    text += fmt::format(", {} {}{}", count, what, count == 1 ? "" : "s");
  return text + ", " + setting.partition;
}

OurRun run_ours(const std::vector<Point>& points, const Setting& setting, int repeats, double time_limit) {
  const SharedArea area = new_area(Arrays::bytes(points.size()));
  auto* const call = new (area.data()) Call{};
  std::copy(setting.abi.begin(), setting.abi.end(), call->abi);
  call->n = static_cast<std::int32_t>(points.size());
  call->repeats = repeats;
  const Arrays arrays(call);
  for (std::size_t i = 0; i < arrays.n; ++i)
    arrays.x[i] = points[i].x, arrays.y[i] = points[i].y, arrays.z[i] = points[i].z;

  const SharedArea report = new_area(kReportBegins);
  std::vector<std::string> words{beside_this_program(""), kCallCommand, path_of(area)};
  if (setting.ranks > 1)
    words.insert(words.begin(),
                 {path_of_pstripack_run(), "-n", std::to_string(setting.ranks), "--oversubscribe", "--"});
  const std::string report_path = path_of(report);  // in this process, not in the child
  const auto ended = legacy_stripack::run_in_child(
      [&] {
        set_environment(setting, report_path);
        become(words);
      },
      time_limit);

  OurRun run;
  static_cast<Setting&>(run) = setting;
  if (call->started == 0)
    throw std::runtime_error(
        setting.ranks > 1
            ? fmt::format("--ranks: {} MPI ranks could not be started: see above", setting.ranks)
            : "the library for --abi " + setting.abi + " could not be called: see above");
  if (call->returned == 0) {
    run.failure = ended.outcome == legacy_stripack::Outcome::timed_out
                      ? fmt::format("did not return within {:.4g} s", time_limit)
                  : ended.signal != 0
                      ? fmt::format("crashed (signal {}, {})", ended.signal, strsignal(ended.signal))
                      : "ended the program";
    return run;
  }
  if (setting.ranks > 1 && !done_by_ranks(report, setting.ranks)) {
    run.failure = "was not carried out by the ranks";
    return run;
  }
  run.ier = call->ier;
  run.seconds = call->seconds;
  run.lists = {{arrays.list, arrays.list + arrays.slots},
               {arrays.lptr, arrays.lptr + arrays.slots},
               {arrays.lend, arrays.lend + arrays.n},
               call->lnew};
  return run;
}

int call_trmesh(const char* path) {
  const SharedArea area = SharedArea::map(pstripack::Descriptor(open(path, O_RDWR | O_CLOEXEC)));
  if (area.data() == nullptr) throw std::system_error(errno, std::generic_category(), path);
  auto* const call = static_cast<Call*>(area.data());
  const Arrays arrays(call);
  const std::string abi = call->abi;
  void* const routine = load_trmesh(abi);
  if (abi == "r4")
    make_calls(call_of_12<float, std::int32_t>(routine, arrays), *call, arrays);
  else if (abi == "8arg")
    make_calls(call_of_8(routine, arrays), *call, arrays);
  else if (abi == "i8")
    make_calls(call_of_12<double, std::int64_t>(routine, arrays), *call, arrays);
  else
    make_calls(call_of_12<double, std::int32_t>(routine, arrays), *call, arrays);
  return 0;
}

bool same_bytes(const OurRun& a, const OurRun& b) {
  return a.failure == b.failure && a.ier == b.ier && a.lists.lnew == b.lists.lnew &&
         a.lists.list == b.lists.list && a.lists.lptr == b.lists.lptr && a.lists.lend == b.lists.lend;
}

}  // namespace comparison
