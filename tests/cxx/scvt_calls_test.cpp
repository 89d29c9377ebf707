// Centroidal tessellations by the C interface: the bits of the C++ layer; errors write nothing.

#include <gtest/gtest.h>
#include <omp.h>

#include <atomic>
#include <cmath>
#include <cstddef>
#include <cstring>
#include <limits>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "capi/pstripack.h"
#include "point_sets.h"
#include "scvt/evaluator.h"
#include "scvt/front.h"
#include "scvt/tessellation.h"
#include "support/lists.h"

namespace {

using namespace pstripack;

const scvt::BumpDensity bump({0, 0.6, 0.8}, 0.5, 0.2, 3);

/// Passes a density on and records its calls.
struct Watch {
  double factor = 1;
  std::thread::id caller = std::this_thread::get_id();
  std::atomic<bool> other_thread{false};
  std::int32_t most = 0;
  std::int64_t calls = 0;
};

void bump_at(std::int32_t n, const double* xyz, double* values, void* user) {
  auto& watch = *static_cast<Watch*>(user);
  std::vector<Point> p(static_cast<std::size_t>(n));
  std::memcpy(p.data(), xyz, p.size() * sizeof(Point));
  bump.at(p.size(), p.data(), values);
  for (std::int32_t i = 0; i < n; ++i) values[i] *= watch.factor;
  if (omp_get_thread_num() == 0) watch.most = std::max(watch.most, n);
  if (std::this_thread::get_id() != watch.caller) watch.other_thread = true;
  if (omp_get_thread_num() == 0) ++watch.calls;
}

pstripack_density density_of(Watch& watch, bool any_thread = false) { return {bump_at, &watch, any_thread}; }

pstripack_scvt_options defaults() {
  pstripack_scvt_options options{};
  options.bytes = sizeof options;
  return options;
}

struct Generators {
  explicit Generators(std::size_t n) : x(n, 7), y(n, 8), z(n, 9) {}
  explicit Generators(const std::vector<Point>& points) {
    for (const Point& p : points) x.push_back(p.x), y.push_back(p.y), z.push_back(p.z);
  }
  std::int32_t count() const { return static_cast<std::int32_t>(x.size()); }
  std::int32_t run(const pstripack_density* density, const pstripack_scvt_options* options) {
    message.assign(200, '\0');
    return pstripack_scvt(count(), x.data(), y.data(), z.data(), density, options, &result, message.data(),
                          200);
  }
  /// What was said, up to its closing zero.
  std::string said() const { return message.c_str(); }

  std::vector<double> x, y, z;
  pstripack_scvt_result result{-1, -1, -1, -1, -1};
  std::string message;
};

void expect_same(const Generators& found, const scvt::Tessellation& expected) {
  const Generators points(expected.state.generators);
  ASSERT_EQ(found.result.generators, points.count());
  for (std::size_t i = 0; i < points.x.size(); ++i) {
    ASSERT_EQ(found.x[i], points.x[i]) << i;
    ASSERT_EQ(found.y[i], points.y[i]) << i;
    ASSERT_EQ(found.z[i], points.z[i]) << i;
  }
  EXPECT_EQ(found.result.energy, expected.result.progress.energy);
  EXPECT_EQ(found.result.gradient, expected.result.progress.gradient);
  EXPECT_EQ(found.result.evaluations, expected.evaluations);
}

class ScvtRun : public ::testing::TestWithParam<int> {};

TEST_P(ScvtRun, HasTheBitsOfTheLayerBelow) {
  omp_set_num_threads(3);
  Watch watch;
  const pstripack_density density = density_of(watch, GetParam() != 0);
  pstripack_scvt_options options = defaults();
  scvt::RunOptions expected;
  expected.tolerance = options.tolerance = 1e-2;

  options.start = PSTRIPACK_SCVT_LEVELS;
  Generators found(3000);
  ASSERT_EQ(found.run(&density, &options), PSTRIPACK_OK) << found.said();
  EXPECT_EQ(found.result.reason, PSTRIPACK_SCVT_CONVERGED);
  EXPECT_LE(found.result.gradient, 1e-2);
  EXPECT_GT(watch.calls, 20);
  EXPECT_LE(watch.most, 65536);
  EXPECT_EQ(watch.other_thread, GetParam() != 0);
  expect_same(found, scvt::run(3000, bump, expected));
}
INSTANTIATE_TEST_SUITE_P(Threads, ScvtRun, ::testing::Values(0, 1));

TEST(Scvt, BeginsWithAFrontOrWithLevels) {
  pstripack_scvt_options options = defaults();
  scvt::RunOptions expected;
  expected.tolerance = options.tolerance = 1e-2;
  const auto run = [&](std::int32_t start, std::size_t n) {
    options.start = start;
    Generators found(n);
    EXPECT_EQ(found.run(nullptr, &options), PSTRIPACK_OK) << found.said();
    return found;
  };
  const scvt::ConstantDensity one;
  const auto from_front = [&](std::size_t n) {
    return scvt::run(scvt::front_generators(n, one), one, expected);
  };
  expect_same(run(PSTRIPACK_SCVT_BY_NUMBER, 3000), from_front(3000));
  expect_same(run(PSTRIPACK_SCVT_BY_NUMBER, 2999), scvt::run(2999, one, expected));
  expect_same(run(PSTRIPACK_SCVT_LEVELS, 3000), scvt::run(3000, one, expected));
  expect_same(run(PSTRIPACK_SCVT_FRONT, 2999), from_front(2999));
}

TEST(Scvt, OptionsArePassedOn) {
  pstripack_scvt_options options = defaults();
  options.start = PSTRIPACK_SCVT_RANDOM;
  options.method = PSTRIPACK_SCVT_LLOYD;
  options.most_evaluations = 9;
  options.seed = 5;
  scvt::RunOptions expected;
  expected.levels = false;
  expected.method = scvt::Method::lloyd;
  expected.most_evaluations = 9;
  expected.seed = 5;
  Generators found(400);
  ASSERT_EQ(found.run(nullptr, &options), PSTRIPACK_OK) << found.said();
  EXPECT_EQ(found.result.reason, PSTRIPACK_SCVT_EVALUATIONS);
  expect_same(found, scvt::run(400, scvt::ConstantDensity(), expected));

  // From the generators passed in, of any length.
  std::vector<Point> start = point_sets::make("random", 300, 2);
  for (std::size_t i = 0; i < start.size(); ++i) {
    const double length = 1 + static_cast<double>(i % 5);
    start[i] = scaled(length, start[i]);
  }
  options.start = PSTRIPACK_SCVT_GIVEN;
  Generators given(start);
  ASSERT_EQ(given.run(nullptr, &options), PSTRIPACK_OK) << given.said();
  expect_same(given, scvt::run(start, scvt::ConstantDensity(), expected));

  // Without options, nor a result.
  Generators plain(12);
  ASSERT_EQ(pstripack_scvt(12, plain.x.data(), plain.y.data(), plain.z.data(), nullptr, nullptr, nullptr,
                           nullptr, 0),
            PSTRIPACK_OK);
  EXPECT_EQ(plain.x[3], scvt::run(12, scvt::ConstantDensity(), {}).state.generators[3].x);
}

// ---- widths

double width(const Point& p) { return 1400 - 500 * p.z; }
void widths_at(std::int32_t n, const double* xyz, double* values, void* user) {
  for (std::int32_t i = 0; i < n; ++i) {
    const Point p{xyz[3 * i], xyz[3 * i + 1], xyz[3 * i + 2]};
    values[i] = user == nullptr ? width(p) : p.z > 0.3 ? 60 : 240;
  }
}

class OfWidths final : public scvt::Density {
 public:
  using scvt::Density::at;
  void at(std::size_t n, const Point* p, double* value) const override {
    for (std::size_t i = 0; i < n; ++i) {
      const double square = 1 / (width(p[i]) * width(p[i]));
      value[i] = square * square;
    }
  }
};

TEST(Scvt, WidthsTellTheNumberOfCells) {
  // The integral over z of 2 pi R^2 / (sqrt(3)/2 width^2).
  const double zone = 2 * std::acos(-1) * 6371.0 * 6371 / (std::sqrt(3) / 2);
  double cells = 0;
  pstripack_density density{widths_at, nullptr, 0};
  ASSERT_EQ(pstripack_scvt_cells(&density, 6371, &cells, nullptr, 0), PSTRIPACK_OK);
  EXPECT_NEAR(cells / (zone / 500 * (1 / 900.0 - 1 / 1900.0)), 1, 1e-9);
  int jumps = 1;
  density.user = &jumps;
  ASSERT_EQ(pstripack_scvt_cells(&density, 6371, &cells, nullptr, 0), PSTRIPACK_OK);
  EXPECT_NEAR(cells / (zone * (0.7 / 3600 + 1.3 / 57600)), 1, 2e-5);
  ASSERT_EQ(pstripack_scvt_cells(nullptr, 6371, &cells, nullptr, 0), PSTRIPACK_OK);
  EXPECT_NEAR(cells / (2 * zone), 1, 1e-9);
}

TEST(Scvt, WidthsTakeThePlaceOfADensity) {
  const pstripack_density density{widths_at, nullptr, 0};
  pstripack_scvt_options options = defaults();
  options.tolerance = 1e-2;
  options.widths = 1;
  scvt::RunOptions expected;
  expected.tolerance = 1e-2;
  Generators found(344);
  ASSERT_EQ(found.run(&density, &options), PSTRIPACK_OK) << found.said();
  expect_same(found, scvt::run(344, OfWidths(), expected));
}

TEST(Scvt, WidthsMustBePositiveAndFinite) {
  const auto bad = [](std::int32_t n, const double*, double* values, void* user) {
    std::fill_n(values, n, *static_cast<double*>(user));
  };
  for (double value : {0.0, -60.0, std::nan(""), std::numeric_limits<double>::infinity()}) {
    const pstripack_density density{bad, &value, 0};
    pstripack_scvt_options options = defaults();
    options.widths = 1;
    Generators found(20);
    EXPECT_EQ(found.run(&density, &options), PSTRIPACK_BAD_DENSITY);
    EXPECT_EQ(found.said().find("the width is "), 0U) << found.said();
    double cells = 7;
    char message[100];
    EXPECT_EQ(pstripack_scvt_cells(&density, 6371, &cells, message, 100), PSTRIPACK_BAD_DENSITY);
    EXPECT_EQ(std::string(message).find("the width is "), 0U) << message;
    EXPECT_EQ(pstripack_scvt_cells(nullptr, value, &cells, message, 100), PSTRIPACK_BAD_OPTION);
    EXPECT_STREQ(message, "the radius must be positive and finite");
    EXPECT_EQ(cells, 7);
  }
}

TEST(Scvt, ARunIsWellCentredOnRequest) {
  pstripack_scvt_options options = defaults();
  options.start = PSTRIPACK_SCVT_RANDOM;
  options.most_evaluations = 16;
  options.well_centred = 1;
  scvt::RunOptions expected;
  expected.levels = false;
  expected.most_evaluations = 16;
  expected.well_centred = true;
  Watch watch;
  const pstripack_density density = density_of(watch);
  Generators found(500);
  ASSERT_EQ(found.run(&density, &options), PSTRIPACK_OK) << found.said();
  const scvt::Tessellation same = scvt::run(500, bump, expected);
  expect_same(found, same);
  EXPECT_GT(same.repair.moved, 0);
  EXPECT_EQ(found.result.reason, PSTRIPACK_SCVT_EVALUATIONS);
  options.most_evaluations = 1;
  ASSERT_EQ(found.run(&density, &options), PSTRIPACK_OK) << found.said();
  EXPECT_EQ(found.result.reason, PSTRIPACK_SCVT_NOT_WELL_CENTRED);
}

TEST(Scvt, OptionsOfAnOlderLibraryAreTheFirstOfThem) {
  pstripack_scvt_options options = defaults();
  options.start = PSTRIPACK_SCVT_RANDOM;
  options.tolerance = -1;  // not looked at
  options.bytes = offsetof(pstripack_scvt_options, tolerance);
  scvt::RunOptions expected;
  expected.levels = false;
  Generators found(12);
  ASSERT_EQ(found.run(nullptr, &options), PSTRIPACK_OK) << found.said();
  expect_same(found, scvt::run(12, scvt::ConstantDensity(), expected));
}

TEST(Scvt, ProgressMayStopTheRun) {
  struct Told {
    std::vector<pstripack_scvt_progress> steps;
    std::size_t most;
  };
  const auto note = [](const pstripack_scvt_progress* progress, void* user) -> std::int32_t {
    auto& told = *static_cast<Told*>(user);
    told.steps.push_back(*progress);
    return told.steps.size() == told.most;
  };
  pstripack_scvt_options options = defaults();
  options.progress = note;
  options.tolerance = 1e-2;
  for (const std::size_t most : {std::size_t{0}, std::size_t{3}}) {
    Told told{{}, most};
    options.user = &told;
    Generators found(2000);
    ASSERT_EQ(found.run(nullptr, &options), PSTRIPACK_OK) << found.said();
    EXPECT_EQ(told.steps.back().energy, found.result.energy);
    EXPECT_EQ(told.steps.back().gradient, found.result.gradient);
    EXPECT_EQ(told.steps.back().generators, found.result.generators);
    if (most == 0) {
      EXPECT_EQ(found.result.reason, PSTRIPACK_SCVT_CONVERGED);
      EXPECT_LT(told.steps.front().generators, 2000);
      EXPECT_EQ(told.steps.back().generators, 2000);
    } else {  // on a coarser level, whose generators come first
      EXPECT_EQ(found.result.reason, PSTRIPACK_SCVT_STOPPED);
      EXPECT_EQ(told.steps.size(), most);
      const auto count = static_cast<std::size_t>(found.result.generators);
      ASSERT_LT(count, 2000U);
      EXPECT_NEAR(std::hypot(found.x[count - 1], found.y[count - 1], found.z[count - 1]), 1, 1e-15);
      EXPECT_EQ(found.x[count], 7);
    }
  }
}

// ---- errors

/// The bytes of arrays, NaNs included.
template <class... Arrays>
std::string bytes_of(const Arrays&... arrays) {
  std::string bytes;
  (bytes.append(reinterpret_cast<const char*>(arrays.data()), arrays.size() * sizeof arrays[0]), ...);
  return bytes;
}

TEST(Scvt, ErrorsOfARunSayWhyAndWriteNothing) {
  const auto refuses = [](Generators generators, std::int32_t code, const std::string& why,
                          const pstripack_density* density = nullptr,
                          pstripack_scvt_options options = defaults()) {
    const auto before = bytes_of(generators.x, generators.y, generators.z);
    EXPECT_EQ(generators.run(density, &options), code) << why;
    EXPECT_NE(generators.said().find(why), std::string::npos) << generators.said() << "\n" << why;
    EXPECT_EQ(bytes_of(generators.x, generators.y, generators.z), before) << why;
    EXPECT_EQ(generators.result.generators, -1) << why;
    EXPECT_EQ(generators.result.energy, -1) << why;
  };
  pstripack_scvt_options given = defaults();
  given.start = PSTRIPACK_SCVT_GIVEN;
  refuses(Generators(3), PSTRIPACK_TOO_FEW_NODES, "at least 4 generators, here are 3");
  std::vector<Point> points = point_sets::make("random", 50, 1);
  points[20] = points[30];
  refuses(Generators(points), PSTRIPACK_COINCIDENT, "generators 21 and 31 coincide", nullptr, given);
  points[20] = {1, NAN, 0};
  refuses(Generators(points), PSTRIPACK_BAD_COORDINATE, "generator 21 is zero or not finite", nullptr, given);
  points[20] = points[21];
  for (Point& p : points) p.z = std::fabs(p.z);
  points[20].x += 0.1;
  refuses(Generators(points), PSTRIPACK_HEMISPHERE, "one hemisphere", nullptr, given);

  Watch watch;
  watch.factor = -1;
  const pstripack_density negative = density_of(watch);
  refuses(Generators(50), PSTRIPACK_BAD_DENSITY, "lon ", &negative);
  const pstripack_density unset{[](std::int32_t, const double*, double*, void*) {}, nullptr, 0};
  refuses(Generators(50), PSTRIPACK_BAD_DENSITY, "the density is nan at lon", &unset);
  for (const std::int32_t any_thread : {0, 1}) {
    const pstripack_density throwing{
        [](std::int32_t, const double*, double*, void*) { throw std::runtime_error("no such file"); },
        nullptr, any_thread};
    refuses(Generators(3000), PSTRIPACK_BAD_DENSITY, "no such file", &throwing);
  }
  const pstripack_density throws_a_number{[](std::int32_t, const double*, double*, void*) { throw 7; },
                                          nullptr, 0};
  refuses(Generators(50), PSTRIPACK_BAD_DENSITY, "the density threw an exception", &throws_a_number);

  const auto refuses_option = [&](const std::string& why, auto change) {
    pstripack_scvt_options options = defaults();
    change(options);
    refuses(Generators(50), PSTRIPACK_BAD_OPTION, why, nullptr, options);
  };
  refuses_option("bytes", [](auto& o) { o.bytes = 0; });
  refuses_option("newer library", [](auto& o) { o.bytes += 8; });
  refuses_option("start", [](auto& o) { o.start = 5; });
  refuses_option("start", [](auto& o) { o.start = -1; });
  refuses_option("method", [](auto& o) { o.method = 2; });
  refuses_option("tolerance", [](auto& o) { o.tolerance = -1e-3; });
  refuses_option("tolerance", [](auto& o) { o.tolerance = NAN; });
  refuses_option("most_evaluations", [](auto& o) { o.most_evaluations = -1; });
}

TEST(Scvt, NamesDifferentVectorsThatAreRoundedToOneDirection) {
  std::vector<Point> points = point_sets::make("random", 30, 1);
  Point a{1.9, 1.9, 1.9}, b = a;
  do {
    a = b;
    b.z = std::nextafter(b.z, 2);
  } while (scvt::unit_vector(a) != scvt::unit_vector(b));
  points.push_back(a);
  points.push_back(b);
  pstripack_scvt_options options = defaults();
  options.start = PSTRIPACK_SCVT_GIVEN;
  Generators rounded(points);
  EXPECT_EQ(rounded.run(nullptr, &options), PSTRIPACK_COINCIDENT);
  EXPECT_EQ(rounded.said(), "generators 31 and 32 coincide: remove one of them");
}

TEST(Scvt, MessagesFitTheirRoom) {
  char room[] = "123456789";
  double x = 7;
  EXPECT_EQ(pstripack_scvt(-1, &x, &x, &x, nullptr, nullptr, nullptr, room, 5), PSTRIPACK_TOO_FEW_NODES);
  EXPECT_STREQ(room, "a te");
  EXPECT_STREQ(room + 5, "6789");
  EXPECT_EQ(pstripack_scvt(3, &x, &x, &x, nullptr, nullptr, nullptr, room, 0), PSTRIPACK_TOO_FEW_NODES);
  EXPECT_STREQ(room, "a te");
  EXPECT_EQ(pstripack_scvt(400000000, &x, &x, &x, nullptr, nullptr, nullptr, nullptr, 5),
            PSTRIPACK_TOO_MANY_NODES);
}

// ---- one step

struct Step {
  explicit Step(const std::vector<Point>& points) : generators(points), lists(room_for(points.size())) {
    const Generators& g = generators;
    EXPECT_EQ(pstripack_trmesh(g.count(), g.x.data(), g.y.data(), g.z.data(), lists.list.data(),
                               lists.lptr.data(), lists.lend.data(), &lists.lnew),
              0);
    for (auto* v : {&xc, &yc, &zc, &mass}) v->assign(points.size(), 7);
  }
  std::int32_t run(const pstripack_density* density) {
    return pstripack_scvt_step(generators.count(), generators.x.data(), generators.y.data(),
                               generators.z.data(), lists.list.data(), lists.lptr.data(), lists.lend.data(),
                               density, xc.data(), yc.data(), zc.data(), mass.data(), &energy, message, 200);
  }
  Generators generators;
  Lists lists;
  std::vector<double> xc, yc, zc, mass;
  double energy = -1;
  char message[200] = "";
};

TEST(ScvtStep, HasTheBitsOfTheLayerBelow) {
  omp_set_num_threads(3);
  for (const std::size_t n : {std::size_t{50}, std::size_t{3000}}) {
    const std::vector<Point> points = scvt::unit_vectors(point_sets::make("random", n, 3));
    scvt::LocalEvaluator evaluator(bump);
    scvt::Cells cells;
    evaluator.evaluate(points, cells);
    scvt::ExactSum energy;
    for (const double e : cells.energy) energy.add(e);
    for (const bool any_thread : {false, true}) {
      Watch watch;
      const pstripack_density density = density_of(watch, any_thread);
      Step step(points);
      ASSERT_EQ(step.run(&density), PSTRIPACK_OK) << step.message;
      EXPECT_EQ(step.mass, cells.mass);
      EXPECT_EQ(step.energy, energy.value());
      for (std::size_t i = 0; i < n; ++i) {
        const Point c = scvt::centroid(cells, i, points[i]);
        ASSERT_EQ((Point{step.xc[i], step.yc[i], step.zc[i]}), c) << i;
      }
      EXPECT_EQ(watch.other_thread, any_thread && n > 100);
    }
  }
}

TEST(ScvtStep, TakesListsInAnyOrder) {
  Step step(point_sets::make("random", 200, 4));
  ASSERT_EQ(step.run(nullptr), PSTRIPACK_OK) << step.message;
  // Slot s becomes 6n-11-s, and each ring begins one neighbour later.
  Step other = step;
  const auto slots = static_cast<std::int32_t>(step.lists.list.size());
  for (std::int32_t s = 1; s <= slots; ++s) {
    const auto from = static_cast<std::size_t>(s - 1), to = static_cast<std::size_t>(slots - s);
    other.lists.list[to] = step.lists.list[from];
    other.lists.lptr[to] = slots + 1 - step.lists.lptr[from];
  }
  for (std::size_t k = 0; k < step.lists.nodes(); ++k)
    other.lists.lend[k] = other.lists.lptr[static_cast<std::size_t>(slots - step.lists.lend[k])];
  for (auto* v : {&other.xc, &other.yc, &other.zc, &other.mass}) v->assign(200, 7);
  ASSERT_EQ(other.run(nullptr), PSTRIPACK_OK) << other.message;
  EXPECT_EQ(bytes_of(other.xc, other.yc, other.zc, other.mass),
            bytes_of(step.xc, step.yc, step.zc, step.mass));
  EXPECT_EQ(other.energy, step.energy);

  // In place, and without masses and energy.
  Generators& g = other.generators;
  ASSERT_EQ(pstripack_scvt_step(g.count(), g.x.data(), g.y.data(), g.z.data(), other.lists.list.data(),
                                other.lists.lptr.data(), other.lists.lend.data(), nullptr, g.x.data(),
                                g.y.data(), g.z.data(), nullptr, nullptr, nullptr, 0),
            PSTRIPACK_OK);
  EXPECT_EQ(bytes_of(g.x, g.y, g.z), bytes_of(step.xc, step.yc, step.zc));
}

/// A program's own loop of steps gives the result of a run by Lloyd's method.
TEST(ScvtStep, ManyAreLloydsMethod) {
  const std::vector<Point> start = scvt::unit_vectors(point_sets::make("random", 100, 5));
  scvt::RunOptions options;
  options.method = scvt::Method::lloyd;
  options.most_evaluations = 11;
  options.tolerance = 1e-12;
  const scvt::Tessellation expected = scvt::run(start, scvt::ConstantDensity(), options);
  std::vector<Point> points = start;
  for (int k = 0; k < 10; ++k) {
    Step step(points);
    ASSERT_EQ(step.run(nullptr), PSTRIPACK_OK) << step.message;
    for (std::size_t i = 0; i < points.size(); ++i) points[i] = {step.xc[i], step.yc[i], step.zc[i]};
  }
  for (std::size_t i = 0; i < points.size(); ++i) ASSERT_TRUE(points[i] == expected.state.generators[i]) << i;
}

TEST(ScvtStep, OfDensitiesOfAnySize) {
  const std::vector<Point> points = point_sets::make("icosahedral", 12, 1);
  Step expected(points);
  ASSERT_EQ(expected.run(nullptr), PSTRIPACK_OK);
  for (double value : {0x1p-1000, 0x1p1022, 1.7e308}) {
    const pstripack_density density{[](std::int32_t n, const double*, double* values, void* user) {
                                      std::fill_n(values, n, *static_cast<double*>(user));
                                    },
                                    &value, 0};
    Step step(points);
    ASSERT_EQ(step.run(&density), value < 1.7e308 ? PSTRIPACK_OK : PSTRIPACK_BAD_DENSITY) << step.message;
    if (value < 1.7e308) {
      EXPECT_NEAR(step.energy / value, expected.energy, 1e-4 * expected.energy);
      EXPECT_NEAR(step.mass[7] / value, expected.mass[7], 1e-4 * expected.mass[7]);
    } else {
      EXPECT_NE(std::string(step.message).find("which reaches 1.7e+308"), std::string::npos) << step.message;
      EXPECT_EQ(step.mass[0], 7);
    }
  }
}

/// A mesh of 21 nodes on each of seven parallels and the poles, whose longitudes are then doubled: it covers
/// the sphere twice.
Step twice_around() {
  const double circle = 2 * std::acos(-1.0);
  std::vector<Point> points, doubled;
  for (int parallel = -3; parallel <= 3; ++parallel)
    for (int k = 0; k < 21; ++k) {
      const double longitude = (k + 0.5 * (parallel & 1)) * circle / 21, latitude = parallel * circle / 18;
      for (auto* const set : {&points, &doubled}) {
        const double at = set == &points ? longitude : 2 * longitude;
        set->push_back(
            {std::cos(latitude) * std::cos(at), std::cos(latitude) * std::sin(at), std::sin(latitude)});
      }
    }
  for (auto* const set : {&points, &doubled}) set->insert(set->end(), {{0, 0, 1}, {0, 0, -1}});
  Step step(points);
  step.generators = Generators(doubled);
  return step;
}

TEST(ScvtStep, ErrorsSayWhyAndWriteNothing) {
  const Step good(point_sets::make("random", 100, 6));
  const auto refuses = [](Step step, std::int32_t code, const std::string& why,
                          const pstripack_density* density = nullptr) {
    const auto before = bytes_of(step.xc, step.yc, step.zc, step.mass);
    EXPECT_EQ(step.run(density), code) << why;
    EXPECT_NE(std::string(step.message).find(why), std::string::npos) << step.message << "\n" << why;
    EXPECT_EQ(bytes_of(step.xc, step.yc, step.zc, step.mass), before) << why;
    EXPECT_EQ(step.energy, -1) << why;
  };
  std::vector<Point> half = point_sets::make("random", 100, 6);
  for (Point& p : half) p.z = std::fabs(p.z);
  refuses(Step(half), PSTRIPACK_HEMISPHERE, "one hemisphere");

  Step step = good;
  step.lists.lptr[17] = 9999;
  refuses(step, PSTRIPACK_BAD_LISTS, "not those of a triangulation");
  step = good;
  step.lists.list[3] = 101;
  refuses(step, PSTRIPACK_BAD_LISTS, "not those of a triangulation");
  step = good;
  step.lists.lptr[static_cast<std::size_t>(step.lists.lend[50]) - 2] =
      step.lists.lptr[static_cast<std::size_t>(step.lists.lend[50]) - 1];
  step.lists.lend[50] -= 1;
  refuses(step, PSTRIPACK_BAD_LISTS, "the lists have 587 neighbours, a triangulation of the sphere has 588");
  step = good;
  step.generators.y[7] = INFINITY;
  refuses(step, PSTRIPACK_BAD_COORDINATE, "generator 8 is zero or not finite");
  step = good;  // of other generators
  for (std::size_t i = 0; i < 100; ++i) step.generators.x[i] = -step.generators.x[i];
  refuses(step, PSTRIPACK_BAD_LISTS, "is clockwise");
  step = good;  // a generator in the place of its neighbour
  const auto neighbour = static_cast<std::size_t>(step.lists.list[0]) - 1;
  for (auto* v : {&step.generators.x, &step.generators.y, &step.generators.z}) (*v)[0] = (*v)[neighbour];
  refuses(step, PSTRIPACK_COINCIDENT, "generators 1 and " + std::to_string(neighbour + 1) + " coincide");
  std::vector<Point> close = point_sets::make("random", 30, 1);
  for (const Point& p :
       {Point{1e-100, 0, 1}, Point{-1e-100, 0, 1}, Point{0, 1e-100, 1}, Point{0, -1e-100, 1}})
    close.push_back(p);
  close.push_back({0, 0, 1});
  refuses(Step(close), PSTRIPACK_COINCIDENT, "the cell of generator 31 is too small");
  // A generator most of the way to a neighbour: no triangle is clockwise, but they are not Delaunay's.
  step = good;
  const auto near =
      static_cast<std::size_t>(step.lists.list[static_cast<std::size_t>(step.lists.lend[0])]) - 1;
  for (auto* v : {&step.generators.x, &step.generators.y, &step.generators.z})
    (*v)[1] += 0.9 * ((*v)[near] - (*v)[1]);
  refuses(step, PSTRIPACK_BAD_LISTS, "the cell of generator 2 has no mass");
  refuses(twice_around(), PSTRIPACK_BAD_LISTS, "the areas of their cells add up to 25.13");
  Watch watch;
  watch.factor = -1;
  const pstripack_density density = density_of(watch);
  refuses(good, PSTRIPACK_BAD_DENSITY, "it must be positive", &density);
  EXPECT_EQ(pstripack_scvt_step(3, nullptr, nullptr, nullptr, nullptr, nullptr, nullptr, nullptr, nullptr,
                                nullptr, nullptr, nullptr, nullptr, nullptr, 0),
            PSTRIPACK_TOO_FEW_NODES);
}

}  // namespace
