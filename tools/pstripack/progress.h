#pragma once
// Progress on stderr: on a terminal one line that is updated, otherwise one line every ten seconds.

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <string>
#include <thread>
#include <utility>
#include <vector>

namespace program {

/// Prints "pstripack: text" on stderr, unless --quiet.
void say(const std::string& text);

/// The steps of a command and their times.
class Progress {
 public:
  Progress();
  ~Progress();
  Progress(const Progress&) = delete;
  Progress& operator=(const Progress&) = delete;

  /// Runs work() as a step; meanwhile reports `doing`.
  template <class Work>
  auto step(const char* doing, const Work& work) {
    begin(doing);
    struct End {
      Progress& progress;
      ~End() { progress.end(); }
    } at_end{*this};
    return work();
  }

  /// Changes what is reported during the current step.
  void now(std::string doing);

  /// Prints the last line: `what` and the seconds of each step.
  void finish(const std::string& what);

 private:
  using Clock = std::chrono::steady_clock;
  void begin(const char* step);
  void end();
  void report();
  double seconds() const { return std::chrono::duration<double>(Clock::now() - start_).count(); }

  const bool on_terminal_;
  std::string step_, doing_;  ///< empty: no step is running
  Clock::time_point start_;
  std::vector<std::pair<std::string, double>> steps_;
  bool ends_ = false;
  std::mutex mutex_;
  std::condition_variable wake_;
  std::thread reporter_;
};

}  // namespace program
