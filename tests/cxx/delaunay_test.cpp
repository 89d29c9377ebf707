// Triangulations through the C API: every family of point sets, judged by the tests' own exact judge, by the
// library's validator, and against CGAL.

#include <gtest/gtest.h>

#ifdef _OPENMP
#include <omp.h>
#endif

#include <algorithm>
#include <iterator>

#include "distributions.h"
#include "point_sets.h"
#include "support/expect.h"
#include "support/guarded.h"
#include "support/names.h"
#ifdef HAVE_CGAL
#include "support/cgal_hull.h"
#endif

namespace {

using point_sets::make;

struct Case {
  std::string family;
  std::size_t n;
};

void PrintTo(const Case& c, std::ostream* out) { *out << c.family << " " << c.n; }

std::string name_of(const ::testing::TestParamInfo<Case>& info) {
  return case_name(info.param.family + "_" + std::to_string(info.param.n));
}

std::vector<Case> cases(const std::vector<std::size_t>& sizes) {
  std::vector<std::string> names = point_sets::families();
  for (const char* more :
       {"cap:1e-6", "cap:1e-8", "dense-cap:1e-7", "antipodal:1e-4", "variable:1e6", "strip:1e-15"})
    names.push_back(more);
  std::vector<Case> all;
  for (const std::string& family : names)
    for (const std::size_t n : sizes) all.push_back({family, n});
  return all;
}

/// Cases of every distribution that the benchmark measures. Nests over more than 100 decades have few nodes,
/// since nearly every test of them takes big integers.
std::vector<Case> hard_cases(const std::vector<std::size_t>& sizes) {
  std::vector<Case> all;
  for (const point_sets::Distribution& d : point_sets::distributions())
    for (const std::size_t n : sizes)
      if (n <= 300 || d.limit <= 4) all.push_back({d.name, n});
  return all;
}

/// The nodes, reordered so that the first three are not on one great circle, which TRMESH requires.
Nodes with_a_triangle_first(Nodes nodes) {
  for (std::uint64_t seed = 1; exact::left(nodes[0], nodes[1], nodes[2]) == 0; ++seed)
    point_sets::shuffle(nodes, seed);
  return nodes;
}

const std::vector<std::size_t> small = {3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 20, 50}, medium = {100, 1000},
                               large = {10000, 40000, 100000};

// ---- Correct, for every family ----

class Delaunay : public ::testing::TestWithParam<Case> {};

TEST_P(Delaunay, IsCorrect) {
  const Nodes nodes = make(GetParam().family, GetParam().n);
  EXPECT_TRUE(is_as_promised(nodes));
}

INSTANTIATE_TEST_SUITE_P(Small, Delaunay, ::testing::ValuesIn(cases(small)), name_of);
INSTANTIATE_TEST_SUITE_P(Medium, Delaunay, ::testing::ValuesIn(cases(medium)), name_of);
INSTANTIATE_TEST_SUITE_P(Large, Delaunay, ::testing::ValuesIn(cases(large)), name_of);

class HardNodes : public ::testing::TestWithParam<Case> {};

TEST_P(HardNodes, AreTriangulatedCorrectly) {
  const Nodes nodes = with_a_triangle_first(make(GetParam().family, GetParam().n));
  EXPECT_TRUE(is_correct(nodes, trmesh(nodes)));
}

INSTANTIATE_TEST_SUITE_P(Of, HardNodes, ::testing::ValuesIn(hard_cases({12, 300, 2000})), name_of);

/// Few enough nodes to find the result by trying all triples.
class FewNodes : public ::testing::TestWithParam<std::size_t> {};

void compare_with_all_triples(const std::vector<Case>& cases, std::uint64_t seeds) {
  for (const Case& c : cases)
    for (std::uint64_t seed = 1; seed <= seeds; ++seed) {
      Nodes nodes = make(c.family, c.n, seed);
      if (seed % 2 == 0) point_sets::shuffle(nodes, seed);
      if (nodes.size() > 12 || expected_ier(nodes) != 0) continue;
      const Mesh m = trmesh(nodes);
      const auto rings = rings_of(m);
      ASSERT_TRUE(rings) << c.family;
      Faces expected = brute_force(nodes, lengths_call_for(nodes));
      if (!rings_of(nodes.size(), expected)) expected = brute_force(nodes, exact::On::directions);
      ASSERT_EQ(faces_of(*rings), expected) << c.family << " seed " << seed;
    }
}

TEST_P(FewNodes, AreTriangulatedAsByTryingAllTriples) {
  compare_with_all_triples(cases({GetParam()}), 20);
  compare_with_all_triples(hard_cases({GetParam()}), 2);
}

INSTANTIATE_TEST_SUITE_P(N, FewNodes, ::testing::Range(std::size_t{3}, std::size_t{12}));

// ---- Against CGAL ----

#ifdef HAVE_CGAL

/// Empty if the triangles are the same up to exact ties: every arc that only one side has crosses triangles
/// whose corners lie in one plane with it.
std::string difference(const Nodes& nodes, const Faces& ours, const Faces& theirs) {
  if (ours.size() != theirs.size())
    return std::to_string(ours.size()) + " triangles, CGAL has " + std::to_string(theirs.size());
  Faces only;
  std::set_difference(ours.begin(), ours.end(), theirs.begin(), theirs.end(), std::back_inserter(only));
  const auto rings = rings_of(nodes.size(), ours);
  if (!rings) return "not a surface";
  for (const auto& f : only) {
    // A triangle that is not in one plane with a neighbouring one is a face of the hull: CGAL must have it.
    bool tie = false;
    for (int k = 0; k < 3; ++k) {
      const auto& ring = rings->neighbours[f[k]];
      const std::int32_t next = f[(k + 1) % 3];
      const std::size_t i =
          static_cast<std::size_t>(std::find(ring.begin(), ring.end(), next) - ring.begin());
      if (rings->boundary[f[k]] && i == 0) continue;  // no triangle beyond
      const std::int32_t beyond = ring[(i + ring.size() - 1) % ring.size()];
      tie = tie || exact::orientation(exact::On::coordinates, nodes[f[0]], nodes[f[1]], nodes[f[2]],
                                      nodes[beyond]) == 0;
    }
    if (!tie)
      return "triangle " + std::to_string(f[0] + 1) + " " + std::to_string(f[1] + 1) + " " +
             std::to_string(f[2] + 1) + " is no tie, and CGAL does not have it";
  }
  return "";
}

class AgainstCgal : public ::testing::TestWithParam<Case> {};

TEST_P(AgainstCgal, TrianglesAreTheSameUpToExactTies) {
  const Nodes nodes = make(GetParam().family, GetParam().n);
  const Mesh m = trmesh(nodes);
  if (m.ier == -2 && expected_ier(nodes) == -2) return;  // Delaunay.IsCorrect has it
  ASSERT_EQ(m.ier, 0);
  const auto rings = rings_of(m);
  ASSERT_TRUE(rings);
  const Hull hull = cgal_hull(nodes);
  if (hull.hidden > 0) {  // CGAL has no answer on directions
    EXPECT_EQ(fault(nodes, *rings, exact::On::directions), "");
  } else {
    EXPECT_EQ(difference(nodes, faces_of(*rings), hull.faces), "");
  }
}

/// All cases except those with thousands of nodes in one plane, for which CGAL's time is quadratic.
std::vector<Case> cases_for_cgal(const std::vector<std::size_t>& sizes) {
  std::vector<Case> all = cases(sizes);
  all.erase(std::remove_if(all.begin(), all.end(),
                           [](const Case& c) {
                             return (c.family == "ring" || c.family == "hemisphere-rim") && c.n > 1000;
                           }),
            all.end());
  return all;
}

INSTANTIATE_TEST_SUITE_P(Small, AgainstCgal, ::testing::ValuesIn(cases_for_cgal({5, 12, 50})), name_of);
INSTANTIATE_TEST_SUITE_P(Medium, AgainstCgal, ::testing::ValuesIn(cases_for_cgal(medium)), name_of);
INSTANTIATE_TEST_SUITE_P(Large, AgainstCgal, ::testing::ValuesIn(cases_for_cgal({10000, 100000})), name_of);

#endif

// ---- Any numbering, any number of threads ----

/// The triangles with the nodes numbered as in `order`: node k there is node order[k].
Faces renamed(const Faces& faces, const std::vector<std::int32_t>& order) {
  Faces result = faces;
  for (auto& f : result)
    for (auto& k : f) k = order[k];
  sort_faces(result);
  return result;
}

class Numbering : public ::testing::TestWithParam<Case> {};

TEST_P(Numbering, DoesNotChangeTheTriangles) {
  const Nodes nodes = with_a_triangle_first(make(GetParam().family, GetParam().n));
  const std::size_t n = nodes.size();
  const Mesh m = trmesh(nodes);
  ASSERT_EQ(m.ier, 0);
  const auto rings = rings_of(m);
  ASSERT_TRUE(rings);
  const Faces faces = faces_of(*rings);

  std::vector<std::vector<std::int32_t>> orders;
  std::vector<std::int32_t> order(n);
  for (std::size_t k = 0; k < n; ++k) order[k] = static_cast<std::int32_t>(k);
  orders.emplace_back(order.rbegin(), order.rend());
  for (const double pstripack::Point::*axis :
       {&pstripack::Point::x, &pstripack::Point::y, &pstripack::Point::z}) {
    std::sort(order.begin(), order.end(),
              [&](std::int32_t a, std::int32_t b) { return nodes[a].*axis < nodes[b].*axis; });
    orders.push_back(order);
  }
  point_sets::Random random(7);
  for (int i = 0; i < 3; ++i) {
    for (std::size_t k = n; k > 1; --k) std::swap(order[k - 1], order[random.below(k)]);
    orders.push_back(order);
  }
  int compared = 0;
  for (const auto& o : orders) {
    Nodes numbered;
    for (const std::int32_t k : o) numbered.push_back(nodes[k]);
    const Mesh other = trmesh(numbered);
    if (exact::left(numbered[0], numbered[1], numbered[2]) == 0) {
      EXPECT_EQ(other.ier, -2);
      continue;
    }
    ASSERT_EQ(other.ier, 0);
    const auto other_rings = rings_of(other);
    ASSERT_TRUE(other_rings);
    EXPECT_EQ(renamed(faces_of(*other_rings), o), faces);
    ++compared;
  }
  EXPECT_GT(compared, 0);
}

INSTANTIATE_TEST_SUITE_P(Of, Numbering, ::testing::ValuesIn(cases({12, 100, 5000})), name_of);
INSTANTIATE_TEST_SUITE_P(Hard, Numbering, ::testing::ValuesIn(hard_cases({100})), name_of);

class ThreadCount : public ::testing::TestWithParam<Case> {};

TEST_P(ThreadCount, DoesNotChangeABit) {
#ifdef _OPENMP
  const Nodes nodes = make(GetParam().family, GetParam().n, 2);
  const int before = omp_get_max_threads();
  const auto mesh_on = [&](int threads) {
    omp_set_num_threads(threads);
    return trmesh(nodes);
  };
  const Mesh one = mesh_on(1);
  for (const int threads : {2, 3, 7}) {
    const Mesh other = mesh_on(threads);
    EXPECT_EQ(other.ier, one.ier);
    EXPECT_TRUE(other == one) << threads << " threads";
  }
  omp_set_num_threads(before);
#else
  GTEST_SKIP() << "built without OpenMP";
#endif
}

INSTANTIATE_TEST_SUITE_P(Of, ThreadCount, ::testing::ValuesIn(cases({3, 100, 70000, 100000})), name_of);
INSTANTIATE_TEST_SUITE_P(Hard, ThreadCount, ::testing::ValuesIn(hard_cases({100, 5000})), name_of);

TEST(Fingerprints, TellSetsOfTrianglesApart) {
  const Nodes nodes = make("random", 1000), others = make("random", 1000, 2);
  const auto print = [](const Mesh& m) {
    return pstripack_fingerprint(static_cast<std::int32_t>(m.nodes()), m.list.data(), m.lptr.data(),
                                 m.lend.data());
  };
  const Mesh m = trmesh(nodes);
  EXPECT_NE(print(m), print(trmesh(others)));
  Mesh rotated = m;  // interior lists started elsewhere: the same triangles
  for (auto& last : rotated.lend) last = rotated.lptr[last - 1];
  EXPECT_EQ(print(m), print(rotated));
}

// ---- What is read and what is written ----

void check_memory(const Nodes& nodes, Edge edge) {
  const Mesh m = guarded_trmesh(nodes, edge);
  ASSERT_EQ(m.ier, 0);
  for (std::size_t i = static_cast<std::size_t>(m.lnew) - 1; i < m.list.size(); ++i)
    ASSERT_TRUE(m.list[i] == untouched && m.lptr[i] == untouched) << "slot " << i + 1;
  const Columns c(nodes);
  Guarded<double> x(c.x, edge), y(c.y, edge), z(c.z, edge);
  Guarded<std::int32_t> list(m.list, edge), lptr(m.lptr, edge), lend(m.lend, edge);
  char message[1] = "";
  for (auto* array : {&x, &y, &z}) array->make_read_only();
  for (auto* array : {&list, &lptr, &lend}) array->make_read_only();
  EXPECT_EQ(pstripack_validate(static_cast<std::int32_t>(nodes.size()), x.data(), y.data(), z.data(),
                               list.data(), lptr.data(), lend.data(), m.lnew, message, 1),
            0);
}

TEST(Memory, NothingOutsideTheArraysIsTouched) {
  for (const Edge edge : {Edge::begin, Edge::end})
    for (const std::size_t n : {3, 4, 5, 6, 7, 13, 100, 1001, 30000})
      for (const char* family : {"random", "hemisphere", "ring", "cap:1e-8"}) {
        const Nodes nodes = make(family, n);
        if (expected_ier(nodes) == 0) check_memory(nodes, edge);
      }
}

TEST(Memory, TheMessageOfTheValidatorStaysInItsBuffer) {
  const Nodes nodes = make("random", 20);
  const Columns c(nodes);
  Mesh m = trmesh(nodes);
  ASSERT_EQ(m.ier, 0);
  m.list[5] = m.list[4];
  for (std::int32_t length = 0; length < 120; ++length) {
    std::vector<char> buffer(200, 'x');
    EXPECT_NE(pstripack_validate(20, c.x.data(), c.y.data(), c.z.data(), m.list.data(), m.lptr.data(),
                                 m.lend.data(), m.lnew, buffer.data(), length),
              0);
    for (std::size_t i = static_cast<std::size_t>(length); i < buffer.size(); ++i) ASSERT_EQ(buffer[i], 'x');
    if (length > 0) {
      EXPECT_NE(std::find(buffer.begin(), buffer.begin() + length, '\0'), buffer.begin() + length);
    }
  }
  EXPECT_NE(pstripack_validate(20, c.x.data(), c.y.data(), c.z.data(), m.list.data(), m.lptr.data(),
                               m.lend.data(), m.lnew, nullptr, 0),
            0);
}

}  // namespace
