// Memory between and before calls: what a process keeps, gives back, and refuses to ask for.

#include <cstdio>
#include <memory>
#include <new>
#include <vector>

#include "base/cached.h"
#include "base/system.h"
#include "base/workspace.h"
#include "support/this_program.h"

namespace {

using pstripack::available_memory, pstripack::memory_limit, pstripack::Block;

/// Bytes a node that this process has in memory after a call with n nodes; then after its memory is released.
int print_bytes_after_a_call(std::size_t n) {
  const Nodes nodes = point_sets::make("random", n);
  Lists lists = room_for(n);
  std::vector<double> x, y, z;
  for (const auto& p : nodes) x.push_back(p.x), y.push_back(p.y), z.push_back(p.z);
  const auto bytes = [&] {
    std::ifstream status("/proc/self/status");
    for (std::string word; status >> word;)
      if (word == "VmRSS:")
        status >> word, std::printf("%.0f\n", 1024 * std::stod(word) / static_cast<double>(n));
  };
  for (int call = 0; call < 2; ++call) {
    bytes();
    pstripack_trmesh(static_cast<std::int32_t>(n), x.data(), y.data(), z.data(), lists.list.data(),
                     lists.lptr.data(), lists.lend.data(), &lists.lnew);
    bytes();
    pstripack_release_memory();
  }
  return 0;
}

/// Bytes a node that stay after each of two calls, between which memory was released.
std::vector<double> bytes_kept(const std::string& variables) {
  const Folder folder;
  const Outcome outcome =
      run_self(folder, "OMP_NUM_THREADS=1 PSTRIPACK_WARM_START=1 " + variables, "calls random 200000");
  std::istringstream numbers(outcome.out);
  std::vector<double> kept;
  for (double before, after; numbers >> before >> after;) kept.push_back(after - before);
  EXPECT_EQ(kept.size(), 2u) << outcome.out;
  kept.resize(2);
  if (variables.find("many") != std::string::npos)
    EXPECT_NE(outcome.err.find("PSTRIPACK_KEEP=many: not a number of bytes"), std::string::npos)
        << outcome.err;
  else
    EXPECT_EQ(outcome.err, "");
  return kept;
}

TEST(Memory, IsKeptForTheNextCallUpToABoundAndReleasedOnRequest) {
  if (kAddressSanitizer || kThreadSanitizer) GTEST_SKIP() << "the sanitizer keeps memory of its own";
  for (const char* const all : {"", "PSTRIPACK_KEEP=", "PSTRIPACK_KEEP=1000000000", "PSTRIPACK_KEEP=many"})
    for (const double bytes : bytes_kept(all)) EXPECT_GT(bytes, 150) << all;
  for (const char* const nothing : {"PSTRIPACK_KEEP=0", "PSTRIPACK_KEEP=1000000"})
    for (const double bytes : bytes_kept(nothing)) EXPECT_LT(bytes, 20) << nothing;
}

TEST(Memory, ThatTheMachineLacksIsRefusedBeforeTheWork) {
  EXPECT_GT(available_memory(), std::size_t{1} << 26);
  EXPECT_LT(available_memory(), memory_limit());
  EXPECT_THROW(Block(memory_limit() - (std::size_t{1} << 20)), std::bad_alloc);
}

/// Caches of more threads than there are places for: the last keep nothing.
TEST(Memory, HasAPlaceForTheCacheOfEachOfThirtyTwoThreads) {
  struct Thing : pstripack::CachedThing {};
  std::vector<pstripack::Cached<Thing>> caches(40);
  for (int round = 0; round < 2; ++round) {
    for (auto& cache : caches) cache.put(std::make_unique<Thing>());
    std::size_t kept = 0;
    for (auto& cache : caches) kept += cache.take() != nullptr;
    EXPECT_EQ(kept, 32u) << "round " << round;
  }
}

}  // namespace

int main(int argc, char** argv) {
  return run_as_or_test(argc, argv, [](const std::string&, const std::string&, std::size_t n, int) {
    return print_bytes_after_a_call(n);
  });
}
