#pragma once
// Scales of axes and colour bars.

#include <string>
#include <vector>

namespace pictures {

/// A scale for some values, linear, or logarithmic if their ratio is large. Its ends are ticks.
class Scale {
 public:
  /// `values`: not empty. `about`: approximate number of steps between ticks.
  Scale(const std::vector<double>& values, int about);
  /// At most `about` steps; fewer if labels of font size `size` would overlap on `pixels` pixels. `exact`:
  /// its ends are the two values, which need not be ticks.
  static Scale fitting(const std::vector<double>& values, bool exact, int about, double pixels, double size);

  double operator()(double value) const;  ///< fraction of the range: 0 to 1

  struct Tick {
    double value;
    std::string label;
  };
  /// Ticks at round values. The first and the last are the ends of the range, unless they are
  /// exact. Label times
  /// factor() is the value.
  const std::vector<Tick>& ticks() const { return ticks_; }
  double factor() const;
  /// "" or "10⁻⁴ ", before the name of the unit.
  std::string name_of_factor() const;

 private:
  void add_linear_ticks(double low, double high, int about);
  void add_logarithmic_ticks(double low, double high, int about);
  bool fits(double pixels, double size) const;
  bool logarithmic_;
  double low_, high_;
  int exponent_ = 0;
  std::vector<Tick> ticks_;
};

/// The step, 1, 2 or 5 times a power of ten, that divides `length` into about `about` steps.
double round_step(double length, int about);

/// About the width of a line of DejaVu Sans, the font of all pictures, in the unit of `size`.
double text_width(const std::string& utf8, double size);

/// "10,242"
std::string grouped(std::size_t number);

}  // namespace pictures
