// Distributed meshes: for every distribution of the points, the stars are those of the serial lists.

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <set>
#include <string>
#include <thread>
#include <tuple>
#include <utility>
#include <vector>

#include "capi/pstripack_mpi.h"
#include "distributions.h"
#include "point_sets.h"
#include "support/child.h"
#include "support/environment.h"
#include "support/expect.h"
#include "support/trmesh.h"

namespace {

std::int64_t huge(std::size_t i) { return from_one(i) * (std::int64_t{1} << 40) + 5; }

std::int64_t sum(std::int64_t value) {
  MPI_Allreduce(MPI_IN_PLACE, &value, 1, MPI_INT64_T, MPI_SUM, MPI_COMM_WORLD);
  return value;
}

/// Compares all that a mesh returns for this rank's part with the serial lists.
void check_part(const pstripack_mesh* mesh, const Nodes& nodes, const std::vector<std::size_t>& mine,
                const Number& number, const Rings& rings) {
  const Sizes sizes(mesh);
  ASSERT_EQ(sizes.points, static_cast<std::int64_t>(mine.size()));
  std::map<std::int64_t, std::size_t> node_of;
  for (std::size_t i = 0; i < nodes.size(); ++i) node_of[number(i)] = i;

  std::vector<std::int64_t> begin(mine.size() + 1), neighbour(static_cast<std::size_t>(sizes.arcs));
  pstripack_mesh_stars(mesh, begin.data(), neighbour.data());
  ASSERT_EQ(begin.back(), sizes.arcs);
  std::set<std::int64_t> outside;
  const std::set<std::size_t> own(mine.begin(), mine.end());
  for (std::size_t i = 0; i < mine.size(); ++i) {
    std::vector<std::int64_t> expected;
    for (const std::int32_t k : rings.neighbours[mine[i]]) {
      expected.push_back(number(static_cast<std::size_t>(k)));
      if (own.count(static_cast<std::size_t>(k)) == 0) outside.insert(expected.back());
    }
    if (rings.boundary[mine[i]]) expected.back() = -expected.back();
    ASSERT_EQ(std::vector<std::int64_t>(neighbour.begin() + begin[i], neighbour.begin() + begin[i + 1]),
              expected)
        << "node " << mine[i];
  }

  std::vector<std::int64_t> halo(static_cast<std::size_t>(sizes.halo));
  std::vector<double> xyz(3 * halo.size());
  pstripack_mesh_halo(mesh, halo.data(), xyz.data());
  ASSERT_EQ(halo, std::vector<std::int64_t>(outside.begin(), outside.end()));
  for (std::size_t i = 0; i < halo.size(); ++i) {
    const auto& p = nodes[node_of.at(halo[i])];
    ASSERT_TRUE(xyz[3 * i] == p.x && xyz[3 * i + 1] == p.y && xyz[3 * i + 2] == p.z);
  }

  // The owner of each halo point tells its number.
  std::vector<std::int32_t> owner(halo.size()), place(halo.size());
  pstripack_mesh_halo_owners(mesh, owner.data(), place.data());
  int most = static_cast<int>(mine.size());
  MPI_Allreduce(MPI_IN_PLACE, &most, 1, MPI_INT, MPI_MAX, MPI_COMM_WORLD);
  std::vector<std::int64_t> numbers(static_cast<std::size_t>(most)),
      of_all(numbers.size() * static_cast<std::size_t>(size_of()));
  for (std::size_t i = 0; i < mine.size(); ++i) numbers[i] = number(mine[i]);
  MPI_Allgather(numbers.data(), most, MPI_INT64_T, of_all.data(), most, MPI_INT64_T, MPI_COMM_WORLD);
  for (std::size_t i = 0; i < halo.size(); ++i) {
    ASSERT_NE(owner[i], rank_of());
    ASSERT_EQ(of_all[static_cast<std::size_t>(owner[i] * most + place[i] - 1)], halo[i]);
  }

  std::vector<std::int64_t> local_begin(begin.size());
  std::vector<std::int32_t> local(neighbour.size());
  ASSERT_EQ(pstripack_mesh_local_stars(mesh, local_begin.data(), local.data()), 0);
  ASSERT_EQ(local_begin, begin);
  for (std::size_t k = 0; k < local.size(); ++k) {
    const auto at = static_cast<std::size_t>(std::abs(local[k])) - 1;
    const std::int64_t global = at < mine.size() ? number(mine[at]) : halo[at - mine.size()];
    ASSERT_EQ(local[k] < 0 ? -global : global, neighbour[k]);
  }

  Faces faces;
  std::vector<std::int64_t> corner(3 * static_cast<std::size_t>(sizes.triangles));
  pstripack_mesh_triangles(mesh, corner.data());
  for (std::size_t t = 0; t < corner.size(); t += 3) {
    std::array<std::int32_t, 3> face;
    for (std::size_t i = 0; i < 3; ++i) face[i] = static_cast<std::int32_t>(node_of.at(corner[t + i]));
    ASSERT_EQ(own.count(static_cast<std::size_t>(face[0])), 1u);
    ASSERT_TRUE(face[0] < face[1] && face[0] < face[2]);
    faces.push_back(face);
  }
  std::sort(faces.begin(), faces.end());
  const Faces all = faces_of(rings);
  ASSERT_TRUE(std::includes(all.begin(), all.end(), faces.begin(), faces.end()));
}

/// `width` values for each of these points, which follow from their numbers.
template <class Value>
std::vector<Value> values_of(const std::vector<std::int64_t>& numbers, std::int64_t width) {
  std::vector<Value> values;
  for (const std::int64_t number : numbers)
    for (std::int64_t k = 0; k < width; ++k) values.push_back(static_cast<Value>(number * (k + 1) - 5 * k));
  return values;
}

/// Values arrive, by one call and in two parts, several under way. Collective.
void check_exchange(pstripack_mesh* mesh, const std::vector<std::size_t>& mine, const Number& number) {
  std::vector<std::int64_t> numbers, halo(static_cast<std::size_t>(Sizes(mesh).halo));
  for (const std::size_t i : mine) numbers.push_back(number(i));
  std::vector<double> xyz(3 * halo.size());
  pstripack_mesh_halo(mesh, halo.data(), xyz.data());
  const auto begin = [&](auto kind, std::int64_t width) {
    const auto values = values_of<decltype(kind)>(numbers, width);
    EXPECT_EQ(pstripack_mesh_exchange_begin(mesh, values.data(), width), 0);
  };
  const auto end = [&](auto kind, std::int64_t width) {
    const auto expected = values_of<decltype(kind)>(halo, width);
    std::vector<decltype(kind)> found(expected.size());
    EXPECT_EQ(pstripack_mesh_exchange_end(mesh, width, found.data()), 0);
    EXPECT_EQ(found, expected);
  };
  begin(double{}, 1);
  begin(std::int64_t{}, 100);
  const auto values = values_of<double>(numbers, 3), expected = values_of<double>(halo, 3);
  std::vector<double> found(expected.size());
  EXPECT_EQ(pstripack_mesh_exchange(mesh, values.data(), 3, found.data()), 0);
  EXPECT_EQ(found, expected);
  end(double{}, 1);
  begin(double{}, 2);
  end(std::int64_t{}, 100);
  end(double{}, 2);
}

/// Collective, even if checks fail on this rank.
void check(pstripack_mesh* mesh, const Nodes& nodes, const std::vector<std::size_t>& mine,
           const Number& number, const Rings& rings) {
  check_part(mesh, nodes, mine, number, rings);
  check_exchange(mesh, mine, number);
  EXPECT_EQ(pstripack_mesh_check(mesh, nullptr), 0);
  EXPECT_EQ(sum(Sizes(mesh).triangles), static_cast<std::int64_t>(faces_of(rings).size()));
}

Rings serial_rings(const Nodes& nodes) {
  const Mesh serial = trmesh(nodes);
  EXPECT_EQ(serial.ier, 0);
  return rings_of(serial).value();
}

TEST(DistributedMesh, StarsAreThoseOfTheSerialLists) {
  OfMesh mesh;
  for (const char* family : {"random", "latlon", "clusters", "hemisphere", "healpix", "box"})
    for (const std::size_t n : {8, 300}) {
      const Nodes nodes = point_sets::make(family, n);
      const Rings rings = serial_rings(nodes);
      for (const auto& d : distributions()) {
        SCOPED_TRACE(std::string(family) + ", " + std::to_string(n) + ", " + d.name);
        const auto mine = nodes_here(d, nodes.size());
        ASSERT_EQ(Part(nodes, mine).triangulate(mesh), 0);
        check(mesh, nodes, mine, from_one, rings);
      }
    }
}

TEST(DistributedMesh, NumbersMayHaveSixtyFourBits) {
  OfMesh mesh;
  const Nodes nodes = point_sets::make("random", 200, 4);
  const Rings rings = serial_rings(nodes);
  for (const auto& d : distributions()) {
    SCOPED_TRACE(d.name);
    const auto mine = nodes_here(d, nodes.size());
    ASSERT_EQ(Part(nodes, mine, huge).triangulate(mesh), 0);
    check(mesh, nodes, mine, huge, rings);
    EXPECT_EQ(pstripack_mesh_gather(mesh, -1, nullptr, nullptr, nullptr, nullptr), PSTRIPACK_BAD_NUMBER);
  }
}

TEST(DistributedMesh, GathersTheCanonicalLists) {
  OfMesh mesh;
  for (const char* family : {"random", "hemisphere"}) {
    const Nodes nodes = point_sets::make(family, 300, 6);
    const Mesh serial = trmesh(nodes);
    for (const auto& d : distributions())
      for (const int root : {-1, 0, size_of() - 1}) {
        ASSERT_EQ(Part(nodes, nodes_here(d, nodes.size())).triangulate(mesh), 0);
        std::uint64_t fingerprint = 0;
        EXPECT_EQ(pstripack_mesh_check(mesh, &fingerprint), 0);
        EXPECT_EQ(fingerprint,
                  pstripack_fingerprint(300, serial.list.data(), serial.lptr.data(), serial.lend.data()));
        Mesh m = serial;
        for (auto* array : {&m.list, &m.lptr, &m.lend}) std::fill(array->begin(), array->end(), untouched);
        const bool here = root == -1 || root == rank_of();
        ASSERT_EQ(
            pstripack_mesh_gather(mesh, root, here ? m.list.data() : nullptr, here ? m.lptr.data() : nullptr,
                                  here ? m.lend.data() : nullptr, here ? &m.lnew : nullptr),
            0);
        if (here) {
          EXPECT_TRUE(m == serial) << family << ", " << d.name;
        }
      }
  }
}

TEST(DistributedMesh, IsTheSameInAnyFloatingPointEnvironmentAndLeavesItAsItWas) {
  for (const char* family : {"pairs", "hemisphere-rim"}) {
    const Nodes nodes = point_sets::make(family, 300);
    const Mesh serial = trmesh(nodes);
    const auto mine = nodes_here(distributions()[1], nodes.size());
    pstripack_mesh* mesh = nullptr;
    Mesh gathered{room_for(nodes.size())};
    std::vector<std::int32_t> home(1), usual_home(1);
    bool is_as_before;
    {
      const StrangeEnvironment environment;
      const Environment before;
      gathered.ier = pstripack_mesh_create(MPI_COMM_WORLD, &mesh) + Part(nodes, mine).triangulate(mesh) +
                     pstripack_mesh_gather(mesh, -1, gathered.list.data(), gathered.lptr.data(),
                                           gathered.lend.data(), &gathered.lnew) +
                     pstripack_mesh_home(mesh, 1, &nodes[0].x, home.data());
      is_as_before = Environment() == before;
    }
    EXPECT_EQ(gathered.ier, 0);
    EXPECT_TRUE(is_as_before);
    EXPECT_TRUE(gathered == serial);
    check_part(mesh, nodes, mine, from_one, serial_rings(nodes));
    EXPECT_EQ(pstripack_mesh_home(mesh, 1, &nodes[0].x, usual_home.data()), 0);
    EXPECT_EQ(home, usual_home);
    pstripack_mesh_free(mesh);
  }
}

TEST(DistributedMesh, NothingOutsideTheArraysIsTouched) {
  const Nodes nodes = point_sets::make("hemisphere", 300);
  const auto mine = nodes_here(distributions()[1], nodes.size());
  const Part part(nodes, mine);
  const std::int64_t n = part.count();
  for (const Edge edge : {Edge::begin, Edge::end}) {
    const OfMesh mesh;
    Guarded<double> xyz(part.xyz, edge);
    Guarded<std::int64_t> number(part.number, edge);
    xyz.make_read_only(), number.make_read_only();
    ASSERT_EQ(pstripack_mesh_triangulate(mesh, n, xyz.data(), number.data()), 0);
    Guarded<std::int32_t> rank(mine.size(), edge);
    EXPECT_EQ(pstripack_mesh_home(mesh, n, xyz.data(), rank.data()), 0);

    const Sizes sizes(mesh);
    const auto arcs = static_cast<std::size_t>(sizes.arcs), halo = static_cast<std::size_t>(sizes.halo);
    Guarded<std::int64_t> begin(mine.size() + 1, edge), neighbour(arcs, edge), halo_number(halo, edge),
        corner(3 * static_cast<std::size_t>(sizes.triangles), edge);
    Guarded<std::int32_t> local(arcs, edge);
    Guarded<double> halo_xyz(3 * halo, edge);
    pstripack_mesh_stars(mesh, begin.data(), neighbour.data());
    EXPECT_EQ(pstripack_mesh_local_stars(mesh, begin.data(), local.data()), 0);
    pstripack_mesh_halo(mesh, halo_number.data(), halo_xyz.data());
    Guarded<std::int32_t> owner(halo, edge), place(halo, edge);
    pstripack_mesh_halo_owners(mesh, owner.data(), place.data());
    pstripack_mesh_triangles(mesh, corner.data());
    Guarded<std::int64_t> received(3 * halo, edge);
    xyz.make_read_only();
    EXPECT_EQ(pstripack_mesh_exchange(mesh, xyz.data(), 3, halo_xyz.data()), 0);
    EXPECT_EQ(pstripack_mesh_exchange(mesh, xyz.data(), 3, received.data()), 0);

    Guarded<std::int32_t> list(6 * nodes.size() - 12, edge), lptr(list.size(), edge),
        lend(nodes.size(), edge), lnew(1, edge);
    EXPECT_EQ(pstripack_mesh_gather(mesh, -1, list.data(), lptr.data(), lend.data(), lnew.data()), 0);
  }
}

/// A mesh of random nodes in slices.
struct OfSlices : OfMesh {
  explicit OfSlices(std::size_t n) : nodes(point_sets::make("random", n)) { EXPECT_EQ(triangulate(), 0); }
  std::int32_t triangulate() const { return Part(nodes, mine).triangulate(*this); }
  const Nodes nodes;
  const std::vector<std::size_t> mine = nodes_here(distributions()[0], nodes.size());
};

using Failed = std::tuple<int, std::int64_t, std::int64_t>;  ///< the code, and the points that it is about

/// Expects the same failure for every distribution, and an empty mesh after it.
void expect_failure(const Nodes& nodes, const Number& number, const Failed& expected) {
  OfMesh mesh;
  for (const auto& d : distributions()) {
    SCOPED_TRACE(d.name);
    const auto good = point_sets::make("random", 20);
    ASSERT_EQ(Part(good, nodes_here(d, good.size())).triangulate(mesh), 0);
    const int code = Part(nodes, nodes_here(d, nodes.size()), number).triangulate(mesh);
    std::int64_t first = 0, second = 0;
    pstripack_mesh_error_points(mesh, &first, &second);
    EXPECT_EQ(Failed(code, first, second), expected);
    const Sizes sizes(mesh);
    EXPECT_EQ(sizes.points + sizes.arcs + sizes.triangles + sizes.halo, 0);
    EXPECT_EQ(pstripack_mesh_gather(mesh, 0, nullptr, nullptr, nullptr, nullptr), -3);
    EXPECT_EQ(pstripack_mesh_exchange(mesh, nullptr, 1, nullptr), -3);
    EXPECT_EQ(pstripack_mesh_check(mesh, nullptr), -3);
  }
}

TEST(DistributedMesh, FailsAlikeOnEveryRank) {
  const Nodes good = point_sets::make("random", 90, 8);
  expect_failure({}, from_one, {PSTRIPACK_TOO_FEW_NODES, 0, 0});
  expect_failure({good[0], good[1]}, from_one, {PSTRIPACK_TOO_FEW_NODES, 0, 0});

  Nodes line;
  for (int i = 0; i < 40; ++i) line.push_back(point_sets::from_degrees(9 * i, 0));
  expect_failure(line, from_one, {PSTRIPACK_COLLINEAR, 0, 0});
  expect_failure(Nodes(30, good[4]), from_one, {PSTRIPACK_COLLINEAR, 0, 0});
  Nodes poles(30, {0, 0, 1});
  for (std::size_t i = 0; i < 30; i += 3) poles[i] = {0, 0, -1};
  expect_failure(poles, from_one, {PSTRIPACK_COLLINEAR, 0, 0});

  Nodes bad = good;
  bad[80].x = std::numeric_limits<double>::quiet_NaN();
  bad[70] = {0, 0, 0};
  expect_failure(bad, from_one, {PSTRIPACK_BAD_COORDINATE, 71, 0});
  expect_failure(bad, huge, {PSTRIPACK_BAD_COORDINATE, huge(70), 0});

  Nodes twice = good;
  twice[33] = twice[11];
  twice[44] = twice[33];
  twice[22] = twice[21];
  expect_failure(twice, from_one, {PSTRIPACK_COINCIDENT, 22, 23});
  expect_failure(twice, huge, {PSTRIPACK_COINCIDENT, huge(21), huge(22)});

  const auto with = [](std::size_t at, std::int64_t value, const Number& number) {
    return [=](std::size_t i) { return i == at ? value : number(i); };
  };
  expect_failure(good, with(5, 0, from_one), {PSTRIPACK_BAD_NUMBER, 0, 0});
  expect_failure(good, with(5, -7, huge), {PSTRIPACK_BAD_NUMBER, -7, 0});
  expect_failure(good, with(5, 9, from_one), {PSTRIPACK_BAD_NUMBER, 9, 0});
  expect_failure(good, with(0, 90, from_one), {PSTRIPACK_BAD_NUMBER, 90, 0});
  expect_failure(good, with(60, huge(2), huge), {PSTRIPACK_BAD_NUMBER, huge(2), 0});
}

TEST(DistributedMesh, WritesALineOfEachNewCode) {
  OfMesh mesh;
  const auto expect_line = [&](const Nodes& nodes, const auto& number, const std::string& line) {
    expect_lines_of_rank_0(
        line, [&] { Part(nodes, nodes_here(distributions()[0], nodes.size()), number).triangulate(mesh); });
  };
  Nodes nodes = point_sets::make("random", 30);
  expect_line(nodes, from_one, "");
  expect_line(Nodes(nodes.begin(), nodes.begin() + 2), from_one, "");  // -1 is STRIPACK's
  const auto from_zero = [](std::size_t i) { return static_cast<std::int64_t>(i); };
  expect_line(
      nodes, from_zero,
      "mesh_triangulate: point 0: a node number is below 1, occurs twice, or is too large for what was "
      "asked (IER = -10)");
  nodes[7] = nodes[3];
  expect_line(nodes, from_one,
              "mesh_triangulate: points 4 and 8: two points lie in the same direction (IER = -9)");
  nodes[20].y = HUGE_VAL;
  expect_line(nodes, from_one,
              "mesh_triangulate: point 21: a coordinate is not finite, or all are zero (IER = -5)");
}

TEST(DistributedMesh, RefusesCountsThatCannotBeAndNamesTheRank) {
  const OfMesh mesh;
  const int odd = size_of() - 1;
  const std::string of_rank = "rank " + std::to_string(odd) + ": n = ";
  for (const auto& [n, code, line] : {std::tuple<std::int64_t, std::int32_t, std::string>{
                                          -7, PSTRIPACK_BAD_SIZE, "-7 is below 0 (IER = -100)"},
                                      {std::int64_t{1} << 29, PSTRIPACK_TOO_MANY_NODES,
                                       "536870912: a rank may have at most 536870911 points (IER = -4)"}})
    expect_lines_of_rank_0("mesh_triangulate: " + of_rank + line, [&, n = n, code = code] {
      EXPECT_EQ(pstripack_mesh_triangulate(mesh, rank_of() == odd ? n : 0, nullptr, nullptr), code);
    });
  const OfSlices made(30);
  testing::internal::CaptureStderr();
  EXPECT_EQ(pstripack_mesh_home(made, -1, nullptr, nullptr), PSTRIPACK_BAD_SIZE);
  EXPECT_NE(testing::internal::GetCapturedStderr().find("mesh_home: rank " + std::to_string(rank_of()) +
                                                        ": n = -1"),
            std::string::npos);
}

TEST(DistributedMesh, GatherRefusesRootsThatDifferOrDoNotExist) {
  const OfSlices mesh(30);
  Mesh m = trmesh(mesh.nodes);
  const int odd = size_of() - 1;
  const auto gather = [&](int root) {
    return pstripack_mesh_gather(mesh, root, m.list.data(), m.lptr.data(), m.lend.data(), &m.lnew);
  };
  for (const auto& [there, here] : {std::pair{0, -1}, {-1, 0}, {0, odd}, {odd, 0}, {0, size_of() + 2}}) {
    if (size_of() == 1) break;
    expect_lines_of_rank_0("mesh_gather: root is " + std::to_string(there) + " on rank 0 and " +
                               std::to_string(here) + " on rank " + std::to_string(odd) + " (IER = -7)",
                           [&, there = there, here = here] {
                             EXPECT_EQ(gather(rank_of() == odd ? here : there), PSTRIPACK_RANKS_DISAGREE);
                           });
  }
  for (const int root : {-2, size_of()})
    expect_lines_of_rank_0("mesh_gather: there is no rank " + std::to_string(root) + " (IER = -8)",
                           [&] { EXPECT_EQ(gather(root), PSTRIPACK_BAD_COMM); });
  EXPECT_TRUE(m == trmesh(mesh.nodes));
  EXPECT_EQ(gather(-1), 0);
}

/// True if each collective call of the mesh returns -8, with a line, and changes nothing.
bool declines(pstripack_mesh* mesh) {
  testing::internal::CaptureStderr();
  char message[100] = "";
  const bool all =
      pstripack_mesh_triangulate(mesh, 0, nullptr, nullptr) == PSTRIPACK_BAD_COMM &&
      pstripack_mesh_gather(mesh, -1, nullptr, nullptr, nullptr, nullptr) == PSTRIPACK_BAD_COMM &&
      pstripack_mesh_exchange(mesh, nullptr, 1, nullptr) == PSTRIPACK_BAD_COMM &&
      pstripack_mesh_exchange_end(mesh, 1, nullptr) == PSTRIPACK_BAD_COMM &&
      pstripack_mesh_check(mesh, nullptr) == PSTRIPACK_BAD_COMM &&
      pstripack_mesh_scvt(mesh, 0, nullptr, nullptr, nullptr, nullptr, nullptr, message, sizeof message) ==
          PSTRIPACK_BAD_COMM;
  const std::string why = "MPI is not running, or must not be called by this thread or process";
  std::string lines;
  for (const char* call : {"mesh_triangulate", "mesh_gather", "mesh_exchange", "mesh_exchange", "mesh_check"})
    lines += std::string("pstripack: ") + call + ": " + why + " (IER = -8)\n";
  return testing::internal::GetCapturedStderr() == lines && message == why && all;
}

TEST(DistributedMesh, DeclinesCallsOfThreadsAndForkedChildrenThatMustNotCallMpi) {
  const OfSlices mesh(30);
  EXPECT_EQ(in_child([&] {
              if (!declines(mesh)) return 1;
              pstripack_mesh_free(mesh);
              return 0;
            }),
            0);
  int provided;
  MPI_Query_thread(&provided);
  if (provided < MPI_THREAD_SERIALIZED)
    std::thread([&] {
      EXPECT_TRUE(declines(mesh));
      pstripack_mesh_free(mesh);
      pstripack_mesh* other;
      EXPECT_EQ(pstripack_mesh_create(MPI_COMM_WORLD, &other), PSTRIPACK_BAD_COMM);
      EXPECT_EQ(pstripack_set_comm(MPI_COMM_WORLD), PSTRIPACK_BAD_COMM);
    }).join();
  ASSERT_EQ(pstripack_mesh_gather(mesh, -2, nullptr, nullptr, nullptr, nullptr), PSTRIPACK_BAD_COMM);
  EXPECT_EQ(mesh.triangulate(), 0);
}

/// Expects a call of the mesh to return a code, and one line of rank 0.
void expect_line(const std::function<int()>& call, int code, const std::string& line) {
  expect_lines_of_rank_0(line + " (IER = " + std::to_string(code) + ")", [&] { EXPECT_EQ(call(), code); });
}

TEST(DistributedMesh, ExchangeRefusesWidthsAlikeOnEveryRank) {
  const OfSlices mesh(60);
  const int odd = size_of() - 1;
  std::vector<double> values(1000), halo(1000, -1);
  const auto exchange = [&](std::int64_t there, std::int64_t here) {
    return [&, width = rank_of() == odd ? here : there] {
      return pstripack_mesh_exchange(mesh, values.data(), width, halo.data());
    };
  };
  const std::string of_odd = "mesh_exchange: rank " + std::to_string(odd) + ": width = ";
  for (const std::int64_t width :
       {std::int64_t{0}, std::int64_t{-7}, std::numeric_limits<std::int64_t>::min()})
    expect_line(exchange(2, width), PSTRIPACK_BAD_SIZE, of_odd + std::to_string(width) + " is below 1");
  if (size_of() > 1) {
    expect_line(exchange(2, 3), PSTRIPACK_RANKS_DISAGREE,
                "mesh_exchange: width is 2 on rank 0 and 3 on rank " + std::to_string(odd));
    const std::int64_t most = std::numeric_limits<std::int64_t>::max();
    for (const std::int64_t width : {most, most / 8, most / 64, std::int64_t{1} << 50})
      expect_line(exchange(width, width), PSTRIPACK_OUT_OF_MEMORY, "mesh_exchange: out of memory");
  }
  EXPECT_EQ(halo, std::vector<double>(1000, -1));
  check(mesh, mesh.nodes, mesh.mine, from_one, serial_rings(mesh.nodes));
}

TEST(DistributedMesh, ATriangulationAndTheEndOfTheMeshEndExchanges) {
  const Nodes nodes = point_sets::make("random", 300);
  const auto mine = nodes_here(distributions()[0], nodes.size());
  const std::vector<double> values(1000 * mine.size());
  double none;
  const auto expect_no_exchange = [&](pstripack_mesh* mesh, std::int64_t width, int code, const char* why) {
    testing::internal::CaptureStderr();
    EXPECT_EQ(pstripack_mesh_exchange_end(mesh, width, &none), code);
    EXPECT_EQ(testing::internal::GetCapturedStderr(), "pstripack: mesh_exchange_end: " + std::string(why) +
                                                          " (IER = " + std::to_string(code) + ")\n");
  };
  const char* const no_exchange = "the mesh is empty, or no exchange of its values is under way";
  OfMesh mesh;
  expect_no_exchange(mesh, 1, PSTRIPACK_EMPTY_MESH, no_exchange);
  for (int step = 0; step < 4; ++step) {
    for (int i = 0; i < step; ++i)
      if (step > 1) {
        EXPECT_EQ(pstripack_mesh_exchange_begin(mesh, values.data(), 1000), 0);
        expect_no_exchange(mesh, 7, PSTRIPACK_BAD_SIZE,
                           "width is not that with which the exchange has begun");
      }
    ASSERT_EQ(Part(nodes, mine).triangulate(mesh), 0);
    expect_no_exchange(mesh, 1000, PSTRIPACK_EMPTY_MESH, no_exchange);
    check(mesh, nodes, mine, from_one, serial_rings(nodes));
  }
  EXPECT_EQ(pstripack_mesh_exchange_begin(mesh, values.data(), 1000), 0);
  EXPECT_EQ(pstripack_mesh_exchange_begin(mesh, values.data(), 1), 0);
  EXPECT_EQ(pstripack_mesh_gather(mesh, -2, nullptr, nullptr, nullptr, nullptr), PSTRIPACK_BAD_COMM);
  EXPECT_EQ(pstripack_mesh_check(mesh, nullptr), 0);
  std::vector<double> halo(1000 * static_cast<std::size_t>(Sizes(mesh).halo));
  EXPECT_EQ(pstripack_mesh_exchange_end(mesh, 1000, halo.data()), 0);
}  // one is under way

TEST(DistributedMesh, RanksThatMakeDifferentCallsAreToldWhich) {
  if (size_of() == 1) return;
  const OfSlices mesh(60);
  const std::vector<double> values(mesh.mine.size());
  char message[100] = "";
  const std::pair<const char*, std::function<int()>> calls[] = {
      {"mesh_triangulate", [&] { return mesh.triangulate(); }},
      {"mesh_gather", [&] { return pstripack_mesh_gather(mesh, -1, nullptr, nullptr, nullptr, nullptr); }},
      {"mesh_exchange", [&] { return pstripack_mesh_exchange_begin(mesh, values.data(), 1); }},
      {"mesh_check", [&] { return pstripack_mesh_check(mesh, nullptr); }}};
  for (std::size_t a = 0; a < std::size(calls); ++a)
    for (std::size_t b = 0; b < std::size(calls); ++b) {
      if (a == b) continue;
      const auto& [name, call] = calls[rank_of() == size_of() - 1 ? b : a];
      ASSERT_EQ(mesh.triangulate(), 0);
      expect_line(call, PSTRIPACK_RANKS_DISAGREE,
                  std::string(calls[a].first) + ": some ranks have called " + calls[std::min(a, b)].first +
                      ", others " + calls[std::max(a, b)].first);
      EXPECT_EQ(pstripack_mesh_check(mesh, nullptr), PSTRIPACK_EMPTY_MESH);
    }
  const auto scvt = [&] {
    return pstripack_mesh_scvt(mesh, 0, nullptr, nullptr, nullptr, nullptr, nullptr, message, sizeof message);
  };
  EXPECT_EQ(rank_of() == 0 ? scvt() : calls[1].second(), PSTRIPACK_RANKS_DISAGREE);
  EXPECT_STREQ(message, rank_of() == 0 ? "some ranks have called mesh_gather, others mesh_scvt" : "");
}

TEST(DistributedMesh, RefusesWhatIsNoIntraCommunicator) {
  pstripack_mesh* mesh;
  EXPECT_EQ(pstripack_mesh_create(MPI_COMM_NULL, &mesh), PSTRIPACK_BAD_COMM);
  EXPECT_EQ(mesh, nullptr);
  EXPECT_EQ(pstripack_mesh_create_f(-1, &mesh), PSTRIPACK_BAD_COMM);
  EXPECT_EQ(mesh, nullptr);
  pstripack_mesh_free(nullptr);
}

}  // namespace

pstripack_mesh* outlives_mpi = nullptr;

int main(int argc, char** argv) {
  const int code =
      run_on_every_rank(argc, argv, [] { pstripack_mesh_create(MPI_COMM_WORLD, &outlives_mpi); });
  if (!declines(outlives_mpi)) return 2;
  pstripack_mesh_free(outlives_mpi);
  return code;
}
