#pragma once
// The elements of a picture, 800 units wide and as high as needed.

#include <string>

#include "pictures/svg.h"

namespace pictures {

constexpr double kWidth = 800;
constexpr const char* kBlack = "#222222";
constexpr const char* kGrey = "#777777";

enum class Anchor { start, middle, end };

class Sheet {
 public:
  /// Adds elements unchanged.
  void add(const std::string& elements) { body_ += elements; }
  void text(const Place& at, double size, Anchor anchor, const std::string& words,
            const char* colour = kBlack);
  void rectangle(double x, double y, double width, double height, const std::string& fill,
                 const char* stroke = "none");
  /// `style`: further attributes. Nothing for an empty path.
  void path(const Path& path, const std::string& style);

  /// The title, if any; returns where it ends.
  double title(const std::string& words);

  /// The whole, `width` pixels wide.
  std::string svg(double height, double width) const;

 private:
  std::string body_;
};

}  // namespace pictures
