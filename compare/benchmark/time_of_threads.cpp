#include "time_of_threads.h"

#include <fmt/format.h>
#include <signal.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <vector>

#include "measuring.h"
#include "model.h"

namespace benchmark {
namespace {

/// Programs that do nothing but use a processor each.
class BusyPrograms {
 public:
  explicit BusyPrograms(int count) {
    while (count-- > 0) {
      const pid_t child = fork();
      if (child == 0)
        for (volatile int i = 0;; i = i + 1) {
        }
      children_.push_back(child);
    }
  }
  ~BusyPrograms() {
    for (const pid_t child : children_) kill(child, SIGKILL);
  }
  BusyPrograms(const BusyPrograms&) = delete;
  BusyPrograms& operator=(const BusyPrograms&) = delete;

 private:
  std::vector<pid_t> children_;
};

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

}  // namespace

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
  const BusyPrograms others(kBusy);
  print_row(fmt::format("a program beside {} others", kBusy), measure_both(self, "", model, repeats));
}

}  // namespace benchmark
