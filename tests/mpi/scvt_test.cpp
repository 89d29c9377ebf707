// Centroidal tessellations of generators that stay on their ranks: every distribution gives the bits of
// pstripack_scvt; errors are the same on every rank and write nothing.

#include <algorithm>
#include <cmath>
#include <cstring>
#include <functional>
#include <limits>
#include <stdexcept>
#include <string>
#include <tuple>
#include <vector>

#include "distributions.h"
#include "point_sets.h"
#include "support/trmesh.h"

namespace {

pstripack_scvt_options of_evaluations(std::int64_t most) {
  pstripack_scvt_options options{};
  options.bytes = sizeof options;
  options.start = PSTRIPACK_SCVT_GIVEN;
  options.tolerance = 1e-12;
  options.most_evaluations = most;
  return options;
}

void bump_at(std::int32_t n, const double* xyz, double* values, void*) {
  for (std::int32_t i = 0; i < n; ++i)
    values[i] = 1 + 20 * std::exp(-4 * (1 - 0.6 * xyz[3 * i + 1] - 0.8 * xyz[3 * i + 2]));
}
const pstripack_density bump{bump_at, nullptr, 0};

/// Generators of lengths other than 1.
Nodes start_of(std::size_t n) {
  Nodes nodes = point_sets::make("random", n, 2);
  for (std::size_t i = 0; i < n; ++i) {
    const double length = 1 + static_cast<double>(i % 3);
    nodes[i] = scaled(length, nodes[i]);
  }
  return nodes;
}

/// This rank's generators, and a run of all.
struct RunOfRanks {
  RunOfRanks(const Nodes& nodes, const Distribution& distribution)
      : mine(nodes_here(distribution, nodes.size())), part(nodes, mine) {}

  std::int32_t operator()(const pstripack_density* density, const pstripack_scvt_options* options) {
    return pstripack_mesh_scvt(mesh, part.count(), part.xyz.data(), part.number.data(), density,
                               rank_of() == 0 ? options : nullptr, &result, message, sizeof message);
  }

  const OfMesh mesh;
  const std::vector<std::size_t> mine;  // from 0
  Part part;
  pstripack_scvt_result result{-1, -1, -1, -1, -1};
  char message[300] = "";
};

/// pstripack_scvt from the same start.
struct Serial {
  Serial(const Nodes& nodes, const pstripack_density* density, const pstripack_scvt_options& options) {
    for (const auto& p : nodes) x.push_back(p.x), y.push_back(p.y), z.push_back(p.z);
    code = pstripack_scvt(static_cast<std::int32_t>(x.size()), x.data(), y.data(), z.data(), density,
                          &options, &result, message, sizeof message);
  }
  std::vector<double> x, y, z;
  pstripack_scvt_result result{-1, -1, -1, -1, -1};
  char message[300] = "";
  std::int32_t code;
};

void expect_same(const RunOfRanks& found, const Serial& expected) {
  for (std::size_t i = 0; i < found.mine.size(); ++i) {
    const std::size_t k = found.mine[i];
    ASSERT_EQ(found.part.xyz[3 * i], expected.x[k]) << k;
    ASSERT_EQ(found.part.xyz[3 * i + 1], expected.y[k]) << k;
    ASSERT_EQ(found.part.xyz[3 * i + 2], expected.z[k]) << k;
  }
  EXPECT_EQ(found.result.energy, expected.result.energy);
  EXPECT_EQ(found.result.gradient, expected.result.gradient);
  EXPECT_EQ(found.result.evaluations, expected.result.evaluations);
  EXPECT_EQ(found.result.generators, static_cast<std::int32_t>(found.mine.size()));
  EXPECT_EQ(found.result.reason, expected.result.reason);
}

TEST(DistributedScvt, HasTheBitsOfTheSerialRun) {
  const Nodes start = start_of(500);
  const pstripack_scvt_options options = of_evaluations(30);
  for (const pstripack_density* density : {static_cast<const pstripack_density*>(nullptr), &bump}) {
    const Serial expected(start, density, options);
    ASSERT_EQ(expected.code, 0) << expected.message;
    ASSERT_EQ(expected.result.evaluations, 30);
    ASSERT_EQ(expected.result.reason, PSTRIPACK_SCVT_EVALUATIONS);
    for (const Distribution& distribution : distributions()) {
      if (density == nullptr && &distribution != &distributions()[1]) continue;
      SCOPED_TRACE(distribution.name);
      RunOfRanks run(start, distribution);
      ASSERT_EQ(run(density, &options), 0) << run.message;
      expect_same(run, expected);
    }
  }
}

TEST(DistributedScvt, TakesWidthsAndIsWellCentredWithTheBitsOfTheSerialRun) {
  const Nodes start = start_of(500);
  pstripack_scvt_options options = of_evaluations(16);
  options.widths = 1;
  options.well_centred = 1;
  const Serial expected(start, &bump, options);
  ASSERT_EQ(expected.code, 0) << expected.message;
  options.well_centred = 0;
  EXPECT_NE(expected.x, Serial(start, &bump, options).x);
  options.well_centred = 1;
  for (const Distribution& distribution : distributions()) {
    SCOPED_TRACE(distribution.name);
    RunOfRanks run(start, distribution);
    ASSERT_EQ(run(&bump, &options), 0) << run.message;
    expect_same(run, expected);
  }
}

TEST(DistributedScvt, TakesRank0sOptionsAndDefaults) {
  const Nodes start = start_of(24);
  pstripack_scvt_options options = of_evaluations(7);
  options.method = PSTRIPACK_SCVT_LLOYD;
  RunOfRanks lloyd(start, distributions()[0]);
  ASSERT_EQ(lloyd(nullptr, &options), 0) << lloyd.message;
  expect_same(lloyd, Serial(start, nullptr, options));

  pstripack_scvt_options defaults{};
  defaults.bytes = sizeof defaults;
  defaults.start = PSTRIPACK_SCVT_GIVEN;
  RunOfRanks plain(start, distributions()[1]);
  ASSERT_EQ(plain(nullptr, nullptr), 0) << plain.message;
  expect_same(plain, Serial(start, nullptr, defaults));
  EXPECT_EQ(plain.result.reason, PSTRIPACK_SCVT_CONVERGED);
}

/// Densities at the ends of what doubles hold: the same results, or the same error.
TEST(DistributedScvt, HasTheBitsOfTheSerialRunAtTheEdges) {
  const pstripack_density tiny{[](std::int32_t n, const double* xyz, double* values, void*) {
                                 bump_at(n, xyz, values, nullptr);
                                 for (std::int32_t i = 0; i < n; ++i)
                                   values[i] = std::ldexp(values[i], -1000);
                               },
                               nullptr, 0};
  const pstripack_density huge{[](std::int32_t n, const double*, double* values, void*) {
                                 for (std::int32_t i = 0; i < n; ++i) values[i] = 1.7e308;
                               },
                               nullptr, 0};
  const Nodes octahedron{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {-1, 0, 0}, {0, -1, 0}, {0, 0, -1}};
  for (const auto& [start, density, code] :
       {std::tuple<Nodes, const pstripack_density*, std::int32_t>(start_of(100), &tiny, 0),
        {octahedron, &huge, PSTRIPACK_BAD_DENSITY}}) {
    const pstripack_scvt_options options = of_evaluations(12);
    const Serial expected(start, density, options);
    ASSERT_EQ(expected.code, code) << expected.message;
    RunOfRanks run(start, distributions()[0]);
    ASSERT_EQ(run(density, &options), code) << run.message;
    EXPECT_STREQ(run.message, expected.message);
    if (code == 0) expect_same(run, expected);
  }
}

TEST(DistributedScvt, LeavesTheMeshOfWhatItReturns) {
  const Nodes start = start_of(200);
  const pstripack_scvt_options options = of_evaluations(10);
  RunOfRanks run(start, distributions()[0]);
  ASSERT_EQ(run(&bump, &options), 0) << run.message;
  Nodes found = start;
  const Serial expected(start, &bump, options);
  for (std::size_t i = 0; i < 200; ++i) found[i] = {expected.x[i], expected.y[i], expected.z[i]};
  Mesh m{room_for(200)};
  ASSERT_EQ(pstripack_mesh_gather(run.mesh, -1, m.list.data(), m.lptr.data(), m.lend.data(), &m.lnew), 0);
  EXPECT_TRUE(m == trmesh(found));
}

TEST(DistributedScvt, ProgressOnRank0StopsAllRanks) {
  struct Told {
    std::int64_t calls = 0, generators = 0;
  };
  pstripack_scvt_options options = of_evaluations(30);
  options.progress = [](const pstripack_scvt_progress* progress, void* user) -> std::int32_t {
    auto& told = *static_cast<Told*>(user);
    told.generators = progress->generators;
    return ++told.calls == 5;
  };
  const Nodes start = start_of(200);
  Told told, told_serial;
  options.user = &told_serial;
  const Serial expected(start, &bump, options);
  options.user = &told;
  for (const Distribution& distribution : distributions()) {
    told = {};
    RunOfRanks run(start, distribution);
    ASSERT_EQ(run(&bump, &options), 0) << run.message;
    EXPECT_EQ(run.result.reason, PSTRIPACK_SCVT_STOPPED);
    expect_same(run, expected);
    EXPECT_EQ(told.calls, rank_of() == 0 ? 5 : 0);
    EXPECT_EQ(told.generators, rank_of() == 0 ? 200 : 0);
  }
}

// ---- errors

/// The text that rank 0 has.
std::string of_rank_0(const char* text) {
  char copy[300] = "";
  std::strncpy(copy, text, sizeof copy - 1);
  MPI_Bcast(copy, sizeof copy, MPI_CHAR, 0, MPI_COMM_WORLD);
  return copy;
}

/// A run that fails: the same code and message on every rank, and nothing else is written.
void expect_refusal(RunOfRanks& run, std::int32_t code, const std::string& why,
                    const pstripack_density* density = nullptr,
                    const pstripack_scvt_options& options = of_evaluations(5)) {
  const std::vector<double> before = run.part.xyz;
  EXPECT_EQ(run(density, &options), code) << run.message;
  EXPECT_NE(std::string(run.message).find(why), std::string::npos) << run.message << "\n" << why;
  EXPECT_EQ(of_rank_0(run.message), run.message);
  EXPECT_TRUE(before.empty() ||
              std::memcmp(before.data(), run.part.xyz.data(), before.size() * sizeof before[0]) == 0);
  EXPECT_EQ(run.result.energy, -1);
  EXPECT_EQ(run.result.reason, -1);
  EXPECT_EQ(Sizes(run.mesh).points, 0);
}

TEST(DistributedScvt, BadDensitiesAreToldOnEveryRank) {
  const Nodes start = start_of(200);
  static const auto near = [](const double* p) { return p[2] > 0.95; };
  const pstripack_density negative{[](std::int32_t n, const double* p, double* values, void*) {
                                     for (std::int32_t i = 0; i < n; ++i)
                                       values[i] = near(p + 3 * i) ? -2 : 1;
                                   },
                                   nullptr, 0};
  const pstripack_density throwing{[](std::int32_t n, const double* p, double* values, void*) {
                                     for (std::int32_t i = 0; i < n; ++i) {
                                       if (near(p + 3 * i)) throw std::runtime_error("no such file");
                                       values[i] = 1;
                                     }
                                   },
                                   nullptr, 0};
  const pstripack_density odd{[](std::int32_t, const double*, double*, void*) { throw 5; }, nullptr, 0};
  for (const Distribution& distribution : distributions()) {
    SCOPED_TRACE(distribution.name);
    RunOfRanks run(start, distribution);
    expect_refusal(run, PSTRIPACK_BAD_DENSITY, "the density is -2 at lon ", &negative);
    expect_refusal(run, PSTRIPACK_BAD_DENSITY, "no such file", &throwing);
    expect_refusal(run, PSTRIPACK_BAD_DENSITY, "threw an exception", &odd);
    // And then goes on.
    const pstripack_scvt_options options = of_evaluations(4);
    ASSERT_EQ(run(nullptr, &options), 0) << run.message;
    expect_same(run, Serial(start, nullptr, options));
  }
  // A density that is bad on one rank only.
  const pstripack_density of_one_rank = rank_of() == size_of() - 1 ? throwing : bump;
  const pstripack_density anywhere{
      [](std::int32_t, const double*, double*, void*) { throw std::runtime_error("the last rank"); }, nullptr,
      0};
  RunOfRanks run(start, distributions()[0]);
  expect_refusal(run, PSTRIPACK_BAD_DENSITY, "the last rank",
                 rank_of() == size_of() - 1 ? &anywhere : &of_one_rank);
}

TEST(DistributedScvt, AProgressProcedureMayThrow) {
  pstripack_scvt_options options = of_evaluations(5);
  options.progress = [](const pstripack_scvt_progress*, void*) -> std::int32_t {
    throw std::runtime_error("the disk is full");
  };
  RunOfRanks run(start_of(60), distributions()[1]);
  expect_refusal(run, PSTRIPACK_BAD_DENSITY, "the disk is full", nullptr, options);
}

TEST(DistributedScvt, BadGeneratorsAreToldOnEveryRank) {
  constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
  const Nodes good = start_of(100);
  for (const Distribution& distribution : distributions()) {
    SCOPED_TRACE(distribution.name);
    const auto refuses = [&](const Nodes& nodes, std::int32_t code, const std::string& why) {
      RunOfRanks run(nodes, distribution);
      expect_refusal(run, code, why);
      std::int64_t points[2];
      pstripack_mesh_error_points(run.mesh, &points[0], &points[1]);
      EXPECT_EQ(points[0] == 21 && points[1] == 71, code == PSTRIPACK_COINCIDENT) << why;
    };
    Nodes nodes = good;
    nodes[20] = scaled(2, nodes[70]);
    refuses(nodes, PSTRIPACK_COINCIDENT, "generators 21 and 71 coincide");
    nodes[20] = {1, kNan, 0};
    refuses(nodes, PSTRIPACK_BAD_COORDINATE, "generator 21 is zero or not finite");
    nodes = good;
    for (auto& p : nodes) p.z = std::fabs(p.z);
    refuses(nodes, PSTRIPACK_HEMISPHERE, "one hemisphere");
    refuses({}, PSTRIPACK_TOO_FEW_NODES, "at least 4 generators, here are 0");

    RunOfRanks twice(good, distribution);
    for (std::int64_t& number : twice.part.number)
      if (number == 9) number = 8;
    expect_refusal(twice, PSTRIPACK_BAD_NUMBER, "number 8 occurs twice");
    RunOfRanks zero(good, distribution);
    for (std::int64_t& number : zero.part.number) --number;
    expect_refusal(zero, PSTRIPACK_BAD_NUMBER, "number 0 is below 1");
  }
}

TEST(DistributedScvt, ACountOfOneRankIsRefusedOnAll) {
  RunOfRanks run(start_of(50), distributions()[0]);
  for (const std::int64_t count : {std::int64_t{-1}, std::int64_t{1} << 29}) {
    const std::int64_t n = rank_of() == size_of() - 1 ? count : run.part.count();
    const std::vector<double> before = run.part.xyz;
    EXPECT_EQ(pstripack_mesh_scvt(run.mesh, n, run.part.xyz.data(), run.part.number.data(), nullptr, nullptr,
                                  &run.result, run.message, sizeof run.message),
              count < 0 ? PSTRIPACK_BAD_SIZE : PSTRIPACK_TOO_MANY_NODES);
    EXPECT_EQ(std::string(run.message),
              "rank " + std::to_string(size_of() - 1) +
                  (count < 0 ? ": n = -1 is below 0"
                             : ": n = 536870912: a rank may have at most 536870911 points"));
    EXPECT_EQ(run.part.xyz, before);
  }
}

TEST(DistributedScvt, OptionsOfRank0AreRefusedOnAll) {
  const auto refuses = [](const std::string& why, auto change) {
    pstripack_scvt_options options = of_evaluations(5);
    change(options);
    RunOfRanks run(start_of(50), distributions()[0]);
    expect_refusal(run, PSTRIPACK_BAD_OPTION, why, nullptr, options);
  };
  refuses("newer library", [](auto& o) { o.bytes += 8; });
  refuses("method", [](auto& o) { o.method = 2; });
}

}  // namespace

int main(int argc, char** argv) {
  return run_on_every_rank(argc, argv, [] {});
}
