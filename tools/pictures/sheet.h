#pragma once
// The elements of a picture, at most 800 units wide and as high as needed.

#include <algorithm>
#include <string>
#include <vector>

#include "pictures/svg.h"

namespace pictures {

constexpr double kWidth = 800, kNarrow = 300;
constexpr const char* kBlack = "#222222";
constexpr const char* kGrey = "#777777";

enum class Anchor { start, middle, end };

/// The rectangle of a text.
struct Box {
  double left, top, right, bottom;
};
Box box_of(const Place& at, double size, Anchor anchor, const std::string& words);
bool overlap(const Box& a, const Box& b);

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
  /// Adds a text, moved away from the left and right border of the sheet. False, adding nothing, if it would
  /// overlap another text.
  bool text_if_free(Place at, double size, Anchor anchor, const std::string& words,
                    const char* colour = kBlack);
  /// A centred line. A line that is too long is made smaller, then shortened.
  void centred(double y, double size, const std::string& words, const char* colour = kBlack);
  void rectangle(double x, double y, double width, double height, const std::string& fill,
                 const char* stroke = "none", const char* kind = nullptr);
  /// Class of the border of a drawing. Only numbers inside the drawing may overlap it.
  static constexpr const char* kDrawing = "drawing";
  /// Adds a path unless it is empty. `style`: further attributes.
  void path(const Path& path, const std::string& style);

  /// Adds the title, if it is not empty; returns its lower end.
  double title(const std::string& words);

  /// The complete SVG.
  std::string svg(double height) const;

 private:
  double width_, pixels_;
  std::string body_;
  std::vector<Box> texts_;
};

}  // namespace pictures
