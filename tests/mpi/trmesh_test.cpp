// TRMESH by all ranks returns the bytes and codes of TRMESH by one.

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "mpi/collective_trmesh.h"
#include "mpi/gather_lists.h"
#include "mpi_test.h"
#include "parallel/coincidence.h"
#include "point_sets.h"
#include "pool/area_layout.h"
#include "support/columns.h"
#include "support/lists.h"

namespace {

using pstripack::AgreedFailure;
using pstripack::Arrays;
using pstripack::MpiCommunicator;
using pstripack::TrmeshCall;
using pstripack::TrmeshResult;

/// Arrays of exactly the sizes that TRMESH asks for.
struct Outcome : Lists {
  explicit Outcome(std::size_t n) : Lists(room_for(n)) {}
  TrmeshResult result{0};
};
bool operator==(const Outcome& a, const Outcome& b) {
  return static_cast<const Lists&>(a) == static_cast<const Lists&>(b) && a.result.ier == b.result.ier &&
         a.result.node == b.result.node && a.result.other == b.result.other;
}

template <class Real>
TrmeshCall call_of(const Columns<Real>& c, Outcome& o) {
  return {static_cast<std::int32_t>(c.x.size()),
          {c.x.data(), c.y.data(), c.z.data()},
          {o.list.data(), o.lptr.data(), o.lend.data(), &o.lnew}};
}

/// Of a rank that has no arrays.
template <class Real>
TrmeshCall no_call() {
  return {0, pstripack::NodeArrays(sizeof(Real), nullptr, nullptr, nullptr), {}};
}

template <class Real>
Outcome by_one(const Columns<Real>& c) {
  Outcome o(c.x.size());
  o.result = pstripack::trmesh(call_of(c, o));
  return o;
}

template <class Real>
Outcome by_all(MpiCommunicator& ranks, Arrays arrays, const Columns<Real>& c) {
  const bool has_arrays = arrays == Arrays::on_every_rank || ranks.rank() == 0;
  Outcome o(has_arrays ? c.x.size() : 0);
  try {
    o.result = collective_trmesh(ranks, arrays, has_arrays ? call_of(c, o) : no_call<Real>());
  } catch (const AgreedFailure& failure) {
    o.result = {failure.code};
  }
  return o;
}

/// TRMESH in memory that all ranks share; returns what this rank finds there.
template <class Real>
Outcome by_all_in_shared_memory(MpiCommunicator& ranks, const Columns<Real>& c) {
  const std::size_t n = c.x.size();
  const pstripack::AreaLayout layout(static_cast<std::int32_t>(std::max<std::size_t>(n, 3)), sizeof(Real));
  MPI_Win window;
  void* area = nullptr;
  MPI_Aint size = ranks.rank() == 0 ? static_cast<MPI_Aint>(layout.size()) : 0;
  int unit = 1;
  MPI_Win_allocate_shared(size, unit, MPI_INFO_NULL, ranks.handle(), &area, &window);
  MPI_Win_shared_query(window, 0, &size, &unit, &area);
  Outcome o(n);
  const std::vector<Real>* const columns[] = {&c.x, &c.y, &c.z};
  const auto each_array = [&](const auto& visit) {
    const pstripack::ListArrays lists = layout.call(area, nullptr).lists;
    visit(o.list, lists.list);
    visit(o.lptr, lists.lptr);
    visit(o.lend, lists.lend);
  };
  if (ranks.rank() == 0) {
    for (int i = 0; i < 3; ++i)
      std::copy(columns[i]->begin(), columns[i]->end(), static_cast<Real*>(layout.coordinate(area, i)));
    if (n >= 3) each_array([](const auto& own, auto* there) { std::copy(own.begin(), own.end(), there); });
  }
  std::int64_t ready = 0;
  ranks.all_min(&ready, 1);
  try {
    TrmeshCall call = layout.call(area, &o.lnew);
    call.n = static_cast<std::int32_t>(n);
    o.result = collective_trmesh(ranks, Arrays::shared, call);
  } catch (const AgreedFailure& failure) {
    o.result = {failure.code};
  }
  if (n >= 3)
    each_array([](auto& own, const auto* there) { std::copy(there, there + own.size(), own.begin()); });
  ranks.broadcast(&o.lnew, sizeof o.lnew, 0);
  MPI_Win_free(&window);
  return o;
}

template <class Real>
void expect_the_same(MpiCommunicator& ranks, const Nodes& nodes, const std::string& what) {
  const Columns<Real> c(nodes);
  Outcome expected = by_one(c);
  EXPECT_TRUE(by_all(ranks, Arrays::on_every_rank, c) == expected) << what << ", on every rank";
  EXPECT_TRUE(by_all_in_shared_memory(ranks, c) == expected) << what << ", in shared memory";
  const Outcome pool = by_all(ranks, Arrays::on_one_rank, c);
  if (ranks.rank() == 0) {
    EXPECT_TRUE(pool == expected) << what << ", on rank 0";
  } else {
    EXPECT_EQ(pool.result.ier, expected.result.ier) << what;
    EXPECT_EQ(pool.result.node, expected.result.node) << what;
  }
}

TEST(CollectiveTrmesh, IsTrmeshOnEveryPointSet) {
  MpiCommunicator ranks(MPI_COMM_WORLD, 4096);
  for (const std::string& family : point_sets::families())
    for (const std::size_t n : {12, 500}) {
      const Nodes nodes = point_sets::make(family, n);
      expect_the_same<double>(ranks, nodes, family + " " + std::to_string(n));
      if (n == 500) expect_the_same<float>(ranks, nodes, family + " in single precision");
    }
  expect_the_same<double>(ranks, point_sets::make("random", 30000), "random");
}

TEST(CollectiveTrmesh, IsTrmeshOnHardNodes) {
  MpiCommunicator ranks(MPI_COMM_WORLD);
  // With many ranks on two processors a call takes seconds: use every sixth family, and all families on fewer
  // ranks.
  const std::size_t step = ranks.size() > 8 ? 6 : 1;
  for (std::size_t k = 0; k < point_sets::hard_families().size(); k += step) {
    const std::string& family = point_sets::hard_families()[k];
    expect_the_same<double>(ranks, point_sets::make(family, 40), family);
  }
}

TEST(CollectiveTrmesh, IsTrmeshForFewNodes) {
  MpiCommunicator ranks(MPI_COMM_WORLD);
  for (std::size_t n = 0; n < 20; ++n) {
    Nodes nodes = point_sets::make("random", 20, 7);
    nodes.resize(n);
    expect_the_same<double>(ranks, nodes, std::to_string(n) + " nodes");
  }
}

TEST(CollectiveTrmesh, ReportsTheSameCoincidence) {
  MpiCommunicator ranks(MPI_COMM_WORLD);
  const Nodes distinct = point_sets::make("random", 60, 3);
  const std::vector<std::vector<std::pair<int, int>>> cases = {{{59, 2}},
                                                               {{4, 1}, {5, 4}, {59, 5}},
                                                               {{30, 20}, {25, 24}, {40, 20}},
                                                               {{10, 9}, {11, 9}, {12, 9}, {13, 8}}};
  for (const auto& copies : cases) {
    Nodes nodes = distinct;
    for (const auto& [to, from] : copies)
      nodes[static_cast<std::size_t>(to)] = nodes[static_cast<std::size_t>(from)];
    expect_the_same<double>(ranks, nodes, "copies");
  }
  Nodes all_alike(40, distinct[5]);
  for (std::size_t i = 0; i < 3; ++i) all_alike[i] = distinct[i];
  expect_the_same<double>(ranks, all_alike, "one node many times");
}

TEST(CollectiveTrmesh, ReportsTheSameBadInput) {
  MpiCommunicator ranks(MPI_COMM_WORLD);
  const Nodes good = point_sets::make("random", 50, 5);
  for (const std::size_t bad : {0, 2, 25, 49})
    for (const double value :
         {std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity()}) {
      Nodes nodes = good;
      nodes[bad].y = nodes[49].x = value;
      expect_the_same<double>(ranks, nodes, "not finite");
      nodes = good;
      nodes[bad] = {0, 0, 0};
      expect_the_same<double>(ranks, nodes, "zero");
    }
  Nodes on_a_line = good;
  on_a_line[1] = on_a_line[0];
  expect_the_same<double>(ranks, on_a_line, "first three on a great circle");
}

TEST(CollectiveTrmesh, TooManyNodesAreRefusedBeforeAnythingIsRead) {
  MpiCommunicator ranks(MPI_COMM_WORLD);
  for (const Arrays arrays : {Arrays::on_every_rank, Arrays::on_one_rank}) {
    TrmeshCall call = no_call<double>();
    call.n = 357913944;
    const TrmeshResult result = collective_trmesh(ranks, arrays, call);
    EXPECT_EQ(result.ier, -4);
  }
}

TEST(CollectiveTrmesh, RanksThatDisagreeAreToldSo) {
  if (size_of() < 2) GTEST_SKIP() << "nobody to disagree with";
  MpiCommunicator ranks(MPI_COMM_WORLD);
  const Nodes nodes = point_sets::make("random", 100, 9);
  for (int odd_one_out = 0; odd_one_out < ranks.size(); ++odd_one_out)
    for (int what = 0; what < 6; ++what) {
      Nodes mine = nodes;
      if (ranks.rank() == odd_one_out) {
        if (what == 0) mine.pop_back();
        if (what == 1) mine[99].z = std::nextafter(mine[99].z, 2.0);
        if (what == 2) std::swap(mine[3], mine[4]);
        if (what == 3) mine[0].x = std::numeric_limits<double>::quiet_NaN();
        if (what == 4) mine.resize(2);
        if (what == 5) std::swap(mine[50].x, mine[50].y);
      }
      const Outcome o = by_all(ranks, Arrays::on_every_rank, Columns<double>(mine));
      Outcome expected(mine.size());
      const int first_other = odd_one_out == 0 ? 1 : odd_one_out;
      expected.result = {-7,
                         odd_one_out > 0 && what == 0   ? 99
                         : odd_one_out > 0 && what == 4 ? 2
                                                        : 100,
                         first_other};
      EXPECT_TRUE(o == expected) << what << ": " << o.result.ier << ", N " << o.result.node << " on rank "
                                 << o.result.other;
    }
}

TEST(Pieces, TheFirstCoincidenceIsFoundFromAnyPairsThatConnectTheSets) {
  const auto first = [](const std::vector<std::pair<std::int64_t, std::int64_t>>& numbers) {
    pstripack::CoincidentPairs pairs;
    for (const auto& [a, b] : numbers)
      pairs.emplace_back(pstripack::GlobalNumber{a}, pstripack::GlobalNumber{b});
    const auto [l, m] = pstripack::first_coincidence(pairs);
    return std::make_pair(l, m);
  };
  using Pair = std::pair<std::int64_t, std::int64_t>;
  EXPECT_EQ(first({{7, 3}}), Pair(3, 7));
  EXPECT_EQ(first({{9, 8}, {8, 7}, {7, 1}, {4, 5}}), Pair(4, 5));
  EXPECT_EQ(first({{9, 2}, {9, 3}}), Pair(2, 3));
  EXPECT_EQ(first({{10, 1}, {9, 2}, {8, 3}, {3, 10}}), Pair(1, 3));
}

}  // namespace

int main(int argc, char** argv) {
  return run_on_every_rank(argc, argv, [] {});
}
