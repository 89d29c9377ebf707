#pragma once
// How long an iteration will last.

#include <cstddef>
#include <deque>
#include <optional>

namespace methods {

/// Of an iteration whose gradient falls to a tolerance. Only where the gradient fell alike in the older and
/// the newer half of the last steps is there an estimate.
class TimeLeft {
 public:
  explicit TimeLeft(double tolerance) : tolerance_(tolerance) {}

  /// After each step: the time since the beginning.
  void add(double seconds, double gradient);
  /// In seconds.
  std::optional<double> seconds() const;

 private:
  struct Step {
    double seconds, log_gradient;
  };
  static constexpr std::size_t kSteps = 41;

  double tolerance_;
  std::deque<Step> steps_;  ///< the last ones
};

}  // namespace methods
