#pragma once
// The sphere on paper. Arcs of great circles stay arcs: they are cut into pieces that look straight.

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "geometry/point.h"
#include "pictures/svg.h"

namespace pictures {

using pstripack::Point;
using Outline = std::vector<Place>;

/// A rectangle of paper.
struct Frame {
  double left, top, right, bottom;
  double width() const { return right - left; }
  double height() const { return bottom - top; }
};

/// The part of an outline in the frame. Where it leaves and re-enters, it follows the frame's border.
Outline clipped_polygon(const Outline& outline, const Frame& frame);
/// The parts of a line in the frame.
std::vector<Outline> clipped_line(const Outline& line, const Frame& frame);

/// Degrees.
struct Spot {
  double lon, lat;
};
Spot spot_of(const Point& p);
/// "12.5°W 40°N"
std::string name_of(const Spot& spot, int decimals = 2);
std::string name_of_longitude(double lon, int decimals = 2);
std::string name_of_latitude(double lat, int decimals = 2);

/// A map of directions: unit vectors.
class View {
 public:
  virtual ~View() = default;

  /// The paper that it fills, or a circle in that.
  const Frame& frame() const { return frame_; }

  /// In the middle of the picture: pixels per radian of the sphere, to the north.
  virtual double scale() const = 0;
  /// The position of a point, if visible.
  virtual std::optional<Place> place(const Point& p) const = 0;
  /// The visible part of a convex polygon, corners counterclockwise: closed outlines.
  virtual std::vector<Outline> polygon(const std::vector<Point>& corners) const = 0;
  /// The visible part of an arc shorter than half a great circle.
  virtual std::vector<Outline> arc(const Point& a, const Point& b) const = 0;

 protected:
  Frame frame_{};
};

/// From infinitely far above `centre`: as far as `radius` degrees around it, at most 90, which is half the
/// sphere. `frame`: where it may be; it is the largest square there.
class Orthographic : public View {
 public:
  Orthographic(const Spot& centre, double radius, const Frame& frame);

  bool shows_limb() const { return shows_limb_; }
  Place middle() const { return middle_; }
  double scale() const override { return scale_; }

  std::optional<Place> place(const Point& p) const override;
  std::vector<Outline> polygon(const std::vector<Point>& corners) const override;
  std::vector<Outline> arc(const Point& a, const Point& b) const override;

 private:
  Point turned(const Point& p) const { return {dot(p, east_), dot(p, north_), dot(p, eye_)}; }
  Place on_paper(const Point& t) const { return {middle_.x + scale_ * t.x, middle_.y - scale_ * t.y}; }
  void add_arc(const Point& a, const Point& b, Outline& outline, int depth = 0) const;

  Point eye_, east_, north_;
  Place middle_;
  double scale_;
  bool shows_limb_;
};

/// Longitude to the right, latitude upwards, in equal steps: what lies within `radius` degrees of `centre`
/// and the rest of that rectangle; from 90 on the whole sphere, cut opposite the centre. `frame`: its width
/// is kept, its height follows, but for that the height is not exceeded.
class LonLat : public View {
 public:
  LonLat(const Spot& centre, double radius, const Frame& frame);

  double west() const { return west_; }
  double east() const { return east_; }
  double south() const { return south_; }
  double north() const { return north_; }
  double scale() const override;
  Place on_paper(const Spot& s) const {
    return {frame_.left + (s.lon - west_) * per_lon_, frame_.bottom - (s.lat - south_) * per_lat_};
  }

  std::optional<Place> place(const Point& p) const override;
  std::vector<Outline> polygon(const std::vector<Point>& corners) const override;
  std::vector<Outline> arc(const Point& a, const Point& b) const override;

 private:
  class Unrolled;
  double west_, east_, south_, north_;
  double per_lon_, per_lat_;  ///< pixels a degree
};

}  // namespace pictures
