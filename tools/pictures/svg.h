#pragma once
// The text of SVG: for `pstripack plot` and `stripack-compare --plot`.

#include <climits>
#include <cmath>
#include <string>

namespace pictures {

/// A place in the picture in pixels, to the right and down.
struct Place {
  double x, y;
};

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
