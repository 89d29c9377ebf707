#pragma once
// For settings that a library reads when it is loaded: the test program runs itself again with `--as ...`.

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <string>
#include <thread>
#include <utility>
#include <vector>

#include "point_sets.h"
#include "support/expect.h"
#include "support/sanitizer.h"
#include "support/trmesh.h"

/// A temporary folder, removed at the end.
class Folder {
 public:
  Folder() {
    char name[] = "/tmp/pstripack_test_XXXXXX";
    path_ = mkdtemp(name);
  }
  ~Folder() { EXPECT_EQ(std::system(("rm -rf " + path_).c_str()), 0); }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  const std::string& path() const { return path_; }

 private:
  std::string path_;
};

inline std::string contents(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  std::ostringstream text;
  text << file.rdbuf();
  return text.str();
}

struct Outcome {
  int code;  ///< -1: a signal
  std::string out, err;
};

/// Runs `before`, words of a shell, and this program with `--as arguments` in `folder`.
inline Outcome run_this_program(const Folder& folder, const std::string& before,
                                const std::string& arguments) {
  char self[4096] = "";
  EXPECT_GT(readlink("/proc/self/exe", self, sizeof self - 1), 0);
  const std::string command =
      "cd " + folder.path() + " && exec > out 2> err && " + before + " '" + self + "' --as " + arguments;
  const int status = std::system(command.c_str());
  return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, contents(folder.path() + "/out"),
          contents(folder.path() + "/err")};
}

/// TRMESH returns the codes that STRIPACK documents, and -5; four calls.
inline bool codes_are_right() {
  Nodes nodes = point_sets::make("random", 100);
  if (trmesh(Nodes(nodes.begin(), nodes.begin() + 2)).ier != PSTRIPACK_TOO_FEW_NODES) return false;
  std::swap(nodes[2], nodes[50]);
  Nodes other = nodes;
  other[2] = other[0];
  if (trmesh(other).ier != PSTRIPACK_COLLINEAR) return false;
  other = nodes;
  other[60] = {0, 0, 0};
  if (trmesh(other).ier != PSTRIPACK_BAD_COORDINATE) return false;
  other = nodes;
  other[70] = other[30];
  return trmesh(other).ier == 31;
}

/// Ends the program with code 1 unless the mesh is right and errno as before. ThreadSanitizer changes errno.
inline void call_trmesh(const Nodes& nodes) {
  errno = ENOTTY;
  const Mesh m = trmesh(nodes);
  if (!kThreadSanitizer && errno != ENOTTY) std::_Exit(1);
  if (!is_correct(nodes, m)) std::_Exit(1);
}

/// Runs call() on `count` threads at once.
template <class Call>
void call_on_threads(int count, const Call& call) {
  std::vector<std::thread> threads;
  for (int i = 0; i < count; ++i) threads.emplace_back(call);
  for (auto& t : threads) t.join();
}

/// call() twice in a forked child, then once here. Returns the child's status.
template <class Call>
int call_around_a_fork(const Call& call) {
  const pid_t child = fork();
  if (child == 0) {
    call();
    call();
    std::exit(0);
  }
  int status = 0;
  waitpid(child, &status, 0);
  call();
  return status;
}

/// main of such a program: run_as(action, points, n, count) for `--as action points n count`, else the tests.
template <class RunAs>
int run_as_or_test(int argc, char** argv, const RunAs& run_as) {
  if (argc > 2 && std::string(argv[1]) == "--as")
    return run_as(argv[2], argc > 3 ? argv[3] : "", argc > 4 ? std::stoul(argv[4]) : 0,
                  argc > 5 ? std::atoi(argv[5]) : 0);
  ::testing::InitGoogleTest(&argc, argv);
  return RUN_ALL_TESTS();
}
