#pragma once
// A picture of the two meshes around each difference, side by side.

#include <string>
#include <vector>

#include "comparison.h"
#include "pictures/svg.h"

namespace comparison {

/// Each row has two panels, the original left and ours right. Arcs of both are grey, arcs of the original
/// alone red, arcs of ours alone blue; the circumcircle that decides is dashed.
class Plot {
 public:
  /// Throws std::invalid_argument unless it is called FILE.svg.
  explicit Plot(const std::string& file);

  /// Draws the differences that the result describes, up to the space of the picture.
  void add(const Result& result, const std::vector<pstripack::Point>& points);

  std::size_t rows() const { return rows_; }
  std::string svg() const;

  /// Throws std::runtime_error if the file cannot be written.
  void write() const;

 private:
  std::string file_;
  std::string body_;
  std::size_t rows_ = 0;
};

}  // namespace comparison
