#include "time_of_threads.h"

#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdio>
#include <memory>
#include <thread>
#include <vector>

#include "contenders.h"
#include "measuring.h"
#include "model.h"
#include "orders.h"
#include "time_of_warm_starts.h"

namespace benchmark {
namespace {

struct Both {
  Samples by_default, on_one_thread;
};

/// Milliseconds a call by default and on one thread, in turn; of the slowest rank, where `launcher` starts
/// several.
Both measure_both(const std::string& self, const std::string& launcher, const Model& model, int repeats) {
  Both both;
  while (!both.by_default.enough(repeats)) {
    both.by_default.add(as_model(self, "env -u OMP_NUM_THREADS " + launcher, model).seconds);
    both.on_one_thread.add(as_model(self, "env OMP_NUM_THREADS=1 " + launcher, model).seconds);
  }
  return both;
}

void print_row(const std::string& name, const Both& both) {
  const double by_default = both.by_default.median(), one = both.on_one_thread.median();
  fmt::print("{:<34} {:>10.2f} {:>10.2f} {:>10.2f}\n", name, 1e3 * by_default, 1e3 * one, by_default / one);
  std::fflush(stdout);
}

void print_head(const std::string& title) {
  fmt::print("\n{}\n\n{:<34} {:>10} {:>10} {:>10}\n", title, "ms a call", "default", "1 thread", "ratio");
}

/// GB/s of a = b + 3c on arrays that are larger than the caches (McCalpin's STREAM), the best of ten rounds.
double triad(int threads) {
  constexpr std::ptrdiff_t kSize = 40'000'000;
  const auto array = [] { return std::unique_ptr<double[]>(new double[kSize]); };
  const auto a = array(), b = array(), c = array();
#pragma omp parallel for num_threads(threads) schedule(static)
  for (std::ptrdiff_t i = 0; i < kSize; ++i) a[i] = 0, b[i] = 1, c[i] = 2;
  double best = INFINITY;
  for (int round = 0; round < 10; ++round)
    best = std::min(best, seconds_of([&] {
#pragma omp parallel for num_threads(threads) schedule(static)
                      for (std::ptrdiff_t i = 0; i < kSize; ++i) a[i] = b[i] + 3 * c[i];
                    }));
  return 24e-9 * kSize / best;
}

}  // namespace

void run_scaling_of_threads(const std::string& self, int repeats) {
  const int processors = static_cast<int>(std::thread::hardware_concurrency());
  std::vector<int> threads;
  for (int t = 1; t < processors; t *= 2) threads.push_back(t);
  threads.push_back(processors);
  fmt::print("\nmilliseconds a call, and how many times as fast as on one thread\n\n{:<30} {:>9}", "threads",
             "");
  for (const int t : threads) fmt::print(" {:>10} {:>6}", t, "");
  fmt::print("\n{:<30} {:>9}", "triad, GB/s", "");
  double one = 0;
  for (const int t : threads) {
    const double speed = triad(t);
    if (one == 0) one = speed;
    fmt::print(" {:>10.1f} {:>6.2f}", speed, speed / one);
  }
  fmt::print("\n");
  const auto print = [&](const char* name, int n, int runs, const auto& seconds) {
    std::vector<Samples> samples(threads.size());
    for (int run = 0; run < runs; ++run)
      for (std::size_t k = 0; k < threads.size(); ++k) samples[k].add(seconds(n, threads[k]));
    fmt::print("{:<30} {:>9}", name, n);
    for (const Samples& s : samples)
      fmt::print(" {:>10.3f} {:>6.2f}", 1e3 * s.median(), samples[0].median() / s.median());
    fmt::print("\n");
    std::fflush(stdout);
  };
  const auto of = [&](Work work) {
    return [&self, work](int n, int t) {
      const Model model{"random", "given", n, std::clamp(3000000 / n, 1, 20), work};
      return as_model(self, fmt::format("OMP_NUM_THREADS={}", t), model).seconds;
    };
  };
  for (const int n : {100000, 1000000}) print("TRMESH", n, repeats, of(Work::trmesh));
  print("TRMESH", 10000000, 1, of(Work::trmesh));
  print("TRMESH, moved by 1e-3", 1000000, 1, [&](int, int t) { return seconds_of_warm_call(self, t); });
  print("TRLIST", 1000000, repeats, of(Work::trlist));
  print("CRLIST", 1000000, repeats, of(Work::crlist));
  print("scvt, one width", 92000, 1, of(Work::scvt));
  print("scvt, 60 to 30 km", 320000, 1, of(Work::widths));
}

void run_time_of_first_calls(const std::string& self, const std::vector<int>& sizes,
                             const legacy_stripack::Library* original_library, int repeats) {
  fmt::print(
      "\nthe first call of TRMESH in a process, and later ones, random nodes: milliseconds; peak of the "
      "process, bytes a node\n\n"
      "{:>10} {:>10} {:>8} {:>10} {:>8} {:>16} {:>16} {:>16}\n",
      "N", "1 thread", "peak", "default", "peak", "later, 1 thread", "original, first", "original, later");
  for (const int n : sizes) {
    const Model model{"random", "given", n, 1, Work::first};
    const Nodes nodes(n <= 1000000 ? comparison::nodes_in_order(model.points, std::size_t(n), model.order)
                                   : std::vector<pstripack::Point>{});
    const int calls = std::clamp(1000000 / n, 1, 100);
    Samples one, all, later, theirs, theirs_later;
    double peak_of_one = 0, peak_of_all = 0;
    while (!one.enough(repeats)) {
      const ModelFigures by_one = as_model(self, "OMP_NUM_THREADS=1", model),
                         by_all = as_model(self, "env -u OMP_NUM_THREADS", model);
      one.add(by_one.seconds), all.add(by_all.seconds);
      peak_of_one = by_one.peak, peak_of_all = by_all.peak;
      if (n <= 10000000)  // more would not fit beside the arrays of this program
        later.add(as_model(self, "OMP_NUM_THREADS=1", {"random", "given", n, calls}).seconds);
      if (original_library == nullptr || nodes.n() == 0) continue;
      theirs.add(measured([&] { return first_call(model, original_library).seconds; }));
      const Stripack library = original(*original_library);
      theirs_later.add(
          measured([&] { return seconds_a_call(Routine::trmesh, library, nodes, nullptr, calls); }));
    }
    const auto ms = [](const Samples& s) {
      return s.empty() ? "-" : fmt::format("{:.2f}", 1e3 * s.median());
    };
    fmt::print("{:>10} {:>10} {:>8.0f} {:>10} {:>8.0f} {:>16} {:>16} {:>16}\n", n, ms(one), peak_of_one,
               ms(all), peak_of_all, ms(later), ms(theirs), ms(theirs_later));
    std::fflush(stdout);
  }
}

void run_time_of_threads(const std::string& self, int repeats) {
  print_head("TRMESH, other random nodes in each call, 20 ms between the calls");
  for (const int n : {20000, 40962, 100000, 163842, 655362, 1000000}) {
    Model model{"random", "given", n, std::clamp(2000000 / n, 5, 40)};
    model.pause_ms = 20;
    print_row(fmt::format("{} nodes", n), measure_both(self, "", model, repeats));
  }
}

void run_time_of_threads_on_busy_machine(const std::string& self, int repeats) {
  constexpr int kBusy = 4;
  Model model{"random", "given", 40962, 20};
  model.pause_ms = 0;
  print_head(fmt::format("TRMESH, {} nodes, other nodes in each call", model.n));
#ifdef BENCHMARK_MPIEXEC
  for (const int ranks : {2, 4}) {
    const std::string launcher = fmt::format(
        "{} {} -n {}", geteuid() == 0 ? "OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1" : "",
        BENCHMARK_MPIEXEC, ranks);
    print_row(fmt::format("each of {} ranks by itself", ranks), measure_both(self, launcher, model, repeats));
  }
#endif
  static std::atomic<bool> is_over{false};
  for (int i = 0; i < kBusy; ++i)
    std::thread([] {
      while (!is_over) {
      }
    }).detach();
  print_row(fmt::format("a program beside {} others", kBusy), measure_both(self, "", model, repeats));
  is_over = true;
}

}  // namespace benchmark
