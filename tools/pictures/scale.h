#pragma once
// Axes and colour bars.

#include <string>
#include <vector>

namespace pictures {

/// The range of some values, linear or, if their ratio is large, logarithmic. It begins and ends at ticks.
class Scale {
 public:
  /// `values`: not empty. About `about` steps between ticks. `always_linear`: for values with a known range,
  /// such as angles.
  Scale(const std::vector<double>& values, int about, bool always_linear = false);
  /// With at most `about` steps, fewer where labels of this size would overlap on so many pixels.
  static Scale fitting(const std::vector<double>& values, int about, double pixels, double size,
                       bool always_linear = false);

  double operator()(double value) const;  ///< 0 to 1 for those values

  struct Tick {
    double value;
    std::string label;
  };
  /// At round values: the first is the least value of the range, the last the largest. Labels are to be
  /// multiplied by factor().
  const std::vector<Tick>& ticks() const { return ticks_; }
  double factor() const;
  /// "" or "10⁻⁴ ", before the name of the unit.
  std::string name_of_factor() const;

 private:
  void add_linear_ticks(double low, double high, int about);
  void add_logarithmic_ticks(double low, double high, int about);
  bool fits(double pixels, double size) const;
  bool logarithmic_;
  int exponent_ = 0;
  std::vector<Tick> ticks_;
};

/// The step, 1, 2 or 5 times a power of ten, that divides a range of this length into about so many.
double round_step(double length, int about);

/// "10,242"
std::string grouped(std::size_t number);

/// "10⁻⁴"
std::string power_of_ten(int exponent);

/// With four significant digits, in exponential form only for very small and very large numbers.
std::string short_number(double value);

}  // namespace pictures
