#include "pictures/scale.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace pictures {
namespace {

/// Values whose largest ratio exceeds this are shown on a logarithmic scale.
constexpr double kMuch = 20;

int exponent_of(double value) { return static_cast<int>(std::floor(std::log10(value))); }

}  // namespace

Scale::Scale(const std::vector<double>& values, bool always_linear) {
  const auto [least, most] = std::minmax_element(values.begin(), values.end());
  low_ = *least, high_ = *most;
  logarithmic_ = !always_linear && low_ > 0 && high_ > kMuch * low_;
  if (high_ - low_ <= 1e-9 * std::fabs(high_)) {  // all the same but for rounding
    const double around = high_ == 0 ? 1 : 0.1 * std::fabs(high_);
    low_ -= around, high_ += around;
  }
  if (high_ <= 0 || decades_only()) return;
  const double typical = logarithmic_ ? std::sqrt(low_ * high_) : high_;
  if (typical < 0.01 || typical >= 1e5) exponent_ = exponent_of(typical);
}

bool Scale::decades_only() const { return logarithmic_ && high_ > 300 * low_; }

double Scale::operator()(double value) const {
  return logarithmic_ ? std::log(value / low_) / std::log(high_ / low_) : (value - low_) / (high_ - low_);
}

double Scale::value_at(double t) const {
  return logarithmic_ ? low_ * std::pow(high_ / low_, t) : low_ + t * (high_ - low_);
}

std::vector<Scale::Tick> Scale::ticks(int about) const {
  std::vector<Tick> result;
  if (!logarithmic_) {
    const double unit = factor();
    const std::vector<double> values = round_values(low_ / unit, high_ / unit, about);
    const double step = values.size() < 2 ? 1 : values[1] - values[0];
    const int decimals = std::max(0, -static_cast<int>(std::floor(std::log10(step) + 1e-6)));
    for (const double value : values)
      result.push_back({value * unit, fmt::format("{:.{}f}", value, decimals)});
    return result;
  }
  const int first = exponent_of(low_), last = exponent_of(high_);
  const int step = decades_only() ? 1 + (last - first) / (about + 1) : 1;
  for (int e = first; e <= last; e += step)
    for (const int digit : {1, 2, 5}) {
      const double value = digit * std::pow(10, e);
      if (value < low_ * (1 - 1e-9) || value > high_ * (1 + 1e-9) || (decades_only() && digit > 1)) continue;
      result.push_back({value, decades_only() ? power_of_ten(e)
                                              : fmt::format("{:g}", digit * std::pow(10, e - exponent_))});
    }
  return result;
}

double Scale::factor() const { return std::pow(10, exponent_); }

std::string Scale::name_of_factor() const { return exponent_ == 0 ? "" : power_of_ten(exponent_) + " "; }

std::vector<double> round_values(double low, double high, int about) {
  const double rough = (high - low) / about;
  double step = std::pow(10, exponent_of(rough));
  for (const int factor : {2, 5, 10})
    if (step < rough && factor * std::pow(10, exponent_of(rough)) <= rough * 1.5)
      step = factor * std::pow(10, exponent_of(rough));
  std::vector<double> values;
  for (double k = std::ceil(low / step - 1e-9); k * step <= high + 1e-9 * step; ++k)
    values.push_back(k == 0 ? 0 : k * step);
  return values;
}

std::string grouped(std::size_t number) {
  std::string text = std::to_string(number);
  for (std::size_t at = text.size(); at > 3;) text.insert(at -= 3, ",");
  return text;
}

std::string power_of_ten(int exponent) {
  if (exponent == 0) return "1";
  static const char* const digits[] = {"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
  std::string text = exponent < 0 ? "10⁻" : "10";
  for (const char c : std::to_string(std::abs(exponent))) text += digits[c - '0'];
  return text;
}

std::string short_number(double value) {
  const double size = std::fabs(value);
  if (size == 0 || (size >= 0.001 && size < 1e5)) return fmt::format("{:.4g}", value);
  const int exponent = exponent_of(size);
  return fmt::format("{:.4g}·{}", value / std::pow(10, exponent), power_of_ten(exponent));
}

}  // namespace pictures
