#pragma once
// How the benchmark measures: repeatedly, in child processes, taking medians.

#include <chrono>
#include <functional>
#include <string>
#include <vector>

#include "child_process.h"

namespace benchmark {

using Clock = std::chrono::steady_clock;
double seconds_since(Clock::time_point start);

struct Measurement {
  legacy_stripack::Outcome outcome;
  double seconds;
};

/// The result of `work`, which runs in its own process.
Measurement measure(const std::function<double()>& work, double time_limit);

/// The same, but throws std::runtime_error if it does not end within half an hour.
double measured(const std::function<double()>& work);

/// The mean of `calls` calls after the first, for which the system clears pages; if the first takes 4 seconds
/// or more, its time.
double seconds_a_call(const std::function<void()>& call, int calls);

class Samples {
 public:
  void add(double seconds) { seconds_.push_back(seconds); }
  /// Fewer repeats of slow calls: at most three above 2 s, one above 30 s.
  bool enough(int repeats) const;
  bool empty() const { return seconds_.empty(); }
  std::size_t size() const { return seconds_.size(); }
  double median() const;

 private:
  std::vector<double> seconds_;
};

/// Adds the result of `seconds`, which makes some calls in a row: see in_a_row.h.
void measure_in_a_row(Samples& samples, const std::function<double()>& seconds);

/// "0.2345", "-" without samples.
std::string microseconds(const Samples& samples, int n);

/// A figure such as `VmHWM:` of /proc/self/status or /proc/meminfo, in bytes.
double bytes_in(const std::string& file, const std::string& key);

/// As /proc/cpuinfo names it.
std::string processor();

}  // namespace benchmark
