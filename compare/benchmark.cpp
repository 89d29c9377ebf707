// pstripack-benchmark: times of PSTRIPACK, the original STRIPACK and CGAL, side by side in one run.
//
// Every measurement is a process of its own on one thread; the contenders take turns, so that a change of
// the machine's mood meets all of them. Arrays are written before the clock starts, and a call that takes
// less than a second is made once before it. CGAL triangulates only; the others write their lists as well.

#include <fmt/chrono.h>
#include <fmt/format.h>
#include <malloc.h>
#include <unistd.h>
#ifdef _OPENMP
#include <omp.h>
#endif

#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <fstream>
#include <functional>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <vector>

#ifdef BENCHMARK_WITH_CGAL
#include "cgal_contender.h"
#endif
#include "original.h"
#include "point_sets.h"
#include "pstripack.h"

extern "C" {  // libstripack, as a Fortran program calls it
void trmesh_(const int* n, const double* x, const double* y, const double* z, int* list, int* lptr, int* lend,
             int* lnew, int* near, int* next, double* dist, int* ier);
void trlist_(const int* n, const int* list, const int* lptr, const int* lend, const int* nrow, int* nt,
             int* ltri, int* ier);
void crlist_(const int* n, const int* ncol, const double* x, const double* y, const double* z,
             const int* list, const int* lend, int* lptr, int* lnew, int* ltri, int* listc, int* nb,
             double* xc, double* yc, double* zc, double* rc, int* ier);
}

namespace {

using legacy_stripack::Library;
using legacy_stripack::Outcome;
using legacy_stripack::run_in_child;
using legacy_stripack::Shared;
using pstripack::Point;
using Clock = std::chrono::steady_clock;

constexpr double kTimeLimit = 1800;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

struct Nodes {
  explicit Nodes(const std::vector<Point>& points) : all(points) {
    for (const Point& p : points) x.push_back(p.x), y.push_back(p.y), z.push_back(p.z);
  }
  int n() const { return static_cast<int>(all.size()); }
  std::vector<Point> all;
  std::vector<double> x, y, z;
};

// The caller's arrays of TRMESH, written once.
struct Lists {
  explicit Lists(int n)
      : list(6 * std::size_t(n) - 12), lptr(list.size()), lend(n), near(n), next(n), dist(n) {}
  std::vector<int> list, lptr, lend, near, next;
  std::vector<double> dist;
  int lnew = 0, ier = 0;
};

/// STRIPACK's routines of one of the two libraries.
struct Stripack {
  std::function<void(const Nodes&, Lists&)> trmesh;
  std::function<void(int n, const Lists&, std::vector<int>& ltri)> trlist;  // NROW = 9
  std::function<void(const Nodes&, Lists&, std::vector<int>& listc, std::vector<double>& centres)> crlist;
};

template <class Trmesh, class Trlist, class Crlist>
Stripack stripack(Trmesh trmesh, Trlist trlist, Crlist crlist) {
  Stripack s;
  s.trmesh = [=](const Nodes& p, Lists& l) {
    const int n = p.n();
    trmesh(&n, p.x.data(), p.y.data(), p.z.data(), l.list.data(), l.lptr.data(), l.lend.data(), &l.lnew,
           l.near.data(), l.next.data(), l.dist.data(), &l.ier);
    if (l.ier != 0) throw std::runtime_error(fmt::format("TRMESH returned IER = {}", l.ier));
  };
  s.trlist = [=](int n, const Lists& l, std::vector<int>& ltri) {
    const int nrow = 9;
    int nt, ier;
    trlist(&n, l.list.data(), l.lptr.data(), l.lend.data(), &nrow, &nt, ltri.data(), &ier);
    if (ier != 0) throw std::runtime_error(fmt::format("TRLIST returned IER = {}", ier));
  };
  s.crlist = [=](const Nodes& p, Lists& l, std::vector<int>& listc, std::vector<double>& centres) {
    const int n = p.n(), ncol = 0;
    const std::size_t stride = 2 * std::size_t(n) - 4;
    int ltri[6], nb, ier;
    double* c = centres.data();
    crlist(&n, &ncol, p.x.data(), p.y.data(), p.z.data(), l.list.data(), l.lend.data(), l.lptr.data(),
           &l.lnew, ltri, listc.data(), &nb, c, c + stride, c + 2 * stride, c + 3 * stride, &ier);
    if (ier != 0) throw std::runtime_error(fmt::format("CRLIST returned IER = {}", ier));
  };
  return s;
}

Stripack ours() { return stripack(&trmesh_, &trlist_, &crlist_); }

Stripack original(const Library& library) {
  const auto method = [&library](auto routine) {
    return [&library, routine](auto... arguments) { (library.*routine)(arguments...); };
  };
  return stripack(method(&Library::trmesh), method(&Library::trlist), method(&Library::crlist));
}

/// The same with CSCRLIST as libngmath ships it, which returns latitudes and longitudes instead of centres;
/// nothing where the original is not libngmath.
std::optional<Stripack> original_as_shipped(const Library& library) {
  using Cscrlist = void(const int*, const int*, const double*, const double*, const double*, const int*,
                        const int*, int*, int*, int*, int*, int*, double*, double*, double*, int*);
  auto* const cscrlist = reinterpret_cast<Cscrlist*>(library.symbol("ngmath_cscrlist_"));
  if (!cscrlist) return std::nullopt;
  Stripack s = original(library);
  s.crlist =
      stripack(&trmesh_, &trlist_,
               [cscrlist](const int* n, const int* ncol, const double* x, const double* y, const double* z,
                          const int* list, const int* lend, int* lptr, int* lnew, int* ltri, int* listc,
                          int* nb, double* rlat, double* rlon, double*, double* rc, int* ier) {
                 cscrlist(n, ncol, x, y, z, list, lend, lptr, lnew, ltri, listc, nb, rlat, rlon, rc, ier);
               })
          .crlist;
  return s;
}

// ---------------------------------------------------------------------------------------------------
// measuring

/// Seconds of one call, measured in a child. `prepare` runs in the child and returns the call.
using Prepare = std::function<std::function<void()>()>;

double measure(const Prepare& prepare, int calls) {
  Shared<double> seconds;
  const auto ended = run_in_child(
      [&] {
        const std::function<void()> call = prepare();
        auto start = Clock::now();
        call();
        const double first = seconds_since(start);
        if (first >= 1) {
          seconds[0] = first;
          return;
        }
        start = Clock::now();
        for (int i = 0; i < calls; ++i) call();
        seconds[0] = seconds_since(start) / calls;
      },
      kTimeLimit);
  if (ended.outcome != Outcome::returned) throw std::runtime_error("a measurement did not come to its end");
  return seconds[0];
}

#ifdef BENCHMARK_WITH_CGAL
double measure_cgal(const std::vector<Point>& points, int calls) {
  Shared<double> seconds;
  const auto ended = run_in_child(
      [&] {
        std::size_t vertices = 0;
        cgal_seconds(points, vertices);
        if (vertices != points.size())
          throw std::runtime_error(fmt::format("CGAL kept {} of {} points", vertices, points.size()));
        double sum = 0;
        for (int i = 0; i < calls; ++i) sum += cgal_seconds(points, vertices);
        seconds[0] = sum / calls;
      },
      kTimeLimit);
  if (ended.outcome != Outcome::returned) throw std::runtime_error("CGAL did not come to its end");
  return seconds[0];
}
#endif

// A figure of /proc/self/status, in bytes.
double status_bytes(const std::string& key) {
  std::ifstream status("/proc/self/status");
  std::string word;
  double kilobytes;
  while (status >> word)
    if (word == key && status >> kilobytes) return 1024 * kilobytes;
  throw std::runtime_error("no " + key + " in /proc/self/status");
}

/// Largest memory during our TRMESH, the first of this process, beyond what it held before with all its
/// arrays written.
double peak_of_first_call(const Nodes& nodes, Lists& lists) {
  malloc_trim(0);  // or memory that was freed before would be used again and not count
  std::ofstream("/proc/self/clear_refs") << "5";  // the peak restarts at what is held now
  const double before = status_bytes("VmHWM:");
  ours().trmesh(nodes, lists);
  return (status_bytes("VmHWM:") - before) / nodes.n();
}

double peak_bytes_a_node(const Nodes& nodes) {
  Shared<double> bytes;
  const auto ended = run_in_child(
      [&] {
        Lists lists(nodes.n());
        bytes[0] = peak_of_first_call(nodes, lists);
      },
      kTimeLimit);
  if (ended.outcome != Outcome::returned) throw std::runtime_error("the memory measurement did not end");
  return bytes[0];
}

class Samples {
 public:
  void add(double seconds) { seconds_.push_back(seconds); }
  bool enough(int repeats) const {
    // Few repeats where one takes long.
    const int wanted = !seconds_.empty() && seconds_.front() > 2 ? std::min(repeats, 3) : repeats;
    return static_cast<int>(seconds_.size()) >= wanted;
  }
  bool empty() const { return seconds_.empty(); }
  double median() const {
    std::vector<double> s = seconds_;
    std::sort(s.begin(), s.end());
    return s.size() % 2 ? s[s.size() / 2] : (s[s.size() / 2 - 1] + s[s.size() / 2]) / 2;
  }

 private:
  std::vector<double> seconds_;
};

// ---------------------------------------------------------------------------------------------------
// cases

enum class Routine { trmesh, trlist, crlist, crlist_as_shipped };

struct Case {
  std::string name;
  Routine routine;
  std::string family;
  int n;
  bool shuffled;
  double original_over_ours, cgal_over_ours;  // required at least; 0: no figure
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
    {"trlist-1e5", Routine::trlist, "random", 100000, false, 300, 0},
    {"crlist-1e6", Routine::crlist_as_shipped, "random", 1000000, false, 3, 0},
    {"crlist-xyz-1e6", Routine::crlist, "random", 1000000, false, 0, 0},
};

Lists lists_from(const Stripack& library, const Nodes& nodes) {
  Lists lists(nodes.n());
  library.trmesh(nodes, lists);
  return lists;
}

Prepare prepare(const Case& c, const Stripack& library, const Nodes& nodes,
                const std::shared_ptr<Lists>& lists) {
  return [&c, &library, &nodes, lists]() -> std::function<void()> {
    const int n = nodes.n();
    const std::size_t triangles = 2 * std::size_t(n) - 4;
    switch (c.routine) {
      case Routine::trmesh: {
        auto own = std::make_shared<Lists>(n);
        return [&library, &nodes, own] { library.trmesh(nodes, *own); };
      }
      case Routine::trlist: {
        auto ltri = std::make_shared<std::vector<int>>(9 * triangles);
        return [&library, n, lists, ltri] { library.trlist(n, *lists, *ltri); };
      }
      case Routine::crlist:
      case Routine::crlist_as_shipped: {
        auto listc = std::make_shared<std::vector<int>>(3 * triangles);
        auto centres = std::make_shared<std::vector<double>>(4 * triangles);
        return [&library, &nodes, lists, listc, centres] { library.crlist(nodes, *lists, *listc, *centres); };
      }
    }
    throw std::logic_error("unknown routine");
  };
}

/// The lists that the original itself makes, taken from a process of its own.
std::shared_ptr<Lists> lists_of_original(const legacy_stripack::Original& original, const Nodes& nodes) {
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

std::string microseconds(const Samples& samples, int n) {
  return samples.empty() ? "-" : fmt::format("{:.4f}", 1e6 * samples.median() / n);
}

std::string ratio(const Samples& theirs, const Samples& own, double required) {
  const std::string measured = theirs.empty() ? "-" : fmt::format("{:.2f}", theirs.median() / own.median());
  return fmt::format("{:>9} {:>7}", measured, required > 0 ? fmt::format("({:g})", required) : "");
}

// ---- this program as a model, in a process of its own ---------------------------------------------------

constexpr int kModelNodes = 1000000;

struct ModelFigures {
  double seconds = 0, peak = 0;  ///< the median of its calls; bytes a node during the first
};

/// What this program is where it is the model.
int be_the_model(int calls) {
  const Nodes nodes(point_sets::make("random", kModelNodes, 1));
  const Stripack library = ours();
  Lists lists(nodes.n());
  const double peak = peak_of_first_call(nodes, lists);
  Samples samples;
  while (!samples.enough(calls)) {
    const auto start = Clock::now();
    library.trmesh(nodes, lists);
    samples.add(seconds_since(start));
  }
  fmt::print("{} {}\n", samples.median(), peak);
  return 0;
}

/// Started by `launcher`, which may begin with NAME=VALUE.
ModelFigures as_model(const std::string& self, const std::string& launcher) {
  const std::string command = fmt::format("{} '{}' --be-the-model 5", launcher, self);
  FILE* const out = popen(command.c_str(), "r");
  ModelFigures figures;
  const bool is_told = out != nullptr && std::fscanf(out, "%lf %lf", &figures.seconds, &figures.peak) == 2;
  if (out == nullptr || pclose(out) != 0 || !is_told) throw std::runtime_error("no figures from " + command);
  return figures;
}

/// TRMESH on all processors beside TRMESH on one, in turn; in this process, since a forked child has one
/// thread. The last case, therefore.
void run_threads(const std::string& self, int repeats) {
#ifdef _OPENMP
  constexpr double kRequired = 1.75;  // of two threads
  const Nodes nodes(point_sets::make("random", 1000000, 1));
  const Stripack library = ours();
  const int processors = omp_get_num_procs();
  Lists lists(nodes.n());
  const auto seconds_on = [&](int threads) {
    omp_set_num_threads(threads);
    const auto start = Clock::now();
    library.trmesh(nodes, lists);
    return seconds_since(start);
  };
  Samples one, all;
  for (const int threads : {1, processors}) seconds_on(threads);  // new pages
  while (!all.enough(repeats)) {
    one.add(seconds_on(1));
    all.add(seconds_on(processors));
  }
  fmt::print("{:<17} {:>8} {:>9} on 1 thread, {} on {}: {:.2f} times the speed{}; peak {:.0f}\n",
             "threads-1e6", nodes.n(), microseconds(one, nodes.n()), microseconds(all, nodes.n()), processors,
             one.median() / all.median(), processors == 2 ? fmt::format(" ({:g})", kRequired) : "",
             as_model(self, fmt::format("OMP_NUM_THREADS={}", processors)).peak);
#else
  static_cast<void>(self);
  static_cast<void>(repeats);
#endif
}

// ---- on threads, and with a pool of ranks -----------------------------------------------------------

/// The same model on its own and with a pool of two ranks of a thread each, in turn. The clock of the whole
/// call: the way to the ranks and back is in it.
void run_pool([[maybe_unused]] const std::string& self, [[maybe_unused]] int repeats) {
#ifdef PSTRIPACK_RUN
  constexpr double kRequired = 1.5;
  const auto seconds_of = [&](const std::string& launcher) {
    return as_model(
               self,
               fmt::format("{}OMP_NUM_THREADS=1 {}",
                           geteuid() == 0 ? "OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 " : "",
                           launcher))
        .seconds;
  };
  Samples alone, pool;
  for (int k = 0; k < std::min(repeats, 5); ++k) {
    alone.add(seconds_of(""));
    pool.add(seconds_of(fmt::format("'{}' -n 2 --bind-to none --oversubscribe --", PSTRIPACK_RUN)));
  }
  fmt::print("{:<17} {:>8} {:>9} alone, {} with a pool of 2 ranks: {:.2f} times the speed ({:g})\n",
             "pool-1e6", kModelNodes, microseconds(alone, kModelNodes), microseconds(pool, kModelNodes),
             alone.median() / pool.median(), kRequired);
#endif
}

/// The nodes of a case. Symmetric sets are shuffled, until the first three are not on one great circle and
/// the original comes to an end.
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

void run(const Case& c, const std::optional<legacy_stripack::Original>& original_library, int repeats) {
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

  Samples own, theirs, cgal;
  while (!own.enough(repeats) || (original_library && !theirs.enough(repeats))) {
    if (!own.enough(repeats)) own.add(measure(prepare(c, own_library, nodes, own_lists), calls));
    if (original_library && !theirs.enough(repeats))
      theirs.add(measure(prepare(c, theirs_library, nodes, theirs_lists), calls));
#ifdef BENCHMARK_WITH_CGAL
    if (c.cgal_over_ours > 0 && !cgal.enough(repeats)) cgal.add(measure_cgal(points, calls));
#endif
  }
  const std::string memory = c.routine == Routine::trmesh && nodes.n() >= 100000
                                 ? fmt::format("{:.0f}", peak_bytes_a_node(nodes))
                                 : "";
  fmt::print("{:<17} {:>8} {:>9} {:>9} {:>9} {} {} {:>9}\n", c.name, nodes.n(), microseconds(own, nodes.n()),
             microseconds(theirs, nodes.n()), microseconds(cgal, nodes.n()),
             ratio(theirs, own, c.original_over_ours), ratio(cgal, own, c.cgal_over_ours), memory);
  std::fflush(stdout);
}

std::string processor() {
  std::ifstream info("/proc/cpuinfo");
  std::string line;
  while (std::getline(info, line))
    if (line.rfind("model name", 0) == 0) return line.substr(line.find(':') + 2);
  return "unknown processor";
}

}  // namespace

int main(int argc, char** argv) {
  std::string names;
  for (const Case& c : kCases) names += " " + c.name;
  const std::vector<std::string> parallel_cases{"threads-1e6", "pool-1e6"};
  for (const std::string& name : parallel_cases) names += " " + name;
  CLI::App app(
      "Times of PSTRIPACK, the original STRIPACK and CGAL on one thread, and their ratios beside those\n"
      "that the project asks for. The exit code says nothing about them.",
      "pstripack-benchmark");
  app.footer("cases:" + names);
  bool quick = false;
  std::vector<std::string> only;
  int repeats = 0;
  app.add_flag("--quick", quick, "only cases with less than 10^6 nodes, three repeats");
  app.add_option("--only", only, "only these cases, as random-1e4,latlon-1e5")->delimiter(',');
  app.add_option("--repeats", repeats, "measurements a case, median taken; default 7, at most 3 above 2 s")
      ->check(CLI::Range(1, 1000));
  int model_calls = 0;
  app.add_option("--be-the-model", model_calls)->group("");  // for run_pool alone
  try {
    app.parse(argc, argv);
    if (model_calls > 0) return be_the_model(model_calls);
    for (const std::string& name : only)
      if (std::find(parallel_cases.begin(), parallel_cases.end(), name) == parallel_cases.end() &&
          std::none_of(kCases.begin(), kCases.end(), [&](const Case& c) { return c.name == name; }))
        throw std::invalid_argument("there is no case " + name + "; cases:" + names);
    if (repeats == 0) repeats = quick ? 3 : 7;
#ifdef _OPENMP
    omp_set_num_threads(1);
#endif

    std::optional<legacy_stripack::Original> original_library;
    const auto where = legacy_stripack::configured_original();
    if (where) original_library.emplace(*where);
    fmt::print("machine    {}\ncompiler   {} {}\nthreads    1\ndate       {:%Y-%m-%d %H:%M} UTC\n",
               processor(), BENCHMARK_COMPILER, BENCHMARK_FLAGS, fmt::gmtime(std::time(nullptr)));
    fmt::print("pstripack  {}\noriginal   {}\n", pstripack_version(), where ? where->name : "none found");
#ifdef BENCHMARK_WITH_CGAL
    fmt::print("CGAL       {}, Delaunay_triangulation_on_sphere_2, -O3 -march=native, no lists\n",
               cgal_version());
#else
    fmt::print("CGAL       none found\n");
#endif
    fmt::print("repeats    {}, median; in parentheses the ratio asked for\n\n", repeats);
    fmt::print("{:<17} {:>8} {:^29} {:^17} {:^17} {:>9}\n", "", "", "microseconds a node", "original / ours",
               "CGAL / ours", "peak");
    fmt::print("{:<17} {:>8} {:>9} {:>9} {:>9} {:>17} {:>17} {:>9}\n", "case", "N", "ours", "original",
               "CGAL", "", "", "bytes/N");
    for (const Case& c : kCases) {
      if (!only.empty() && std::find(only.begin(), only.end(), c.name) == only.end()) continue;
      if (quick && only.empty() && c.n >= 1000000) continue;
      try {
        run(c, original_library, repeats);
      } catch (const std::exception& e) {
        fmt::print("{:<17} {}\n", c.name, e.what());
      }
    }
    const auto is_wanted = [&](const std::string& name) {
      return only.empty() ? !quick : std::find(only.begin(), only.end(), name) != only.end();
    };
    if (is_wanted("pool-1e6")) run_pool(argv[0], repeats);
    if (is_wanted("threads-1e6")) run_threads(argv[0], repeats);
    fmt::print(
        "\ncrlist: against CSCRLIST as libngmath ships it, which turns centres into latitudes and longitudes;"
        "\ncrlist-xyz: against the same without that, as STRIPACK's CRLIST\npeak: memory during TRMESH "
        "beyond the caller's arrays; asked for: at most 220 bytes a node\n");
    return 0;
  } catch (const CLI::ParseError& e) {
    if (e.get_exit_code() == 0) return app.exit(e);
    std::fprintf(stderr, "pstripack-benchmark: %s\n", e.what());
    return 2;
  } catch (const std::invalid_argument& e) {
    std::fprintf(stderr, "pstripack-benchmark: %s\n", e.what());
    return 2;
  } catch (const std::exception& e) {
    std::fprintf(stderr, "pstripack-benchmark: %s\n", e.what());
    return 1;
  }
}
