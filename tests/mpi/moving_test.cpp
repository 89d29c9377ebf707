// Distributed meshes whose calls begin with the stars of the last one: when they do, and that nobody can tell
// from the stars.

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "base/kept.h"
#include "geometry/predicates.h"
#include "mpi/area_of_all.h"
#include "mpi/collective_trmesh.h"
#include "mpi/distributed_mesh.h"
#include "mpi_test.h"
#include "point_sets.h"
#include "pool/area_layout.h"
#include "support/columns.h"
#include "support/failing_allocation.h"
#include "support/follower.h"
#include "support/lists.h"
#include "support/moves.h"
#include "support/room_to_stay.h"

namespace {

using namespace pstripack;
using point_sets::Random;

constexpr std::size_t kN = 2000;

struct Result {
  std::int32_t code = 0;
  std::vector<std::int64_t> begin, neighbour, halo;
  std::vector<double> xyz;
};
bool operator==(const Result& a, const Result& b) {
  return a.code == b.code && a.begin == b.begin && a.neighbour == b.neighbour && a.halo == b.halo &&
         a.xyz == b.xyz;
}

/// This rank's part of the nodes: numbers from 1.
struct Part {
  std::vector<std::int64_t> numbers;
  Nodes points;
  void place(const Nodes& nodes) {
    points.clear();
    for (const std::int64_t k : numbers) points.push_back(nodes[static_cast<std::size_t>(k) - 1]);
  }
};

/// The nodes by longitude: stripes.
Part part_of(const Nodes& nodes) {
  Part part;
  for (std::size_t i = 0; i < nodes.size(); ++i) {
    const double turn = std::atan2(nodes[i].y, nodes[i].x) / 6.2831853071796 + 0.5;
    if (std::min(static_cast<int>(turn * size_of()), size_of() - 1) == rank_of())
      part.numbers.push_back(static_cast<std::int64_t>(i) + 1);
  }
  return part;
}

Result result_of(const DistributedMesh& mesh, std::int32_t code) {
  Result r;
  r.code = code;
  if (code != 0) return r;
  const OwnStars& own = mesh.own();
  r.begin.resize(own.count() + 1);
  r.neighbour.resize(own.arcs());
  r.halo.resize(own.outside().size());
  r.xyz.resize(3 * r.halo.size());
  own.stars(r.begin.data(), r.neighbour.data());
  own.halo(r.halo.data(), r.xyz.data());
  EXPECT_EQ(static_cast<std::size_t>(r.begin.back()), r.neighbour.size());
  return r;
}

std::int32_t triangulate(DistributedMesh& mesh, const Part& part, DistributedMesh::Report* report = nullptr) {
  try {
    return mesh.triangulate(static_cast<std::int64_t>(part.numbers.size()), &part.points.data()->x,
                            part.numbers.data(), report);
  } catch (const AgreedFailure& failure) {
    return failure.code;
  }
}

/// A mesh, beside one that begins anew.
class Beside {
 public:
  /// Whether the call began with the stars of the last one.
  bool call(const Nodes& nodes, Part& part) {
    part.place(nodes);
    DistributedMesh::Report report;
    const std::int32_t code = triangulate(mesh_, part, &report);
    DistributedMesh anew(MPI_COMM_WORLD);
    const Result right = result_of(anew, triangulate(anew, part));
    EXPECT_TRUE(result_of(mesh_, code) == right) << (report.cost.mine.flips >= 0 ? "warm" : "cold");
    EXPECT_EQ(report.points, static_cast<std::int64_t>(nodes.size()));
    return report.cost.mine.flips >= 0;
  }

 private:
  DistributedMesh mesh_{MPI_COMM_WORLD};
};

TEST(Moving, CallsBeginWithTheLastStarsFromTheThirdOn) {
  Random random(1);
  for (const std::size_t n : {kN, std::size_t{60000}}) {  // the latter on threads, if there are any
    Nodes nodes = point_sets::make("random", n, 1);
    Part part = part_of(nodes);
    Beside mesh;
    for (int step = 0; step < 5; ++step) {
      EXPECT_EQ(mesh.call(nodes, part), step >= 2) << step;
      move_all(nodes, 1e-3 * spacing(n), random);
    }
  }
}

using Starts = std::vector<bool>;

/// With other nodes, or the same from other ranks or in another order, a call begins anew.
TEST(Moving, CallsBeginAnewWhereTheNumbersAreNotTheSame) {
  Random random(2);
  Nodes nodes = point_sets::make("random", kN, 1);
  Part part = part_of(nodes);
  Beside mesh;
  const auto calls = [&](int count) {
    Starts warm;
    for (int i = 0; i < count; ++i) {
      move_all(nodes, 1e-4 * spacing(kN), random);
      warm.push_back(mesh.call(nodes, part));
    }
    return warm;
  };
  EXPECT_EQ(calls(3), (Starts{false, false, true}));
  if (rank_of() == size_of() - 1) std::swap(part.numbers.front(), part.numbers.back());
  EXPECT_EQ(calls(3), (Starts{false, false, true})) << "another order on one rank";
  nodes.push_back({0, 0, -1});
  if (rank_of() == 0) part.numbers.push_back(static_cast<std::int64_t>(nodes.size()));
  EXPECT_EQ(calls(3), (Starts{false, false, true})) << "one node more";
  nodes.pop_back();
  if (rank_of() == 0) part.numbers.pop_back();
  rotate(nodes, {0, 0, 1}, 1);
  part = part_of(nodes);
  EXPECT_EQ(calls(3), (Starts{false, false, true})) << "from other ranks";
}

/// Far moves are noticed by a look at a few stars; a mesh that does not fit after all is tried ever more
/// seldom.
TEST(Moving, CallsBeginAnewWhereTheStarsDoNotFit) {
  Random random(3);
  const Nodes nodes = point_sets::make("random", kN, 1);
  Part part = part_of(nodes);
  Beside mesh;
  for (int step = 0; step < 4; ++step) {
    Nodes other = nodes;
    move_all(other, 10 * spacing(kN), random);
    EXPECT_FALSE(mesh.call(other, part));
  }
  Starts warm;
  for (int step = 0; step < 6; ++step) {
    Nodes other = nodes;
    other[7] = {-nodes[7].x, -nodes[7].y, -nodes[7].z};
    if (step % 2 == 1) other[7] = nodes[7];
    warm.push_back(mesh.call(other, part));
  }
  EXPECT_EQ(warm, Starts(6));
  Nodes meet = nodes, bad = nodes;
  meet[3] = meet[4];
  bad[5].z = std::numeric_limits<double>::quiet_NaN();
  DistributedMesh lenient(MPI_COMM_WORLD);
  for (const auto& [set, code] : std::vector<std::pair<const Nodes*, int>>{{&nodes, 0},
                                                                           {&nodes, 0},
                                                                           {&nodes, 0},
                                                                           {&meet, -9},
                                                                           {&nodes, 0},
                                                                           {&nodes, 0},
                                                                           {&nodes, 0},
                                                                           {&bad, -5}}) {
    part.place(*set);
    EXPECT_EQ(triangulate(lenient, part), code);
  }
}

/// Wherever memory runs out on a rank in a call that would begin with the last stars, for a moment or for
/// good: the same stars, or code -6 on every rank; and the next call is right.
TEST(Moving, SurviveMemoryThatRunsOut) {
  const Nodes nodes = point_sets::make("random", 1000, 1);
  Part part = part_of(nodes);
  part.place(nodes);
  DistributedMesh anew(MPI_COMM_WORLD);
  const Result right = result_of(anew, triangulate(anew, part));
  for (const int calls_before : {2, 3})  // the first call that begins so, and a later one
    for (const bool for_good : {false, true}) {
      int last = 1;
      for (long which = 1; last != 0; which += 1 + which / 4) {
        DistributedMesh mesh(MPI_COMM_WORLD);
        for (int i = 0; i < calls_before; ++i) EXPECT_EQ(triangulate(mesh, part), 0);
        int happened = 0;
        std::int32_t code;
        {
          const FailingAllocation failing(rank_of() == size_of() - 1 ? which : 0, for_good);
          code = triangulate(mesh, part);
          happened = FailingAllocation::happened();
        }
        EXPECT_TRUE(code == 0 || code == -6) << code;
        if (code == 0) {
          EXPECT_TRUE(result_of(mesh, code) == right) << which;
        }
        EXPECT_TRUE(result_of(mesh, triangulate(mesh, part)) == right) << which;
        MPI_Allreduce(&happened, &last, 1, MPI_INT, MPI_MAX, MPI_COMM_WORLD);
        ASSERT_LT(which, 100000);
      }
    }
}

// ---- comm mode, and the pool on one machine
// ------------------------------------------------------------------

/// TRMESH by all ranks, in arrays of their own or in memory that they share.
class Caller {
 public:
  explicit Caller(bool shared) : shared_(shared) {}

  /// Whether the call began with the rings of the last one.
  bool call(const Nodes& nodes, int ier = 0, long failing = 0, bool for_good = false) {
    const std::size_t n = nodes.size();
    const Columns<double> c(nodes);
    Lists lists;
    lists.list.assign(6 * n - 12, 0);
    lists.lptr = lists.list;
    lists.lend.assign(n, 0);
    TrmeshCall call{static_cast<std::int32_t>(n), {c.x.data(), c.y.data(), c.z.data()}, {}};
    const AreaLayout layout(call.n, sizeof(double));
    SharedArea area;
    if (shared_) {
      area = area_of_all(ranks_.handle(), layout.size());
      call = layout.call(area.data(), &lists.lnew);
      call.n = static_cast<std::int32_t>(n);
      const std::vector<double>* const columns[] = {&c.x, &c.y, &c.z};
      for (int i = 0; i < 3 && ranks_.rank() == 0; ++i)
        std::copy(columns[i]->begin(), columns[i]->end(),
                  static_cast<double*>(layout.coordinate(area.data(), i)));
      meet();
    } else {
      call.lists = {lists.list.data(), lists.lptr.data(), lists.lend.data(), &lists.lnew};
    }
    GroupCost cost;
    TrmeshResult result{0};
    try {
      const FailingAllocation memory(ranks_.rank() == ranks_.size() - 1 ? failing : 0, for_good);
      result =
          collective_trmesh(ranks_, shared_ ? Arrays::shared : Arrays::on_every_rank, call, &cost, &last_);
      has_failed = FailingAllocation::happened();
    } catch (const AgreedFailure& failure) {
      has_failed = true;
      EXPECT_EQ(failure.code, -6);
      EXPECT_GT(failing, 0);
      return false;
    }
    EXPECT_EQ(result.ier, ier);
    if (shared_) {
      std::copy_n(call.lists.list, lists.list.size(), lists.list.data());
      std::copy_n(call.lists.lptr, lists.lptr.size(), lists.lptr.data());
      std::copy_n(call.lists.lend, lists.lend.size(), lists.lend.data());
      ranks_.broadcast(&lists.lnew, sizeof lists.lnew, 0);
      meet();
    }
    if (const auto right = made_anew(nodes)) {
      EXPECT_TRUE(lists == *right) << (cost.mine.flips >= 0 ? "warm" : "cold");
    }
    return cost.mine.flips >= 0;
  }
  bool has_failed = false;  ///< memory, in the last call

 private:
  void meet() {
    std::int64_t here = 0;
    ranks_.all_min(&here, 1);
  }
  const bool shared_;
  MpiCommunicator ranks_{MPI_COMM_WORLD};
  LastCall last_;
};

/// In random order, so that nearly all neighbours of a node are in the slices of others.
TEST(Moving, CallsOfTrmeshBeginWithTheLastRings) {
  for (const bool shared : {false, true}) {
    SCOPED_TRACE(shared ? "shared memory" : "own arrays");
    Random random(4);
    Caller caller(shared);
    Nodes nodes = point_sets::make("random", kN, 1);
    for (int step = 0; step < 5; ++step) {
      EXPECT_EQ(caller.call(nodes), step >= 2) << step;
      move_all(nodes, 1e-3 * spacing(kN), random);
    }
    nodes.pop_back();
    for (int step = 0; step < 4; ++step) {
      EXPECT_EQ(caller.call(nodes), step >= 2) << "another number, " << step;
      move_all(nodes, 1e-9, random);
    }
    Nodes far = nodes;
    move_all(far, 10 * spacing(kN), random);
    EXPECT_FALSE(caller.call(far)) << "other nodes";
    EXPECT_FALSE(caller.call(nodes)) << "others again";
    EXPECT_FALSE(caller.call(nodes));
    EXPECT_TRUE(caller.call(nodes));
    Nodes meet = nodes;
    meet[9] = meet[5];
    EXPECT_FALSE(caller.call(meet, 6)) << "two nodes coincide";
    for (int step = 0; step < 6; ++step) caller.call(nodes);
    Nodes half = nodes;
    for (Point& p : half) p.z = std::fabs(p.z);
    for (int step = 0; step < 5; ++step) EXPECT_FALSE(caller.call(half)) << "a boundary";
  }
}

TEST(Moving, RingsOfTheLastCallCountAmongWhatStays) {
  const Nodes nodes = point_sets::make("random", kN, 1);
  auto caller = std::make_unique<Caller>(false);
  for (int i = 0; i < 2; ++i) EXPECT_FALSE(caller->call(nodes));
  const std::size_t room = room_to_stay();
  caller.reset();
  EXPECT_GT(room_to_stay(), room + 50 * kN / static_cast<std::size_t>(size_of()));
}

/// As if an allocation had failed between two calls, on the last rank.
void let_memory_run_out() {
  if (rank_of() == size_of() - 1) {
    EXPECT_TRUE(give_up_kept_things());
    EXPECT_FALSE(give_up_kept_things());
  }
}

/// What one rank gave up is no more use to the others. What they keep is their own: another mesh lives on.
TEST(Moving, StarsAreGivenUpWhereMemoryIsOut) {
  const Nodes nodes = point_sets::make("random", kN, 1);
  Caller caller(false);
  for (int step = 0; step < 4; ++step) EXPECT_EQ(caller.call(nodes), step >= 2);
  let_memory_run_out();
  EXPECT_FALSE(caller.call(nodes)) << "rings that were given up";
  EXPECT_TRUE(caller.call(nodes)) << "they have come again";

  Part part = part_of(nodes);
  Beside mesh, other;
  for (int step = 0; step < 4; ++step) EXPECT_EQ(mesh.call(nodes, part), step >= 2);
  let_memory_run_out();
  EXPECT_TRUE(mesh.call(nodes, part)) << "begins with the stars that the caller has";
  for (int step = 0; step < 4; ++step) EXPECT_EQ(other.call(nodes, part), step >= 2);
  EXPECT_TRUE(mesh.call(nodes, part));
}

/// Where more meshes live than there are places, calls of the others begin with the stars that their callers
/// have.
TEST(Moving, MeshesMayBeMany) {
  const Nodes nodes = point_sets::make("random", 1000, 1);
  Part part = part_of(nodes);
  std::vector<Beside> meshes(34);
  for (int step = 0; step < 4; ++step)
    for (Beside& mesh : meshes) EXPECT_EQ(mesh.call(nodes, part), step >= 2);
}

TEST(Moving, CallsOfTrmeshSurviveMemoryThatRunsOut) {
  const Nodes nodes = point_sets::make("random", 1000, 1);
  for (const int calls_before :
       {1, 2, 3})  // the one that keeps rings, the first that begins with them, another
    for (const bool for_good : {false, true}) {
      int any = 1;
      for (long which = 1; any != 0; which += 1 + which / 2) {
        Caller caller(false);
        for (int i = 0; i < calls_before; ++i) caller.call(nodes);
        caller.call(nodes, 0, which, for_good);
        const int happened = caller.has_failed;
        caller.call(nodes);
        MPI_Allreduce(&happened, &any, 1, MPI_INT, MPI_MAX, MPI_COMM_WORLD);
        ASSERT_LT(which, 100000);
      }
    }
}

/// So many flips that rings which are not used any more go.
TEST(Moving, CallsOfTrmeshGoOnForLong) {
  Random random(5);
  Caller caller(false);
  Nodes nodes = point_sets::make("fibonacci", 1000, 1);
  int warm = 0;
  for (int step = 0; step < 50; ++step) {
    warm += caller.call(nodes);
    move_all(nodes, 0.03 * spacing(1000), random);
  }
  EXPECT_GT(warm, 25);
}

}  // namespace

int main(int argc, char** argv) {
  return run_on_every_rank(argc, argv, [] {});
}
