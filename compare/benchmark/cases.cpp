#include "cases.h"

#include <fmt/format.h>
#include <unistd.h>
#ifdef _OPENMP
#include <omp.h>
#endif

#include <algorithm>
#include <cstdio>
#include <functional>
#include <memory>
#include <stdexcept>
#include <utility>

#include "contenders.h"
#include "measuring.h"
#include "memory_of_lists.h"
#include "model.h"
#include "orders.h"
#include "point_sets.h"
#include "pstripack.h"
#include "time_of_distributions.h"
#include "time_of_orders.h"
#include "time_of_queries.h"
#include "time_of_scvt.h"
#include "time_of_threads.h"
#include "time_of_warm_starts.h"

namespace benchmark {
namespace {

using legacy_stripack::Library;
using legacy_stripack::Outcome;
using pstripack::Point;

enum class Routine { trmesh, trlist_of_6_rows, trlist_of_9_rows, crlist, crlist_as_shipped };

struct Case {
  std::string name;
  Routine routine;
  std::string family;
  int n;
  bool shuffled;
  double original_over_ours, cgal_over_ours;  // smallest ratio required; 0: none
  bool takes_the_original_minutes = false;    // if so, only ours is measured
  bool has_witnesses() const { return cgal_over_ours > 0; }
};

const std::vector<Case> kCases{
    {"random-1e4", Routine::trmesh, "random", 10000, false, 4.5, 2.2},
    {"random-1e5", Routine::trmesh, "random", 100000, false, 6.5, 2.2},
    {"random-1e6", Routine::trmesh, "random", 1000000, false, 22, 2.0},
    {"latlon-1e5", Routine::trmesh, "latlon", 100000, false, 120, 0},
    {"icosahedral-12", Routine::trmesh, "icosahedral", 12, true, 1, 0},
    {"icosahedral-42", Routine::trmesh, "icosahedral", 42, true, 1, 0},
    {"icosahedral-162", Routine::trmesh, "icosahedral", 162, true, 1, 0},
    {"icosahedral-642", Routine::trmesh, "icosahedral", 642, true, 1, 0},
    {"icosahedral-2562", Routine::trmesh, "icosahedral", 2562, true, 1, 0},
    {"trlist-1e5", Routine::trlist_of_9_rows, "random", 100000, false, 300, 0},
    {"trlist-1e6", Routine::trlist_of_9_rows, "random", 1000000, false, 0, 0, true},
    {"trlist-6-rows-1e6", Routine::trlist_of_6_rows, "random", 1000000, false, 0, 0, true},
    {"crlist-1e6", Routine::crlist_as_shipped, "random", 1000000, false, 3, 0},
    {"crlist-xyz-1e6", Routine::crlist, "random", 1000000, false, 0, 0},
};

Lists lists_from(const Stripack& library, const Nodes& nodes) {
  Lists lists(nodes.n());
  library.trmesh(nodes, lists);
  return lists;
}

/// Seconds of one call of the case's routine, in its own process. `lists`: for routines that read a
/// triangulation.
double measure_call(const Case& c, const Stripack& library, const Nodes& nodes,
                    const std::shared_ptr<Lists>& lists, int calls) {
  return measured([&] {
    const int n = nodes.n();
    const std::size_t triangles = 2 * std::size_t(n) - 4;
    switch (c.routine) {
      case Routine::trmesh: {
        Lists own(n);
        return seconds_a_call([&] { library.trmesh(nodes, own); }, calls);
      }
      case Routine::trlist_of_6_rows:
      case Routine::trlist_of_9_rows: {
        const int rows = c.routine == Routine::trlist_of_6_rows ? 6 : 9;
        std::vector<int> ltri(static_cast<std::size_t>(rows) * triangles);
        return seconds_a_call([&] { library.trlist(n, *lists, rows, ltri); }, calls);
      }
      case Routine::crlist:
      case Routine::crlist_as_shipped: {
        std::vector<int> listc(3 * triangles);
        std::vector<double> centres(4 * triangles);
        return seconds_a_call([&] { library.crlist(nodes, *lists, listc, centres); }, calls);
      }
    }
    throw std::logic_error("unknown routine");
  });
}

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

std::string ratio(const Samples& theirs, const Samples& own, double required) {
  const std::string measured = theirs.empty() ? "-" : fmt::format("{:.2f}", theirs.median() / own.median());
  return fmt::format("{:>9} {:>7}", measured, required > 0 ? fmt::format("({:g})", required) : "");
}

// ---- on threads, and with a pool of ranks -----------------------------------------------------------

const Model kModel{"random", "given", 1000000, 5};

/// Measures CRLIST on all processors and the original's in turn; libngmath's if the original is libngmath. In
/// this process.
void run_crlist_on_threads(const std::optional<legacy_stripack::Original>& original_library, int repeats) {
#ifdef _OPENMP
  if (!original_library) return;
  constexpr double kRequired = 5;  // of two threads
  const Nodes nodes(nodes_in_order(kModel.points, static_cast<std::size_t>(kModel.n), kModel.order));
  const Stripack own_library = ours();
  const auto as_shipped = original_as_shipped(original_library->library());
  const Stripack theirs_library = as_shipped ? *as_shipped : original(original_library->library());
  omp_set_num_threads(omp_get_num_procs());
  Lists own_lists = lists_from(own_library, nodes);
  const auto theirs_lists = lists_of_original(*original_library, nodes);
  std::vector<int> listc(6 * static_cast<std::size_t>(nodes.n()) - 12);
  std::vector<double> centres(4 * (2 * static_cast<std::size_t>(nodes.n()) - 4));
  const auto seconds = [&](const Stripack& library, Lists& lists) {
    const auto start = Clock::now();
    library.crlist(nodes, lists, listc, centres);
    return seconds_since(start);
  };
  Samples own, theirs;
  while (!own.enough(repeats)) {
    measure_in_a_row(own, [&] { return seconds(own_library, own_lists); });
    measure_in_a_row(theirs, [&] { return seconds(theirs_library, *theirs_lists); });
  }
  fmt::print("{:<17} {:>8} {:>9} on {} threads, the original {}: {:.2f} times the speed ({:g})\n",
             "crlist-threads", nodes.n(), microseconds(own, nodes.n()), omp_get_num_procs(),
             microseconds(theirs, nodes.n()), theirs.median() / own.median(), kRequired);
#else
  static_cast<void>(original_library);
  static_cast<void>(repeats);
#endif
}

/// Measures the same model alone and with a pool of two single-threaded ranks in turn. The time is that of
/// the whole call, with the transfer to the ranks and back.
void run_pool([[maybe_unused]] const std::string& self, [[maybe_unused]] int repeats) {
#ifdef PSTRIPACK_RUN
  constexpr double kRequired = 1.5;
  const auto seconds_of = [&](const std::string& launcher) {
    return as_model(
               self,
               fmt::format("{}OMP_NUM_THREADS=1 {}",
                           geteuid() == 0 ? "OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 " : "",
                           launcher),
               kModel)
        .seconds;
  };
  Samples alone, pool;
  for (int k = 0; k < std::min(repeats, 5); ++k) {
    alone.add(seconds_of(""));
    pool.add(seconds_of(fmt::format("'{}' -n 2 --bind-to none --oversubscribe --", PSTRIPACK_RUN)));
  }
  fmt::print("{:<17} {:>8} {:>9} alone, {} with a pool of 2 ranks: {:.2f} times the speed ({:g})\n",
             "pool-1e6", kModel.n, microseconds(alone, kModel.n), microseconds(pool, kModel.n),
             alone.median() / pool.median(), kRequired);
#endif
}

// ---- in the original's order ------------------------------------------------------------------------

/// TRMESH under PSTRIPACK_ORDER. A process reads this variable once, so each order is measured in a model of
/// its own.
struct OrderCase {
  std::string name, setting, family, order;
  int n;
  double original_over_ours;
};
const std::vector<OrderCase> kOrderCases{
    {"order-random-1e5", "original", "random", "given", 100000, 1},
    {"order-random-1e6", "original", "random", "given", 1000000, 1},
    {"order-latlon-1e5", "original", "latlon", "given", 100000, 20},
    {"order-sorted-1e5", "original", "random", "latitude", 100000, 0},
    {"order-bitwise-1e5", "bitwise", "latlon", "given", 100000, 1},
};

void run_order(const OrderCase& c, const std::string& self,
               const std::optional<legacy_stripack::Original>& original_library, int repeats) {
  const Nodes nodes(nodes_in_order(c.family, static_cast<std::size_t>(c.n), c.order));
  const Model model{c.family, c.order, c.n, std::max(1, 200000 / c.n)};
  Samples own, theirs;
  double peak = 0;
  while (!own.enough(repeats) || (original_library && !theirs.enough(repeats))) {
    if (!own.enough(repeats)) {
      const ModelFigures figures = as_model(self, "OMP_NUM_THREADS=1 PSTRIPACK_ORDER=" + c.setting, model);
      own.add(figures.seconds);
      peak = figures.peak;
    }
    if (original_library && !theirs.enough(repeats))
      theirs.add(measured([&] {
        Lists lists(nodes.n());
        const Stripack library = original(original_library->library());
        return seconds_a_call([&] { library.trmesh(nodes, lists); }, model.calls);
      }));
  }
  fmt::print("{:<17} {:>8} {:>9} {:>9} {:>9} {:>9} {} {:>17} {:>17} {:>9.0f}\n", c.name, nodes.n(),
             microseconds(own, nodes.n()), microseconds(theirs, nodes.n()), "-", "-",
             ratio(theirs, own, c.original_over_ours), "", "", peak);
  std::fflush(stdout);
}

/// The nodes of a case. Symmetric sets are shuffled until the first three nodes are not on one great circle
/// and the original returns.
std::vector<Point> nodes_of(const Case& c, const std::optional<legacy_stripack::Original>& original_library) {
  for (std::uint64_t seed = 1; seed <= 100; ++seed) {
    std::vector<Point> points = point_sets::make(c.family, c.n, 1);
    if (!c.shuffled) return points;
    point_sets::shuffle(points, seed);
    const Nodes nodes(points);
    Lists lists(nodes.n());
    const int ier = pstripack_trmesh(nodes.n(), nodes.x.data(), nodes.y.data(), nodes.z.data(),
                                     lists.list.data(), lists.lptr.data(), lists.lend.data(), &lists.lnew);
    if (ier != 0) continue;
    if (!original_library) return points;
    const auto result = original_library->triangulate(points, 5);
    if (result.outcome == Outcome::returned && result.ier == 0) return points;
  }
  throw std::runtime_error("no order of the nodes that the original can triangulate");
}

void run(const Case& c, const std::optional<legacy_stripack::Original>& if_any, int repeats) {
  const std::optional<legacy_stripack::Original> none;
  const auto& original_library = c.takes_the_original_minutes ? none : if_any;
  const std::vector<Point> points = nodes_of(c, original_library);
  const Nodes nodes(points);
  const int calls = std::max(1, 200000 / nodes.n());

  const Stripack own_library = ours();
  Stripack theirs_library;
  if (original_library) {
    const Library& library = original_library->library();
    theirs_library = original(library);
    if (c.routine == Routine::crlist_as_shipped)
      if (const auto as_shipped = original_as_shipped(library)) theirs_library = *as_shipped;
  }

  std::shared_ptr<Lists> own_lists, theirs_lists;
  if (c.routine != Routine::trmesh) {
    own_lists = std::make_shared<Lists>(lists_from(own_library, nodes));
    if (original_library) theirs_lists = lists_of_original(*original_library, nodes);
  }

  Samples own, theirs, by_cgal, by_qhull;
  const auto witness_turn = [&](const Witness& witness, Samples& samples) {
    if (c.has_witnesses() && witness.seconds != nullptr && !samples.enough(repeats))
      samples.add(measured([&] { return seconds_a_call(witness, points, calls); }));
  };
  while (!own.enough(repeats) || (original_library && !theirs.enough(repeats))) {
    if (!own.enough(repeats)) own.add(measure_call(c, own_library, nodes, own_lists, calls));
    if (original_library && !theirs.enough(repeats))
      theirs.add(measure_call(c, theirs_library, nodes, theirs_lists, calls));
    witness_turn(cgal, by_cgal);
    witness_turn(qhull, by_qhull);
  }
  const std::string memory = c.routine == Routine::trmesh && nodes.n() >= 100000
                                 ? fmt::format("{:.0f}", peak_bytes_a_node(nodes))
                                 : "";
  fmt::print("{:<17} {:>8} {:>9} {:>9} {:>9} {:>9} {} {} {} {:>9}\n", c.name, nodes.n(),
             microseconds(own, nodes.n()), microseconds(theirs, nodes.n()), microseconds(by_cgal, nodes.n()),
             microseconds(by_qhull, nodes.n()), ratio(theirs, own, c.original_over_ours),
             ratio(by_cgal, own, c.cgal_over_ours), ratio(by_qhull, own, 0), memory);
  std::fflush(stdout);
}

const std::vector<std::string> kParallelCases{"pool-1e6", "crlist-threads"};
const std::vector<std::pair<std::string, int>> kTimesOfOrders{{"orders-1e5", 100000},
                                                              {"orders-1e6", 1000000}};
const std::vector<std::pair<std::string, int>> kTimesOfQueries{
    {"queries-1e3", 1000}, {"queries-1e4", 10000}, {"queries-1e5", 100000}, {"queries-1e6", 1000000}};
const std::string kDistributions = "distributions", kOnThreads = "distributions-threads",
                  kWarmStart = "warm-start", kScvt = "scvt", kMemoryOfLists = "memory-of-lists",
                  kThreads = "threads", kBusy = "busy";

}  // namespace

std::vector<std::string> case_names() {
  std::vector<std::string> names;
  for (const Case& c : kCases) names.push_back(c.name);
  for (const OrderCase& c : kOrderCases) names.push_back(c.name);
  names.insert(names.end(), kParallelCases.begin(), kParallelCases.end());
  for (const auto& [name, n] : kTimesOfOrders) names.push_back(name);
  for (const auto& [name, n] : kTimesOfQueries) names.push_back(name);
  names.push_back(kDistributions);
  names.push_back(kOnThreads);
  names.push_back(kWarmStart);
  names.push_back(kScvt);
  names.push_back(kMemoryOfLists);
  names.push_back(kThreads);
  names.push_back(kBusy);
  return names;
}

void run_cases(const std::string& self, const CaseSettings& settings,
               const std::optional<legacy_stripack::Original>& original_library) {
  const auto& [quick, only, sets, repeats] = settings;
  const auto is_wanted = [&wanted = only](const std::string& name, bool by_default) {
    return wanted.empty() ? by_default : std::find(wanted.begin(), wanted.end(), name) != wanted.end();
  };
  for (const auto& [name, n] : kTimesOfOrders)
    if (is_wanted(name, !quick)) run_time_of_orders(n, repeats);
  if (is_wanted(kWarmStart, false)) run_time_of_warm_starts(self, repeats);
  if (is_wanted(kScvt, false)) run_time_of_scvt(quick, repeats);
  if (is_wanted(kThreads, false)) run_time_of_threads(self, repeats);
  if (is_wanted(kBusy, false)) run_time_of_threads_on_busy_machine(self, repeats);
  if (is_wanted(kMemoryOfLists, false)) print_memory_of_lists();
  if (is_wanted(kDistributions, false)) run_time_of_distributions(sets, repeats);
  if (is_wanted(kOnThreads, false)) run_distributions_on_threads(sets, repeats);
  for (const auto& [name, n] : kTimesOfQueries)
    if (is_wanted(name, false)) {
      if (!original_library) throw std::invalid_argument(name + ": there is no original to compare with");
      run_time_of_queries(n, *original_library, repeats);
    }
  const auto has_its_own_table = [](const std::string& name) {
    return name == kDistributions || name == kOnThreads || name == kWarmStart || name == kScvt ||
           name == kMemoryOfLists || name == kThreads || name == kBusy || name.rfind("orders-", 0) == 0 ||
           name.rfind("queries-", 0) == 0;
  };
  if (!only.empty() && std::all_of(only.begin(), only.end(), has_its_own_table)) return;

  fmt::print("\nin parentheses the ratio asked for\n\n");
  fmt::print("{:<17} {:>8} {:^39} {:^17} {:^17} {:^17} {:>9}\n", "", "", "microseconds a node",
             "original / ours", "CGAL / ours", "Qhull / ours", "peak");
  fmt::print("{:<17} {:>8} {:>9} {:>9} {:>9} {:>9} {:>17} {:>17} {:>17} {:>9}\n", "case", "N", "ours",
             "original", "CGAL", "Qhull", "", "", "", "bytes/N");
  for (const Case& c : kCases) {
    if (!is_wanted(c.name, !quick || c.n < 1000000)) continue;
    try {
      run(c, original_library, repeats);
    } catch (const std::exception& e) {
      fmt::print("{:<17} {}\n", c.name, e.what());
    }
  }
  for (const OrderCase& c : kOrderCases)
    if (is_wanted(c.name, !quick || c.n < 1000000)) run_order(c, self, original_library, repeats);
  if (is_wanted("pool-1e6", !quick)) run_pool(self, repeats);
  if (is_wanted("crlist-threads", !quick)) run_crlist_on_threads(original_library, repeats);
  fmt::print(
      "\ncrlist: against CSCRLIST as libngmath ships it, which turns centres into latitudes and longitudes;"
      "\ncrlist-xyz: against the same routine without these angles, as STRIPACK's CRLIST"
      "\norder: lists in the original's order, PSTRIPACK_ORDER=original"
      "\norder-bitwise: PSTRIPACK_ORDER=bitwise"
      "\npeak: memory during TRMESH "
      "beyond the caller's arrays; asked for: at most 220 bytes a node\n");
}

}  // namespace benchmark
