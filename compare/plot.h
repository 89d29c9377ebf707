#pragma once
// The meshes around each difference, side by side, as a picture.

#include <string>
#include <vector>

#include "comparison.h"
#include "pictures/svg.h"

namespace comparison {

/// Rows of two panels, the original left and ours right: arcs grey, those that only the original has red,
/// those that only ours has blue, and dashed the circumscribed circle that decides.
class Plot {
 public:
  /// FILE.svg, or FILE.png where rsvg-convert is installed; throws std::invalid_argument for anything else.
  explicit Plot(const std::string& file);

  /// Draws the differences that the result describes, as long as there is space.
  void add(const Result& result, const std::vector<pstripack::Point>& points);

  std::size_t rows() const { return rows_; }
  std::string svg() const;

  /// Throws std::runtime_error if the file cannot be written.
  void write() const;

 private:
  std::string file_;
  pictures::Kind kind_;
  std::string body_;
  std::size_t rows_ = 0;
};

}  // namespace comparison
