#pragma once
// The elements of a picture, at most 800 units wide and as high as needed.

#include <algorithm>
#include <string>

#include "pictures/svg.h"

namespace pictures {

constexpr double kWidth = 800, kNarrow = 300;
constexpr const char* kBlack = "#222222";
constexpr const char* kGrey = "#777777";

enum class Anchor { start, middle, end };

class Sheet {
 public:
  /// A picture of fewer pixels than kWidth is drawn in pixels, so that its texts stay readable; one of fewer
  /// than kNarrow, or of more than kWidth, is scaled.
  explicit Sheet(double pixels) : width_(std::clamp(pixels, kNarrow, kWidth)), pixels_(pixels) {}
  double width() const { return width_; }

  /// Adds elements unchanged.
  void add(const std::string& elements) { body_ += elements; }
  void text(const Place& at, double size, Anchor anchor, const std::string& words,
            const char* colour = kBlack);
  /// A centred line, smaller if it is too long.
  void centred(double y, double size, const std::string& words);
  void rectangle(double x, double y, double width, double height, const std::string& fill,
                 const char* stroke = "none");
  /// A coloured square and what it stands for, cut off beyond `width`.
  void key(double x, double y, double width, const std::string& colour, const std::string& words);
  /// Adds a path unless it is empty. `style`: further attributes.
  void path(const Path& path, const std::string& style);

  /// The complete SVG.
  std::string svg(double height) const;

 private:
  double width_, pixels_;
  std::string body_;
};

}  // namespace pictures
