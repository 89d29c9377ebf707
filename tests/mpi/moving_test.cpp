// Distributed meshes whose calls begin with the stars of the last call: when this happens, and that the
// resulting stars are the same.

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include "base/cached.h"
#include "geometry/predicates.h"
#include "mpi/collective_trmesh.h"
#include "mpi/distributed_mesh.h"
#include "mpi_test.h"
#include "point_sets.h"
#include "support/columns.h"
#include "support/failing_allocation.h"
#include "support/follower.h"
#include "support/lists.h"
#include "support/moves.h"
#include "trmesh/warm_start.h"

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

/// The rank of each node: stripes of longitude, the first of which begins at this fraction of a turn.
std::vector<int> stripes(const Nodes& nodes, double begin = 0) {
  std::vector<int> owner;
  for (const Point& p : nodes) {
    const double turn = std::atan2(p.y, p.x) / 6.2831853071796 + 1.5 - begin;
    owner.push_back(std::min(static_cast<int>((turn - std::floor(turn)) * size_of()), size_of() - 1));
  }
  return owner;
}

/// The part of this rank: owner[i] brings node i.
Part part_of(const std::vector<int>& owner) {
  Part part;
  for (std::size_t i = 0; i < owner.size(); ++i)
    if (owner[i] == rank_of()) part.numbers.push_back(static_cast<std::int64_t>(i) + 1);
  return part;
}
Part part_of(const Nodes& nodes) { return part_of(stripes(nodes)); }

/// The part in another order.
Part shuffled(Part part, Random& random) {
  for (std::size_t i = part.numbers.size(); i > 1; --i)
    std::swap(part.numbers[i - 1],
              part.numbers[static_cast<std::size_t>(random.uniform() * static_cast<double>(i))]);
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

/// Exchanges the numbers of the points, and points. Collective.
void expect_exchange(DistributedMesh& mesh, const Part& part, const Result& right) {
  std::vector<std::int64_t> halo(right.halo.size());
  std::vector<double> xyz(right.xyz.size());
  EXPECT_EQ(mesh.begin_exchange(part.numbers.data(), 1), 0);
  EXPECT_EQ(mesh.begin_exchange(part.points.data(), 3), 0);
  EXPECT_EQ(mesh.end_exchange(1, halo.data(), false), 0);
  EXPECT_EQ(mesh.end_exchange(3, xyz.data(), false), 0);
  EXPECT_EQ(halo, right.halo);
  EXPECT_EQ(xyz, right.xyz);
}

/// A mesh, compared with a new one at each call.
class Beside {
 public:
  /// Makes a call. True if it began with the stars of the last call.
  bool call(const Nodes& nodes, Part& part) {
    part.place(nodes);
    DistributedMesh::Report report;
    const std::int32_t code = triangulate(mesh_, part, &report);
    DistributedMesh anew(MPI_COMM_WORLD);
    const Result right = result_of(anew, triangulate(anew, part));
    EXPECT_TRUE(result_of(mesh_, code) == right) << (report.cost.mine.flips >= 0 ? "warm" : "cold");
    EXPECT_EQ(report.points, static_cast<std::int64_t>(nodes.size()));
    if (right.code == 0) {
      std::uint64_t fingerprint = 1, of_new = 0;
      EXPECT_EQ(mesh_.check(&fingerprint), 0);
      EXPECT_EQ(anew.check(&of_new), 0);
      EXPECT_EQ(fingerprint, of_new);
      expect_exchange(mesh_, part, right);
    }
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

/// With other nodes, or many of the same from other ranks, a call begins anew.
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
  EXPECT_EQ(calls(3), (Starts{true, true, true})) << "another order on one rank";
  nodes.push_back({0, 0, -1});
  if (rank_of() == 0) part.numbers.push_back(static_cast<std::int64_t>(nodes.size()));
  EXPECT_EQ(calls(3), (Starts{false, false, true})) << "one node more";
  nodes.pop_back();
  if (rank_of() == 0) part.numbers.pop_back();
  rotate(nodes, {0, 0, 1}, 1);
  part = part_of(nodes);
  EXPECT_EQ(calls(3), (Starts{false, false, true})) << "from other ranks";
}

/// Before each call some nodes go to other ranks, and those of the last step come back, or the stripes turn;
/// every rank brings its nodes in another order.
TEST(Moving, CallsBeginWithTheLastStarsWhereFewNodesChangeRanks) {
  Random random(6), order(static_cast<std::uint64_t>(7 + rank_of()));
  Nodes nodes = point_sets::make("fibonacci", kN, 1);
  const std::vector<int> home = stripes(nodes);
  Beside mesh;
  const auto call = [&](const std::vector<int>& owner) {
    move_all(nodes, 0.02 * spacing(kN), random);
    Part part = shuffled(part_of(owner), order);
    return mesh.call(nodes, part);
  };
  EXPECT_FALSE(call(home));
  EXPECT_FALSE(call(home));
  for (const std::size_t change : {0, 1, 20, 120})
    for (int step = 0; step < 3; ++step) {
      std::vector<int> owner = home;
      for (std::size_t k = 0; k < change; ++k)
        owner[static_cast<std::size_t>(random.uniform() * kN)] =
            static_cast<int>(random.uniform() * size_of()) % size_of();
      EXPECT_TRUE(call(owner)) << change;
    }
  for (int step = 0; step < 10; ++step)
    EXPECT_TRUE(call(stripes(nodes, step * 0.1 / size_of()))) << "a tenth";
  if (size_of() == 1) return;
  for (const double begin : {0.4, 0.0, 0.0})
    EXPECT_FALSE(call(stripes(nodes, begin / size_of()))) << "many, or the first ones after these";
  for (const double begin : {0.01, 0.02}) EXPECT_TRUE(call(stripes(nodes, begin / size_of())));
}

/// A rank that has no nodes, one, few, none again.
TEST(Moving, CallsBeginWithTheLastStarsWhereARankHasNodesForAWhile) {
  Random random(8);
  Nodes nodes = point_sets::make("fibonacci", kN, 1);
  Beside mesh;
  int step = 0;
  for (const std::size_t count : {0, 0, 0, 1, 40, 0, 200, 3, 0}) {
    std::vector<int> owner = stripes(nodes);
    for (std::size_t i = 0; i < kN; ++i) {
      if (owner[i] == size_of() - 1) owner[i] = 0;
      if (i >= 700 && i < 700 + count) owner[i] = size_of() - 1;
    }
    Part part = part_of(owner);
    EXPECT_EQ(mesh.call(nodes, part), step++ >= 2) << count;
    move_all(nodes, 0.01 * spacing(kN), random);
  }
}

/// Numbers that are wrong, other nodes, or nodes that coincide, in a call in which nodes change ranks.
TEST(Moving, CallsWhereNodesChangeRanksHaveTheSameCodes) {
  const Nodes nodes = point_sets::make("random", kN, 1);
  const std::vector<int> home = stripes(nodes);
  std::vector<int> away = home;
  for (std::size_t i = 0; i < 50; ++i) away[i] = (home[i] + 1) % size_of();
  const auto is_last = [] { return rank_of() == size_of() - 1; };
  const std::vector<std::pair<std::int32_t, std::function<void(Nodes&, Part&)>>> calls{
      {0, [](Nodes&, Part&) {}},
      {PSTRIPACK_BAD_NUMBER,
       [&](Nodes&, Part& part) {
         if (is_last()) part.numbers[3] = part.numbers[4];
       }},
      {PSTRIPACK_BAD_NUMBER,
       [&](Nodes&, Part& part) {
         if (is_last()) part.numbers.back() = 0;
       }},
      {PSTRIPACK_COINCIDENT, [](Nodes& p, Part&) { p[9] = p[8]; }},
      {PSTRIPACK_BAD_COORDINATE, [](Nodes& p, Part&) { p[9] = {}; }},
      {0,
       [&](Nodes& p, Part& part) {  // one number more, one less: as many
         p.push_back({0, 0, 1});
         if (is_last()) part.numbers.back() = kN + 1;
       }},
      {0,
       [&](Nodes&, Part& part) {
         if (is_last()) part.numbers.pop_back();
       }},
      {PSTRIPACK_TOO_FEW_NODES, [](Nodes&, Part& part) { part.numbers.clear(); }}};
  for (const auto& [code, change] : calls) {
    DistributedMesh mesh(MPI_COMM_WORLD), anew(MPI_COMM_WORLD);
    Part part = part_of(home);
    part.place(nodes);
    for (int i = 0; i < 3; ++i) EXPECT_EQ(triangulate(mesh, part), 0);
    Nodes other = nodes;
    part = part_of(away);
    change(other, part);
    const Nodes before = other;
    part.points.clear();
    for (const std::int64_t k : part.numbers)
      part.points.push_back(before[k > 0 ? static_cast<std::size_t>(k) - 1 : 0]);
    EXPECT_EQ(triangulate(mesh, part), code);
    EXPECT_EQ(triangulate(anew, part), code);
    EXPECT_TRUE(result_of(mesh, code) == result_of(anew, code));
    for (int i = 0; i < 2; ++i) EXPECT_EQ(mesh.error_point(i), anew.error_point(i));
  }
}

/// Points that drift are brought by the ranks that are their homes. Homes that become crowded are made anew.
TEST(Moving, PointsThatDriftAreSentHome) {
  Nodes nodes = point_sets::make("fibonacci", kN, 1);
  Part part = part_of(nodes);
  DistributedMesh mesh(MPI_COMM_WORLD);
  std::vector<std::int32_t> home(kN);
  int warm = 0;
  for (int step = 0; step < 60; ++step) {
    part.place(nodes);
    DistributedMesh::Report report;
    DistributedMesh anew(MPI_COMM_WORLD);
    ASSERT_EQ(triangulate(mesh, part, &report), 0);
    const Result right = result_of(anew, triangulate(anew, part));
    ASSERT_TRUE(result_of(mesh, 0) == right) << step;
    warm += report.cost.mine.flips >= 0;
    auto most = static_cast<std::int64_t>(part.numbers.size());
    MPI_Allreduce(MPI_IN_PLACE, &most, 1, MPI_INT64_T, MPI_MAX, MPI_COMM_WORLD);
    const std::int64_t share = static_cast<std::int64_t>(kN) / size_of();
    if (step > 1) {
      EXPECT_LT(most, share + share / 8 + 64 + 50) << step;
    }
    for (Point& p : nodes) {
      p.x += 0.02;
      p = point_sets::normalized(p);
    }
    ASSERT_TRUE(mesh.home(static_cast<std::int64_t>(kN), &nodes.data()->x, home.data()));
    part = part_of(std::vector<int>(home.begin(), home.end()));
  }
  EXPECT_GT(warm, 30);
}

/// Far moves are noticed in a sample of stars. A mesh that does not fit although its sample did is tried less
/// and less often.
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
    other[7] = scaled(-1, nodes[7]);
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

bool is_on_any(int value) {
  MPI_Allreduce(MPI_IN_PLACE, &value, 1, MPI_INT, MPI_MAX, MPI_COMM_WORLD);
  return value != 0;
}

/// Stars that are damaged on the last rank: check() tells the damaged one, or a smaller neighbour.
TEST(Moving, CheckFindsDamagedStars) {
  const Nodes nodes = point_sets::make("random", 200, 1);
  Part part = part_of(nodes);
  part.place(nodes);
  using Damage = std::function<void(std::int32_t*, std::uint32_t)>;
  const Damage damages[] = {
      [](std::int32_t* ring, std::uint32_t) { std::swap(ring[0], ring[1]); },
      [](std::int32_t* ring, std::uint32_t) { ring[0] = ring[2]; },
      [](std::int32_t* ring, std::uint32_t count) { ring[count - 1] = -ring[count - 1]; },
      [](std::int32_t* ring, std::uint32_t) { ring[1] = -ring[1]; },
      [](std::int32_t* ring, std::uint32_t) { ring[1] = 0; },
      [](std::int32_t* ring, std::uint32_t) { ring[1] = 1 << 30; },
      [](std::int32_t* ring, std::uint32_t count) { std::reverse(ring, ring + count); }};
  for (const Damage& damage : damages) {
    DistributedMesh mesh(MPI_COMM_WORLD);
    ASSERT_EQ(triangulate(mesh, part), 0);
    std::int64_t damaged = 0;
    if (rank_of() == size_of() - 1)
      mesh.own().visit([&](const auto& stars) {
        const auto ring = stars.of_node[0];
        if constexpr (sizeof *ring.begin == sizeof(std::int32_t))
          damage(const_cast<std::int32_t*>(ring.begin), ring.count);
        damaged = part.numbers[0];
      });
    std::uint64_t fingerprint = 77;
    EXPECT_EQ(mesh.check(&fingerprint), PSTRIPACK_BAD_LISTS);
    EXPECT_EQ(fingerprint, 77u);
    EXPECT_GT(mesh.error_point(0), 0);
    MPI_Allreduce(MPI_IN_PLACE, &damaged, 1, MPI_INT64_T, MPI_MAX, MPI_COMM_WORLD);
    EXPECT_LE(mesh.error_point(0), damaged);
  }
}

/// Any allocation, or all from one on, fail on a rank in a call that would begin with the last stars: all
/// ranks get the same stars, or code -6, and the next call is correct.
TEST(Moving, SurviveMemoryThatRunsOut) {
  const Nodes nodes = point_sets::make("random", 1000, 1);
  Random order(static_cast<std::uint64_t>(rank_of()));
  Part part = part_of(nodes), other = shuffled(part_of(stripes(nodes, 0.05 / size_of())), order);
  part.place(nodes);
  other.place(nodes);
  struct Case {
    int calls_before;
    const Part& now;
  };
  // The first call that begins so, a later one, and one in which nodes change ranks.
  for (const auto& [calls_before, now] : {Case{2, part}, Case{3, part}, Case{3, other}})
    for (const bool for_good : {false, true}) {
      DistributedMesh anew(MPI_COMM_WORLD);
      const Result right = result_of(anew, triangulate(anew, now));
      bool failed = true;
      for (long which = 1; failed; which += 1 + which / 4) {
        DistributedMesh mesh(MPI_COMM_WORLD);
        for (int i = 0; i < calls_before; ++i) EXPECT_EQ(triangulate(mesh, part), 0);
        bool happened = false;
        std::int32_t code;
        {
          const FailingAllocation failing(rank_of() == size_of() - 1 ? which : 0, for_good);
          code = triangulate(mesh, now);
          happened = FailingAllocation::happened();
        }
        EXPECT_TRUE(code == 0 || code == -6) << code;
        if (code == 0) {
          EXPECT_TRUE(result_of(mesh, code) == right) << which;
        }
        EXPECT_TRUE(result_of(mesh, triangulate(mesh, now)) == right) << which;
        failed = is_on_any(happened);
      }
    }
}

// ---- comm mode and the pool ---------------------------------------------------------------------------

/// TRMESH by all ranks, in comm mode. Begins without a mesh.
class Caller {
 public:
  Caller() { free_cached_things(); }

  /// Whether the call began with the mesh of the last one.
  bool call(const Nodes& nodes, int ier = 0, long failing = 0, bool for_good = false) {
    const std::size_t n = nodes.size();
    const Columns<double> c(nodes);
    Lists lists = room_for(n);
    GroupCost cost;
    try {
      const FailingAllocation memory(ranks_.rank() == ranks_.size() - 1 ? failing : 0, for_good);
      const TrmeshResult result =
          collective_trmesh(ranks_, Arrays::on_every_rank,
                            {static_cast<std::int32_t>(n),
                             {c.x.data(), c.y.data(), c.z.data()},
                             {lists.list.data(), lists.lptr.data(), lists.lend.data(), &lists.lnew}},
                            &cost);
      has_failed = FailingAllocation::happened();
      EXPECT_EQ(result.ier, ier);
    } catch (const AgreedFailure& failure) {
      has_failed = true;
      EXPECT_EQ(failure.code, -6);
      EXPECT_GT(failing, 0);
      EXPECT_TRUE(
          std::all_of(lists.list.begin(), lists.list.end(), [](std::int32_t e) { return e == untouched; }));
      return false;
    }
    if (const auto right = made_anew(nodes)) {
      EXPECT_TRUE(lists == *right) << (cost.mine.flips >= 0 ? "warm" : "cold");
    }
    return cost.mine.flips >= 0;
  }
  bool has_failed = false;  ///< memory, in the last call

 private:
  MpiCommunicator ranks_{MPI_COMM_WORLD};
};

TEST(Moving, CallsOfTrmeshBeginWithTheLastMesh) {
  Random random(4);
  Caller caller;
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
  Nodes meet = nodes;
  meet[9] = meet[5];
  EXPECT_FALSE(caller.call(meet, 6)) << "two nodes coincide";
}

/// As if an allocation had failed between two calls, on the last rank.
void let_memory_run_out() {
  if (rank_of() == size_of() - 1) {
    EXPECT_TRUE(free_cached_things());
    EXPECT_FALSE(free_cached_things());
  }
}

/// If one rank gave up its stars, those of the other ranks are useless. Other meshes are not affected.
TEST(Moving, StarsAreGivenUpWhereMemoryIsOut) {
  const Nodes nodes = point_sets::make("random", kN, 1);
  Caller caller;
  for (int step = 0; step < 4; ++step) EXPECT_EQ(caller.call(nodes), step >= 2);
  if (rank_of() == size_of() - 1) free_cached_things();
  for (int step = 0; step < 4; ++step)
    EXPECT_EQ(caller.call(nodes), step >= 2) << "the last rank has given up its mesh";

  Part part = part_of(nodes);
  Beside mesh, other;
  for (int step = 0; step < 4; ++step) EXPECT_EQ(mesh.call(nodes, part), step >= 2);
  let_memory_run_out();
  EXPECT_TRUE(mesh.call(nodes, part)) << "begins with the stars that the caller has";
  let_memory_run_out();
  Part other_ranks = part_of(stripes(nodes, 0.02 / size_of()));
  EXPECT_TRUE(mesh.call(nodes, other_ranks)) << "those of the other ranks are of use";
  EXPECT_TRUE(mesh.call(nodes, part));
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
       {1, 2, 3})  // the one that caches a mesh, the first that begins with it, another
    for (const bool for_good : {false, true}) {
      bool failed = true;
      for (long which = 1; failed; which += 1 + which / 2) {
        Caller caller;
        for (int i = 0; i < calls_before; ++i) caller.call(nodes);
        caller.call(nodes, 0, which, for_good);
        failed = is_on_any(caller.has_failed);
        caller.call(nodes);
      }
    }
}

}  // namespace

int main(int argc, char** argv) {
  return run_on_every_rank(argc, argv, [] {});
}
