#pragma once
// Estimate of the remaining time of an iteration.

#include <cstddef>
#include <deque>
#include <optional>

namespace methods {

/// Estimates when the gradient will have fallen to a tolerance. There is an estimate only if the gradient
/// fell similarly fast in the older and the newer half of the last steps.
class TimeLeft {
 public:
  explicit TimeLeft(double tolerance) : tolerance_(tolerance) {}

  /// To be called after each step. `seconds`: time since the beginning.
  void add(double seconds, double gradient);
  /// The remaining seconds.
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
