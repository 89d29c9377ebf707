#pragma once
// Progress on stderr: on a terminal one line that is updated, otherwise one line every ten seconds.

#include <chrono>
#include <string>
#include <utility>
#include <vector>

namespace program {

/// Prints "pstripack: text" on stderr, unless --quiet.
void say(const std::string& text);

/// The steps of a command and their times.
class Progress {
 public:
  /// Runs work() as a step.
  template <class Work>
  auto step(const char* doing, const Work& work) {
    begin(doing);
    struct End {
      Progress& progress;
      ~End() { progress.end(); }
    } at_end{*this};
    return work();
  }

  /// Reports what is done during the current step, and its seconds.
  void now(const std::string& doing);

  /// Prints the last line: `what` and the seconds of each step.
  void finish(const std::string& what);

 private:
  using Clock = std::chrono::steady_clock;
  void begin(const char* step);
  void end();
  double seconds() const { return std::chrono::duration<double>(Clock::now() - start_).count(); }

  Clock::time_point start_, told_;  ///< of the step, and of the last report
  std::vector<std::pair<std::string, double>> steps_;
};

}  // namespace program
