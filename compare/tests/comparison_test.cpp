#include "comparison.h"

#include <gtest/gtest.h>

#include <utility>

#include "capi/pstripack.h"
#include "point_sets.h"

namespace comparison {
namespace {

using pstripack::Point;

/// The result of a call for these points.
OurRun called(const std::vector<Point>& points) {
  std::vector<double> x, y, z;
  for (const Point& p : points) x.push_back(p.x), y.push_back(p.y), z.push_back(p.z);
  OurRun run;
  Lists& lists = run.lists;
  lists.list.assign(6 * points.size() - 12, kUntouched);
  lists.lptr = lists.list;
  lists.lend.assign(points.size(), kUntouched);
  run.ier = pstripack_trmesh(static_cast<std::int32_t>(points.size()), x.data(), y.data(), z.data(),
                             lists.list.data(), lists.lptr.data(), lists.lend.data(), &lists.lnew);
  return run;
}

legacy_stripack::Triangulation as_the_original(const OurRun& run) {
  legacy_stripack::Triangulation t;
  t.ier = run.ier;
  t.lnew = run.lists.lnew;
  t.list = run.lists.list;
  t.lptr = run.lists.lptr;
  t.lend = run.lists.lend;
  return t;
}

class Comparison : public testing::Test {
 protected:
  const std::vector<Point> points_ = point_sets::make("random", 50);
  const OurRun run_ = called(points_);
  const legacy_stripack::Triangulation original_ = as_the_original(run_);
};

TEST_F(Comparison, OfEqualMeshesIsEqual) {
  const Result result = compare(points_, original_, 0x1p-52, {run_, run_}, 5);
  EXPECT_TRUE(result.equal());
  EXPECT_FALSE(result.against_us());
  EXPECT_EQ(verdict_in_short(result), "equal");
}

TEST_F(Comparison, CountsOtherBytesAgainstUs) {
  OurRun other = run_;
  other.threads = 2;
  other.lists.lptr.back() = 1;  // an unused slot: the mesh is the same
  const Result result = compare(points_, original_, 0x1p-52, {run_, other}, 5);
  EXPECT_TRUE(result.against_us());
  ASSERT_EQ(result.broken_promises.size(), 1u);
  EXPECT_EQ(result.broken_promises[0],
            "the result on r8, 2 threads, 1 rank, bisection has other bytes than that on r8, 1 thread, 1 "
            "rank, bisection");
}

TEST_F(Comparison, CountsACallThatDoesNotReturnAgainstUs) {
  OurRun lost;
  lost.ranks = 4;
  lost.failure = "crashed";
  const Result one_lost = compare(points_, original_, 0x1p-52, {lost, run_}, 5);
  EXPECT_EQ(one_lost.broken_promises,
            std::vector<std::string>{"the call on r8, 1 thread, 4 ranks, bisection crashed"});
  EXPECT_TRUE(one_lost.meshes_compared);  // the other one has returned
  const Result all_lost = compare(points_, original_, 0x1p-52, {lost}, 5);
  EXPECT_TRUE(all_lost.against_us());
  EXPECT_EQ(verdict_in_short(all_lost), "WE ARE WRONG");
}

TEST_F(Comparison, CountsAWrongMeshAgainstUs) {
  OurRun wrong = run_;
  std::swap(wrong.lists.lptr[0], wrong.lists.lptr[20]);
  EXPECT_TRUE(compare(points_, original_, 0x1p-52, {wrong}, 5).against_us());
}

TEST_F(Comparison, OfAnOriginalThatGaveNoResultIsNotEqualAndNotAgainstUs) {
  legacy_stripack::Triangulation none;
  none.outcome = legacy_stripack::Outcome::timed_out;
  const Result result = compare(points_, none, 0x1p-52, {run_}, 5);
  EXPECT_FALSE(result.equal());
  EXPECT_FALSE(result.against_us());
  EXPECT_EQ(verdict_in_short(result), "no result");
}

}  // namespace
}  // namespace comparison
