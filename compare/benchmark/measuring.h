#pragma once
// How the benchmark measures: repeatedly, in child processes, taking medians.

#include <chrono>
#include <functional>
#include <string>
#include <vector>

#include "child_process.h"
#include "median.h"

namespace benchmark {

using Clock = std::chrono::steady_clock;
double seconds_since(Clock::time_point start);

struct Measurement {
  legacy_stripack::Outcome outcome;
  double seconds;
};

/// The result of `work`, which runs in its own process.
Measurement measure(const std::function<double()>& work, double time_limit);

/// The same; throws std::runtime_error if it does not end within half an hour.
double measured(const std::function<double()>& work);

double seconds_of(const std::function<void()>& call);
/// The mean time of `calls` calls after an unmeasured first one, for which the system clears pages. If the
/// first call takes 4 seconds or more, its time is returned.
double seconds_a_call(const std::function<void()>& call, int calls);

class Samples {
 public:
  void add(double seconds) { seconds_.push_back(seconds); }
  /// Fewer repeats of slow calls: at most three above 2 s, one above 30 s.
  bool enough(int repeats) const;
  bool empty() const { return seconds_.empty(); }
  double median() const { return ::median(seconds_); }

 private:
  std::vector<double> seconds_;
};

/// "0.2345"; "-" if there are no samples.
std::string microseconds(const Samples& samples, int n);

/// Of the medians; "-" if there are no samples.
std::string ratio(const Samples& a, const Samples& b);

/// Peak memory of `call` in bytes, for which this process must have called nothing before that keeps memory.
/// What it held before, with all arrays written, is subtracted.
double peak_bytes(const std::function<void()>& call);

/// The value of a key such as `VmHWM:` in /proc/self/status or /proc/meminfo, in bytes; NaN where
/// there are no such files.
double bytes_in(const std::string& file, const std::string& key);

/// The processor's name in /proc/cpuinfo.
std::string processor();

}  // namespace benchmark
