#include "time_of_scvt.h"

#include <fmt/format.h>
#include <time.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <stdexcept>
#include <vector>

#include "contenders.h"
#include "csv_file.h"
#include "measuring.h"
#include "median.h"
#include "point_sets.h"
#include "scvt/evaluator.h"
#include "scvt/first_generators.h"
#include "scvt/front.h"
#include "scvt/tessellation.h"

namespace benchmark {
namespace {

using namespace pstripack::scvt;
using pstripack::Point;

enum class First { front, levels, random };
const char* name_of(First first) {
  return first == First::front ? "front" : first == First::levels ? "levels" : "random";
}

std::unique_ptr<Density> density_called(const std::string& name) {
  if (name == "constant") return std::make_unique<ConstantDensity>();
  constexpr double kDegree = 3.14159265358979323846 / 180;
  const Point centre{std::cos(30 * kDegree), 0, std::sin(30 * kDegree)};
  return std::make_unique<BumpDensity>(centre, 30 * kDegree, 10 * kDegree, 3);  // bump of `pstripack scvt`
}

/// Processor seconds of the calling thread.
double cpu_seconds() {
  timespec t;
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

Tessellation descend(std::size_t n, const Density& density, First first, RunOptions options) {
  options.levels = first == First::levels;
  return first == First::front ? run(front_generators(n, density), density, options)
                               : run(n, density, options);
}

/// Runs work() in a process of its own, where triangulations may reuse the last mesh.
void in_its_own_process(const std::function<void()>& work) {
  measured([&] {
    setenv("PSTRIPACK_WARM_START", "1", 1);
    work();
    return 0.0;
  });
}

// ---- whole runs -------------------------------------------------------------------------------------

struct Row {
  const char* density;
  std::size_t n;
  First first;
  double tolerance;
  double evaluations;  ///< largest number; 0: not required
};

constexpr double kEvaluations = 250;
const std::vector<Row> kRows{
    {"constant", 10242, First::front, 1e-5, kEvaluations},
    {"constant", 10242, First::levels, 1e-5, kEvaluations},
    {"constant", 10242, First::random, 1e-5, 0},
    {"constant", 163842, First::front, 1e-5, kEvaluations},
    {"constant", 163842, First::levels, 1e-5, kEvaluations},
    {"constant", 163842, First::random, 1e-5, 0},
    {"bump", 10242, First::front, 1e-4, kEvaluations},
    {"bump", 10242, First::levels, 1e-4, kEvaluations},
    {"bump", 10242, First::random, 1e-4, 0},
    {"bump", 163842, First::front, 1e-4, kEvaluations},
    {"bump", 163842, First::levels, 1e-4, kEvaluations},
    {"bump", 163842, First::random, 1e-4, 0},
};
bool is_quick(const Row& row) { return row.n < 20000 && row.first != First::random; }

struct Found {
  double evaluations, gradient, energy, seconds;
  bool has_converged;
};

Found found_by(const std::string& density_name, std::size_t n, First first, double tolerance) {
  const legacy_stripack::Shared<Found> found;
  in_its_own_process([&] {
    const auto density = density_called(density_name);
    RunOptions options;
    options.tolerance = tolerance;
    const double start = cpu_seconds();
    const Tessellation t = descend(n, *density, first, options);
    found[0] = {t.evaluations, t.result.progress.gradient, t.result.progress.energy, cpu_seconds() - start,
                t.result.end == End::converged};
  });
  return found[0];
}

void print_runs(bool quick) {
  fmt::print(
      "\nCentroidal tessellations on one thread, to a gradient. evaluations: of all N cells; those of levels "
      "by "
      "their share\nof N. In parentheses the most that may be. energy N: a lattice of regular hexagons would "
      "have 25.3255, density 1\n\n{:<10} {:>8} {:<7} {:>9} {:>18} {:>9} {:>10} {:>12}\n",
      "density", "N", "first", "gradient", "evaluations", "reached", "energy N", "cpu seconds");
  for (const Row& row : kRows) {
    if (quick && !is_quick(row)) continue;
    const Found f = found_by(row.density, row.n, row.first, row.tolerance);
    fmt::print("{:<10} {:>8} {:<7} {:>9.0e} {:>10.1f} {:>7} {:>9.2e} {:>10.4f} {:>12.1f}{}\n", row.density,
               row.n, name_of(row.first), row.tolerance, f.evaluations,
               row.evaluations > 0 ? fmt::format("({:g})", row.evaluations) : "", f.gradient,
               f.energy * static_cast<double>(row.n), f.seconds, f.has_converged ? "" : " NOT converged");
    std::fflush(stdout);
  }
}

// ---- beside TRMESH ------------------------------------------------------------------------------------

/// Processor seconds of `calls` calls with random nodes that reuse no mesh.
double seconds_of_trmesh(int n, int calls) {
  return measured([&] {
    const Nodes nodes(point_sets::make("random", static_cast<std::size_t>(n), 1));
    Lists lists(n);
    const Stripack library = ours();
    const double start = cpu_seconds();
    for (int k = 0; k < calls; ++k) library.trmesh(nodes, lists);
    return cpu_seconds() - start;
  });
}

void print_run_beside_trmesh(int n) {
  constexpr double kEnergy = 25.375, kRatio = 6, kTolerance = 1e-4;
  constexpr int kCalls = 100;
  const Found f = found_by("constant", static_cast<std::size_t>(n), First::front, kTolerance);
  const double trmesh = seconds_of_trmesh(n, kCalls);
  fmt::print(
      "\n{} generators, density 1, front, gradient {:.0e}: energy N {:.4f} ({:g}); cpu seconds {:.2f}, {} "
      "calls "
      "of TRMESH\nwith as many random nodes {:.2f}: {:.2f} ({:g})\n",
      n, kTolerance, f.energy * n, kEnergy, f.seconds, kCalls, trmesh, f.seconds / trmesh, kRatio);
  std::fflush(stdout);
}

/// Measures an evaluation and the call of TRMESH in it, in turn. Before each of them the generators make a
/// step of Lloyd's method.
void print_evaluation_beside_trmesh(int n, int repeats) {
  constexpr double kRatio = 2.5;
  const legacy_stripack::Shared<double> of_evaluation, of_trmesh;
  in_its_own_process([&] {
    const ConstantDensity density;
    LocalEvaluator evaluator(density);
    std::vector<Point> generators = front_generators(static_cast<std::size_t>(n), density);
    std::vector<std::int32_t> list, lptr, lend;
    Cells cells;
    std::vector<double> evaluations, calls;
    for (int k = -3; k < 3 * repeats; ++k) {
      double start = cpu_seconds();
      evaluator.evaluate(generators, cells);
      const double evaluation = cpu_seconds() - start;
      for (std::size_t i = 0; i < generators.size(); ++i) generators[i] = centroid(cells, i, generators[i]);
      start = cpu_seconds();
      triangulate(generators, list, lptr, lend);
      if (k < 0) continue;
      calls.push_back(cpu_seconds() - start);
      evaluations.push_back(evaluation);
    }
    of_evaluation[0] = median(evaluations);
    of_trmesh[0] = median(calls);
  });
  fmt::print("an evaluation of these: {:.4f} us a generator, TRMESH, warm: {:.4f}: {:.2f} ({:g})\n",
             1e6 * of_evaluation[0] / n, 1e6 * of_trmesh[0] / n, of_evaluation[0] / of_trmesh[0], kRatio);
  std::fflush(stdout);
}

// ---- programs -----------------------------------------------------------------------------------------

/// The lines that a command writes to stdout.
std::vector<std::string> lines_of(const std::string& command) {
  FILE* const out = popen(command.c_str(), "r");
  if (out == nullptr) throw std::runtime_error("cannot start " + command);
  std::vector<std::string> lines;
  char line[4096];
  while (std::fgets(line, sizeof line, out) != nullptr) lines.emplace_back(line);
  if (pclose(out) != 0) throw std::runtime_error("this command failed: " + command);
  return lines;
}

class Folder {
 public:
  Folder() {
    std::string name = (std::filesystem::temp_directory_path() / "pstripack-benchmark-XXXXXX").string();
    if (mkdtemp(name.data()) == nullptr) throw std::runtime_error("cannot make " + name);
    path_ = name;
  }
  ~Folder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
  }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  std::string file(const std::string& name) const { return (path_ / name).string(); }

 private:
  std::filesystem::path path_;
};

void print_command(int n) {
  constexpr double kMinutes = 5;
  const Folder folder;
  const auto start = Clock::now();
  lines_of(fmt::format("PSTRIPACK_WARM_START=1 '{}' --quiet --threads 2 scvt {} --tolerance 1e-4 -o '{}'",
                       PSTRIPACK_PROGRAM, n, folder.file("mesh.off")));
  fmt::print("pstripack scvt {}, density 1, gradient 1e-04, 2 threads, with output: {:.2f} minutes ({:g})\n",
             n, seconds_since(start) / 60, kMinutes);
  std::fflush(stdout);
}

#ifdef SCVT_LEGACY
/// Runs the example and prints from its table of times. The last call of TRMESH is for the output.
void print_legacy_example(int n) {
  constexpr double kRatio = 4;
  constexpr int kIterations = 10;
  const Folder folder;
  double all = 0, trmesh = 0;
  for (const std::string& line :
       lines_of(fmt::format("OMP_NUM_THREADS=1 PSTRIPACK_WARM_START=1 '{}' -n {} -i {} -o '{}'", SCVT_LEGACY,
                            n, kIterations, folder.file("mesh")))) {
    char part[32];
    double seconds = 0;
    if (std::sscanf(line.c_str(), "seconds in %31s %lf", part, &seconds) != 2) continue;
    if (part == std::string("trmesh")) trmesh = seconds;
    if (part == std::string("trmesh") || part == std::string("centroids")) all += seconds;
  }
  const double a_call = trmesh / (kIterations + 1);
  fmt::print("an iteration of examples/scvt_legacy, {} generators, over its call of TRMESH: {:.2f} ({:g})\n",
             n, (all - a_call) / kIterations / a_call, kRatio);
}
#endif

}  // namespace

void run_time_of_scvt(bool quick, int repeats) {
  constexpr int kBesideTrmesh = 100000, kMany = 1000000;
  print_runs(quick);
  if (quick) return;
  print_run_beside_trmesh(kBesideTrmesh);
  print_evaluation_beside_trmesh(kBesideTrmesh, repeats);
#ifdef SCVT_LEGACY
  print_legacy_example(kBesideTrmesh);
#endif
  print_command(kMany);
}

void run_descents(const DescentSettings& settings) {
  struct Descent {
    const char* name;
    Method method;
    First first;
  };
  constexpr Descent kDescents[] = {{"lloyd", Method::lloyd, First::random},
                                   {"newton", Method::newton, First::random},
                                   {"levels", Method::newton, First::levels},
                                   {"front", Method::newton, First::front}};
  struct Step {
    double evaluations, seconds, gradient, energy;
  };
  std::optional<CsvFile> csv;
  if (!settings.csv.empty()) csv.emplace(settings.csv, "descent,n,evaluations,seconds,gradient,energy");
  const auto n = static_cast<std::size_t>(settings.n);
  fmt::print(
      "\n{} generators, density 1, one thread, to a gradient of {:.0e} in at most {} evaluations\n\n"
      "{:<8} {:<7} {:>12} {:>12} {:>9} {:>10}\n",
      n, settings.tolerance, settings.evaluations, "method", "first", "evaluations", "cpu seconds",
      "gradient", "energy N");
  for (const Descent& d : kDescents) {
    const auto most = static_cast<std::size_t>(settings.evaluations) + 1;
    const legacy_stripack::Shared<Step> steps(most);
    const legacy_stripack::Shared<std::size_t> count;
    in_its_own_process([&] {
      const ConstantDensity density;
      RunOptions options;
      options.method = d.method;
      options.tolerance = settings.tolerance;
      options.most_evaluations = settings.evaluations;
      std::int64_t before = 0;  // number of generators of the level
      double of_levels = 0, of_this = 0;
      const double start = cpu_seconds();
      options.progress = [&](const Progress& p) {
        if (p.generators != before) of_levels += of_this;
        before = p.generators;
        of_this = static_cast<double>(p.evaluations * p.generators) / settings.n;
        const Step step{of_levels + of_this, cpu_seconds() - start, p.gradient,
                        p.energy * static_cast<double>(p.generators)};
        if (p.generators == settings.n && count[0] < most) steps[count[0]++] = step;
        return true;
      };
      descend(n, density, d.first, options);
    });
    if (count[0] == 0) throw std::runtime_error(fmt::format("{}: a run without a step", d.name));
    const Step& last = steps[count[0] - 1];
    fmt::print("{:<8} {:<7} {:>12.1f} {:>12.2f} {:>9.2e} {:>10.4f}\n",
               d.method == Method::lloyd ? "lloyd" : "newton", name_of(d.first), last.evaluations,
               last.seconds, last.gradient, last.energy);
    std::fflush(stdout);
    double shown = 0;  // leave out steps that would look like one in the picture
    for (std::size_t k = 0; csv && k < count[0]; ++k) {
      if (steps[k].evaluations < 1.1 * shown && k + 1 < count[0]) continue;
      shown = steps[k].evaluations;
      csv->row(fmt::format("{},{},{:.6g},{:.6g},{:.6g},{:.9g}", d.name, n, shown, steps[k].seconds,
                           steps[k].gradient, steps[k].energy));
    }
  }
}

}  // namespace benchmark
