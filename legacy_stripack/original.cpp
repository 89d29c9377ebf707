#include "original.h"

#include <algorithm>
#include <chrono>
#include <cstring>
#include <sstream>

namespace legacy_stripack {
namespace {

constexpr int kMaxCalls = 1000;
constexpr double kEnoughSeconds = 10;

struct Report {
  int ier, lnew;
  int calls_done;  // written last
  double seconds[kMaxCalls];
};

}  // namespace

std::optional<Location> configured_original() {
#ifdef ORIGINAL_FILE
  return Location{ORIGINAL_NAME, ORIGINAL_FILE, abi_named(ORIGINAL_ABI)};
#else
  return std::nullopt;
#endif
}

Triangulation Original::triangulate(const std::vector<double>& x, const std::vector<double>& y,
                                    const std::vector<double>& z, double time_limit, int calls) const {
  using Clock = std::chrono::steady_clock;
  const int n = static_cast<int>(x.size());
  const std::size_t slots = n < 3 ? 0 : 6 * static_cast<std::size_t>(n) - 12;
  calls = std::clamp(calls, 1, kMaxCalls);

  Shared<volatile Report> report;
  Shared<int> shared(2 * slots + x.size() + 1);

  const Ended ended = run_in_child(
      [&] {
        // Ordinary memory, written before the clock starts, as in a model that has called TRMESH before.
        std::vector<int> list(slots), lptr(slots), lend(x.size()), near(x.size()), next(x.size());
        std::vector<double> dist(x.size());
        const auto first_start = Clock::now();
        for (int call = 0; call < calls; ++call) {
          if (std::chrono::duration<double>(Clock::now() - first_start).count() > kEnoughSeconds) break;
          int ier = 0, lnew = 0;
          const auto start = Clock::now();
          library_.trmesh(&n, x.data(), y.data(), z.data(), list.data(), lptr.data(), lend.data(), &lnew,
                          near.data(), next.data(), dist.data(), &ier);
          report->seconds[call] = std::chrono::duration<double>(Clock::now() - start).count();
          if (call == 0) {
            report->ier = ier;
            report->lnew = lnew;
            int* to = std::copy(list.begin(), list.end(), shared.data());
            to = std::copy(lptr.begin(), lptr.end(), to);
            std::copy(lend.begin(), lend.end(), to);
          }
          __atomic_store_n(&report->calls_done, call + 1, __ATOMIC_RELEASE);
        }
      },
      time_limit);

  Triangulation result;
  const int done = __atomic_load_n(&report->calls_done, __ATOMIC_ACQUIRE);
  if (ended.outcome != Outcome::returned && done == 0) {
    result.outcome = ended.outcome;
    result.signal = ended.signal;
    return result;
  }
  result.ier = report->ier;
  result.lnew = report->lnew;
  const int* from = shared.data();
  result.list.assign(from, from + slots);
  result.lptr.assign(from + slots, from + 2 * slots);
  result.lend.assign(from + 2 * slots, from + 2 * slots + x.size());
  std::vector<double> seconds(done);
  for (int call = 0; call < done; ++call) seconds[call] = report->seconds[call];
  std::nth_element(seconds.begin(), seconds.begin() + done / 2, seconds.end());
  result.seconds = seconds[done / 2];
  return result;
}

std::string describe(const Triangulation& result, double time_limit) {
  std::ostringstream text;
  switch (result.outcome) {
    case Outcome::returned:
      text << "returned";
      break;
    case Outcome::timed_out:
      text << "did not return within " << time_limit << " s";
      break;
    case Outcome::crashed:
      text << "crashed (signal " << result.signal << ", " << strsignal(result.signal) << ")";
      break;
    case Outcome::stopped:
      text << "stopped the program";
      break;
  }
  return text.str();
}

}  // namespace legacy_stripack
