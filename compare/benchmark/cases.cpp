#include "cases.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <functional>
#include <memory>
#include <stdexcept>

#include "contenders.h"
#include "measuring.h"
#include "model.h"
#include "orders.h"
#include "time_of_distributions.h"
#include "time_of_queries.h"
#include "time_of_scvt.h"
#include "time_of_threads.h"
#include "time_of_warm_starts.h"

namespace benchmark {
namespace {

using legacy_stripack::Outcome;
using pstripack::Point;

struct Case {
  std::string name;
  Routine routine;
  std::string family, order;
  int n;
  bool has_witnesses = false;
  bool takes_the_original_minutes = false;  // if so, only ours is measured
  std::string setting{};                    // of PSTRIPACK_ORDER, for TRMESH
};

const std::vector<Case> kCases{
    {"random-1e4", Routine::trmesh, "random", "given", 10000, true},
    {"random-1e5", Routine::trmesh, "random", "given", 100000, true},
    {"random-1e6", Routine::trmesh, "random", "given", 1000000, true},
    {"latlon-1e5", Routine::trmesh, "latlon", "given", 100000},
    {"icosahedral-42", Routine::trmesh, "icosahedral", "shuffled", 42},
    {"icosahedral-162", Routine::trmesh, "icosahedral", "shuffled", 162},
    {"icosahedral-642", Routine::trmesh, "icosahedral", "shuffled", 642},
    {"icosahedral-2562", Routine::trmesh, "icosahedral", "shuffled", 2562},
    {"trlist-1e5", Routine::trlist, "random", "given", 100000},
    {"trlist-1e6", Routine::trlist, "random", "given", 1000000, false, true},
    {"crlist-1e6", Routine::crlist, "random", "given", 1000000},
    {"order-random-1e5", Routine::trmesh, "random", "given", 100000, false, false, "original"},
    {"order-random-1e6", Routine::trmesh, "random", "given", 1000000, false, false, "original"},
    {"order-latlon-1e5", Routine::trmesh, "latlon", "given", 100000, false, false, "original"},
    {"order-bitwise-1e5", Routine::trmesh, "latlon", "given", 100000, false, false, "bitwise"},
};

/// The original's lists for these nodes, made in a process of their own.
std::shared_ptr<Lists> lists_of_original(const legacy_stripack::Original& original, const Nodes& nodes) {
  constexpr double kTimeLimit = 1800;
  const auto result = original.triangulate(nodes.x, nodes.y, nodes.z, kTimeLimit);
  if (result.outcome != Outcome::returned || result.ier != 0)
    throw std::runtime_error("the original did not triangulate the nodes");
  auto lists = std::make_shared<Lists>(nodes.n());
  lists->list = result.list;
  lists->lptr = result.lptr;
  lists->lend = result.lend;
  lists->lnew = result.lnew;
  return lists;
}

double peak_bytes_a_node(const Nodes& nodes) {
  return measured([&] {
    Lists lists(nodes.n());
    return peak_bytes([&] { ours().trmesh(nodes, lists); }) / nodes.n();
  });
}

void run(const Case& c, const std::string& self, const std::optional<legacy_stripack::Original>& if_any,
         int repeats) {
  const std::optional<legacy_stripack::Original> none;
  const auto& original_library = c.takes_the_original_minutes ? none : if_any;
  const std::vector<Point> points =
      comparison::nodes_in_order(c.family, static_cast<std::size_t>(c.n), c.order);
  const Nodes nodes(points);
  const int calls = std::max(1, 200000 / nodes.n());

  const Stripack own_library = ours();
  Stripack theirs_library;
  if (original_library) theirs_library = original(original_library->library());

  std::shared_ptr<Lists> own_lists, theirs_lists;
  if (c.routine != Routine::trmesh) {
    own_lists = std::make_shared<Lists>(nodes.n());
    own_library.trmesh(nodes, *own_lists);
    if (original_library) theirs_lists = lists_of_original(*original_library, nodes);
  }

  const auto measured_call = [&](const Stripack& library, const std::shared_ptr<Lists>& lists) {
    return measured([&] { return seconds_a_call(c.routine, library, nodes, lists.get(), calls); });
  };
  Samples own, theirs, by_cgal, by_qhull;
  const auto witness_turn = [&](const Witness& witness, Samples& samples) {
    if (c.has_witnesses && witness.seconds != nullptr && !samples.enough(repeats))
      samples.add(measured([&] { return seconds_a_call(witness, points, calls); }));
  };
  // A process reads PSTRIPACK_ORDER once, so each setting is measured in a model of its own.
  double peak = c.routine == Routine::trmesh && nodes.n() >= 100000 ? peak_bytes_a_node(nodes) : 0;
  const auto own_turn = [&] {
    if (c.setting.empty()) return measured_call(own_library, own_lists);
    const ModelFigures figures =
        as_model(self, "OMP_NUM_THREADS=1 PSTRIPACK_ORDER=" + c.setting, {c.family, c.order, c.n, calls});
    peak = figures.peak;
    return figures.seconds;
  };
  while (!own.enough(repeats) || (original_library && !theirs.enough(repeats))) {
    if (!own.enough(repeats)) own.add(own_turn());
    if (original_library && !theirs.enough(repeats)) theirs.add(measured_call(theirs_library, theirs_lists));
    witness_turn(cgal, by_cgal);
    witness_turn(qhull, by_qhull);
  }
  fmt::print("{:<17} {:>8} {:>9} {:>9} {:>9} {:>9} {:>15} {:>11} {:>12} {:>9}\n", c.name, nodes.n(),
             microseconds(own, nodes.n()), microseconds(theirs, nodes.n()), microseconds(by_cgal, nodes.n()),
             microseconds(by_qhull, nodes.n()), ratio(theirs, own), ratio(by_cgal, own), ratio(by_qhull, own),
             peak > 0 ? fmt::format("{:.0f}", peak) : "");
  std::fflush(stdout);
}

// ---- tables of their own, which run only if named ----------------------------------------------------

struct Call {
  const std::string& self;
  const CaseSettings& settings;
  const std::optional<legacy_stripack::Original>& original_library;
};

struct Table {
  std::string name;
  std::function<void(const Call&)> print;
};

Table table_of_queries(const std::string& name, int n) {
  return {name, [name, n](const Call& c) {
            if (!c.original_library)
              throw std::invalid_argument(name + ": there is no original to compare with");
            run_time_of_queries(n, *c.original_library, c.settings.repeats);
          }};
}

const std::vector<Table> kTables{
    {"warm-start", [](const Call& c) { run_time_of_warm_starts(c.self, c.settings.repeats); }},
    {"scvt", [](const Call&) { run_time_of_scvt(); }},
    {"threads", [](const Call& c) { run_time_of_threads(c.self, c.settings.repeats); }},
    {"busy", [](const Call& c) { run_time_of_threads_on_busy_machine(c.self, c.settings.repeats); }},
    {"first-call",
     [](const Call& c) {
       run_time_of_first_calls(c.self, {2562, 10242, 40962, 163842, 1000000, 10000000},
                               c.original_library ? &c.original_library->library() : nullptr,
                               c.settings.repeats);
     }},
    {"first-call-1e8", [](const Call& c) { run_time_of_first_calls(c.self, {100000000}, nullptr, 1); }},
    {"thread-counts", [](const Call& c) { run_scaling_of_threads(c.self, c.settings.repeats); }},
    {"distributions", [](const Call& c) { run_time_of_distributions(c.settings.sets, c.settings.repeats); }},
    table_of_queries("queries-1e4", 10000),
    table_of_queries("queries-1e6", 1000000),
};

}  // namespace

std::vector<std::string> case_names() {
  std::vector<std::string> names;
  for (const Case& c : kCases) names.push_back(c.name);
  for (const Table& t : kTables) names.push_back(t.name);
  return names;
}

void run_cases(const std::string& self, const CaseSettings& settings,
               const std::optional<legacy_stripack::Original>& original_library) {
  const std::vector<std::string>& only = settings.only;
  const auto is_named = [&](const std::string& name) {
    return std::find(only.begin(), only.end(), name) != only.end();
  };
  std::size_t tables = 0;
  for (const Table& t : kTables)
    if (is_named(t.name)) t.print({self, settings, original_library}), ++tables;
  if (tables > 0 && tables == only.size()) return;

  fmt::print("\n{:<17} {:>8} {:^39} {:>15} {:>11} {:>12} {:>9}\n", "", "", "microseconds a node",
             "original / ours", "CGAL / ours", "Qhull / ours", "peak");
  fmt::print("{:<17} {:>8} {:>9} {:>9} {:>9} {:>9} {:>15} {:>11} {:>12} {:>9}\n", "case", "N", "ours",
             "original", "CGAL", "Qhull", "", "", "", "bytes/N");
  for (const Case& c : kCases) {
    if (!only.empty() && !is_named(c.name)) continue;
    try {
      run(c, self, original_library, settings.repeats);
    } catch (const std::exception& e) {
      fmt::print("{:<17} {}\n", c.name, e.what());
    }
  }
  fmt::print(
      "\ncrlist: the original without the latitudes and longitudes of centres that libngmath adds"
      "\norder: lists in the original's order, PSTRIPACK_ORDER=original"
      "\norder-bitwise: PSTRIPACK_ORDER=bitwise"
      "\npeak: memory during TRMESH beyond the caller's arrays\n");
}

}  // namespace benchmark
