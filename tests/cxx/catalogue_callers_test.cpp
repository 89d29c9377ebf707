// TRMESH called by threads, forked children and with little stack or memory; memory stays flat.

#include <fcntl.h>
#include <gtest/gtest.h>
#include <pthread.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <thread>

#include "point_sets.h"
#include "support/child.h"
#include "support/expect.h"

namespace {

using point_sets::make;

/// Pages of this process: all (virtual) and resident, in bytes.
struct Usage {
  std::size_t all = 0, resident = 0;
};

Usage usage() {
  Usage u;
  std::FILE* file = std::fopen("/proc/self/statm", "r");
  if (file == nullptr || std::fscanf(file, "%zu %zu", &u.all, &u.resident) != 2) std::abort();
  std::fclose(file);
  const std::size_t page = static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
  return {u.all * page, u.resident * page};
}

TEST(Calls, FromSixteenThreadsAtOnceAreRight) {
  std::vector<Nodes> sets;
  std::vector<Mesh> expected;
  for (std::size_t i = 0; i < 16; ++i) {
    const char* family[] = {"random", "ring", "cap:1e-8", "latlon"};
    sets.push_back(make(family[i % 4], 200 + 700 * i, i));
    expected.push_back(trmesh(sets[i]));
    ASSERT_TRUE(is_as_promised(sets[i], expected[i]));
  }
  std::atomic<int> wrong{0};
  std::vector<std::thread> threads;
  for (std::size_t i = 0; i < 16; ++i)
    threads.emplace_back([&, i] {
      for (int repeat = 0; repeat < 20; ++repeat) wrong += trmesh(sets[i]) == expected[i] ? 0 : 1;
    });
  for (std::thread& t : threads) t.join();
  EXPECT_EQ(wrong, 0);
}

TEST(Calls, FromInsideAParallelRegionAreRight) {
  const Nodes nodes = make("random", 20000);
  const Mesh expected = trmesh(nodes);
  int wrong = 0;
#pragma omp parallel for num_threads(4) reduction(+ : wrong)
  for (int i = 0; i < 8; ++i) wrong += trmesh(nodes) == expected ? 0 : 1;
  EXPECT_EQ(wrong, 0);
}

/// Number of calls over which memory must stay flat: `number`, or PSTRIPACK_TEST_CALLS.
int calls_or(int number) {
  const char* const asked = std::getenv("PSTRIPACK_TEST_CALLS");
  return asked != nullptr ? std::atoi(asked) : number;
}

/// Memory must not grow during run(calls), after some first calls.
template <class Run>
void expect_flat_memory(const Run& run, int first, int calls) {
  run(first);
  const Usage before = usage();
  run(calls);
  const Usage after = usage();
  EXPECT_LE(after.resident, before.resident + (1u << 19));
  EXPECT_LE(after.all, before.all + (1u << 20));
  std::printf("%d calls: resident memory %zu kB before, %zu kB after\n", calls, before.resident / 1024,
              after.resident / 1024);
}

TEST(Calls, KeepMemoryFlat) {
  const Nodes nodes = make("random", 100), directions = make("cap:1e-8", 100);
  const auto run = [&](int calls) {
    for (int i = 0; i < calls; ++i) {
      const Mesh m = trmesh(i % 50 == 0 ? directions : nodes);
      if (m.ier != 0) std::abort();
    }
  };
  expect_flat_memory(run, 1000, calls_or(100000));
}

TEST(Calls, ThatAreRefusedKeepMemoryFlat) {
  Nodes collinear = make("random", 100), coinciding = collinear, bad = collinear;
  collinear[1] = collinear[0], coinciding[99] = coinciding[5], bad[50].x = std::nan("");
  const Nodes few(collinear.begin(), collinear.begin() + 2);
  const auto run = [&](int calls) {
    for (int i = 0; i < calls; i += 4)
      if (trmesh(collinear).ier != -2 || trmesh(coinciding).ier != 6 || trmesh(bad).ier != -5 ||
          trmesh(few).ier != -1)
        std::abort();
  };
  const int saved = dup(2), nowhere = open("/dev/null", O_WRONLY);
  dup2(nowhere, 2);  // a line for each bad coordinate
  expect_flat_memory(run, 200, calls_or(4000));
  dup2(saved, 2);
  close(saved);
  close(nowhere);
}

TEST(Calls, FitAStackOfOneMegabyte) {
  struct Job {
    std::vector<Nodes> sets = {make("latlon", 200000), make("ring", 20000), make("cap:1e-8", 20000),
                               make("strip:1e-15", 2000)};
    int ier = -99;
  } job;
  pthread_attr_t attributes;
  pthread_attr_init(&attributes);
  ASSERT_EQ(pthread_attr_setstacksize(&attributes, 1 << 20), 0);
  pthread_t thread;
  ASSERT_EQ(pthread_create(
                &thread, &attributes,
                [](void* argument) -> void* {
                  auto* j = static_cast<Job*>(argument);
                  j->ier = 0;
                  for (const Nodes& nodes : j->sets) j->ier += std::abs(trmesh(nodes).ier);
                  return nullptr;
                },
                &job),
            0);
  pthread_join(thread, nullptr);
  pthread_attr_destroy(&attributes);
  EXPECT_EQ(job.ier, 0);
}

TEST(Calls, InAForkedChildAreRight) {
  const Nodes nodes = make("random", 50000);
  EXPECT_EQ(in_child([&] { return trmesh(nodes).ier; }), 0);  // before the parent's first call
  const Mesh expected = trmesh(nodes);                        // starts threads
  EXPECT_EQ(in_child([&] { return trmesh(nodes) == expected ? 0 : 1; }), 0);
  EXPECT_TRUE(trmesh(nodes) == expected);
}

TEST(OutOfMemory, IsReportedAndTouchesNothing) {
  // In a child whose address space is limited to little more than it uses: every limit must work.
  const Nodes nodes = make("random", 50000);
  int refused = 0, done = 0;
  for (std::size_t kilobytes = 64; kilobytes < (1u << 20); kilobytes = kilobytes * 5 / 4) {
    const int code = in_child([&] {
      const Columns c(nodes);
      const std::size_t n = nodes.size();
      Mesh m{room_for(n)};
      const std::size_t bytes = usage().all + kilobytes * 1024;
      const rlimit limit{bytes, bytes};
      if (setrlimit(RLIMIT_AS, &limit) != 0 || std::freopen("/dev/null", "w", stderr) == nullptr) return 90;
      m.ier = pstripack_trmesh(static_cast<std::int32_t>(n), c.x.data(), c.y.data(), c.z.data(),
                               m.list.data(), m.lptr.data(), m.lend.data(), &m.lnew);
      if (m.ier == -6) return is_untouched(m) ? 6 : 91;
      return m.ier == 0 && m.lnew == static_cast<std::int32_t>(6 * n - 11) ? 0 : 92;
    });
    EXPECT_TRUE(code == 0 || code == 6) << "code " << code << " with " << kilobytes << " kB";
    (code == 6 ? refused : done) += 1;
  }
  EXPECT_GT(refused, 3);
  EXPECT_GT(done, 1);
}

}  // namespace
