#pragma once
// Makes the allocations of a call fail, one after another.

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <functional>
#include <string>
#include <vector>

#include "base/workspace.h"
#include "support/failing_allocation.h"

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
inline long fail_each_allocation(const Call& call) {
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
