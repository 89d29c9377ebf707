#pragma once
// Axes and colour bars.

#include <string>
#include <vector>

namespace pictures {

/// The range of some values, linear or, if their ratio is large, logarithmic.
class Scale {
 public:
  /// Not empty; finite. Always linear: for values with a known range, such as angles.
  explicit Scale(const std::vector<double>& values, bool always_linear = false);

  double operator()(double value) const;  ///< 0 to 1 for those values
  double low() const { return low_; }
  double high() const { return high_; }
  double value_at(double t) const;

  struct Tick {
    double value;
    std::string label;
  };
  /// At round values, about `about` of them. Labels are to be multiplied by factor().
  std::vector<Tick> ticks(int about) const;
  double factor() const;
  /// "" or "10⁻⁴ ", before the name of the unit.
  std::string name_of_factor() const;

 private:
  bool decades_only() const;
  double low_, high_;
  bool logarithmic_;
  int exponent_ = 0;
};

/// Round values from `low` to `high` in equal steps of 1, 2 or 5 times a power of ten.
std::vector<double> round_values(double low, double high, int about);

/// "10,242"
std::string grouped(std::size_t number);

/// "10⁻⁴"
std::string power_of_ten(int exponent);

/// With this many significant digits, in exponential form only for very small and very large numbers.
std::string short_number(double value);

}  // namespace pictures
