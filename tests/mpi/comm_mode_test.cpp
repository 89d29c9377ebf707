// Comm mode: the program's own calls of TRMESH become collective, and give the same bytes.

#include <array>
#include <cstdlib>
#include <string>
#include <thread>
#include <vector>

#include "capi/pstripack_mpi.h"
#include "mpi_test.h"
#include "point_sets.h"
#include "support/child.h"
#include "support/environment.h"
#include "support/expect.h"
#include "support/trmesh.h"

namespace {

/// Sets comm mode for its lifetime.
class CommMode {
 public:
  explicit CommMode(MPI_Comm comm = MPI_COMM_WORLD) : code_(pstripack_set_comm(comm)) {}
  ~CommMode() { pstripack_set_comm(MPI_COMM_NULL); }
  CommMode(const CommMode&) = delete;
  CommMode& operator=(const CommMode&) = delete;
  int code() const { return code_; }

 private:
  const int code_;
};

TEST(CommMode, GivesTheSameBytes) {
  for (const char* family : {"random", "latlon", "cap", "hemisphere-rim", "ring"})
    for (const std::size_t n : {5, 1000}) {
      const Nodes nodes = point_sets::make(family, n);
      const Mesh expected = trmesh(nodes), single = trmesh_r4(nodes);
      const CommMode mode;
      ASSERT_EQ(mode.code(), 0);
      EXPECT_TRUE(trmesh(nodes) == expected) << family;
      EXPECT_TRUE(trmesh_r4(nodes) == single) << family;
      EXPECT_TRUE(trmesh_i8(nodes) == expected) << family;
    }
}

/// Under PSTRIPACK_ORDER=bitwise: the original's lists of grids, even if they are not the exact mesh.
TEST(CommMode, GivesTheSameBytesOfGrids) {
  const char* const order = std::getenv("PSTRIPACK_ORDER");
  const bool is_bitwise = order != nullptr && std::string(order) == "bitwise";
  for (const char* family : {"latlon", "tripolar"}) {
    const Nodes nodes = point_sets::make(family, 1000);
    const Mesh expected = trmesh(nodes);
    EXPECT_EQ(expected.ier, 0);
    EXPECT_EQ(verdict(nodes, expected) != "", is_bitwise) << family;
    const CommMode mode;
    EXPECT_TRUE(trmesh(nodes) == expected) << family;
  }
}

TEST(CommMode, GivesTheSameBytesInAnyFloatingPointEnvironmentAndLeavesItAsItWas) {
  for (const char* family : {"pairs", "hemisphere-rim", "cap:1e-8"}) {
    const Nodes nodes = point_sets::make(family, 1000);
    const Mesh expected = trmesh(nodes);
    Mesh strange;
    bool is_as_before;
    {
      const StrangeEnvironment environment;
      const Environment before;
      const CommMode mode;
      strange = trmesh(nodes);
      is_as_before = Environment() == before;
    }
    EXPECT_TRUE(strange == expected) << family;
    EXPECT_TRUE(is_as_before) << family;
  }
}

TEST(CommMode, TouchesNothingOutsideTheArrays) {
  const Nodes nodes = point_sets::make("hemisphere", 1000);
  const CommMode mode;
  for (const Edge edge : {Edge::begin, Edge::end}) EXPECT_EQ(guarded_trmesh(nodes, edge).ier, 0);
}

TEST(CommMode, IsCollectiveOnlyWhileItIsSet) {
  const Nodes nodes = point_sets::make("random", 200);
  const Mesh expected = trmesh(nodes);
  { const CommMode mode; }
  if (rank_of() == 0) {
    EXPECT_TRUE(trmesh(nodes) == expected);
  }
  MPI_Barrier(MPI_COMM_WORLD);
}

TEST(CommMode, WorksOnPartsOfTheWorldWithDataOfTheirOwn) {
  const int colour = rank_of() % 3 == 2 ? MPI_UNDEFINED : rank_of() % 3;
  MPI_Comm part;
  MPI_Comm_split(MPI_COMM_WORLD, colour, -rank_of(), &part);
  const Nodes nodes = point_sets::make("random", static_cast<std::size_t>(300 + rank_of() % 3));
  const Mesh expected = trmesh(nodes);
  {
    const CommMode mode(part);  // MPI_COMM_NULL on every third rank: it goes on alone
    ASSERT_EQ(mode.code(), 0);
    for (int calls = 0; calls <= rank_of() % 3; ++calls) EXPECT_TRUE(trmesh(nodes) == expected);
  }
  if (part != MPI_COMM_NULL) MPI_Comm_free(&part);
}

TEST(CommMode, IsReplacedByAnotherCommunicator) {
  const Nodes nodes = point_sets::make("random", 100 + 10 * static_cast<std::size_t>(rank_of()));
  const Mesh expected = trmesh(nodes);
  const CommMode world;
  ASSERT_EQ(pstripack_set_comm_f(MPI_Comm_c2f(MPI_COMM_SELF)), 0);
  EXPECT_TRUE(trmesh(nodes) == expected);
}

TEST(CommMode, RanksThatDisagreeAreToldSoAndNothingIsWritten) {
  if (size_of() < 2) GTEST_SKIP() << "nobody to disagree with";
  const CommMode mode;
  const auto expect_refused = [](const Nodes& nodes, const std::string& line) {
    expect_lines_of_rank_0("trmesh: " + line + " (IER = -7)", [&] {
      const Mesh m = trmesh(nodes);
      EXPECT_EQ(m.ier, PSTRIPACK_RANKS_DISAGREE);
      EXPECT_TRUE(is_untouched(m));
    });
  };
  const int last = size_of() - 1;
  Nodes nodes = point_sets::make("random", 100);
  if (rank_of() == last) nodes[50].x = -nodes[50].x;
  expect_refused(nodes,
                 "the coordinates of 100 nodes on rank " + std::to_string(last) + " are not those on rank 0");
  expect_refused(point_sets::make("random", rank_of() == 0 ? 99 : 100),
                 "N is 99 on rank 0 and 100 on rank 1");
}

TEST(CommMode, KnowsTheOtherCodes) {
  const CommMode mode;
  Nodes nodes = point_sets::make("random", 100);
  EXPECT_EQ(trmesh(Nodes(nodes.begin(), nodes.begin() + 2)).ier, PSTRIPACK_TOO_FEW_NODES);
  nodes[70] = nodes[30];
  EXPECT_EQ(trmesh(nodes).ier, 31);
  EXPECT_TRUE(trmesh_i8(nodes) == trmesh(nodes));
  nodes[60] = {0, 0, 0};
  const Mesh bad = trmesh(nodes);
  EXPECT_EQ(bad.ier, PSTRIPACK_BAD_COORDINATE);
  EXPECT_TRUE(is_untouched(bad));
  nodes = point_sets::make("random", 100);
  nodes[2] = nodes[0];
  EXPECT_EQ(trmesh(nodes).ier, PSTRIPACK_COLLINEAR);
}

TEST(CommMode, RefusesWhatIsNoIntraCommunicatorAndKeepsTheOneBefore) {
  const CommMode mode;
  MPI_Comm freed;
  MPI_Comm_dup(MPI_COMM_WORLD, &freed);
  const MPI_Comm handle = freed;
  MPI_Comm_free(&freed);
  EXPECT_EQ(pstripack_set_comm(handle), PSTRIPACK_BAD_COMM);
  for (const int none : {-1, 12345678}) EXPECT_EQ(pstripack_set_comm_f(none), PSTRIPACK_BAD_COMM);
  if (size_of() < 2) return;
  MPI_Comm half, inter;
  const int colour = rank_of() % 2;
  MPI_Comm_split(MPI_COMM_WORLD, colour, 0, &half);
  MPI_Intercomm_create(half, 0, MPI_COMM_WORLD, 1 - colour, 1, &inter);
  EXPECT_EQ(pstripack_set_comm(inter), PSTRIPACK_BAD_COMM);
  MPI_Comm_free(&inter);
  MPI_Comm_free(&half);
  const Mesh different = trmesh(point_sets::make("random", 50 + static_cast<std::size_t>(rank_of())));
  EXPECT_EQ(different.ier, PSTRIPACK_RANKS_DISAGREE) << "not collective any more";
}

TEST(CommMode, ForkedChildrenAndOtherThreadsGoOnAlone) {
  const Nodes nodes = point_sets::make("random", 300);
  const Mesh expected = trmesh(nodes);
  const CommMode mode;
  if (rank_of() == 0) {
    EXPECT_EQ(in_child([&] { return trmesh(nodes) == expected ? 0 : 1; }), 0);
    Mesh in_thread;
    std::thread([&] { in_thread = trmesh(nodes); }).join();
    EXPECT_TRUE(in_thread == expected);
  }
  EXPECT_TRUE(trmesh(nodes) == expected);
}

/// Run under PSTRIPACK_ORDER=original on rank 0 alone.
TEST(CommMode, RefusesRanksThatDisagreeInTheOrder) {
  if (std::getenv("ORDER_OF_RANK_0") == nullptr) GTEST_SKIP() << "all ranks have the same";
  expect_lines_of_rank_0("set_comm: PSTRIPACK_ORDER on rank 1 is not that on rank 0 (IER = -7)",
                         [] { EXPECT_EQ(pstripack_set_comm(MPI_COMM_WORLD), PSTRIPACK_RANKS_DISAGREE); });
  pstripack_set_comm(MPI_COMM_NULL);
}

}  // namespace

int main(int argc, char** argv) {
  const char* const order = std::getenv("ORDER_OF_RANK_0");
  for (const char* variable : {"OMPI_COMM_WORLD_RANK", "PMI_RANK"})
    if (const char* rank = std::getenv(variable); order != nullptr && rank != nullptr && std::atoi(rank) == 0)
      setenv("PSTRIPACK_ORDER", order, 1);
  const Nodes nodes = point_sets::make("random", 400);
  const Mesh expected = trmesh(nodes);
  // MPI is not initialised, and MPI_Comm_c2f is not yet allowed: any handle.
  if (pstripack_set_comm(MPI_COMM_WORLD) != PSTRIPACK_BAD_COMM) return 1;
  if (pstripack_set_comm_f(0) != PSTRIPACK_BAD_COMM) return 1;
  const int code = run_on_every_rank(argc, argv, [] { pstripack_set_comm(MPI_COMM_WORLD); });
  if (!(trmesh(nodes) == expected)) return 2;  // MPI_Finalize has ended comm mode
  if (pstripack_set_comm(MPI_COMM_WORLD) != PSTRIPACK_BAD_COMM) return 3;
  if (pstripack_set_comm(MPI_COMM_NULL) != 0) return 4;
  return code;
}
