#include "pictures/scale.h"

#include <algorithm>
#include <charconv>
#include <cmath>

namespace pictures {
namespace {

/// Values whose largest ratio exceeds this are shown on a logarithmic scale.
constexpr double kMuch = 20;
/// Above this ratio only powers of ten are labelled.
constexpr double kDecades = 300;
/// Values are limited to this range: otherwise differences and powers of ten might overflow.
constexpr double kLeast = 1e-300, kLargest = 1e300;
/// Tolerance for rounding, as a fraction of a step.
constexpr double kRounding = 1e-6;

double within_range(double value) {
  return std::fabs(value) < kLeast ? 0 : std::clamp(value, -kLargest, kLargest);
}

/// The number as printf writes it by %f or %g, in any locale.
std::string printed(std::chars_format format, int precision, double value) {
  char text[400];  // 1e300 has 301 digits
  return {text, std::to_chars(text, text + sizeof text, value, format, precision).ptr};
}

/// "10⁻⁴"
std::string power_of_ten(int exponent) {
  if (exponent == 0) return "1";
  static const char* const digits[] = {"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
  std::string text = exponent < 0 ? "10⁻" : "10";
  for (const char c : std::to_string(std::abs(exponent))) text += digits[c - '0'];
  return text;
}

int exponent_of(double value) { return static_cast<int>(std::floor(std::log10(value))); }

}  // namespace

Scale::Scale(const std::vector<double>& values, int about) {
  const auto [least, most] = std::minmax_element(values.begin(), values.end());
  double low = within_range(*least), high = within_range(*most);
  logarithmic_ = low > 0 && high > kMuch * low;
  if (high - low <= 1e-9 * std::fabs(high)) {  // all equal up to rounding
    const double around = high == 0 ? 1 : 0.1 * std::fabs(high);
    low -= around, high += around;
  }
  if (!logarithmic_ || high <= kDecades * low) {
    const double largest = std::max(std::fabs(low), std::fabs(high));
    if (largest < 0.01 || largest >= 1e5)
      exponent_ = exponent_of(logarithmic_ ? std::sqrt(low * high) : largest);
  }
  if (logarithmic_)
    add_logarithmic_ticks(low, high, about);
  else
    add_linear_ticks(low, high, about);
  low_ = ticks_.front().value, high_ = ticks_.back().value;
}

void Scale::add_linear_ticks(double low, double high, int about) {
  const double unit = factor(), step = round_step((high - low) / unit, about);
  const int decimals = std::max(0, -static_cast<int>(std::floor(std::log10(step) + kRounding)));
  const double first = std::floor(low / unit / step + kRounding),
               last = std::ceil(high / unit / step - kRounding);
  for (double k = first; k <= last; ++k)
    ticks_.push_back(
        {k == 0 ? 0 : k * step * unit, printed(std::chars_format::fixed, decimals, k == 0 ? 0 : k * step)});
}

void Scale::add_logarithmic_ticks(double low, double high, int about) {
  const int first = static_cast<int>(std::floor(std::log10(low) + kRounding)),
            last = static_cast<int>(std::ceil(std::log10(high) - kRounding));
  if (high > kDecades * low) {
    const int step = (last - first + about - 1) / about;
    for (int e = first; e < last + step; e += step) ticks_.push_back({std::pow(10, e), power_of_ten(e)});
    return;
  }
  const bool close = about > 3;  // ticks
  for (int e = first; e <= last; ++e)
    for (const int digit : {1, 2, 5}) {
      if (digit > 1 && !close) continue;
      const double value = digit * std::pow(10, e);
      if (value < low * (1 + kRounding)) ticks_.clear();  // a later tick is nearer to the least value
      if (ticks_.empty() || ticks_.back().value < high * (1 - kRounding))
        ticks_.push_back(
            {value, printed(std::chars_format::general, 6, digit * std::pow(10, e - exponent_))});
    }
}

bool Scale::fits(double pixels, double size) const {
  constexpr double kGap = 6;
  for (std::size_t i = 1; i < ticks_.size(); ++i) {
    const double widths = text_width(ticks_[i - 1].label, size) + text_width(ticks_[i].label, size);
    if (pixels * ((*this)(ticks_[i].value) - (*this)(ticks_[i - 1].value)) < widths / 2 + kGap) return false;
  }
  return true;
}

Scale Scale::fitting(const std::vector<double>& values, bool exact, int about, double pixels, double size) {
  for (;; --about) {
    Scale scale(values, about);
    if (exact) {
      scale.low_ = values.front(), scale.high_ = values.back();
      const double rounding = kRounding * (scale.high_ - scale.low_);
      const auto is_outside = [&](const Tick& t) {
        return t.value < scale.low_ - rounding || t.value > scale.high_ + rounding;
      };
      scale.ticks_.erase(std::remove_if(scale.ticks_.begin(), scale.ticks_.end(), is_outside),
                         scale.ticks_.end());
    }
    if (about == 1 || scale.fits(pixels, size)) return scale;
  }
}

double Scale::operator()(double value) const {
  if (logarithmic_ && value <= low_) return 0;
  return std::clamp(
      logarithmic_ ? std::log(value / low_) / std::log(high_ / low_) : (value - low_) / (high_ - low_), 0.0,
      1.0);
}

double Scale::factor() const { return std::pow(10, exponent_); }

std::string Scale::name_of_factor() const { return exponent_ == 0 ? "" : power_of_ten(exponent_) + " "; }

double round_step(double length, int about) {
  const double rough = length / about, power = std::pow(10, exponent_of(rough));
  double step = power;
  for (const int factor : {2, 5, 10})
    if (step < rough && factor * power <= rough * 1.5) step = factor * power;
  return step;
}

double text_width(const std::string& utf8, double size) {
  const auto letters = std::count_if(utf8.begin(), utf8.end(), [](char c) { return (c & 0xc0) != 0x80; });
  return 0.62 * size * static_cast<double>(letters);
}

std::string grouped(std::size_t number) {
  std::string text = std::to_string(number);
  for (std::size_t at = text.size(); at > 3;) text.insert(at -= 3, ",");
  return text;
}

}  // namespace pictures
