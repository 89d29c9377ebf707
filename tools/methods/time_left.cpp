#include "methods/time_left.h"

#include <cmath>

namespace methods {

void TimeLeft::add(double seconds, double gradient) {
  steps_.push_back({seconds, std::log(gradient)});
  if (steps_.size() > kSteps) steps_.pop_front();
}

std::optional<double> TimeLeft::seconds() const {
  if (steps_.size() < kSteps || !(tolerance_ > 0)) return std::nullopt;
  const Step &first = steps_.front(), &middle = steps_[kSteps / 2], &last = steps_.back();
  const double older = first.log_gradient - middle.log_gradient,
               newer = middle.log_gradient - last.log_gradient;
  if (!(older > 0 && newer > 0 && older < 2 * newer && newer < 2 * older)) return std::nullopt;
  return (last.seconds - first.seconds) * (last.log_gradient - std::log(tolerance_)) / (older + newer);
}

}  // namespace methods
