// Limits of a library that reads a damaged file: each test runs in a process of its own.

#include "files/reading_guard.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>

#include "files/output_file.h"
#include "support/sanitizer.h"
#include "support/this_program.h"

namespace files {
namespace {

/// Calls itself until the stack is full.
int recursion_without_end(volatile int* count) {
  volatile char frame[1024] = {};
  *count = *count + 1;
  return *count < 0 ? 0 : recursion_without_end(count) + frame[0];
}

TEST(reading_guard, ends_the_program_where_the_library_crashes) {
  const auto crash = [](int signal) {
    const ReadingGuard guard("x.nc", 3);
    raise(signal);
  };
  for (const int signal : {SIGSEGV, SIGBUS, SIGFPE, SIGABRT})
    EXPECT_EXIT(crash(signal), testing::ExitedWithCode(3),
                ": x.nc: cannot be read: the NetCDF library crashed: the file is damaged\n$");
  if (kAddressSanitizer || kThreadSanitizer) return;
  const auto recur = [] {
    const ReadingGuard guard("x.nc", 3);
    volatile int count = 0;
    recursion_without_end(&count);
  };
  EXPECT_EXIT(recur(), testing::ExitedWithCode(3), "crashed");
}

TEST(reading_guard, ends_the_program_where_the_library_does_not_end) {
  const auto loop = [] {
    ReadingGuard guard("x.nc", 1, 1);
    for (volatile int i = 0;; i = 1 - i) const ReadingGuard::Limits limits(guard);
  };
  EXPECT_EXIT(loop(), testing::ExitedWithCode(1),
              ": x.nc: cannot be read: the NetCDF library does not end: the file is damaged\n$");
}

TEST(reading_guard, leaves_no_unfinished_output) {
  const Folder folder;
  const auto crash = [&] {
    const OutputFile file(folder.path() + "/a");
    const ReadingGuard guard("x.nc");
    raise(SIGSEGV);
  };
  EXPECT_EXIT(crash(), testing::ExitedWithCode(1), "crashed");
  EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

TEST(reading_guard, limits_the_memory_of_calls_and_of_nothing_else) {
  if (kAddressSanitizer || kThreadSanitizer) GTEST_SKIP() << "the sanitizer ends where memory ends";
  constexpr std::size_t kMegabyte = 1 << 20;
  const auto can_allocate = [](std::size_t bytes) {
    void* volatile memory = std::malloc(bytes);
    std::free(memory);
    return memory != nullptr;
  };
  ReadingGuard guard("x.nc");
  {
    const ReadingGuard::Limits limits(guard);
    EXPECT_TRUE(can_allocate(200 * kMegabyte));
    EXPECT_FALSE(can_allocate(300 * kMegabyte));
  }
  EXPECT_TRUE(can_allocate(300 * kMegabyte));
  guard.grant(100 * kMegabyte);
  const ReadingGuard::Limits limits(guard);
  EXPECT_TRUE(can_allocate(600 * kMegabyte));
  EXPECT_FALSE(can_allocate(700 * kMegabyte));
}

}  // namespace
}  // namespace files
