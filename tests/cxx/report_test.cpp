// PSTRIPACK_REPORT. The library reads it when it is loaded, so every case runs this program again.

#include <omp.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <fstream>
#include <regex>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include "point_sets.h"
#include "support/expect.h"
#include "support/this_program.h"
#include "support/trmesh.h"

namespace {

const std::string kOne = "OMP_NUM_THREADS=1 PSTRIPACK_REPORT=1";
const std::string kSeconds = "[0-9]+\\.[0-9]{6}";
const std::string kPhases = " seconds=" + kSeconds + " divide=" + kSeconds + " triangulate=" + kSeconds +
                            " merge=" + kSeconds + " lists=" + kSeconds + " gather=" + kSeconds;

std::string line_of(const std::string& before_seconds) {
  const std::string words =
      std::regex_replace(before_seconds, std::regex("threads=[0-9]+"), "$& of=[0-9]+ limit=[a-z]+");
  return "pstripack: threads " + words + kPhases + " rounds=[0-9]+ halo=[0-9]+ bytes=0 start=cold";
}
std::string row_of(int calls) {
  return "pstripack: threads +" + std::to_string(calls) + "( +" + kSeconds + "){7}";
}

::testing::AssertionResult matches(const std::string& line, const std::string& pattern) {
  if (std::regex_match(line, std::regex(pattern))) return ::testing::AssertionSuccess();
  return ::testing::AssertionFailure() << "'" << line << "' is not like\n'" << pattern << "'";
}

double value(const std::string& line, const std::string& key) {
  const std::size_t at = line.find(" " + key + "=");
  return at == std::string::npos ? -1 : std::stod(line.substr(at + key.size() + 2));
}

TEST(Report, IsSilentUnlessAskedFor) {
  const Folder folder;
  for (const char* environment : {"env -u PSTRIPACK_REPORT", "PSTRIPACK_REPORT=", "PSTRIPACK_REPORT=0"}) {
    const Outcome outcome = run_self(folder, environment, "calls random 1000 2");
    EXPECT_EQ(outcome.out + outcome.err, "") << environment;
  }
}

TEST(Report, HasALineACallAndATableAtExit) {
  const Folder folder;
  const Outcome outcome = run_self(folder, kOne, "calls random 1000 2");
  EXPECT_EQ(outcome.out, "");
  const auto all = lines(outcome.err);
  ASSERT_EQ(all.size(), 4u) << outcome.err;
  for (int i = 0; i < 2; ++i)
    EXPECT_TRUE(matches(all[i], line_of("n=1000 ranks=1 threads=1 triangles=1996 boundary=0 ier=0")));
  EXPECT_EQ(all[2].find("pstripack: total seconds"), 0u);
  EXPECT_TRUE(matches(all[3], row_of(2)));
}

/// threads=..., of=... and limit=... of a call of TRMESH by this program under `environment`.
std::string threads_of(const std::string& environment, const std::string& call) {
  const Folder folder;
  const std::string line = run_self(folder, environment + " PSTRIPACK_REPORT=1", call).err;
  std::smatch match;
  return std::regex_search(line, match, std::regex("threads=[0-9]+ of=[0-9]+ limit=[a-z]+")) ? match.str()
                                                                                             : line;
}

TEST(Report, TellsHowManyThreadsACallTakesAndWhy) {
  const std::string unset = "env -u OMP_NUM_THREADS", ranks = unset + " OMPI_COMM_WORLD_LOCAL_SIZE=100000",
                    call = "inserted random 60000 1";
  const std::string of = " of=" + std::to_string(omp_get_num_procs());
  EXPECT_EQ(threads_of("OMP_NUM_THREADS=1", call), "threads=1" + of + " limit=asked");
  EXPECT_EQ(threads_of("OMP_NUM_THREADS=3", call), "threads=3" + of + " limit=asked");
  EXPECT_EQ(threads_of("OMP_NUM_THREADS=3", "inserted random 29999 1"), "threads=1" + of + " limit=size");
  if (omp_get_num_procs() == 1) return;
  EXPECT_EQ(threads_of(ranks, call), "threads=1" + of + " limit=ranks");
  EXPECT_EQ(threads_of("taskset -c 0 " + unset, call), "threads=1 of=1 limit=none");
}

TEST(Report, AWordIsNoFile) {
  const Folder folder;
  for (const std::string word : {"yes", "TRUE", "off"}) {
    const Outcome outcome = run_self(folder, "PSTRIPACK_REPORT=" + word, "calls random 1000 1");
    expect_line(outcome.err, "pstripack: PSTRIPACK_REPORT=" + word + ": neither 1 nor the path");
    EXPECT_EQ(contents(folder.path() + "/" + word), "");
  }
  EXPECT_EQ(run_self(folder, "PSTRIPACK_REPORT=./yes", "calls random 1000 1").err, "");
  EXPECT_EQ(lines(contents(folder.path() + "/yes")).size(), 3u);
}

TEST(Report, HasNoTableWithoutACall) {
  const Folder folder;
  EXPECT_EQ(run_self(folder, kOne, "calls random 1000 0").err, "");
}

TEST(Report, PhasesAreWithinTheCall) {
  const Folder folder;
  for (const char* threads : {"1", "2"}) {
    const std::string line =
        run_self(folder, std::string("PSTRIPACK_REPORT=1 OMP_NUM_THREADS=") + threads, "calls random 60000 1")
            .err;
    double sum = 0;
    for (const char* phase : {"divide", "triangulate", "merge", "lists", "gather"}) {
      EXPECT_GE(value(line, phase), 0) << phase;
      sum += value(line, phase);
    }
    EXPECT_GT(value(line, "triangulate"), 0);
    EXPECT_GT(value(line, "lists"), 0);
    EXPECT_LE(sum, value(line, "seconds") + 5e-6) << line;
#ifdef _OPENMP
    EXPECT_EQ(value(line, "threads"), std::stod(threads)) << line;
#endif
  }
}

TEST(Report, CountsBoundaryNodes) {
  const Folder folder;
  for (const char* family : {"cap", "hemisphere-rim"}) {
    const std::size_t n = point_sets::make(family, 500).size();
    const std::size_t boundary = boundary_nodes(trmesh(point_sets::make(family, n)));
    ASSERT_GT(boundary, 0u);
    const std::string line = run_self(folder, kOne, "calls " + std::string(family) + " 500 1").err;
    EXPECT_EQ(value(line, "boundary"), static_cast<double>(boundary)) << line;
    EXPECT_EQ(value(line, "triangles"), static_cast<double>(2 * n - 2 - boundary)) << line;
  }
  // Three boundary nodes: as many slots as without a boundary.
  EXPECT_TRUE(matches(lines(run_self(folder, kOne, "calls random 3 1").err)[0],
                      line_of("n=3 ranks=1 threads=1 triangles=1 boundary=3 ier=0")));
}

TEST(Report, TellsEveryCode) {
  const Folder folder;
  const Outcome outcome = run_self(folder, kOne, "codes");
  EXPECT_EQ(outcome.out, "");
  const auto all = lines(outcome.err);
  ASSERT_EQ(all.size(), 9u);
  EXPECT_TRUE(matches(all[0], line_of("n=2 ranks=1 threads=1 triangles=0 boundary=0 ier=-1")));
  EXPECT_TRUE(matches(all[1], line_of("n=100 ranks=1 threads=1 triangles=0 boundary=0 ier=-2")));
  EXPECT_TRUE(matches(
      all[2], line_of("n=100 ranks=1 threads=1 triangles=0 boundary=0 ier=-5") + " lengths=0\\.\\.1"));
  EXPECT_EQ(all[3].find("pstripack: trmesh: node 61 of 100"), 0u) << "the line of every IER -5";
  EXPECT_TRUE(matches(all[4], line_of("n=100 ranks=1 threads=1 triangles=[0-9]+ boundary=0 ier=31")));
  EXPECT_EQ(value(all[4], "triangles"), 2 * 70 - 4) << "nodes 1 to 70";
  EXPECT_TRUE(matches(all[5], line_of("n=1073741824 ranks=1 threads=1 triangles=0 boundary=0 ier=-4")));
  EXPECT_TRUE(matches(all[8], row_of(5)));
  const Outcome in_order = run_self(folder, kOne + " PSTRIPACK_ORDER=original", "codes");
  EXPECT_EQ(in_order.out, "");
  EXPECT_EQ(lines(in_order.err).size(), 9u) << in_order.err;
}

TEST(Report, TellsTheLengthsWhereTheyAreNot1) {
  const Folder folder;
  const auto ends_with = [&](const std::string& as, const std::string& end) {
    const std::string line = lines(run_self(folder, kOne, as).err).at(0);
    return line.size() > end.size() && line.substr(line.size() - end.size()) == end;
  };
  EXPECT_TRUE(ends_with("lengths random 1000", " start=cold lengths=0.5..6.37e+03"));
  EXPECT_TRUE(ends_with("calls random 1000 1", " start=cold"));
}

TEST(Report, IsAppendedToAFile) {
  const Folder folder;
  for (const std::string& path : {std::string("report"), folder.path() + "/report"}) {
    const Outcome outcome =
        run_self(folder, "OMP_NUM_THREADS=1 PSTRIPACK_REPORT=" + path, "elsewhere random 1000 1");
    EXPECT_EQ(outcome.out + outcome.err, "");
  }
  const auto all = lines(contents(folder.path() + "/report"));
  ASSERT_EQ(all.size(), 6u);
  EXPECT_TRUE(matches(all[3], line_of("n=1000 ranks=1 threads=1 triangles=1996 boundary=0 ier=0")));
  EXPECT_TRUE(matches(all[5], row_of(1)));
}

TEST(Report, WarnsOnceOfAFileThatCannotBeWrittenAndGoesOn) {
  const Folder folder;
  for (const char* path : {"/proc/no/such/folder", "/tmp", "/dev/full"}) {
    const Outcome outcome = run_self(folder, std::string("PSTRIPACK_REPORT=") + path, "calls random 100 3");
    EXPECT_EQ(outcome.out, "");
    expect_line(outcome.err, std::string("pstripack: PSTRIPACK_REPORT: ") + path + ": ");
  }
}

/// A truncated name would be that of another file.
TEST(Report, IsNotWrittenUnderAnotherNameWhereItsOwnIsTooLong) {
  const Folder folder;
  std::string deep;
  while (folder.path().size() + deep.size() < 3900) deep += "/" + std::string(100, 'd');
  const std::string command =
      "mkdir -p '" + folder.path() + deep + "' && cd '" + folder.path() + deep + "' && env";
  const Outcome outcome =
      run_self(folder, command + " PSTRIPACK_REPORT=" + std::string(250, 'r'), "calls random 100 1");
  expect_line(outcome.err, "pstripack: ", "File name too long; there is no report");
  EXPECT_EQ(std::system(("test -z \"$(find " + folder.path() + " -name 'r*')\"").c_str()), 0);
}

TEST(Report, KeepsTheLinesOfThreadsWhole) {
  const Folder folder;
  const auto all = lines(run_self(folder, kOne, "threads random 500 8").err);
  ASSERT_EQ(all.size(), 10u);
  for (int i = 0; i < 8; ++i)
    EXPECT_TRUE(matches(all[i], line_of("n=500 ranks=1 threads=1 triangles=996 boundary=0 ier=0")));
  EXPECT_TRUE(matches(all[9], row_of(8)));
}

TEST(Report, OfAForkedChildIsItsOwn) {
  const Folder folder;
  const auto all = lines(run_self(folder, kOne, "fork random 500 1").err);
  ASSERT_EQ(all.size(), 8u);
  EXPECT_TRUE(matches(all[4], row_of(2))) << "the child's: two calls, none of the parent's";
  EXPECT_TRUE(matches(all[7], row_of(2))) << "the parent's: one call before, one after";
}

/// Under PSTRIPACK_ORDER=original a canonical result is correct by our own rules.
TEST(Report, TellsTheOrderAndHowFarFromTheExactMeshTheOriginalIs) {
  const Folder folder;
  const auto order_of = [&](const std::string& order, const std::string& arguments) {
    const std::string line = lines(run_self(folder, kOne + " PSTRIPACK_ORDER=" + order, arguments).err)[0];
    return line.substr(line.find(" order=") + 1);
  };
  for (const std::string order : {"original", "bitwise"}) {
    EXPECT_EQ(order_of(order, "inserted random 1000 1"), "order=original");
    EXPECT_EQ(order_of(order, "meridian"), "order=canonical: the original's search for node 4 does not end");
    EXPECT_EQ(order_of(order, "in-line"),
              "order=canonical: STRIPACK rejects node 5: within rounding it is collinear with every visible "
              "boundary edge");
  }
  EXPECT_EQ(order_of("original", "six"),
            "order=canonical: the original's triangulation is not the exact mesh");
  EXPECT_EQ(order_of("bitwise", "six"),
            "order=original: differs from the exact mesh in 1 arc and 2 boundary triangles");
}

TEST(Report, TellsTheOrdersThatThereAre) {
  const Folder folder;
  EXPECT_EQ(
      lines(run_self(folder, "PSTRIPACK_ORDER=bitwse", "calls random 100 1").err),
      std::vector<std::string>{"pstripack: PSTRIPACK_ORDER=bitwse: no such order, so canonical is used; set "
                               "it to canonical, original, bitwise, ngmath or bitwise-ngmath"});
}

/// Four nodes of one meridian; and five of which the fourth is attached by a null triangle.
const Nodes kMeridian{{0.452695204446832, 0.5590320207484465, 0.6946583704589973},
                      {0.4602557974987226, 0.5683685756099448, 0.6819983600624985},
                      {0.467676192176097, 0.5775319998974023, 0.6691306063588582},
                      {0.47495412815485366, 0.5865195023430131, 0.6560590289905072}};
const Nodes kInLine{{-0.5773502691896258, 0.5773502691896258, -0.5773502691896258},
                    {-0.7071067811865475, 0.7071067811865475, 0},
                    {1, 0, 0},
                    {-0.5773502691896258, 0.5773502691896258, 0.5773502691896258},
                    {0, 0, 1}};

/// Three nodes on each of two meridians, whose middle ones lie on the arc between the others up to rounding.
const Nodes kSix{{0.43730985356969798, -0.75744288503322266, -0.48480962024633706},
                 {0.57476950271242455, -0.73567141543654491, -0.35836794954530027},
                 {0.46679021324860098, -0.80850436582248753, -0.35836794954530027},
                 {0.5998821115988352, -0.76781408904324377, -0.224951054343865},
                 {0.48718503239261773, -0.843829228791103, -0.224951054343865},
                 {0.53846965924633561, -0.6892097345422058, -0.48480962024633706}};
/// The program that the cases run. Exit code 0 if all results are as without a report.
int run_as(const std::string& action, const std::string& family, std::size_t n, int count) {
  if (action == "codes") return codes_are_right() ? 0 : 1;
  if (action == "meridian" || action == "in-line") {
    call_trmesh(action == "meridian" ? kMeridian : kInLine);
    return 0;
  }
  if (action == "six") return trmesh(kSix).ier;
  Nodes nodes = point_sets::make(family, n);
  if (action == "lengths") {
    for (auto& p : nodes) p = scaled(6371, p);
    nodes[7] = {0, 0, 0.5};
    return trmesh(nodes).ier;
  }
  if (action == "inserted") return trmesh(nodes).ier;
  return make_calls(action, nodes, count, "PSTRIPACK_REPORT");
}

}  // namespace

int main(int argc, char** argv) { return run_as_or_test(argc, argv, run_as); }
