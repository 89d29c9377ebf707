#include "original.h"

#include <dlfcn.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/resource.h>

#include <chrono>
#include <cmath>
#include <fstream>
#include <random>
#include <thread>

#include "probe.h"

namespace legacy_stripack {
namespace {

const Abi kR8, kR4{4, 4, 12}, k8arg{8, 4, 8}, kI8{8, 8, 12};

struct Node {
  double x, y, z;
};
using Nodes = std::vector<Node>;

const Nodes kOctahedron{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {-1, 0, 0}, {0, -1, 0}, {0, 0, -1}};
// LIST and LPTR that the original returns for the octahedron.
const std::vector<int> kOctahedronList{2, 3, 3, 1, 1, 2, 4, 4, 3, 2, 5, 5,
                                       5, 1, 3, 4, 6, 6, 6, 6, 1, 5, 4, 2};
const std::vector<int> kOctahedronLptr{2, 11, 4,  20, 6, 7,  12, 3, 10, 19, 17, 5,
                                       9, 15, 16, 18, 1, 14, 13, 8, 22, 23, 24, 21};
const std::vector<int> kOctahedronLend{11, 4, 7, 10, 16, 24};

double processor_seconds_of_children() {
  rusage used;
  getrusage(RUSAGE_CHILDREN, &used);
  return static_cast<double>(used.ru_utime.tv_sec + used.ru_stime.tv_sec) +
         1e-6 * static_cast<double>(used.ru_utime.tv_usec + used.ru_stime.tv_usec);
}

TEST(faulty_original, that_hangs_is_killed_at_the_time_limit) {
  const Original original(ORIGINAL_THAT_HANGS, kR8);
  const double before = processor_seconds_of_children();
  EXPECT_EQ(original.triangulate(kOctahedron, 0.2).outcome, Outcome::timed_out);
  const double seconds = processor_seconds_of_children() - before;
  EXPECT_GE(seconds, 0.19);  // scheduler and rusage may count differently
  EXPECT_LT(seconds, 5);
}

TEST(run_in_child, limits_processor_time_so_that_a_busy_machine_looks_like_no_hang) {
  const auto wait = [] { std::this_thread::sleep_for(std::chrono::milliseconds(200)); };
  EXPECT_EQ(run_in_child(wait, 0.1).outcome, Outcome::returned);
}

TEST(run_in_child, also_ends_work_that_sleeps) {
  const auto sleep = [] { std::this_thread::sleep_for(std::chrono::hours(1)); };
  EXPECT_EQ(run_in_child(sleep, 0.01).outcome, Outcome::timed_out);
}

TEST(faulty_original, that_crashes_is_reported_with_its_signal) {
  const Original original(ORIGINAL_THAT_CRASHES, kR8);
  const Triangulation result = original.triangulate(kOctahedron, 10);
  EXPECT_EQ(result.outcome, Outcome::crashed);
  EXPECT_EQ(result.signal, SIGSEGV);
}

TEST(faulty_original, that_stops_the_program_is_told_from_one_that_returns) {
  const Original original(ORIGINAL_THAT_STOPS, kR8);
  EXPECT_EQ(original.triangulate(kOctahedron, 10).outcome, Outcome::stopped);
  const Nodes three(kOctahedron.begin(), kOctahedron.begin() + 3);
  const Triangulation result = original.triangulate(three, 10);
  EXPECT_EQ(result.outcome, Outcome::returned);
  EXPECT_EQ(result.ier, 42);
}

TEST(library, that_is_missing_or_is_not_stripack_is_refused) {
  EXPECT_THROW(Original("/no/such/library.so", kR8), std::runtime_error);
  EXPECT_THROW(Original("libm.so.6", kR8), std::runtime_error);
}

TEST(abi, has_a_name_that_names_it) {
  for (const char* name : {"r8", "r4", "i8", "8arg", "r4-i8", "r4-8arg", "i8-8arg", "r4-i8-8arg"})
    EXPECT_EQ(name_of(abi_named(name)), name);
  EXPECT_EQ(abi_named("8arg-r4"), (Abi{4, 4, 8}));
  EXPECT_EQ(describe(kI8), "REAL*8, INTEGER*8, TRMESH with 12 arguments");
  EXPECT_THROW(abi_named("r16"), std::invalid_argument);
}

TEST(probe, of_a_library_that_gives_no_mesh_says_what_it_did) {
  const struct {
    const char *file, *what;
  } cases[] = {{ORIGINAL_THAT_HANGS, "did not return within 0.5 s"},
               {ORIGINAL_THAT_CRASHES, "crashed (signal 11, Segmentation fault)"},
               {ORIGINAL_THAT_STOPS, "stopped the program"}};
  for (const auto& one : cases) {
    const Probe probe = probe_abi(Library(one.file), 8, 0.5);
    EXPECT_EQ(probe.abi, std::nullopt) << one.file;
    const std::string what = one.what;
    EXPECT_EQ(probe.why_not, "with REAL*8 it " + what + "; with REAL*4 it " + what);
  }
}

void expect_abi(const std::string& file, const Abi& abi) {
  for (const int first_real_bytes : {8, 4}) {
    const Probe probe = probe_abi(Library(file), first_real_bytes);
    ASSERT_TRUE(probe.abi) << file << ": " << probe.why_not;
    EXPECT_EQ(name_of(*probe.abi), name_of(abi)) << file;
  }
}

TEST(probe, finds_the_abi_of_our_libraries) {
  expect_abi(STRIPACK, kR8);
  expect_abi(STRIPACK_R4, kR4);
  expect_abi(STRIPACK_8ARG, k8arg);
  expect_abi(STRIPACK_I8, kI8);
}

#ifdef ORIGINAL_R4  // libngmath.a was found

TEST(probe, finds_the_abi_of_originals_and_the_names_of_ncar) {
  expect_abi(configured_original()->file, kR8);
  expect_abi(ORIGINAL_CS, kR8);
  expect_abi(ORIGINAL_R4, kR4);
  expect_abi(ORIGINAL_8ARG, k8arg);
}

Nodes random_nodes(int n) {
  std::mt19937_64 random(1);
  std::normal_distribution<double> normal;
  Nodes nodes;
  while (static_cast<int>(nodes.size()) < n) {
    // Single-precision values: the same nodes for every ABI.
    const Node p{static_cast<float>(normal(random)), static_cast<float>(normal(random)),
                 static_cast<float>(normal(random))};
    const double r = std::sqrt(p.x * p.x + p.y * p.y + p.z * p.z);
    nodes.push_back({static_cast<float>(p.x / r), static_cast<float>(p.y / r), static_cast<float>(p.z / r)});
  }
  return nodes;
}

TEST(original, gives_the_golden_lists_of_the_octahedron) {
  const Triangulation result = Original(*configured_original()).triangulate(kOctahedron, 10, 3);
  ASSERT_EQ(result.outcome, Outcome::returned);
  EXPECT_EQ(result.ier, 0);
  EXPECT_EQ(result.lnew, 25);
  EXPECT_EQ(result.list, kOctahedronList);
  EXPECT_EQ(result.lptr, kOctahedronLptr);
  EXPECT_EQ(result.lend, kOctahedronLend);
  EXPECT_GT(result.seconds, 0);
}

TEST(original, that_never_returns_does_not_stop_us) {
  // Four nodes on a meridian for which the original does not return.
  const Nodes meridian{{0.452695204446832, 0.5590320207484465, 0.6946583704589973},
                       {0.4602557974987226, 0.5683685756099448, 0.6819983600624985},
                       {0.467676192176097, 0.5775319998974023, 0.6691306063588582},
                       {0.47495412815485366, 0.5865195023430131, 0.6560590289905072}};
  const Triangulation result = Original(*configured_original()).triangulate(meridian, 0.5);
  EXPECT_NE(result.outcome, Outcome::returned);
}

TEST(original, is_the_same_through_every_abi) {
  const Nodes nodes = random_nodes(500);
  const Triangulation r8 = Original(*configured_original()).triangulate(nodes, 10);
  const Triangulation r4 = Original(ORIGINAL_R4, kR4).triangulate(nodes, 10);
  const Triangulation args8 = Original(ORIGINAL_8ARG, k8arg).triangulate(nodes, 10);
  ASSERT_EQ(r8.ier, 0);
  for (const Triangulation* other : {&r4, &args8}) {
    EXPECT_EQ(other->ier, 0);
    EXPECT_EQ(other->lnew, r8.lnew);
    EXPECT_EQ(other->list, r8.list);
    EXPECT_EQ(other->lptr, r8.lptr);
    EXPECT_EQ(other->lend, r8.lend);
  }
}

TEST(library, of_64_bit_integers_is_the_same_as_of_32) {
  // Our library, since no original has this ABI.
  const Nodes nodes = random_nodes(500);
  const Triangulation r8 = Original(STRIPACK, kR8).triangulate(nodes, 10);
  const Triangulation i8 = Original(STRIPACK_I8, kI8).triangulate(nodes, 10);
  ASSERT_EQ(r8.ier, 0);
  EXPECT_EQ(i8.ier, 0);
  EXPECT_EQ(i8.lnew, r8.lnew);
  EXPECT_EQ(i8.list, r8.list);
  EXPECT_EQ(i8.lptr, r8.lptr);
  EXPECT_EQ(i8.lend, r8.lend);
}

TEST(library, says_what_to_do_with_an_archive) {
  const std::string archive = testing::TempDir() + "original.a";
  std::ofstream(archive) << "!<arch>\n";
  try {
    const Library library(archive, kR8);
    FAIL() << "an archive is loaded";
  } catch (const std::runtime_error& error) {
    EXPECT_NE(std::string(error.what()).find("gfortran -shared"), std::string::npos) << error.what();
  }
}

TEST(abi_adapter, has_the_r8_symbols_and_passes_calls_on) {
  void* handle = dlopen(ADAPTED_8ARG, RTLD_NOW | RTLD_LOCAL);
  ASSERT_NE(handle, nullptr) << dlerror();
  for (const char* symbol : {"trmesh_", "trlist_", "crlist_"})
    EXPECT_NE(dlsym(handle, symbol), nullptr) << symbol;
  const Triangulation result = Original(ADAPTED_8ARG, kR8).triangulate(kOctahedron, 10);
  EXPECT_EQ(result.lnew, 25);
  EXPECT_EQ(result.list, kOctahedronList);
}

// Centres (XC, YC, ZC) and radii of the octahedron's eight triangles.
std::vector<double> crlist_of_octahedron(const Library& library) {
  const int n = 6, ncol = 0;
  std::vector<double> x, y, z;
  for (const Node& p : kOctahedron) x.push_back(p.x), y.push_back(p.y), z.push_back(p.z);
  Shared<double> centres(4 * 8);
  Shared<int> codes(2);
  const Ended ended = run_in_child(
      [&] {
        std::vector<int> lptr = kOctahedronLptr, listc(24), ltri(6);
        int lnew = 25;
        library.crlist(&n, &ncol, x.data(), y.data(), z.data(), kOctahedronList.data(),
                       kOctahedronLend.data(), lptr.data(), &lnew, ltri.data(), listc.data(), &codes[0],
                       &centres[0], &centres[8], &centres[16], &centres[24], &codes[1]);
      },
      10);
  EXPECT_EQ(ended.outcome, Outcome::returned);
  EXPECT_EQ(codes[0], 0);
  EXPECT_EQ(codes[1], 0);
  return {centres.data(), centres.data() + 4 * 8};
}

TEST(crlist, has_stripacks_17_arguments_and_cartesian_centres_in_every_abi) {
  // Circumcentres: (+--), (++-), (+++), (+-+), (-+-), (-++), (--+), (---) over root 3.
  const int sign[8][3] = {{1, -1, -1}, {1, 1, -1}, {1, 1, 1},   {1, -1, 1},
                          {-1, 1, -1}, {-1, 1, 1}, {-1, -1, 1}, {-1, -1, -1}};
  const Location where = *configured_original();
  const struct {
    Library library;
    double tolerance;
  } cases[] = {{Library(where.file, where.abi), 0},  // to the last bit
               {Library(ORIGINAL_8ARG, k8arg), 0},
               {Library(ADAPTED_8ARG, kR8), 0},
               {Library(STRIPACK_I8, kI8), 1e-15},
               {Library(ORIGINAL_R4, kR4), 1e-7}};
  for (const auto& one : cases) {
    const std::vector<double> centre = crlist_of_octahedron(one.library);
    for (int t = 0; t < 8; ++t) {
      for (int i = 0; i < 3; ++i)
        EXPECT_NEAR(centre[8 * i + t], sign[t][i] * (1 / std::sqrt(3.0)), one.tolerance) << t << " " << i;
      EXPECT_NEAR(centre[24 + t], 0.9553166181245092, one.tolerance + 2e-16);
    }
  }
}

#endif

}  // namespace
}  // namespace legacy_stripack
