// For each n the n-th allocation of a call fails, in every routine that allocates. The routine must return
// the documented code, change no result and leak nothing, and the next call must be correct.

#include <gtest/gtest.h>
#include <omp.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cstdio>
#include <cstdlib>
#include <functional>
#include <numeric>
#include <string>
#include <thread>
#include <vector>

#include "base/workspace.h"
#include "capi/plain_calls.h"
#include "capi/pstripack.h"
#include "point_sets.h"
#include "support/child.h"
#include "support/columns.h"
#include "support/failing_allocation.h"
#include "support/lists.h"
#include "support/moves.h"
#include "support/text_calls.h"
#include "trmesh/warm_start.h"

namespace {

/// An array that a call writes, with its contents before the call.
class Result {
 public:
  template <class T>
  explicit Result(std::vector<T>& array)
      : place_(reinterpret_cast<unsigned char*>(array.data())),
        before_(place_, place_ + array.size() * sizeof(T)) {}

  void restore() const { std::copy(before_.begin(), before_.end(), place_); }
  std::vector<unsigned char> bytes() const { return {place_, place_ + before_.size()}; }
  bool is_untouched() const { return std::equal(before_.begin(), before_.end(), place_); }

 private:
  unsigned char* place_;
  std::vector<unsigned char> before_;
};

struct Call {
  std::function<std::int64_t()> run;  ///< returns its code
  std::vector<Result> results;
  std::int64_t out_of_memory = -6;  ///< the code for it
  std::ptrdiff_t lines = 1;         ///< number of lines on stderr in this case
  long every = 1;                   ///< a call without failures is tried after this many failures
};

/// Runs the call repeatedly: first its first allocation fails, then its second, until no allocation is left;
/// then all allocations from the first on fail, from the second on, ... Each run must return the code for it
/// and leave the results unchanged, or do without the memory. It must leak nothing, and the next call must be
/// correct. Returns a lower bound of the number of failed allocations.
long fail_each_allocation(const Call& call) {
  const auto restore = [&] {
    std::for_each(call.results.begin(), call.results.end(), [](auto& r) { r.restore(); });
  };
  const auto written = [&] {
    std::vector<std::vector<unsigned char>> all;
    for (const Result& r : call.results) all.push_back(r.bytes());
    return all;
  };
  restore();
  const std::int64_t code = call.run();
  const auto expected = written();
  EXPECT_NE(code, call.out_of_memory);
  long failures = 0;
  for (const bool for_good : {false, true})
    for (long which = 1;; ++which, ++failures) {
      restore();
      pstripack::free_cached_blocks();
      std::int64_t now;
      ::testing::internal::CaptureStderr();
      {
        const FailingAllocation memory(which, for_good);
        now = call.run();
      }
      const std::string said = ::testing::internal::GetCapturedStderr();
      const std::string where =
          (for_good ? "from allocation " : "allocation ") + std::to_string(which) + ": " + said;
      pstripack::free_cached_blocks();
      EXPECT_EQ(FailingAllocation::blocks(), 0u) << where;
      if (now == call.out_of_memory) {
        EXPECT_TRUE(FailingAllocation::happened()) << where;
        for (const Result& r : call.results) EXPECT_TRUE(r.is_untouched()) << where;
        EXPECT_EQ(std::count(said.begin(), said.end(), '\n'), call.lines) << where;
      } else {
        EXPECT_EQ(now, code) << where;
        EXPECT_TRUE(written() == expected) << where;
      }
      if (which % call.every == 0) {
        restore();
        EXPECT_EQ(call.run(), code) << "after " << where;
        EXPECT_TRUE(written() == expected) << "after " << where;
      }
      if (::testing::Test::HasFailure() || !FailingAllocation::happened()) break;
    }
  return failures;
}

/// The routines for one kind of reals and integers.
#define KIND(name, RealType, IntType, list_suffix, suffix, trmesh_name)          \
  struct name {                                                                  \
    using Real = RealType;                                                       \
    using Int = IntType;                                                         \
    static constexpr auto trmesh = trmesh_name;                                  \
    static constexpr auto trlist = pstripack_trlist_##list_suffix;               \
    static constexpr auto trlist2 = pstripack_trlist2_##list_suffix;             \
    static constexpr auto polygons = pstripack_voronoi_poly_count_##list_suffix; \
    static constexpr auto crlist = pstripack_crlist_##suffix;                    \
    static constexpr auto trfind = pstripack_trfind_##suffix;                    \
    static constexpr auto nearnd = pstripack_nearnd_##suffix;                    \
    static constexpr auto getnp = pstripack_getnp_##suffix;                      \
    static constexpr auto inside = pstripack_inside_##suffix;                    \
    static constexpr auto trprnt = pstripack_trprnt_##suffix;                    \
    static constexpr auto trlprt = pstripack_trlprt_##suffix;                    \
    static constexpr auto trplot = pstripack_trplot_##suffix;                    \
    static constexpr auto vrplot = pstripack_vrplot_##suffix;                    \
  }
KIND(R4, float, std::int32_t, i4, r4, pstripack_trmesh_r4);
KIND(R8, double, std::int32_t, i4, r8, pstripack_trmesh);
KIND(I8, double, std::int64_t, i8, i8, pstripack_trmesh_i8);

/// The arrays of a triangulation and of all that is computed from it.
template <class Kind>
struct Arrays : Columns<typename Kind::Real> {
  using Real = typename Kind::Real;
  using Int = typename Kind::Int;
  using Columns<Real>::x, Columns<Real>::y, Columns<Real>::z;

  explicit Arrays(const Nodes& nodes)
      : Columns<Real>(nodes),
        n(static_cast<Int>(nodes.size())),
        list(6 * nodes.size() - 12, -77),
        lptr(list),
        lend(nodes.size(), -77),
        lnew(1, -77) {}
  Call trmesh() {
    return {[this] {
              return Kind::trmesh(n, x.data(), y.data(), z.data(), list.data(), lptr.data(), lend.data(),
                                  lnew.data());
            },
            {Result(list), Result(lptr), Result(lend), Result(lnew)}};
  }

  Int n;
  std::vector<Int> list, lptr, lend, lnew;
};

template <class Kind>
Arrays<Kind> triangulated(const Nodes& nodes) {
  Arrays<Kind> a(nodes);
  EXPECT_EQ(a.trmesh().run(), 0);
  return a;
}

/// Sets for all paths: sphere, boundary, coincident nodes, predicates on directions.
std::vector<Nodes> small_sets() {
  std::vector<Nodes> sets{point_sets::make("random", 200), point_sets::make("cap", 150),
                          point_sets::make("random", 200), point_sets::make("random", 200)};
  sets[2][170] = sets[2][60];
  for (std::size_t i = 0; i < 200; ++i) {
    const double length = 1 + static_cast<double>(i % 7) / 4;
    sets[3][i] = scaled(length, sets[3][i]);
  }
  return sets;
}

/// The code of a routine that returns a text.
int text(void* handle) {
  pstripack_free_text(handle);
  return handle == nullptr ? -6 : 0;
}

template <class Kind>
class EachAllocation : public ::testing::Test {
 protected:
  static void fails(const Call& call) { failures += fail_each_allocation(call); }
  static void TearDownTestSuite() { std::printf("%ld allocations failed\n", failures), failures = 0; }
  static inline long failures = 0;
};
using Kinds = ::testing::Types<R4, R8, I8>;
TYPED_TEST_SUITE(EachAllocation, Kinds);

TYPED_TEST(EachAllocation, OfTrmesh) {
  for (const Nodes& nodes : small_sets()) this->fails(Arrays<TypeParam>(nodes).trmesh());
}

/// For a grid PSTRIPACK_ORDER=bitwise returns the original's lists and reports how they differ from the exact
/// mesh.
TYPED_TEST(EachAllocation, OfTrmeshOfAGrid) {
  Arrays<TypeParam> a(point_sets::make("latlon", 200));
  this->fails(a.trmesh());
}

TYPED_TEST(EachAllocation, OfTriangleLists) {
  using Int = typename TypeParam::Int;
  omp_set_num_threads(2);
  for (const std::size_t n : {200, 20000}) {
    Arrays<TypeParam> a = triangulated<TypeParam>(point_sets::make("random", n));
    std::vector<Int> ltri(9 * (2 * n - 4), -77);
    Int nt = 0, ier = 0;
    const auto code = [&] { return ier != 0 && nt != 0 ? -99 : ier; };
    this->fails({[&] {
                   TypeParam::trlist(a.n, a.list.data(), a.lptr.data(), a.lend.data(), 9, &nt, ltri.data(),
                                     &ier);
                   return code();
                 },
                 {Result(ltri)}});
    this->fails({[&] {
                   TypeParam::trlist2(a.n, a.list.data(), a.lptr.data(), a.lend.data(), &nt, ltri.data(),
                                      &ier);
                   return code();
                 },
                 {Result(ltri)}});
  }
}

/// CRLIST, and the routines that print and draw its result.
TYPED_TEST(EachAllocation, OfVoronoiDiagrams) {
  using Real = typename TypeParam::Real;
  using Int = typename TypeParam::Int;
  omp_set_num_threads(2);
  for (const Nodes& nodes :
       {point_sets::make("random", 200), point_sets::make("cap", 150), point_sets::make("random", 20000)}) {
    Arrays<TypeParam> a = triangulated<TypeParam>(nodes);
    const std::size_t n = nodes.size();
    std::vector<Int> ltri(6 * n, -77), listc(a.list.size(), -77), nb(1, -77);
    std::vector<Real> xc(2 * n, 5), yc(xc), zc(xc), rc(xc);
    Int ier = 0;
    this->fails({[&] {
                   TypeParam::crlist(a.n, a.n, a.x.data(), a.y.data(), a.z.data(), a.list.data(),
                                     a.lend.data(), a.lptr.data(), a.lnew.data(), ltri.data(), listc.data(),
                                     nb.data(), xc.data(), yc.data(), zc.data(), rc.data(), &ier);
                   return ier;
                 },
                 {Result(a.lptr), Result(a.lnew), Result(ltri), Result(listc), Result(nb), Result(xc),
                  Result(yc), Result(zc), Result(rc)}});
    if (n > 200) continue;
    this->fails({[&] {
                   void* const picture =
                       TypeParam::vrplot(7, Real(7.5), 30, 40, 90, a.n, a.x.data(), a.y.data(), a.z.data(),
                                         2 * a.n - 4, listc.data(), a.lptr.data(), a.lend.data(), xc.data(),
                                         yc.data(), zc.data(), "(title)", 7, 1, &ier);
                   return text(picture) == ier ? ier : -99;
                 },
                 {}});
    this->fails(
        {[&] { return text(TypeParam::polygons(a.n, a.lend.data(), a.lptr.data(), listc.data())); }, {}});
  }
}

TYPED_TEST(EachAllocation, OfSearches) {
  using Real = typename TypeParam::Real;
  using Int = typename TypeParam::Int;
  for (const char* family : {"random", "cap", "ring"}) {
    const Nodes nodes = point_sets::make(family, 300);
    Arrays<TypeParam> a = triangulated<TypeParam>(nodes);
    const Real p[] = {Real(0.6), Real(-0.48), Real(0.64)};
    std::vector<Real> b(3, 5), al(1, 5);
    std::vector<Int> i(3, -77);
    this->fails({[&] {
                   TypeParam::trfind(1, p, a.n, a.x.data(), a.y.data(), a.z.data(), a.list.data(),
                                     a.lptr.data(), a.lend.data(), &b[0], &b[1], &b[2], &i[0], &i[1], &i[2]);
                   return i[0];
                 },
                 {Result(b)},
                 0});
    this->fails({[&] {
                   return TypeParam::nearnd(p, 1, a.n, a.x.data(), a.y.data(), a.z.data(), a.list.data(),
                                            a.lptr.data(), a.lend.data(), al.data());
                 },
                 {Result(al)},
                 0});
    std::vector<Int> npts(270, 0);
    std::vector<Real> df(1, 5);
    npts[0] = 1;
    for (Int l = 2, ier = 0; l <= 270; ++l) {  // from 258 on it allocates
      const auto next = [&, l] {
        Int code = 0;
        TypeParam::getnp(a.x.data(), a.y.data(), a.z.data(), a.list.data(), a.lptr.data(), a.lend.data(), l,
                         npts.data(), df.data(), &code);
        return code;
      };
      if (l == 2 || l == 40 || l == 270) this->fails({next, {Result(npts), Result(df)}});
      ier = next();
      ASSERT_EQ(ier, 0);
    }
    std::vector<Int> polygon(20);
    std::iota(polygon.begin(), polygon.end(), Int{1});
    Int ier = 0;
    this->fails({[&] {
                   TypeParam::inside(p, a.n, a.x.data(), a.y.data(), a.z.data(), 20, polygon.data(), &ier);
                   return ier;
                 },
                 {}});
  }
}

TYPED_TEST(EachAllocation, OfListings) {
  using Real = typename TypeParam::Real;
  using Int = typename TypeParam::Int;
  Arrays<TypeParam> a = triangulated<TypeParam>(point_sets::make("cap", 100));
  std::vector<Int> ltri(9 * 200, -77);
  Int nt = 0, ier = 0;
  TypeParam::trlist(a.n, a.list.data(), a.lptr.data(), a.lend.data(), 9, &nt, ltri.data(), &ier);
  for (const Int f90 : {0, 1}) {
    this->fails({[&] {
                   return text(TypeParam::trprnt(a.n, a.x.data(), a.y.data(), a.z.data(), 0, a.list.data(),
                                                 a.lptr.data(), a.lend.data(), f90));
                 },
                 {}});
    this->fails({[&] {
                   return text(TypeParam::trlprt(a.n, a.x.data(), a.y.data(), a.z.data(), 0, 9, nt,
                                                 ltri.data(), f90));
                 },
                 {}});
  }
  this->fails({[&] {
                 void* const picture =
                     TypeParam::trplot(7, Real(7.5), 30, 40, 90, a.n, a.x.data(), a.y.data(), a.z.data(),
                                       a.list.data(), a.lptr.data(), a.lend.data(), "(title)", 7, 1, &ier);
                 return text(picture) == ier ? ier : -99;
               },
               {}});
}

using EachAllocationOf = EachAllocation<R8>;

TEST_F(EachAllocationOf, TrmeshOnThreads) {
  omp_set_num_threads(2);
  Nodes nodes = point_sets::make("random", 20000);
  for (const bool with_coincidence : {false, true}) {
    if (with_coincidence) nodes[15000] = nodes[7000];
    Arrays<R8> a(nodes);
    Call call = a.trmesh();
    call.every = 8;  // the calls take a while
    fails(call);
  }
}

/// Calls with slowly moving nodes, where some arcs flip. Any of the calls may run out of memory, also in the
/// middle of the flips; the next calls must be right.
TEST_F(EachAllocationOf, TrmeshThatBeginsWithTheLastMesh) {
  constexpr int kCalls = 5;
  constexpr std::size_t n = 6000;
  std::vector<Arrays<R8>> right;
  Nodes nodes = point_sets::make("fibonacci", n);
  point_sets::Random random(1);
  for (int i = 0; i < kCalls; ++i) {
    right.push_back(triangulated<R8>(nodes));
    move_all(nodes, 0.2 * spacing(n), random);
  }
  for (int k = 0; k < 2 * kCalls; ++k) {
    const int failing = k / 2;
    const bool for_good = k % 2 != 0;  // then the cold start fails as well
    bool failed = true;
    for (long which = 1; failed; ++which, failures += failed) {
      pstripack::free_cached_blocks();
      for (int i = 0; i < kCalls; ++i) {
        Arrays<R8> a = right[static_cast<std::size_t>(i)];
        for (auto* lists : {&a.list, &a.lptr, &a.lend, &a.lnew}) std::fill(lists->begin(), lists->end(), -77);
        const Call call = a.trmesh();
        std::int64_t code;
        {
          const FailingAllocation memory(i == failing ? which : 0, for_good && i == failing);
          code = call.run();
          if (i == failing) failed = FailingAllocation::happened();
        }
        ASSERT_TRUE(code == 0 || (code == -6 && i == failing)) << which << " " << i << " " << code;
        if (code == 0) {
          ASSERT_TRUE(a.list == right[static_cast<std::size_t>(i)].list &&
                      a.lptr == right[static_cast<std::size_t>(i)].lptr &&
                      a.lend == right[static_cast<std::size_t>(i)].lend);
        } else {
          for (const Result& r : call.results) ASSERT_TRUE(r.is_untouched()) << which;
        }
      }
    }
  }
  EXPECT_GT(failures, 20);
}

/// Runs as a model under pstripack-run. Each call is the first of its thread and needs more shared memory
/// than the previous call. If memory fails, the call runs on the model's own threads.
TEST_F(EachAllocationOf, ACallThatGoesToThePool) {
  if (std::getenv("PSTRIPACK_POOL") == nullptr) GTEST_SKIP() << "not under pstripack-run";
  std::size_t n = 170000;
  for (const bool for_good : {false, true}) {
    bool failed = true;
    for (long which = 1; failed; ++which, failures += failed, n += 2000) {
      Arrays<R8> a(point_sets::make("random", n));
      const Call call = a.trmesh();
      std::int64_t code = 0;
      std::thread([&] {
        const FailingAllocation memory(which, for_good);
        code = call.run();
        failed = FailingAllocation::happened();
      }).join();
      ASSERT_TRUE(code == 0 ? a.lnew[0] == 6 * a.n - 11 : code == -6 && failed) << which;
      for (const Result& r : call.results) ASSERT_TRUE(code == 0 || r.is_untouched()) << which;
    }
  }
  EXPECT_GT(failures, 5);
}

TEST_F(EachAllocationOf, TheValidator) {
  const auto of_validator = [](Arrays<R8>& a) {
    fails({[&] {
             char message[200];
             return pstripack_validate(a.n, a.x.data(), a.y.data(), a.z.data(), a.list.data(), a.lptr.data(),
                                       a.lend.data(), a.lnew[0], message, sizeof message);
           },
           {},
           -6,
           0});
  };
  for (const Nodes& nodes : {point_sets::make("random", 200), point_sets::make("cap", 150)}) {
    Arrays<R8> a = triangulated<R8>(nodes);
    of_validator(a);
    ++a.list[5];  // broken lists
    of_validator(a);
  }
  // Lists that are correct for other nodes: each thread finds a defect, whose text needs memory.
  omp_set_num_threads(2);
  Arrays<R8> a = triangulated<R8>(point_sets::make("random", 2500));
  for (auto* const axis : {&a.x, &a.y, &a.z}) std::reverse(axis->begin(), axis->end());
  of_validator(a);
}

TEST_F(EachAllocationOf, TheFingerprint) {
  Arrays<R8> a = triangulated<R8>(point_sets::make("random", 200));
  fails({[&] {
           return static_cast<std::int64_t>(
               pstripack_fingerprint(a.n, a.list.data(), a.lptr.data(), a.lend.data()));
         },
         {},
         0,
         0});
}

/// A run and one step.
TEST_F(EachAllocationOf, CentroidalTessellations) {
  const pstripack_density density{[](std::int32_t n, const double* xyz, double* values, void*) {
                                    for (std::int32_t i = 0; i < n; ++i) values[i] = 2 + xyz[3 * i];
                                  },
                                  nullptr, 0};
  pstripack_scvt_options options{};
  options.bytes = sizeof options;
  options.start = PSTRIPACK_SCVT_GIVEN;
  options.most_evaluations = 6;  // three of them by Lloyd's method
  Arrays<R8> a = triangulated<R8>(point_sets::make("fibonacci", 1600));
  std::vector<double> x = a.x, y = a.y, z = a.z, mass(1600, 7), energy(1, 7);
  fails({[&] {
           return pstripack_scvt(a.n, x.data(), y.data(), z.data(), nullptr, &options, nullptr, nullptr, 0);
         },
         {Result(x), Result(y), Result(z)},
         -6,
         0,
         100});
  fails({[&] {
           char message[200];
           return pstripack_scvt_step(a.n, a.x.data(), a.y.data(), a.z.data(), a.list.data(), a.lptr.data(),
                                      a.lend.data(), &density, x.data(), y.data(), z.data(), mass.data(),
                                      energy.data(), message, sizeof message);
         },
         {Result(x), Result(y), Result(z), Result(mass), Result(energy)},
         -6,
         0});
}

TEST(Blocks, ALargeCallFindsItsOwnAgain) {
  const auto pages = static_cast<std::size_t>(sysconf(_SC_PHYS_PAGES));
  const std::size_t large = (std::size_t{1} << 30) + (std::size_t{1} << 28);
  if (pages < 4 * (large / static_cast<std::size_t>(sysconf(_SC_PAGESIZE))))
    GTEST_SKIP() << "half of the memory is too little";
  pstripack::free_cached_blocks();
  pstripack::Block{large};  // none of its pages is touched
  const FailingAllocation none_is_made(1);
  EXPECT_NO_THROW(pstripack::Block{large});
  EXPECT_FALSE(FailingAllocation::happened());
}

TEST(Blocks, ThoseKeptAreGivenUpBeforeMemoryIsOut) {
  constexpr std::size_t small = 1 << 20, large = 3 << 20;
  for (const bool one_is_kept : {true, false}) {
    pstripack::free_cached_blocks();
    if (one_is_kept) pstripack::Block{small};
    const FailingAllocation memory(1);
    if (one_is_kept)
      EXPECT_NO_THROW(pstripack::Block{large});
    else
      EXPECT_THROW(pstripack::Block{large}, std::bad_alloc);
    EXPECT_TRUE(FailingAllocation::happened());
  }
  pstripack::free_cached_blocks();
}

/// A static object whose destructor calls TRMESH. Made before the library's own objects, destroyed after
/// them.
struct Last {
  ~Last() {
    for (int i = 0; wanted != nullptr && i < 3; ++i)
      if (wanted->trmesh().run() != 0) _exit(1);
  }
  Arrays<R8>* wanted = nullptr;
} last;

/// Those of static objects, and those of threads that go on.
TEST(Blocks, ServeCallsWhileTheProgramEnds) {
  Arrays<R8> a(point_sets::make("random", 20000)), b = a;
  EXPECT_EQ(in_child([&]() -> int {
              std::atomic<int> calls{0};
              std::thread([&] {
                for (const Call call = a.trmesh();; ++calls) call.run();
              }).detach();
              while (calls < 2) std::this_thread::yield();
              last.wanted = &b;
              std::exit(0);
            }),
            0);
}

}  // namespace
