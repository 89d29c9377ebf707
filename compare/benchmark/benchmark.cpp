// pstripack-benchmark: times of PSTRIPACK, the original STRIPACK, CGAL and Qhull, side by side in one run.
//
// Every measurement runs in its own process on one thread. The contenders alternate, so that changes in the
// machine's speed affect all of them. Arrays are written before the clock starts, and a call of less than a
// second is preceded by an unmeasured one. CGAL and Qhull only triangulate; the others also write their
// lists.

#include <fmt/chrono.h>
#include <fmt/format.h>
#ifdef _OPENMP
#include <omp.h>
#endif

#include <CLI/CLI.hpp>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <optional>
#include <stdexcept>
#include <string>
#include <thread>

#include "cases.h"
#include "contenders.h"
#include "curves.h"
#include "measuring.h"
#include "model.h"
#include "number_in.h"
#include "original.h"
#include "pstripack.h"
#include "standard_streams.h"
#include "time_of_scvt.h"
#include "time_of_warm_starts.h"

using namespace benchmark;

namespace {

void print_head(const std::optional<legacy_stripack::Location>& where, int repeats) {
  fmt::print("machine    {}\nprocessors {}, no binding\ncompiler   {} {}\ndate       {:%Y-%m-%d %H:%M} UTC\n",
             processor(), std::thread::hardware_concurrency(), BENCHMARK_COMPILER, BENCHMARK_FLAGS,
             fmt::gmtime(std::time(nullptr)));
  fmt::print("pstripack  {}\noriginal   {}\nCGAL       {}\nQhull      {}\n", pstripack_version(),
             where ? where->name : "none found", cgal.description, qhull.description);
  fmt::print(
      "threads    1, unless stated otherwise\nrepeats    {}, median; at most 3 above 2 s, 1 above 30 s; "
      "on threads by threes\n",
      repeats);
}

}  // namespace

int main(int argc, char** argv) {
  fill_standard_streams();
  CLI::App app("Times of PSTRIPACK, the original STRIPACK, CGAL and Qhull on one thread, and their ratios.",
               "pstripack-benchmark");
  app.footer("cases: " + CLI::detail::join(case_names(), " "));
  CaseSettings cases;
  app.add_option(
         "--only", cases.only,
         "only these cases, for example random-1e4,latlon-1e5; those from `warm-start` on run only if "
         "named")
      ->delimiter(',')
      ->check(CLI::IsMember(case_names()));
  app.add_option("--sets", cases.sets, "only these point sets in the case `distributions`")->delimiter(',');
  const std::string repeats_help =
      "measurements each, median taken; default 7, at most 3 above 2 s, 1 above 30 s; on threads by threes";
  app.add_option("--repeats", cases.repeats, repeats_help)->check(CLI::Range(1, 1000));

  CurveSettings curves;
  CLI::App& curves_app = *app.add_subcommand("curves",
                                             "Time per node against N, for all contenders and several orders "
                                             "of the nodes. A contender that exceeds\n"
                                             "the time limit, or would not fit into memory, skips larger N.");
  curves_app.add_option("--points", curves.points, "point set, as in stripack-compare")
      ->capture_default_str();
  curves_app
      .add_option("--orders", curves.orders,
                  "given: as the point set makes them; shuffled; sorted: south to north;\n"
                  "rows: south to north in rows along the longitude, as grids are numbered")
      ->delimiter(',')
      ->check(CLI::IsMember(std::vector<std::string>{"given", "shuffled", "sorted", "rows"}))
      ->capture_default_str();
  curves_app.add_option("--sizes", curves.sizes, "numbers of nodes, increasing")
      ->delimiter(',')
      ->check(CLI::Range(4, 300000000))
      ->capture_default_str();
  curves_app.add_option("--contenders", curves.contenders, "only these; ratios are to the first one")
      ->delimiter(',')
      ->check(CLI::IsMember(contender_names()));
  curves_app
      .add_option("--time-limit", curves.time_limit, "seconds of one measurement, including its preparation")
      ->check(number_in(1e-6, 1e6))
      ->capture_default_str();
  curves_app.add_option("--repeats", curves.repeats, repeats_help)->check(CLI::Range(1, 1000));

  DescentSettings descents;
  CLI::App& descents_app = *app.add_subcommand(
      "descents", "Centroidal tessellations: gradient and energy against evaluations and time.");
  descents_app.add_option("--n", descents.n, "generators")
      ->check(CLI::Range(4, 10000000))
      ->capture_default_str();
  descents_app
      .add_option("--evaluations", descents.evaluations, "largest number of evaluations for each method")
      ->check(CLI::Range(1, 10000000))
      ->capture_default_str();

  Model model;  // see as_model
  app.add_option("--be-the-model", model.calls)->group("");
  app.add_option("--model-points", model.points)->group("");
  app.add_option("--model-order", model.order)->group("");
  app.add_option("--model-nodes", model.n)->group("");
  app.add_option("--model-pause", model.pause_ms)->group("");
  app.add_option("--model-work", model.work)->group("");
  MovingModel moving_model;  // see run_time_of_warm_starts
  app.add_option("--be-the-moving-model", moving_model.moves)->group("");
  try {
    app.parse(argc, argv);
    if (!moving_model.moves.empty()) return be_the_moving_model(moving_model);
    // Calls with the same nodes must not reuse the last mesh: measure first calls.
    setenv("PSTRIPACK_WARM_START", "0", 1);
    if (model.calls > 0) return be_the_model(model);
#ifdef _OPENMP
    omp_set_num_threads(1);
#endif
    const auto where = legacy_stripack::configured_original();
    std::optional<legacy_stripack::Original> original_library;
    if (where) original_library.emplace(*where);
    print_head(where, curves_app.parsed() ? curves.repeats : cases.repeats);
    if (curves_app.parsed())
      run_curves(argv[0], curves, original_library);
    else if (descents_app.parsed())
      run_descents(descents);
    else
      run_cases(argv[0], cases, original_library);
    expect_printed();
    return 0;
  } catch (const CLI::ParseError& e) {
    if (e.get_exit_code() == 0) return after_help("pstripack-benchmark", app.exit(e));
    std::fprintf(stderr, "pstripack-benchmark: %s\n", e.what());
    return 2;
  } catch (const std::exception& e) {
    std::fprintf(stderr, "pstripack-benchmark: %s\n", e.what());
    return dynamic_cast<const std::invalid_argument*>(&e) != nullptr ? 2 : 1;
  }
}
