// For each n the n-th allocation fails, on one rank or on all, in every function of pstripack_mpi.h. All
// ranks must return the same code, change no result and leak nothing, and the next call must be correct.

#include <functional>
#include <string>
#include <vector>

#include "base/workspace.h"
#include "mpi/distributions.h"
#include "point_sets.h"
#include "support/expect.h"
#include "support/failing_allocation.h"
#include "support/trmesh.h"

namespace {

/// The smallest and the largest value of all ranks.
struct Extent {
  explicit Extent(int value) {
    const int mine[] = {value, -value};
    int all[2];
    MPI_Allreduce(mine, all, 2, MPI_INT, MPI_MIN, MPI_COMM_WORLD);
    smallest = all[0], largest = -all[1];
  }
  int smallest, largest;
};

enum Ranks { only_first, only_last, every };
bool is_hit(Ranks which) { return which == every || rank_of() == (which == only_first ? 0 : size_of() - 1); }

/// Makes every stride-th allocation of call() fail in turn, alone or with all later ones. On several ranks,
/// whose calls take longer, these take turns: on the first rank, on the last, or on all. call() returns its
/// code; check(code) returns the defect after it, if any; clear() undoes a successful call.
void fail_each_allocation(
    const std::function<int()>& call, const std::function<bool(int)>& is_right,
    const std::function<void()>& clear = [] {}, long stride = 1) {
  long failures = 0;
  for (const Ranks hit : {only_first, only_last, every})
    for (const bool for_good : {false, true}) {
      if (size_of() == 1 && hit != every) continue;
      bool failed = true;
      const long turn = size_of() == 1 ? 0 : 2 * hit + for_good, turns = size_of() == 1 ? 1 : 6;
      for (long which = 1 + turn * stride; failed; which += turns * stride, failures += failed) {
        int code;
        pstripack::free_cached_blocks();
        {
          const FailingAllocation memory(is_hit(hit) ? which : 0, for_good);
          code = call();
        }
        const Extent codes(code);
        ASSERT_EQ(codes.smallest, codes.largest) << "the ranks disagree, allocation " << which;
        ASSERT_TRUE(code == 0 || code == PSTRIPACK_OUT_OF_MEMORY) << code;
        ASSERT_TRUE(is_right(code)) << "code " << code << ", allocation " << which;
        if (code == 0) clear();
        failed = Extent(FailingAllocation::happened()).largest != 0;
        pstripack::free_cached_blocks();
        ASSERT_EQ(FailingAllocation::blocks(), 0u) << "allocation " << which;
        ASSERT_EQ(call(), 0) << "after allocation " << which;
        ASSERT_TRUE(is_right(0)) << "after allocation " << which;
        clear();
      }
    }
  if (rank_of() == 0) std::printf("%ld allocations failed\n", failures);
}

const Nodes& nodes() {
  static const Nodes random = point_sets::make("random", 500);
  return random;
}

// Must be the first test, so that allocations of the first call of the process also fail.
TEST(EachAllocation, OfCommMode) {
  Mesh m;
  const Columns c(nodes());
  const auto clear_arrays = [&] { m = {room_for(nodes().size())}; };
  const Mesh expected = trmesh(nodes());
  const auto call = [&] {
    return pstripack_trmesh(static_cast<std::int32_t>(nodes().size()), c.x.data(), c.y.data(), c.z.data(),
                            m.list.data(), m.lptr.data(), m.lend.data(), &m.lnew);
  };
  fail_each_allocation([] { return pstripack_set_comm(MPI_COMM_WORLD); }, [](int) { return true; },
                       [] { pstripack_set_comm(MPI_COMM_NULL); });
  ASSERT_EQ(pstripack_set_comm(MPI_COMM_WORLD), 0);
  clear_arrays();
  fail_each_allocation(call, [&](int code) {
    m.ier = code;
    const bool right = code == 0 ? m == expected : is_untouched(m);
    clear_arrays();
    return right;
  });
  pstripack_set_comm(MPI_COMM_NULL);
}

TEST(EachAllocation, OfDistributedMeshes) {
  pstripack_mesh* mesh = nullptr;
  const auto free_it = [&] { pstripack_mesh_free(mesh), mesh = nullptr; };
  fail_each_allocation([&] { return pstripack_mesh_create(MPI_COMM_WORLD, &mesh); },
                       [&](int code) { return (code == 0) == (mesh != nullptr); }, free_it);

  const Part part(nodes());
  ASSERT_EQ(pstripack_mesh_create(MPI_COMM_WORLD, &mesh), 0);
  fail_each_allocation(
      [&] { return part.triangulate(mesh); },
      [&](int code) { return Sizes(mesh).points == (code == 0 ? part.count() : 0); },
      // Empties the mesh, which frees its memory.
      [&] { EXPECT_EQ(pstripack_mesh_triangulate(mesh, -1, nullptr, nullptr), PSTRIPACK_BAD_SIZE); });

  ASSERT_EQ(part.triangulate(mesh), 0);
  const Mesh expected = trmesh(nodes());
  for (const std::int32_t root : {0, -1}) {
    const bool gets = root == -1 || rank_of() == root;
    Mesh m;
    const auto clear_arrays = [&] { m = {room_for(nodes().size())}; };
    clear_arrays();
    fail_each_allocation(
        [&] {
          return pstripack_mesh_gather(mesh, root, m.list.data(), m.lptr.data(), m.lend.data(), &m.lnew);
        },
        [&](int code) {
          m.ier = 0;
          const bool right = code == 0 && gets ? m == expected : is_untouched(m);
          clear_arrays();
          return right;
        });
  }
  free_it();
}

TEST(EachAllocation, OfCentroidalTessellations) {
  const OfMesh mesh;
  pstripack_scvt_options options{};
  options.bytes = sizeof options;
  options.start = PSTRIPACK_SCVT_GIVEN;
  options.most_evaluations = 5;  // three steps of Lloyd's method and one that makes the first pair
  const Part given(nodes());
  Part part = given;
  pstripack_scvt_result result;
  char message[200];
  const auto scvt = [&] {
    part.xyz = given.xyz;
    message[0] = '\0';
    result.evaluations = untouched;
    return pstripack_mesh_scvt(mesh, part.count(), part.xyz.data(), part.number.data(), nullptr, &options,
                               &result, message, sizeof message);
  };
  ASSERT_EQ(scvt(), 0);
  const std::vector<double> moved = part.xyz;
  ASSERT_NE(moved, given.xyz);
  const auto empty_mesh = [&] {
    EXPECT_EQ(pstripack_mesh_triangulate(mesh, -1, nullptr, nullptr), PSTRIPACK_BAD_SIZE);
  };
  empty_mesh();
  fail_each_allocation(
      scvt,
      [&](int code) {
        const bool is_done = code == 0;
        return part.xyz == (is_done ? moved : given.xyz) &&
               Sizes(mesh).points == (is_done ? part.count() : 0) &&
               result.evaluations == (is_done ? 5 : untouched) &&
               message == std::string(is_done ? "" : pstripack_strerror(code));
      },
      empty_mesh, 151);
}

// Not collective: each rank has its own code.
TEST(EachAllocation, OfTheCallsOfOneRank) {
  const OfMesh mesh;
  const Part part(nodes());
  ASSERT_EQ(part.triangulate(mesh), 0);
  std::vector<std::int64_t> begin(part.number.size() + 1, untouched);
  std::vector<std::int32_t> neighbour(static_cast<std::size_t>(Sizes(mesh).arcs), untouched),
      rank(part.number.size(), untouched);
  ASSERT_EQ(pstripack_mesh_local_stars(mesh, begin.data(), neighbour.data()), 0);
  const auto expected_begin = begin;
  const auto expected = neighbour;
  bool failed = true;
  for (long which = 1; failed; ++which) {
    begin.assign(begin.size(), untouched);
    neighbour.assign(neighbour.size(), untouched);
    const auto empty_begin = begin;
    const auto empty = neighbour;
    int code, home;
    pstripack::free_cached_blocks();
    {
      const FailingAllocation memory(which);
      code = pstripack_mesh_local_stars(mesh, begin.data(), neighbour.data());
      failed = FailingAllocation::happened();
    }
    EXPECT_EQ(code, failed ? PSTRIPACK_OUT_OF_MEMORY : 0);
    EXPECT_TRUE(begin == (failed ? empty_begin : expected_begin) && neighbour == (failed ? empty : expected));
    {
      const FailingAllocation memory(which);
      home = pstripack_mesh_home(mesh, part.count(), part.xyz.data(), rank.data());
      EXPECT_FALSE(FailingAllocation::happened());
    }
    EXPECT_EQ(home, 0);
    pstripack::free_cached_blocks();
    EXPECT_EQ(FailingAllocation::blocks(), 0u);
  }
}

}  // namespace

int main(int argc, char** argv) {
  return run_on_every_rank(argc, argv, [] {});
}
