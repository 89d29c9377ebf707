// How many threads a call takes by default: given masks, ranks, quotas and running threads, how many.

#include "base/free_processors.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>
#include <thread>
#include <vector>

#include "base/parallel_for.h"
#include "base/system.h"
#include "support/this_program.h"

namespace pstripack {
namespace {

void expect(const Processors& machine, int threads, ThreadLimit limit) {
  const ThreadCount count = free_processors(machine);
  EXPECT_EQ(count.threads, threads);
  EXPECT_STREQ(name_of(count.limit), name_of(limit));
}

TEST(FreeProcessors, AreAllOfTheMaskOnAQuietMachine) {
  expect({2, 2, 2}, 2, ThreadLimit::none);
  expect({4, 64, 64}, 4, ThreadLimit::none);
  expect({1, 64, 64}, 1, ThreadLimit::none);
}

TEST(FreeProcessors, AreThoseThatNobodyElseUses) {
  for (int others = 0; others < 20; ++others) {
    const int left = std::max(1, 16 - others);
    expect({16, 16, 16, 1, 0, others}, left, left < 16 ? ThreadLimit::busy : ThreadLimit::none);
    // Four of the machine's sixteen: the others may run on the other twelve.
    expect({4, 16, 16, 1, 0, others}, std::min(4, left), left < 4 ? ThreadLimit::busy : ThreadLimit::none);
  }
}

TEST(FreeProcessors, AreSharedByTheRanksOfAMachine) {
  expect({64, 64, 64, 64}, 1, ThreadLimit::ranks);  // bound to nothing
  expect({32, 64, 64, 64}, 1, ThreadLimit::ranks);  // bound to a socket
  expect({16, 64, 64, 4}, 16, ThreadLimit::none);   // bound to 16 each
  expect({64, 64, 64, 4}, 16, ThreadLimit::ranks);
  expect({8, 64, 8, 4}, 2, ThreadLimit::ranks);  // a job with 8 processors of a shared machine
  expect({2, 2, 2, 4}, 1, ThreadLimit::ranks);   // more ranks than processors
  expect({8, 64, 0, 4}, 2, ThreadLimit::ranks);  // the parent's mask is unknown
  expect({8, 64, 64, 4, 0, 60}, 4, ThreadLimit::busy);
  expect({64, 64, 64, 64, 0, 100}, 1, ThreadLimit::ranks);
}

TEST(FreeProcessors, AreThoseOfTheQuota) {
  expect({64, 64, 64, 1, 2}, 2, ThreadLimit::quota);
  expect({64, 64, 64, 2, 8}, 4, ThreadLimit::ranks);  // of one container
  expect({2, 64, 64, 1, 8}, 2, ThreadLimit::none);
}

TEST(FreeProcessors, LauncherTellsTheRanksOfAMachine) {
  const std::vector<std::string> names{
      "OMPI_COMM_WORLD_LOCAL_SIZE", "MPI_LOCALNRANKS",      "PMI_LOCAL_SIZE", "MV2_COMM_WORLD_LOCAL_SIZE",
      "SLURM_STEP_NUM_TASKS",       "SLURM_STEP_NUM_NODES", "SLURM_NTASKS"};
  for (const auto& name : names) unsetenv(name.c_str());
  EXPECT_EQ(local_ranks(), 1);
  for (std::size_t k = 0; k < 4; ++k) {
    setenv(names[k].c_str(), "12", 1);
    EXPECT_EQ(local_ranks(), 12) << names[k];
    setenv(names[k].c_str(), "many", 1);
    EXPECT_EQ(local_ranks(), 1) << names[k];
    unsetenv(names[k].c_str());
  }
  setenv("SLURM_NTASKS", "64", 1);  // of the job: a program that its script starts is no rank
  EXPECT_EQ(local_ranks(), 1);
  setenv("SLURM_STEP_NUM_TASKS", "7", 1);
  setenv("SLURM_STEP_NUM_NODES", "2", 1);
  EXPECT_EQ(local_ranks(), 4);
  for (const auto& name : names) unsetenv(name.c_str());
}

/// Files as the kernel has them, below a folder.
class FreeProcessorsOfFiles : public ::testing::Test {
 protected:
  void SetUp() override {
#ifndef PSTRIPACK_LINUX
    GTEST_SKIP() << "only Linux has these files";
#endif
  }
  void write(const std::string& path, const std::string& text) const {
    const std::filesystem::path file = root() + path;
    std::filesystem::create_directories(file.parent_path());
    std::ofstream(file) << text;
  }
  std::string root() const { return folder_.path(); }
  int quota() const { return quota_of_control_groups(root().c_str()); }
  int quota_with(const std::string& path, const std::string& text) const {
    write(path, text);
    return quota();
  }

 private:
  const Folder folder_;
};

TEST_F(FreeProcessorsOfFiles, QuotaIsTheLeastOfAllGroups) {
  EXPECT_EQ(quota(), 0);
  EXPECT_EQ(quota_with("/proc/self/cgroup", "0::/system.slice/job.scope\n"), 0);
  EXPECT_EQ(quota_with("/sys/fs/cgroup/system.slice/job.scope/cpu.max", "max 100000\n"), 0);
  EXPECT_EQ(quota_with("/sys/fs/cgroup/system.slice/cpu.max", "450000 100000\n"), 4);
  EXPECT_EQ(quota_with("/sys/fs/cgroup/system.slice/job.scope/cpu.max", "200000 100000\n"), 2);
  // A container's own, which is its root.
  EXPECT_EQ(quota_with("/sys/fs/cgroup/cpu.max", "50000 100000\n"), 1);
}

TEST_F(FreeProcessorsOfFiles, QuotaOfVersionOne) {
  EXPECT_EQ(
      quota_with("/proc/self/cgroup", "5:cpuset:/a\n4:cpu,cpuacct:/docker/1a\n1:name=systemd:/x\n0::/\n"), 0);
  write("/sys/fs/cgroup/cpu/cpu.cfs_quota_us", "-1\n");
  EXPECT_EQ(quota_with("/sys/fs/cgroup/cpu/cpu.cfs_period_us", "100000\n"), 0);
  write("/sys/fs/cgroup/cpu/docker/1a/cpu.cfs_quota_us", "300000\n");
  EXPECT_EQ(quota_with("/sys/fs/cgroup/cpu/docker/1a/cpu.cfs_period_us", "100000\n"), 3);
}

TEST_F(FreeProcessorsOfFiles, OthersAreAllRunningThreadsButOurs) {
  const auto others_with = [&](const std::string& path, const std::string& text) {
    write(path, text);
    return threads_of_others(root().c_str());
  };
  EXPECT_EQ(threads_of_others(root().c_str()), 0);  // no such files
  EXPECT_EQ(others_with("/proc/loadavg", "0.20 0.18 0.12 7/80 11206\n"), 6);
  EXPECT_EQ(others_with("/proc/self/task/10/stat", "10 (a) R 1 1\n"), 6);
  EXPECT_EQ(others_with("/proc/self/task/11/stat", "11 (named ) R) S 1 1\n"), 6);  // sleeps
  EXPECT_EQ(others_with("/proc/self/task/12/stat", "12 (spins) R 1 1\n"), 5);
  EXPECT_EQ(others_with("/proc/loadavg", "0.20 0.18 0.12 1/80 11206\n"), 0);
  EXPECT_EQ(others_with("/proc/loadavg", "nothing\n"), 0);
}

constexpr std::size_t kMany = 100000000;

TEST(ThreadCount, ObeysWhoAsks) {
  const ChosenThreads outer(3);
  EXPECT_EQ(thread_count(kMany).threads, 3);
  EXPECT_STREQ(name_of(thread_count(kMany).limit), "asked");
  {
    const ChosenThreads inner(2);
    EXPECT_EQ(threads_for(kMany), 2);
    const ChosenThreads unchanged(0);
    EXPECT_EQ(threads_for(kMany), 2);
  }
  EXPECT_EQ(threads_for(kMany), 3);
  EXPECT_EQ(threads_for(29999), 2);
  EXPECT_STREQ(name_of(thread_count(29999).limit), "size");
  EXPECT_EQ(most_threads_for(29999), 2);
  EXPECT_EQ(threads_for(19999), 1);
}

TEST(ThreadCount, OfASecondCallLeavesTheFirstItsThreads) {
  const Folder folder;
  run_self(folder, "env -u OMP_NUM_THREADS", "beside others 0 0");
}
int leaves_others_their_processors(const std::string&, const std::string&, std::size_t, int) {
  const int processors = processors_of_mask();
  for (int used = 1; used <= processors; ++used) {
    int threads = 0;
    const AtWork here(used);
    std::thread([&] { threads = threads_for(kMany); }).join();
    if (threads < 1 || threads > std::max(1, processors - used)) return 1;
  }
  return 0;
}

}  // namespace
}  // namespace pstripack

int main(int argc, char** argv) {
  return run_as_or_test(argc, argv, pstripack::leaves_others_their_processors);
}
