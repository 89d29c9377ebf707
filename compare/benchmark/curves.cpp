#include "curves.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <functional>
#include <stdexcept>
#include <thread>

#include "contenders.h"
#include "measuring.h"
#include "model.h"
#include "orders.h"

namespace benchmark {
namespace {

using legacy_stripack::Outcome;

/// A set of nodes, and how often one measurement triangulates it.
struct Task {
  Task(const std::string& points_, const std::string& order_, int wanted)
      : points(points_),
        order(order_),
        nodes(comparison::nodes_in_order(points, static_cast<std::size_t>(wanted), order)),
        calls(std::max(1, 200000 / nodes.n())) {}
  const std::string& points;
  const std::string& order;
  const Nodes nodes;
  const int calls;
};

struct Contender {
  std::string name;
  int threads;
  double bytes_a_node;  ///< memory of its process, including arrays and nodes; measured, then rounded up
  std::function<Measurement(const Task&, double time_limit)> measure;
};

Contender stripack_contender(const std::string& name, double bytes_a_node, const Stripack& library) {
  return {name, 1, bytes_a_node, [library](const Task& task, double time_limit) {
            return measure(
                [&] { return seconds_a_call(Routine::trmesh, library, task.nodes, nullptr, task.calls); },
                time_limit);
          }};
}

Contender witness_contender(const std::string& name, double bytes_a_node, const Witness& witness) {
  return {name, 1, bytes_a_node, [&witness](const Task& task, double time_limit) {
            return measure([&] { return seconds_a_call(witness, task.nodes.all, task.calls); }, time_limit);
          }};
}

/// The contender on all threads; the time limit does not apply to it.
Contender threads_contender(const std::string& name, double bytes_a_node, const std::string& self) {
  const int processors = static_cast<int>(std::thread::hardware_concurrency());
  return {name, processors, bytes_a_node, [self, processors](const Task& task, double) {
            const Model model{task.points, task.order, task.nodes.n(), task.calls};
            const std::string launcher = fmt::format("OMP_NUM_THREADS={}", processors);
            return Measurement{Outcome::returned, as_model(self, launcher, model).seconds};
          }};
}

/// The results of one contender in one order of the nodes, over increasing sizes.
struct Course {
  Contender contender;
  Samples samples;    ///< at the current size
  std::string ended;  ///< the reason why larger sizes are skipped; empty: none
};

/// Measures the contenders in turn until each has enough samples or is to be skipped.
void measure_all(std::vector<Course>& courses, const Task& task, const CurveSettings& settings) {
  const auto wants_turn = [&](const Course& c) {
    return c.ended.empty() && !c.samples.enough(settings.repeats);
  };
  const double bytes = bytes_in("/proc/meminfo", "MemAvailable:");
  const int n = task.nodes.n();
  for (Course& c : courses) {
    c.samples = {};
    if (const double wanted = c.contender.bytes_a_node * n; c.ended.empty() && wanted > bytes)
      c.ended = fmt::format("{:.0f} GB of memory needed at N = {}", wanted / 1e9, n);
  }
  while (std::any_of(courses.begin(), courses.end(), wants_turn))
    for (Course& c : courses) {
      if (!wants_turn(c)) continue;
      const Measurement m = c.contender.measure(task, settings.time_limit);
      if (m.outcome == Outcome::returned)
        c.samples.add(m.seconds);
      else
        c.ended =
            (m.outcome == Outcome::timed_out ? fmt::format("over {:g} s", settings.time_limit) : "failed") +
            fmt::format(" at N = {}", n);
    }
}

std::vector<Contender> contenders(const std::string& self, const std::vector<std::string>& wanted,
                                  const std::optional<legacy_stripack::Original>& original_library) {
  std::vector<Contender> all{stripack_contender("pstripack", 350, ours()),
                             threads_contender("pstripack-threads", 450, self)};
  if (original_library)
    all.push_back(stripack_contender("original", 150, original(original_library->library())));
  if (cgal.seconds != nullptr) all.push_back(witness_contender("cgal", 300, cgal));
  if (qhull.seconds != nullptr) all.push_back(witness_contender("qhull", 650, qhull));
  const auto is_unwanted = [&](const Contender& c) {
    return !wanted.empty() && std::find(wanted.begin(), wanted.end(), c.name) == wanted.end();
  };
  all.erase(std::remove_if(all.begin(), all.end(), is_unwanted), all.end());
  return all;
}

void run_order(const std::string& order, const CurveSettings& settings, std::vector<Course> courses) {
  fmt::print("\n{} nodes, order {}: microseconds a node, and what that is of the first column\n{:>9}",
             settings.points, order, "N");
  for (const Course& c : courses) fmt::print(" {:>17} {:>7}", c.contender.name, "");
  fmt::print("\n{:>9}", "threads");
  for (const Course& c : courses) fmt::print(" {:>17} {:>7}", c.contender.threads, "");
  fmt::print("\n");
  for (const int size : settings.sizes) {
    std::fflush(stdout);
    const Task task(settings.points, order, size);
    const int n = task.nodes.n();
    measure_all(courses, task, settings);
    const Samples& first = courses.front().samples;
    fmt::print("{:>9}", n);
    for (const Course& c : courses)
      fmt::print(" {:>17} {:>7}", microseconds(c.samples, n), ratio(c.samples, first));
    fmt::print("\n");
  }
  for (const Course& c : courses)
    if (!c.ended.empty()) fmt::print("{}: {}; larger N skipped\n", c.contender.name, c.ended);
}

}  // namespace

const std::vector<std::string>& contender_names() {
  static const std::vector<std::string> names{"pstripack", "pstripack-threads", "original", "cgal", "qhull"};
  return names;
}

void run_curves(const std::string& self, const CurveSettings& settings,
                const std::optional<legacy_stripack::Original>& original_library) {
  std::vector<Course> courses;
  for (const Contender& c : contenders(self, settings.contenders, original_library))
    courses.push_back({c, {}, ""});
  if (courses.empty()) throw std::invalid_argument("none of these contenders is in this build");
  for (const std::string& order : settings.orders) run_order(order, settings, courses);
}

}  // namespace benchmark
