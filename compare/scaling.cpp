// pstripack-scaling: how the triangulation scales with ranks, measured on this machine and projected beyond
// it.
//
// It starts itself under mpirun for every number of ranks. More ranks than processors share them, so only the
// processor time of each rank and phase is meaningful, not the clock. The critical path is the sum over the
// phases of the slowest rank's processor time (each its median over the calls), as if every rank had its own
// processor and messages cost only the processor time of sending and receiving. Speed-ups from it are
// projections, and the tables say so. Serial is TRMESH on one thread, from arrays to lists, in the process of
// rank 0, between the calls of all ranks.

#include <fmt/format.h>
#include <mpi.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <map>
#include <numeric>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include "in_a_row.h"
#include "lloyd_step.h"
#include "median.h"
#include "move_home.h"
#include "mpi/collective_trmesh.h"
#include "mpi/distributed_evaluator.h"
#include "mpi/distributed_mesh.h"
#include "number_in.h"
#include "point_sets.h"
#include "pool/area_layout.h"
#include "scvt/evaluator.h"
#include "scvt/front.h"
#include "standard_streams.h"
#include "trmesh/trmesh.h"
#include "usual_cost.h"

namespace {

using namespace pstripack;
using Phase = ParallelCost::Phase;

const std::string kMoving = "moving";  ///< a mode with a table of its own
const std::string kScvt = "scvt";      ///< a mode: an evaluation of centroidal tessellations
/// This mode has no gathering; the column shows the integrals instead.
constexpr Phase kIntegrate = Phase::gather;

struct Settings {
  std::string mode, family = "random";
  std::size_t n = 1000000;
  int repeats = 5;
  double change = 0;  ///< fraction of the points that change ranks before each call of a moving mesh
  bool warm = false;  ///< calls may reuse the mesh of the last call
};

double seconds() { return clock_seconds(CLOCK_MONOTONIC); }
double cpu_seconds() { return clock_seconds(CLOCK_PROCESS_CPUTIME_ID); }

// ---- one run on some ranks: prints one line of names and values on rank 0 -----------------------------

/// Processor seconds of work() on rank 0 while the other ranks sleep; 0 on these. Collective.
template <class Work>
double on_rank_0(MpiCommunicator& ranks, const Work& work) {
  double spent = 0;
  if (ranks.rank() == 0) {
    const double start = cpu_seconds();
    work();
    spent = cpu_seconds() - start;
  }
  MPI_Request all_are_here;
  MPI_Ibarrier(ranks.handle(), &all_are_here);
  for (int done = 0; MPI_Test(&all_are_here, &done, MPI_STATUS_IGNORE), !done;) usleep(1000);
  return spent;
}

/// TRMESH on one thread.
class SerialCall {
 public:
  explicit SerialCall(const std::vector<Point>& points_on_root) : n_(points_on_root.size()) {
    if (n_ == 0) return;  // another rank
    for (const Point& p : points_on_root) x_.push_back(p.x), y_.push_back(p.y), z_.push_back(p.z);
    list_.resize(6 * n_ - 12);
    lptr_.resize(6 * n_ - 12);
    lend_.resize(n_);
  }
  void operator()() {
    std::int32_t lnew = 0;
    const TrmeshCall call{static_cast<std::int32_t>(n_),
                          {x_.data(), y_.data(), z_.data()},
                          {list_.data(), lptr_.data(), lend_.data(), &lnew}};
    if (trmesh(call).ier != 0) throw std::runtime_error("these nodes cannot be triangulated");
  }

 private:
  std::size_t n_;
  std::vector<double> x_, y_, z_;
  std::vector<std::int32_t> list_, lptr_, lend_;
};

/// What each call of the ranks took on this rank.
struct Calls {
  std::vector<double> wall;
  std::vector<ParallelCost> cost;
};

/// Prints a line of names and values: of the phases, the processor time of the slowest rank.
void print(MpiCommunicator& ranks, const Settings& s, const std::vector<double>& serial, const Calls& calls) {
  const GroupCost cost = usual_cost(ranks, calls.cost);
  if (ranks.rank() != 0) return;
  const double(&slowest)[Phase::phases] = cost.maximum.cpu_seconds;
  fmt::print(
      "row n {} ranks {} serial {} wall {} divide {} triangulate {} merge {} lists {} "
      "gather {} halo {} bytes {} rounds {}\n",
      s.n, ranks.size(), median(serial), median(calls.wall), slowest[Phase::divide],
      slowest[Phase::triangulate], slowest[Phase::merge], slowest[Phase::lists], slowest[Phase::gather],
      cost.total.halo, cost.total.bytes_sent, cost.maximum.rounds);
  std::fflush(stdout);
}

/// TRMESH as a pool's ranks execute it: arrays and lists are in memory shared with rank 0, or, as between
/// machines, sent to and from rank 0.
class PoolCall {
 public:
  PoolCall(MpiCommunicator& ranks, const std::vector<Point>& points_on_root, bool shared) : ranks_(ranks) {
    std::int64_t n = static_cast<std::int64_t>(points_on_root.size());
    ranks.broadcast(&n, sizeof n, 0);
    const AreaLayout layout(static_cast<std::int32_t>(n), sizeof(double));
    MPI_Aint size = ranks.rank() == 0 ? static_cast<MPI_Aint>(layout.size()) : 0;
    int unit = 1;
    void* area = nullptr;
    double* x[3] = {};
    MPI_Win_allocate_shared(size, unit, MPI_INFO_NULL, shared ? ranks.handle() : MPI_COMM_SELF, &area,
                            &window_);
    MPI_Win_shared_query(window_, 0, &size, &unit, &area);
    if (shared) arrays_ = Arrays::shared;
    if (shared || ranks.rank() == 0) {
      call_ = layout.call(area, nullptr);
      for (int axis = 0; axis < 3; ++axis) x[axis] = static_cast<double*>(layout.coordinate(area, axis));
    }
    for (std::size_t i = 0; i < points_on_root.size(); ++i) {
      x[0][i] = points_on_root[i].x;
      x[1][i] = points_on_root[i].y;
      x[2][i] = points_on_root[i].z;
    }
    std::int64_t ready = 0;
    ranks.all_min(&ready, 1);
  }
  ~PoolCall() { MPI_Win_free(&window_); }
  PoolCall(const PoolCall&) = delete;
  PoolCall& operator=(const PoolCall&) = delete;
  void operator()(GroupCost* cost) {
    std::int32_t lnew = 0;
    TrmeshCall call = call_;
    call.lists.lnew = &lnew;
    collective_trmesh(ranks_, arrays_, call, cost);
  }

 private:
  MpiCommunicator& ranks_;
  MPI_Win window_;
  Arrays arrays_ = Arrays::on_one_rank;
  TrmeshCall call_;
};

/// A distributed mesh whose points make small steps of Lloyd's method. Prints the least time of the calls and
/// the number of flipped arcs.
void run_moving(const Settings& s) {
  constexpr int kStepsBefore = 12, kCallsBefore = 3;
  constexpr double kPart = 0.06;
  MPI_Init(nullptr, nullptr);
  {
    DistributedMesh mesh(MPI_COMM_WORLD);
    MpiCommunicator& ranks = mesh.ranks();
    std::vector<Point> points;
    if (ranks.rank() == 0) points = point_sets::make(s.family, s.n, 1);
    std::vector<std::int64_t> numbers;
    for (std::size_t i = 0; i < points.size(); ++i) numbers.push_back(static_cast<std::int64_t>(i) + 1);
    DistributedMesh::Report report;
    double spent = 0;
    const auto call = [&] {
      std::int64_t ready = 0;
      ranks.all_min(&ready, 1);
      report = {};
      const double start = seconds();
      if (mesh.triangulate(static_cast<std::int64_t>(points.size()), &points.data()->x, numbers.data(),
                           &report) != 0)
        throw std::runtime_error("these nodes cannot be triangulated");
      ranks.all_min(&ready, 1);
      spent = seconds() - start;
    };
    for (int step = 0; step < kStepsBefore; ++step) {
      call();
      lloyd_step(mesh, points, 1);
    }
    for (int k = 0; k < 2; ++k) {
      call();
      move_home(ranks, mesh, points, numbers, nobody);
    }
    double least = 1e9, least_cpu = 1e9, flips = 0;
    int warm = 0;
    for (int k = 0; k < kCallsBefore + s.repeats; ++k) {
      call();
      lloyd_step(mesh, points, kPart);
      if (s.change > 0)  // half of them leave and half return
        move_home(ranks, mesh, points, numbers, [&](std::int64_t number) {
          const auto every = static_cast<std::int64_t>(2 / s.change);
          return number % every == k % every;
        });
      if (k < kCallsBefore) continue;
      least = std::min(least, spent);
      const double(&cpu)[Phase::phases] = report.cost.maximum.cpu_seconds;
      least_cpu = std::min(least_cpu, std::accumulate(std::begin(cpu), std::end(cpu), 0.0));
      if (report.cost.maximum.flips >= 0) ++warm, flips += static_cast<double>(report.cost.total.flips);
    }
    if (ranks.rank() == 0)
      fmt::print("row n {} ranks {} wall {} cpu {} warm {} flips {} halo {} bytes {}\n", s.n, ranks.size(),
                 least, least_cpu, warm, flips / std::max(warm, 1), report.cost.total.halo,
                 report.cost.total.bytes_sent);
  }
  MPI_Finalize();
}

/// An evaluation of generators that follow Lloyd's method: their cells, energy and gradient.
class Evaluation {
 public:
  Evaluation(scvt::Evaluator& evaluator, std::vector<Point> generators)
      : evaluator_(evaluator), generators_(std::move(generators)) {}
  void operator()() {
    evaluator_.evaluate(generators_, cells_);
    scvt::ExactSum sums[2];
    for (std::size_t i = 0; i < generators_.size(); ++i) {
      const Point move = minus(centroid(cells_, i, generators_[i]), generators_[i]);
      sums[0].add(cells_.energy[i]);
      sums[1].add(dot(move, move));
    }
    evaluator_.add_up(sums, 2);
  }
  void step() {
    for (std::size_t i = 0; i < generators_.size(); ++i) generators_[i] = centroid(cells_, i, generators_[i]);
  }

 private:
  scvt::Evaluator& evaluator_;
  std::vector<Point> generators_;
  scvt::Cells cells_;
};

void run_on_ranks(const Settings& s) {
  MPI_Init(nullptr, nullptr);
  {
    const scvt::ConstantDensity density;
    DistributedMesh mesh(MPI_COMM_WORLD);
    MpiCommunicator& ranks = mesh.ranks();
    std::vector<Point> points;
    if (ranks.rank() == 0)
      points = s.mode == kScvt ? scvt::front_generators(s.n, density) : point_sets::make(s.family, s.n, 1);
    const std::size_t n = points.size();
    std::vector<double> alone;
    Calls calls;
    // Alternate, so that disturbances affect both. prepare() is called before each call of the ranks.
    const auto measure = [&](const auto& serial, const auto& call, const auto& prepare) {
      while (calls.cost.size() < static_cast<std::size_t>(s.repeats)) {
        in_a_row([&](bool counts) {
          const double spent = on_rank_0(ranks, serial);
          if (counts) alone.push_back(spent);
        });
        in_a_row([&](bool counts) {
          prepare();
          const double start = seconds();
          const GroupCost cost = call();
          if (!counts) return;
          calls.wall.push_back(seconds() - start);
          calls.cost.push_back(cost.mine);
        });
      }
    };
    const auto nothing = [] {};
    std::vector<std::int64_t> numbers(n);
    for (std::size_t i = 0; i < n; ++i) numbers[i] = static_cast<std::int64_t>(i) + 1;
    const auto go_home = [&] {
      for (int k = 0; k < 2; ++k) {  // the second call starts where the first has moved the generators
        mesh.triangulate(static_cast<std::int64_t>(points.size()), &points.data()->x, numbers.data());
        move_home(ranks, mesh, points, numbers, nobody);
      }
    };
    if (s.mode == "distributed") {
      SerialCall serial(points);
      go_home();
      measure([&] { serial(); },
              [&] {
                DistributedMesh::Report report;
                mesh.triangulate(static_cast<std::int64_t>(points.size()), &points.data()->x, numbers.data(),
                                 &report);
                return report.cost;
              },
              nothing);
    } else if (s.mode == kScvt) {
      scvt::LocalEvaluator local(density);
      Evaluation serial(local, points);
      go_home();
      scvt::DistributedEvaluator distributed(mesh, density);
      distributed.begin_with(numbers);
      Evaluation call(distributed, points);
      for (int k = 0; k < 3; ++k) {  // from now on triangulations may reuse the last mesh
        on_rank_0(ranks, [&] { serial(); });
        call();
      }
      measure(
          [&] {
            serial();
            serial.step();
          },
          [&] {
            DistributedMesh::Report report;
            distributed.report_to(&report);
            const double start = cpu_seconds() - ranks.idle_cpu_seconds;
            call();
            distributed.report_to(nullptr);
            double* const spent = report.cost.mine.cpu_seconds;
            const double all = cpu_seconds() - ranks.idle_cpu_seconds - start;
            spent[kIntegrate] = all - std::accumulate(spent, spent + Phase::phases, 0.0);
            return report.cost;
          },
          [&] {
            call.step();
            std::int64_t ready = 0;
            ranks.all_min(&ready, 1);
          });
    } else {
      SerialCall serial(points);
      PoolCall call(ranks, points, s.mode == "pool");
      measure([&] { serial(); },
              [&] {
                GroupCost cost;
                call(&cost);
                return cost;
              },
              nothing);
    }
    print(ranks, s, alone, calls);
  }
  MPI_Finalize();
}

// ---- the tables ---------------------------------------------------------------------------------------

using Row = std::map<std::string, double>;

Row measure(const std::string& self, const Settings& s, int ranks) {
  const std::string command = fmt::format(
      "{}OMP_NUM_THREADS=1 PSTRIPACK_WARM_START={} {} -n {} '{}' --mode {} --family {} --n {} "
      "--repeats {} --change {}",
      geteuid() == 0 ? "OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1 " : "", s.warm ? 1 : 0,
      MPIRUN, ranks, self, s.mode, s.family, s.n, s.repeats, s.change);
  FILE* const out = popen(command.c_str(), "r");
  if (out == nullptr) throw std::runtime_error("cannot start " + command);
  Row row;
  char line[2000];
  while (std::fgets(line, sizeof line, out) != nullptr)
    if (std::string(line).rfind("row ", 0) == 0) {
      std::istringstream words(line + 4);
      std::string name;
      double value;
      while (words >> name >> value) row[name] = value;
    }
  if (pclose(out) != 0 || row.empty()) throw std::runtime_error("this command failed: " + command);
  return row;
}

double path(const Row& r) {
  return r.at("divide") + r.at("triangulate") + r.at("merge") + r.at("lists") + r.at("gather");
}

void head(bool of_scvt) {
  fmt::print("{:>9} {:>5} {:>8} | {:>7} {:>11} {:>7} {:>7} {:>7} | {:>8} {:>9} | {:>9} {:>10} {:>6}\n", "N",
             "ranks", "clock", "divide", "triangulate", "merge", "lists", of_scvt ? "cells" : "gather",
             "path", "speed-up", "halo", "bytes", "rounds");
}

void show(const Row& r) {
  const double ms = 1e3;
  fmt::print(
      "{:>9.0f} {:>5.0f} {:>8.2f} | {:>7.2f} {:>11.2f} {:>7.2f} {:>7.2f} {:>7.2f} | {:>8.2f} {:>9.2f} | "
      "{:>9.0f} "
      "{:>10.0f} {:>6.0f}\n",
      r.at("n"), r.at("ranks"), ms * r.at("wall"), ms * r.at("divide"), ms * r.at("triangulate"),
      ms * r.at("merge"), ms * r.at("lists"), ms * r.at("gather"), ms * path(r), r.at("serial") / path(r),
      r.at("halo"), r.at("bytes"), r.at("rounds"));
  std::fflush(stdout);
}

const std::vector<std::string> kModes{"distributed", "pool", "messages", kScvt, kMoving};

struct Tables {
  std::vector<int> ranks{1, 2, 4, 8, 16, 32, 64};
  std::vector<std::size_t> sizes{10000, 100000, 1000000};
  std::vector<std::string> modes{kModes.begin(), kModes.begin() + 3};
};

/// Runs warm and cold calls in turn, so that disturbances affect both. Prints the least time of all calls.
void print_moving(const std::string& self, Settings s, const Tables& t) {
  constexpr int kRuns = 3;
  s.mode = kMoving;
  fmt::print(
      "\ndistributed, points at home{}, {}, small steps of Lloyd's method: a call that may begin with the "
      "stars "
      "of the last one\nbeside the same call with PSTRIPACK_WARM_START=0; the clock, and processor time of "
      "the "
      "slowest rank\n\n"
      "{:>9} {:>5} {:>9} {:>9} {:>11} {:>9} {:>9} {:>11} {:>9} {:>10} {:>9} {:>10}\n",
      s.change > 0 ? fmt::format(", of which {} change ranks before each call", s.change) : "", s.family, "N",
      "ranks", "cold us/N", "warm us/N", "cold / warm", "cold cpu", "warm cpu", "cold / warm", "flips/N",
      "warm calls", "halo", "bytes");
  for (const std::size_t n : t.sizes)
    for (const int p : t.ranks) {
      s.n = n;
      double least[2] = {1e9, 1e9}, cpu[2] = {1e9, 1e9};
      Row warm;
      for (int run = 0; run < kRuns; ++run)
        for (const bool is_warm : {false, true}) {
          s.warm = is_warm;
          const Row r = measure(self, s, p);
          least[is_warm] = std::min(least[is_warm], r.at("wall"));
          cpu[is_warm] = std::min(cpu[is_warm], r.at("cpu"));
          if (is_warm) warm = r;
        }
      const double us = 1e6 / static_cast<double>(n);
      fmt::print(
          "{:>9} {:>5} {:>9.4f} {:>9.4f} {:>11.2f} {:>9.4f} {:>9.4f} {:>11.2f} {:>9.5f} {:>10} {:>9} "
          "{:>10}\n",
          n, p, us * least[0], us * least[1], least[0] / least[1], us * cpu[0], us * cpu[1], cpu[0] / cpu[1],
          warm.at("flips") / static_cast<double>(n), fmt::format("{}/{}", warm.at("warm"), s.repeats),
          warm.at("halo"), warm.at("bytes"));
      std::fflush(stdout);
    }
}

void print_tables(const std::string& self, Settings s, const Tables& t) {
  fmt::print(
      "Milliseconds. clock: of a call, {} processors shared by all ranks. divide ... gather: processor time "
      "of the slowest rank.\npath: their sum. Speed-up: PROJECTED, serial TRMESH over path. halo, "
      "bytes: of all ranks. scvt: an evaluation of generators that "
      "move by Lloyd's method, after\nthose of a front; serial: the same on one thread; cells: integrals and "
      "sums.\n",
      sysconf(_SC_NPROCESSORS_ONLN));
  for (const std::string& mode : t.modes) {
    if (mode == kMoving) {
      print_moving(self, s, t);
      continue;
    }
    s.mode = mode;
    s.warm = mode == kScvt;
    fmt::print("\n{}, {}, constant N\n",
               mode == "pool"       ? "pool on one machine, arrays and lists in rank 0's memory"
               : mode == "messages" ? "pool on several machines, arrays and lists sent from and to rank 0"
               : mode == kScvt      ? "scvt, generators at home"
                                    : "distributed, points at home",
               mode == kScvt ? "density 1" : s.family);
    head(mode == kScvt);
    for (const std::size_t n : t.sizes)
      for (const int p : t.ranks) {
        s.n = n;
        show(measure(self, s, p));
      }
  }
}

}  // namespace

int main(int argc, char** argv) {
  fill_standard_streams();
  CLI::App app{
      "How PSTRIPACK scales with MPI ranks: halo, bytes, processor time per phase, projected speed-up."};
  Settings s;
  Tables t;
  app.add_option("--ranks", t.ranks, "numbers of ranks")->delimiter(',')->capture_default_str();
  app.add_option("--sizes", t.sizes, "numbers of nodes")->delimiter(',')->capture_default_str();
  app.add_option("--family", s.family, "point set, as in stripack-compare")->capture_default_str();
  app.add_option("--repeats", s.repeats, "calls of each kind, three in a row; their median is shown")
      ->capture_default_str()
      ->check(CLI::PositiveNumber);
  app.add_option("--change", s.change,
                 "with --modes moving: part of the points that change ranks before each call")
      ->check(number_in(0, 1));
  app.add_option("--modes", t.modes, "only tables of these modes; `scvt` and `moving` run only if named")
      ->delimiter(',')
      ->check(CLI::IsMember(kModes))
      ->capture_default_str();
  app.add_option("--mode", s.mode, "no tables: one run of this mode on the ranks of this mpirun")
      ->check(CLI::IsMember(kModes));
  app.add_option("--n", s.n, "nodes of that run")->capture_default_str();
  try {
    app.parse(argc, argv);
    // Calls with the same nodes must not reuse the last mesh: measure first calls.
    if (s.mode != kMoving && s.mode != kScvt) setenv("PSTRIPACK_WARM_START", "0", 1);
    if (s.mode == kMoving)
      run_moving(s);
    else if (!s.mode.empty())
      run_on_ranks(s);
    else
      print_tables(argv[0], s, t);
    expect_printed();
    return 0;
  } catch (const CLI::ParseError& error) {
    if (error.get_exit_code() == 0) return after_help("pstripack-scaling", app.exit(error));
    fmt::print(stderr, "pstripack-scaling: {}\n", error.what());
    return 2;
  } catch (const std::exception& error) {
    fmt::print(stderr, "pstripack-scaling: {}\n", error.what());
    return 1;
  }
}
