#include "files/output_file.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>
#include <vector>

#include "error_of.h"
#include "support/this_program.h"

namespace files {
namespace {

std::size_t entries(const std::string& folder) {
  namespace fs = std::filesystem;
  return static_cast<std::size_t>(std::distance(fs::directory_iterator(folder), fs::directory_iterator()));
}

TEST(output_file, has_its_name_only_when_it_is_complete) {
  const Folder folder;
  const std::string name = folder.path() + "/a";
  {
    OutputFile file(name);
    file.print("new");
    EXPECT_FALSE(std::filesystem::exists(name));
    file.commit();
    EXPECT_EQ(contents(name), "new");
  }
  {
    OutputFile file(name);
    file.print("half");
  }
  EXPECT_EQ(contents(name), "new");
  EXPECT_EQ(entries(folder.path()), 1u);
}

mode_t permissions_of(const std::string& name) {
  struct stat status {};
  EXPECT_EQ(stat(name.c_str(), &status), 0);
  return status.st_mode & 0777;
}

TEST(output_file, has_the_permissions_of_any_new_file) {
  const Folder folder;
  const mode_t before = umask(027);
  {
    OutputFile file(folder.path() + "/a");
    file.commit();
  }
  umask(before);
  EXPECT_EQ(permissions_of(folder.path() + "/a"), 0640u);
}

TEST(output_file, has_the_permissions_of_the_file_that_it_replaces) {
  const Folder folder;
  const std::string name = folder.path() + "/a";
  for (const mode_t mode : {0600, 0640, 0664, 0755}) {
    std::ofstream(name) << "old";
    chmod(name.c_str(), mode);
    OutputFile file(name);
    EXPECT_EQ(permissions_of(file.path()), 0600u);  // nobody reads it before it is complete
    file.print("new");
    file.commit();
    EXPECT_EQ(permissions_of(name), mode);
    EXPECT_EQ(contents(name), "new");
  }
}

// Of root access() says that it may write any file.
TEST(output_file, does_not_replace_a_file_that_nobody_may_write) {
  const Folder folder;
  const std::string name = folder.path() + "/a";
  std::ofstream(name) << "old";
  std::filesystem::create_symlink("a", folder.path() + "/link");
  chmod(name.c_str(), 0444);
  for (const std::string& to : {name, folder.path() + "/link"}) {
    EXPECT_EQ(error_of([&] { OutputFile file(to); }), to + ": cannot be written: Permission denied");
  }
  EXPECT_EQ(entries(folder.path()), 2u);
}

TEST(output_file, may_have_a_name_of_250_characters) {
  const Folder folder;
  OutputFile(folder.path() + "/" + std::string(250, 'c')).commit();
  EXPECT_EQ(entries(folder.path()), 1u);
}

TEST(output_file, replaces_what_a_link_points_to) {
  const Folder folder;
  std::ofstream(folder.path() + "/target") << "old";
  std::filesystem::create_symlink("target", folder.path() + "/link");
  {
    OutputFile file(folder.path() + "/link");
    file.print("new");
    file.commit();
  }
  EXPECT_TRUE(std::filesystem::is_symlink(folder.path() + "/link"));
  EXPECT_EQ(contents(folder.path() + "/target"), "new");
}

TEST(output_file, leaves_nothing_after_a_signal) {
  const Folder folder;
  for (const int signal : {SIGTERM, SIGPIPE}) {
    const auto write_half = [&] {
      OutputFile file(folder.path() + "/a"), beside(folder.path() + "/b");
      file.print("half");
      raise(signal);
    };
    EXPECT_EXIT(write_half(), testing::KilledBySignal(signal), "");
    EXPECT_EQ(entries(folder.path()), 0u);
  }
}

TEST(output_file, writes_to_what_cannot_be_replaced) {
  OutputFile file("/dev/null");
  file.print("text");
  file.commit();
  EXPECT_TRUE(std::filesystem::is_character_file("/dev/null"));
}

// Past failure: as root, `-o /dev/stdout` replaced the link by a file if stdout was a deleted file, as that
// of a test that captures it; elsewhere it lost what others had written.
TEST(output_file, does_not_replace_a_link_to_an_open_file) {
  const Folder folder;
  const std::string name = folder.path() + "/file", link = folder.path() + "/link";
  const int file = open(name.c_str(), O_RDWR | O_CREAT, 0600);
  ASSERT_GE(file, 0);
  unlink(name.c_str());
  std::filesystem::create_symlink("/proc/self/fd/" + std::to_string(file), link);
  {
    OutputFile output(link);
    output.print("text");
    output.commit();
  }
  EXPECT_TRUE(std::filesystem::is_symlink(link));
  char text[5] = "";
  EXPECT_EQ(pread(file, text, 4, 0), 4);
  EXPECT_STREQ(text, "text");
  close(file);
}

TEST(output_file, stands_on_stdout_behind_what_others_have_written) {
  const Folder folder;
  for (const char* const name : {"/dev/stdout", "/proc/self/fd/1", "-"}) {
    const std::string out = folder.path() + "/out";
    const auto write_in_between = [&] {
      dup2(open(out.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600), STDOUT_FILENO);
      std::printf("head\n");
      std::fflush(stdout);
      OutputFile output(name);
      output.print("text\n");
      output.commit();
      std::printf("end\n");
      std::fflush(stdout);
      _exit(0);
    };
    std::fflush(stdout);
    EXPECT_EXIT(write_in_between(), testing::ExitedWithCode(0), "");
    EXPECT_EQ(contents(out), "head\ntext\nend\n") << name;
  }
}

}  // namespace
}  // namespace files
