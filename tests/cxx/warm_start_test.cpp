// Calls of TRMESH that may begin with the mesh of an earlier call give the bytes of calls that cannot.

#include "trmesh/warm_start.h"

#include <gtest/gtest.h>
#include <unistd.h>
#ifdef _OPENMP
#include <omp.h>
#endif

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <string>
#include <thread>

#include "base/cached.h"
#include "base/parallel_for.h"
#include "base/workspace.h"
#include "geometry/predicates.h"
#include "lists/adjacency_lists.h"
#include "mesh/delaunay.h"
#include "point_sets.h"
#include "support/child.h"
#include "support/columns.h"
#include "support/lists.h"
#include "support/moves.h"
#include "support/room_in_cache.h"
#include "trmesh/trmesh.h"

namespace {

using namespace pstripack;
using point_sets::make;
using point_sets::Random;

struct Result : Lists {
  std::int32_t ier = 0;
  bool is_warm = false;
  std::int64_t flips = 0;
};

/// Calls TRMESH with arrays that are freed before the next call.
template <class Real = double>
Result call(const Nodes& nodes) {
  const Columns<Real> c(nodes);
  Result r{room_for(nodes.size())};
  CallWay way;
  const TrmeshResult result = trmesh({static_cast<std::int32_t>(nodes.size()),
                                      {c.x.data(), c.y.data(), c.z.data()},
                                      {r.list.data(), r.lptr.data(), r.lend.data(), &r.lnew}},
                                     &way);
  const ParallelCost& cost = way.cost.maximum;
  r.ier = result.ier;
  r.is_warm = cost.flips >= 0;
  if (r.is_warm) {
    EXPECT_EQ(cost.threads, threads_for(nodes.size()));
  }
  r.flips = std::max<std::int64_t>(cost.flips, 0);
  return r;
}

Result cold_call(const Nodes& nodes) {
  free_cached_things();
  Result r = call(nodes);
  EXPECT_FALSE(r.is_warm);
  return r;
}

bool same(const Result& a, const Result& b) { return a == b && a.ier == b.ier; }

struct Tally {
  int warm = 0, cold = 0;
  std::int64_t flips = 0;
};

/// Expects the same bytes of warm and of cold calls for these sets, one after another.
Tally compare(const std::vector<Nodes>& sets) {
  free_cached_things();
  std::vector<Result> results;
  Tally tally;
  for (const Nodes& nodes : sets) {
    results.push_back(call(nodes));
    ++(results.back().is_warm ? tally.warm : tally.cold);
    tally.flips += results.back().flips;
  }
  for (std::size_t i = 0; i < sets.size(); ++i)
    EXPECT_TRUE(same(results[i], cold_call(sets[i])))
        << "call " << i + 1 << (results[i].is_warm ? ", warm" : ", cold");
  free_cached_things();
  return tally;
}

/// With the first three nodes not on one great circle.
Nodes nodes_of(const std::string& family, std::size_t n) {
  Nodes nodes = make(family, n, 1);
  for (std::uint64_t seed = 1; left(nodes[0], nodes[1], nodes[2]) == 0; ++seed)
    point_sets::shuffle(nodes, seed);
  return nodes;
}

constexpr std::size_t kN = 2000, kThreads = 6;

TEST(WarmStart, IsInvisibleUnderLloydSteps) {
  for (const std::string& family : point_sets::families()) {
    SCOPED_TRACE(family);
    std::vector<Nodes> sets{nodes_of(family, kN)};
    while (sets.size() < 12) {
      const Result r = cold_call(sets.back());
      if (r.ier != 0) break;
      sets.push_back(sets.back());
      lloyd_step(sets.back(), r.list, r.lend);
    }
    const Tally tally = compare(sets);
    if (family == "random") {
      EXPECT_GE(tally.warm, 8);
    }
  }
}

TEST(WarmStart, IsInvisibleUnderMovesOfAnySize) {
  Random random(2);
  for (const std::string family : {"random", "latlon", "icosahedral", "fibonacci", "variable:1e3"})
    for (const double fraction : {1e-16, 1e-12, 1e-6, 1e-3, 0.01, 0.03, 0.1, 0.3, 1.0}) {
      SCOPED_TRACE(family + ", " + std::to_string(fraction));
      const Nodes nodes = nodes_of(family, kN);
      const double distance = fraction * spacing(nodes.size());
      const Tally tally = compare(sets_of(nodes, 6, [&](Nodes& p, int) { move_all(p, distance, random); }));
      if ((fraction <= 1e-3 && family == "random") || (fraction <= 0.01 && family == "fibonacci")) {
        EXPECT_EQ(tally.warm, 4);
      }
      if (fraction == 1) {
        EXPECT_EQ(tally.warm, 0);
      }
    }
}

TEST(WarmStart, CopiesTheListsOfNodesThatStayWhereTheyAre) {
  const Tally tally = compare(std::vector<Nodes>(5, nodes_of("latlon", kN)));
  EXPECT_EQ(tally.warm, 3);
  EXPECT_EQ(tally.flips, 0);
}

TEST(WarmStart, IsInvisibleWhereOneNodeJumps) {
  Random random(3);
  const Tally tally = compare(sets_of(nodes_of("random", kN), 40, [&](Nodes& p, int step) {
    move_all(p, 1e-4 * spacing(kN), random);
    if (step % 8 == 5) p[random.below(kN)] = random.direction();
  }));
  EXPECT_GT(tally.warm, 0);
  EXPECT_GE(tally.cold, 2 + 5);
}

TEST(WarmStart, ReturnsTheCodesOfColdCalls) {
  const Nodes good = nodes_of("random", kN);
  // After two calls a mesh is kept, but it has taken no nodes in yet.
  const auto after_warm_calls = [&](const Nodes& nodes) {
    std::int32_t ier = 0;
    for (const int calls : {2, 4}) {
      free_cached_things();
      for (int i = 0; i < calls; ++i) EXPECT_EQ(call(good).is_warm, i >= 2);
      const Result r = call(nodes);
      EXPECT_TRUE(same(r, cold_call(nodes)));
      ier = r.ier;
    }
    return ier;
  };
  Nodes bad = good;
  bad[1234].y = std::nan("");
  EXPECT_EQ(after_warm_calls(bad), -5);
  bad = good;
  bad[777] = {0, 0, 0};
  EXPECT_EQ(after_warm_calls(bad), -5);
  bad = good;
  bad[2] = scaled(-1, bad[1]);
  EXPECT_EQ(after_warm_calls(bad), -2);
  for (const double length : {1.0, 2.0}) {
    bad = good;
    bad[1700] = scaled(length, good[40]);
    EXPECT_EQ(after_warm_calls(bad), 41);
  }
}

/// A mesh could follow these nodes, but the first three move onto one great circle.
TEST(WarmStart, ReturnsMinusTwoOfNodesThatHardlyMove) {
  Nodes nodes = nodes_of("random", kN);
  const auto swap_to = [&](std::size_t to, std::size_t from) { std::swap(nodes[to], nodes[from]); };
  const Point p = nodes[0];
  swap_to(1, static_cast<std::size_t>(
                 std::min_element(nodes.begin() + 1, nodes.end(),
                                  [&](const Point& a, const Point& b) { return dot(a, p) > dot(b, p); }) -
                 nodes.begin()));
  const Point q = nodes[1];
  const Point normal = point_sets::normalized(cross(p, q));
  swap_to(2, static_cast<std::size_t>(std::min_element(nodes.begin() + 2, nodes.end(),
                                                       [&](const Point& a, const Point& b) {
                                                         return std::fabs(dot(a, normal)) <
                                                                std::fabs(dot(b, normal));
                                                       }) -
                                      nodes.begin()));
  // Onto the equator: all of it turned, so that zeros are exact.
  const Point third = point_sets::normalized(cross(normal, p));
  for (Point& r : nodes) r = point_sets::normalized({dot(r, p), dot(r, third), dot(r, normal)});
  nodes[0].z = nodes[1].z = 1e-9;
  free_cached_things();
  for (int i = 0; i < 4; ++i) EXPECT_EQ(call(nodes).is_warm, i >= 2);
  nodes[0].z = nodes[1].z = nodes[2].z = 0;
  const Result r = call(nodes);
  EXPECT_EQ(r.ier, -2);
  EXPECT_EQ(r.lnew, untouched);
}

TEST(WarmStart, IsInvisibleWhereLengthsHideNodes) {
  Random random(5);
  Nodes first = nodes_of("random", kN);
  for (std::size_t k = 0; k < 50; ++k) {
    const Point &p = first[k], d = random.direction();
    first[kN - 1 - k] = point_sets::normalized(plus(p, scaled(1e-5, d)));
  }
  const Tally tally = compare(sets_of(first, 12, [&](Nodes& p, int step) {
    if (step == 6) {
      for (std::size_t k = 0; k < 50; ++k) {
        Point& q = p[k];
        q = scaled(1 - 9e-7, q);
      }
    } else {
      move_all(p, 1e-9, random);
      if (step > 6)
        for (std::size_t k = 0; k < 50; ++k) p[k] = scaled(1 - 9e-7, p[k]);
    }
  }));
  EXPECT_GE(tally.warm, 4);
}

/// Remeshing: the same number of nodes, some renumbered: two nodes, neighbours or not, a run of nodes, or
/// all.
TEST(WarmStart, IsInvisibleWhereNodesAreRenumbered) {
  Random random(17);
  const auto tally = compare(sets_of(nodes_of("random", kN), 60, [&](Nodes& p, int step) {
    const std::size_t a = 3 + random.below(kN - 103);
    const auto at = p.begin() + static_cast<std::ptrdiff_t>(a);
    if (step % 10 < 9) return move_all(p, 1e-3 * spacing(kN), random);
    const int kind = step / 10 % 5;
    if (kind == 0) std::swap(*at, p[3 + random.below(kN - 3)]);
    if (kind == 1)  // its nearest
      std::swap(*at, *std::min_element(at + 1, p.end(), [at](const Point& c, const Point& d) {
        return dot(c, *at) > dot(d, *at);
      }));
    if (kind == 2) std::reverse(at, at + 100);
    if (kind == 3) std::iter_swap(at, at + 1);
    if (kind == 4) point_sets::shuffle(p, 5);
  }));
  EXPECT_GT(tally.warm, 10);
  EXPECT_GT(tally.cold, 10);
}

/// The whole mesh rotates, or is reflected, so that no triangle is counterclockwise any more.
TEST(WarmStart, IsInvisibleWhereTheWholeMeshTurns) {
  Nodes nodes = nodes_of("random", kN), mirrored = nodes;
  std::vector<Nodes> sets(4, nodes);
  for (const double angle : {1e-6, 0.1, 1.5, 3.0}) {
    for (Point& p : nodes)
      p = {std::cos(angle) * p.x - std::sin(angle) * p.y, std::sin(angle) * p.x + std::cos(angle) * p.y, p.z};
    sets.push_back(nodes);
  }
  for (Point& p : mirrored) std::swap(p.x, p.y);
  for (const Nodes& after : {mirrored, mirrored, nodes, mirrored, mirrored, mirrored}) sets.push_back(after);
  EXPECT_GT(compare(sets).warm, 2);
}

/// After a single call with a bad node, calls are correct and soon begin with the last mesh again.
TEST(WarmStart, GoesOnAfterACallThatFailed) {
  Random random(18);
  Nodes nodes = nodes_of("random", kN);
  std::vector<Nodes> sets;
  for (int step = 0; step < 24; ++step) {
    move_all(nodes, 1e-3 * spacing(kN), random);
    sets.push_back(nodes);
    Point& p = sets.back()[static_cast<std::size_t>(100 * step) % kN];
    if (step % 8 == 4) p.x = std::nan("");
    if (step % 8 == 5) p = {HUGE_VAL, 0, 0};
    if (step % 8 == 6) p = {0, 0, 0};
  }
  EXPECT_GT(compare(sets).warm, 6);
}

TEST(WarmStart, IsInvisibleWhereNGoesUpAndDownByMuch) {
  std::vector<Nodes> sets;
  for (int round = 0; round < 4; ++round)
    for (const std::size_t n : {std::size_t{40000}, kN, std::size_t{1000}, std::size_t{999}, std::size_t{7}})
      sets.push_back(nodes_of("random", n));
  EXPECT_EQ(compare(sets).warm, 2 * 3);
}

TEST(WarmStart, KeepsSeveralMeshes) {
  Random random(8);
  std::vector<Nodes> sets, current{nodes_of("random", kN), nodes_of("fibonacci", kN),
                                   nodes_of("random", 1500), nodes_of("fibonacci", 1500)};
  for (int step = 0; step < 8; ++step) {
    for (Nodes& nodes : current) {
      move_all(nodes, 1e-4 * spacing(kN), random);
      sets.push_back(nodes);
    }
    std::rotate(current.begin(), current.begin() + 1, current.end());
  }
  EXPECT_EQ(compare(sets).warm, 4 * 6);
}

TEST(WarmStart, IsInvisibleForOtherNodesOfTheSameNumber) {
  std::vector<Nodes> sets;
  for (std::uint64_t seed = 1; seed <= 8; ++seed) sets.push_back(make("random", kN, seed));
  EXPECT_EQ(compare(sets).warm, 0);
}

TEST(WarmStart, IsInvisibleInSinglePrecision) {
  Random random(9);
  const auto sets =
      sets_of(nodes_of("random", kN), 8, [&](Nodes& p, int) { move_all(p, 1e-2 * spacing(kN), random); });
  free_cached_things();
  std::vector<Result> results;
  int warm = 0;
  for (const Nodes& nodes : sets) results.push_back(call<float>(nodes)), warm += results.back().is_warm;
  EXPECT_EQ(warm, 6);
  for (std::size_t i = 0; i < sets.size(); ++i) {
    free_cached_things();
    EXPECT_TRUE(same(results[i], call<float>(sets[i]))) << i;
  }
}

/// Two threads each with the same sets; `run(call)` calls call(0) to call(kThreads - 1) on threads.
template <class Run>
void expect_same_on_threads(const Run& run) {
  std::vector<std::vector<Nodes>> sets(kThreads);
  std::vector<std::vector<Result>> results(kThreads);
  for (std::size_t t = 0; t < kThreads; ++t) {
    Random random(t);
    sets[t] = sets_of(make("random", kN + t % 2, t / 2), 30, [&](Nodes& p, int step) {
      move_all(p, (step % 7 == 6 ? 0.5 : 1e-3) * spacing(kN), random);
    });
  }
  free_cached_things();
  run([&](std::size_t t) {
    for (const Nodes& nodes : sets[t]) results[t].push_back(call(nodes));
  });
  for (std::size_t t = 0; t < kThreads; ++t)
    for (std::size_t i = 0; i < sets[t].size(); ++i)
      EXPECT_TRUE(same(results[t][i], cold_call(sets[t][i]))) << t << " " << i;
}

TEST(WarmStart, IsInvisibleToThreadsThatCallAtOnce) {
  expect_same_on_threads([](const auto& calls) {
    std::vector<std::thread> threads;
    for (std::size_t t = 0; t < kThreads; ++t) threads.emplace_back([&calls, t] { calls(t); });
    for (auto& thread : threads) thread.join();
  });
}

#ifdef _OPENMP
TEST(WarmStart, IsInvisibleInsideAParallelRegion) {
  expect_same_on_threads([](const auto& calls) {
#pragma omp parallel for num_threads(4) schedule(static, 1)
    for (std::size_t t = 0; t < kThreads; ++t) calls(t);
  });
}
#endif

TEST(WarmStart, BeginsAnewInAForkedChild) {
  const Nodes nodes = nodes_of("random", kN);
  free_cached_things();
  Result last;
  for (int i = 0; i < 3; ++i) last = call(nodes);
  EXPECT_TRUE(last.is_warm);
  EXPECT_EQ(in_child([&] {
              for (int i = 0; i < 4; ++i) {
                const Result r = call(nodes);
                if (!same(r, last) || r.is_warm != (i >= 2)) return 1 + i;
              }
              return 0;
            }),
            0);
  EXPECT_TRUE(call(nodes).is_warm);
  free_cached_things();
}

TEST(WarmStart, GivesItsMemoryUpWhereItIsAskedFor) {
  const Nodes nodes = nodes_of("random", kN);
  for (int i = 0; i < 4; ++i) call(nodes);
  EXPECT_TRUE(free_cached_blocks());
  EXPECT_FALSE(free_cached_things());
  EXPECT_FALSE(call(nodes).is_warm);
  free_cached_things();
}

/// A call with nodes that do not fit leaves the mesh to those that do.
TEST(WarmStart, RecognisesItsNodesAfterOthers) {
  const auto is_recognised = [](const Nodes& nodes) {
    const Columns<> c(nodes);
    return WarmStart({c.x.data(), c.y.data(), c.z.data()}, nodes.size()).is_prepared();
  };
  const auto is_kept = [](const Nodes& nodes) {
    free_cached_things();
    for (int i = 0; i < 2; ++i) EXPECT_FALSE(call(nodes).is_warm);
  };
  const Nodes nodes = nodes_of("random", kN);
  is_kept(nodes);
  EXPECT_TRUE(is_recognised(nodes));
  Nodes others = nodes;
  for (Point& p : others) p = scaled(2, p);
  EXPECT_FALSE(is_recognised(others));
  // Every 64th star is looked at: one jump turns its triangles over, too few to count as arcs.
  int seen = 0;
  for (std::size_t k = 0; k < 64; ++k) {
    others = nodes;
    others[k] = scaled(-1, nodes[k]);
    seen += !is_recognised(others);
  }
  EXPECT_GE(seen, 1);
  EXPECT_LT(seen, 32);
  EXPECT_TRUE(call(nodes).is_warm);

  // Half the diagonals of the quadrangles are not locally Delaunay any more; no triangle is turned over.
  const Nodes lattice = nodes_of("latlon", 1100);
  is_kept(lattice);
  Random random(11);
  others = lattice;
  for (std::size_t k = 0; k < others.size(); k += 3) {
    const Point &p = lattice[k], d = random.direction();
    others[k] = point_sets::normalized(plus(p, scaled(1e-6, d)));
  }
  EXPECT_FALSE(is_recognised(others));
  EXPECT_TRUE(call(lattice).is_warm);
  free_cached_things();
}

/// One node far from the stars that are looked at first: its length decides which predicates are right.
TEST(WarmStart, IsInvisibleWhereOneLengthIsNotOne) {
  const Nodes nodes = nodes_of("random", 1000);
  for (std::size_t k = 0; k < 1000; k += 50)
    for (const int calls : {2, 3}) {
      Nodes others = nodes;
      Point& p = others[k];
      p = scaled(1.0005, p);
      free_cached_things();
      for (int i = 0; i < calls; ++i) call(nodes);
      const Result r = call(others);
      EXPECT_FALSE(r.is_warm);
      EXPECT_TRUE(same(r, cold_call(others))) << k;
    }
}

/// Stars with more neighbours than a sample has room for are left out of it.
TEST(WarmStart, IsInvisibleAroundHubs) {
  Random random(12);
  Nodes nodes = nodes_of("random", 1000);
  std::size_t around = 0;
  const auto put_around = [&](const Point& hub) {  // hubs have multiples of 3 as numbers
    const Point u = point_sets::normalized(cross(hub, {0.36, 0.48, 0.8})), v = cross(hub, u);
    for (int i = 0; i < 60; ++i) {
      const double c = 1e-3 * std::cos(0.1047 * i), s = 1e-3 * std::sin(0.1047 * i);
      while (around % 3 == 0) ++around;
      nodes[around++] = point_sets::normalized(plus(plus(hub, scaled(c, u)), scaled(s, v)));
    }
  };
  for (const std::size_t k : {33, 99, 165, 231, 297, 363, 429}) put_around(nodes[k]);
  const Tally tally = compare(sets_of(nodes, 5, [&](Nodes& p, int) { move_all(p, 1e-9, random); }));
  EXPECT_EQ(tally.warm, 3);
}

/// The first test of a kept mesh uses the lists of another call, even if its memory still holds nodes of an
/// earlier mesh.
TEST(WarmStart, TestsAMeshThatIsNew) {
  Random random(13);
  const Nodes nodes = nodes_of("fibonacci", kN);
  Nodes others = nodes;
  move_all(others, 0.02 * spacing(kN), random);
  free_cached_things();
  for (int i = 0; i < 3; ++i) call(nodes);
  free_cached_things();
  for (int i = 0; i < 2; ++i) call(others);
  const Result r = call(nodes);
  EXPECT_TRUE(r.is_warm);
  EXPECT_GT(r.flips, 0);
  EXPECT_EQ(call(nodes).flips, 0);  // of this call, in which none has moved
  EXPECT_TRUE(same(r, cold_call(nodes)));
}

/// Rings that grow need room, which is made where the lists are kept anew.
TEST(WarmStart, GoesOnWithEveryCall) {
  Random random(14);
  const Tally tally = compare(sets_of(make("fibonacci", 1000, 1), 150,
                                      [&](Nodes& p, int) { move_all(p, 0.05 * spacing(1000), random); }));
  EXPECT_EQ(tally.cold, 2);
}

/// Nodes may drift while no mesh is kept: a call is compared with the one before, warm or cold.
TEST(WarmStart, LooksAtTheLastCallOnly) {
  Nodes nodes = make("fibonacci", kN, 1);
  const Nodes drift = make("random", kN, 2);
  free_cached_things();
  int i = 0;
  for (; i <= 8; ++i) {  // meshes that do not fit: the next is kept after eight calls
    nodes[0] = scaled(-1, nodes[0]);
    EXPECT_FALSE(call(nodes).is_warm);
  }
  for (; i <= 16; ++i) {
    const double by = 0.03 * spacing(kN);
    for (std::size_t k = 0; k < kN; ++k) {
      Point& p = nodes[k];
      p = point_sets::normalized(plus(p, scaled(by, drift[k])));
    }
    EXPECT_EQ(call(nodes).is_warm, i == 16) << i;
  }
  free_cached_things();
}

/// Meshes with a boundary or with few nodes are useless and not kept.
TEST(WarmStart, KeepsNothingThatNoCallCanBeginWith) {
  free_cached_things();
  call(make("cap", kN, 1));
  EXPECT_FALSE(free_cached_things());
  call(nodes_of("random", 999));
  EXPECT_FALSE(free_cached_things());
  call(nodes_of("random", 1000));
  EXPECT_TRUE(free_cached_things());
}

TEST(WarmStart, KeepsNothingWhereItIsOffAndNamesOtherValues) {
  if (std::getenv("IN_CHILD") != nullptr) {
    const bool is_off = std::getenv("PSTRIPACK_WARM_START") == std::string("0");
    for (int i = 0; i < 3; ++i) EXPECT_EQ(call(make("random", kN, 1)).is_warm, i == 2 && !is_off);
    EXPECT_NE(free_cached_things(), is_off);
    return;
  }
  for (const char* const value : {"0", "1", "", "00", "off"}) {
    testing::internal::CaptureStderr();
    EXPECT_EQ(in_child([=] {
                setenv("IN_CHILD", "1", 1);
                setenv("PSTRIPACK_WARM_START", value, 1);
                execl("/proc/self/exe", "warm_start_test", "--gtest_filter=*WhereItIsOffAndNamesOtherValues",
                      nullptr);
                return 1;
              }),
              0);
    const std::string name = value;
    EXPECT_EQ(testing::internal::GetCapturedStderr(),
              name.size() < 2 ? "" : "pstripack: PSTRIPACK_WARM_START=" + name + ": not 0 or 1; 1 is used\n");
  }
}

/// The meshes of four first callers do not prevent those of four others from being kept.
TEST(WarmStart, ForgetsTheMeshesOfOthersInTurn) {
  const auto set = [](std::uint64_t seed) { return make("random", 1000, seed); };
  free_cached_things();
  const std::size_t before = room_in_cache();
  for (std::uint64_t seed = 1; seed <= 4; ++seed)
    for (int i = 0; i < 2; ++i) call(set(seed));
  for (int round = 0; round < 3; ++round)
    for (std::uint64_t seed = 5; seed <= 8; ++seed) EXPECT_EQ(call(set(seed)).is_warm, round == 2);
  EXPECT_TRUE(free_cached_things());
  EXPECT_FALSE(free_cached_things());
  EXPECT_EQ(room_in_cache(), before);
}

/// After a mesh that did not fit, the next one is kept one call later than usual, until a mesh fits.
TEST(WarmStart, WaitsOneCallMoreAfterAMeshThatDidNotFit) {
  const Nodes here = nodes_of("random", kN);
  Nodes there = here;
  there[0] = scaled(-1, here[0]);
  free_cached_things();
  for (int i = 0; i < 3; ++i) EXPECT_EQ(call(here).is_warm, i == 2);
  for (int round = 0; round < 3; ++round)
    for (const Nodes& nodes : {there, here})
      for (int i = 0; i < 3; ++i) EXPECT_EQ(call(nodes).is_warm, i == 2) << round << " " << i;
  free_cached_things();
}

/// A mesh that never fits, though the sample does, is tried again after 2, 4, ... 64, 64 calls; one of other
/// nodes of the same number waits as long.
TEST(WarmStart, IsTriedAgainAfterAtMost64Calls) {
  const Nodes nodes = nodes_of("random", 1000);
  const Result lists = cold_call(nodes);
  Nodes others = nodes;
  others[0] = scaled(2, nodes[0]);
  const Columns<> c(others);
  free_cached_things();
  std::vector<int> tries;
  for (int i = 0, last = 0; i < 300; ++i) {
    Result r = lists;
    const ListArrays arrays{r.list.data(), r.lptr.data(), r.lend.data(), &r.lnew};
    WarmStart start({c.x.data(), c.y.data(), c.z.data()}, 1000);
    if (start.is_prepared()) tries.push_back(i - last), last = i;
    EXPECT_FALSE(start.write_lists(arrays, nullptr));
    start.remember(arrays);
  }
  EXPECT_EQ(tries, (std::vector<int>{2, 2, 4, 8, 16, 32, 64, 64, 64}));
  // Other nodes, as many: their mesh is kept after 64 calls in which the sample fitted.
  const Nodes next = make("random", 1000, 9);
  for (int i = 0; i < 66; ++i) EXPECT_EQ(call(next).is_warm, i == 65) << i;
  free_cached_things();
}

/// All meshes together have a bound: what is kept counts, and where there is no room nothing is.
TEST(WarmStart, CountsWhatItKeeps) {
  const Nodes nodes = nodes_of("random", kN);
  free_cached_things();
  const std::size_t before = room_in_cache();
  for (int i = 0; i < 2; ++i) call(nodes);
  EXPECT_LT(room_in_cache(), before - 50 * kN);
  free_cached_things();
  EXPECT_EQ(room_in_cache(), before);
  {
    const CacheReservation all(before);
    for (int i = 0; i < 4; ++i) EXPECT_FALSE(call(nodes).is_warm);
  }
  free_cached_things();
}

#ifdef _OPENMP
TEST(WarmStart, IsInvisibleOnThreads) {
  Random random(10);
  constexpr std::size_t kMany = 50000;
  const auto sets = sets_of(make("fibonacci", kMany, 1), 8, [&](Nodes& p, int step) {
    move_all(p, (step < 5 ? 1e-3 : 0.02) * spacing(kMany), random);
  });
  std::vector<Result> first;
  for (const int threads : {1, 2, 3}) {
    omp_set_num_threads(threads);
    free_cached_things();
    int warm = 0;
    for (std::size_t i = 0; i < sets.size(); ++i) {
      Result r = call(sets[i]);
      warm += r.is_warm;
      if (threads == 1) first.push_back(cold_call(sets[i])), free_cached_things();
      EXPECT_TRUE(same(r, first[i])) << threads << " threads, call " << i + 1;
    }
    EXPECT_EQ(warm, threads == 1 ? 0 : 6);
  }
  omp_set_num_threads(1);
  EXPECT_GT(compare(sets).flips, 100);
}
#endif

}  // namespace
