#pragma once
// The elements of a picture, 800 units wide and as high as needed.

#include <string>
#include <vector>

#include "pictures/svg.h"

namespace pictures {

constexpr double kWidth = 800;
constexpr const char* kBlack = "#222222";
constexpr const char* kGrey = "#777777";

enum class Anchor { start, middle, end };

/// What a text occupies.
struct Box {
  double left, top, right, bottom;
};
Box box_of(const Place& at, double size, Anchor anchor, const std::string& words);
bool overlap(const Box& a, const Box& b);

class Sheet {
 public:
  /// Adds elements unchanged.
  void add(const std::string& elements) { body_ += elements; }
  void text(const Place& at, double size, Anchor anchor, const std::string& words,
            const char* colour = kBlack);
  /// The same, moved into the sheet from its left and right border; nothing, and false, where it would
  /// overlap another text.
  bool text_if_free(Place at, double size, Anchor anchor, const std::string& words,
                    const char* colour = kBlack);
  /// A line in the middle: smaller, and at last shortened, if it is too long.
  void centred(double y, double size, const std::string& words, const char* colour = kBlack);
  void rectangle(double x, double y, double width, double height, const std::string& fill,
                 const char* stroke = "none", const char* kind = nullptr);
  /// Of the class `drawing`, which no text but numbers inside it overlaps.
  static constexpr const char* kDrawing = "drawing";
  /// `style`: further attributes. Nothing for an empty path.
  void path(const Path& path, const std::string& style);

  /// The title, if any; returns where it ends.
  double title(const std::string& words);

  /// The whole, `width` pixels wide.
  std::string svg(double height, double width) const;

 private:
  std::string body_;
  std::vector<Box> texts_;
};

}  // namespace pictures
