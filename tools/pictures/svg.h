#pragma once
// Pictures as SVG, or PNG made of it: for `pstripack plot` and `stripack-compare --plot`.

#include <climits>
#include <cmath>
#include <optional>
#include <string>

#include "files/output_file.h"
#include "pictures/place.h"

namespace pictures {

enum class Kind { svg, png };

/// By the suffix of the file: .svg or .png.
std::optional<Kind> kind_of(const std::string& file);

/// Throws std::runtime_error if PNG is requested and rsvg-convert, which makes it, is missing.
void expect_converter(Kind kind);

/// Writes the picture; the caller calls commit(). Throws std::runtime_error if it cannot be written.
void write(files::OutputFile& file, Kind kind, const std::string& svg);

/// The text for an attribute or element of XML; it may contain any bytes.
std::string escaped_for_xml(const std::string& text);

/// The data of a <path>, in hundredths of a pixel. Pieces shorter than that are left out.
class Path {
 public:
  void move(const Place& p);
  void line(const Place& p);
  void close() {
    data_ += 'Z';
    last_ = kNowhere;
  }
  /// A dot: round and as wide as the line if stroke-linecap is "round".
  void dot(const Place& p) {
    move(p);
    data_ += "h0";
  }
  bool empty() const { return data_.empty(); }
  const std::string& data() const { return data_; }

 private:
  struct Hundredths {
    long x, y;
  };
  static Hundredths rounded(const Place& p) { return {std::lround(100 * p.x), std::lround(100 * p.y)}; }
  void add(char command, const Hundredths& p);
  std::string data_;
  static constexpr Hundredths kNowhere{LONG_MIN, LONG_MIN};
  Hundredths last_ = kNowhere;
};

}  // namespace pictures
