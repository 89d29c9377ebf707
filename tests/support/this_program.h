#pragma once
// For settings that a library reads when it is loaded: the test program runs itself again with `--as ...`.

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <string>
#include <thread>
#include <utility>

#include "point_sets.h"
#include "support/expect.h"
#include "support/sanitizer.h"
#include "support/text.h"
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

struct Outcome {
  std::string out, err;
};

/// Runs `before`, words of a shell, and this program with `--as arguments` in `folder`. It must end well, or
/// not, if so told.
inline Outcome run_self(const Folder& folder, const std::string& before, const std::string& arguments,
                        bool well = true) {
  char self[4096] = "";
  EXPECT_GT(readlink("/proc/self/exe", self, sizeof self - 1), 0);
  const std::string command =
      "cd " + folder.path() + " && exec > out 2> err && " + before + " '" + self + "' --as " + arguments;
  EXPECT_EQ(std::system(command.c_str()) == 0, well) << before << " " << arguments;
  return {contents(folder.path() + "/out"), contents(folder.path() + "/err")};
}

/// Expects one line that begins or goes on so.
inline void expect_line(const std::string& text, const std::string& begin, const std::string& then = "") {
  EXPECT_EQ(lines(text).size(), 1u) << text;
  EXPECT_EQ(text.find(begin), 0u) << text;
  EXPECT_NE(text.find(then), std::string::npos) << text;
}

/// TRMESH returns the codes that STRIPACK documents, -5 and -4; five calls.
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
  if (trmesh(other).ier != 31) return false;
  return pstripack_trmesh(1 << 30, nullptr, nullptr, nullptr, nullptr, nullptr, nullptr, nullptr) ==
         PSTRIPACK_TOO_MANY_NODES;
}

/// Ends the program with code 1 unless the mesh is right and errno as before. ThreadSanitizer changes errno.
inline void call_trmesh(const Nodes& nodes) {
  errno = ENOTTY;
  const Mesh m = trmesh(nodes);
  if (!kThreadSanitizer && errno != ENOTTY) std::_Exit(1);
  if (!is_correct(nodes, m)) std::_Exit(1);
}

/// Calls TRMESH `count` times: on as many threads at once (action "threads"), behind a change of the folder
/// and without `variable` ("elsewhere"), before two calls in a forked child and another one here ("fork").
/// Returns an exit code.
inline int make_calls(const std::string& action, const Nodes& nodes, int count, const char* variable) {
  const auto call = [&nodes] { call_trmesh(nodes); };
  if (action == "threads") {
    std::vector<std::thread> threads;
    for (int i = 0; i < count; ++i) threads.emplace_back(call);
    for (auto& t : threads) t.join();
    return 0;
  }
  if (action == "elsewhere" && (chdir("/") != 0 || unsetenv(variable) != 0)) return 1;
  for (int i = 0; i < count; ++i) call();
  if (action != "fork") return 0;
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
