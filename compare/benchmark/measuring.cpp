#include "measuring.h"

#include <fmt/format.h>
#if defined(__GLIBC__)
#include <malloc.h>
#endif

#include <algorithm>
#include <fstream>
#include <limits>

namespace benchmark {

using legacy_stripack::Outcome;

double seconds_since(Clock::time_point start) {
  return std::chrono::duration<double>(Clock::now() - start).count();
}

Measurement measure(const std::function<double()>& work, double time_limit) {
  legacy_stripack::Shared<double> seconds;
  const auto ended = legacy_stripack::run_in_child([&] { seconds[0] = work(); }, time_limit);
  return {ended.outcome, seconds[0]};
}

double measured(const std::function<double()>& work) {
  constexpr double kTimeLimit = 1800;
  const Measurement m = measure(work, kTimeLimit);
  if (m.outcome != Outcome::returned)
    throw std::runtime_error("a measurement crashed or exceeded its time limit");
  return m.seconds;
}

double seconds_of(const std::function<void()>& call) {
  const auto start = Clock::now();
  call();
  return seconds_since(start);
}

double seconds_a_call(const std::function<void()>& call, int calls) {
  const double first = seconds_of(call);
  constexpr double kLong = 4;
  if (first >= kLong) return first;
  const auto start = Clock::now();
  for (int i = 0; i < calls; ++i) call();
  return seconds_since(start) / calls;
}

bool Samples::enough(int repeats) const {
  const double first = seconds_.empty() ? 0 : seconds_.front();
  const int most = first > 30 ? 1 : first > 2 ? 3 : repeats;
  return static_cast<int>(seconds_.size()) >= std::min(repeats, most);
}

std::string microseconds(const Samples& samples, int n) {
  return samples.empty() ? "-" : fmt::format("{:.4f}", 1e6 * samples.median() / n);
}

std::string ratio(const Samples& a, const Samples& b) {
  return a.empty() || b.empty() ? "-" : fmt::format("{:.2f}", a.median() / b.median());
}

double peak_bytes(const std::function<void()>& call) {
#if defined(__GLIBC__)
  malloc_trim(0);  // otherwise freed memory would be reused without being counted
#endif
  std::ofstream("/proc/self/clear_refs") << "5";  // resets the peak to the current size
  const auto peak = [] { return bytes_in("/proc/self/status", "VmHWM:"); };
  const double before = peak();
  call();
  return peak() - before;
}

double bytes_in(const std::string& file, const std::string& key) {
  std::ifstream figures(file);
  std::string word;
  double kilobytes;
  while (figures >> word)
    if (word == key && figures >> kilobytes) return 1024 * kilobytes;
  return std::numeric_limits<double>::quiet_NaN();
}

std::string processor() {
  std::ifstream info("/proc/cpuinfo");
  std::string line;
  while (std::getline(info, line))
    if (line.rfind("model name", 0) == 0) return line.substr(line.find(':') + 2);
  return "unknown processor";
}

}  // namespace benchmark
