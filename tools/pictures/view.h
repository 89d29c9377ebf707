#pragma once
// Projections of the sphere. Arcs of great circles are cut into pieces that look straight.

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "files/clipping.h"
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

/// Degrees.
struct Spot {
  double lon, lat;
};
Spot spot_of(const Point& p);
/// "12.5°W", "40°N"
std::string name_of_longitude(double lon, int decimals = 2);
std::string name_of_latitude(double lat, int decimals = 2);

/// A map of the sphere's directions, given as unit vectors.
class View {
 public:
  virtual ~View() = default;

  /// The rectangle that the view fills, or whose inscribed circle it fills.
  const Frame& frame() const { return frame_; }
  /// What it shows, or somewhat more.
  const files::Region& bounds() const { return bounds_; }
  /// Its border is a circle.
  bool is_disc() const { return is_disc_; }

  /// Pixels per radian, northwards from the middle of the picture.
  virtual double scale() const = 0;
  /// The position of a point, if it is visible.
  virtual std::optional<Place> place(const Point& p) const = 0;
  /// The visible part of a convex polygon with counterclockwise corners, as closed outlines.
  virtual std::vector<Outline> polygon(const std::vector<Point>& corners) const = 0;
  /// The visible part of an arc shorter than half a great circle.
  virtual std::vector<Outline> arc(const Point& a, const Point& b) const = 0;

 protected:
  Frame frame_{};
  files::Region bounds_;
  bool is_disc_ = false;
};

/// The view from infinitely far above `centre`, up to `radius` degrees around it; at most 90, half of the
/// sphere. It is the largest square inside `frame`.
class Orthographic : public View {
 public:
  Orthographic(const Spot& centre, double radius, const Frame& frame);

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
};

/// Longitude to the right, latitude upwards, in equal steps. It shows the bounding rectangle of the cap of
/// `radius` degrees around `centre`; from 90 degrees on the whole sphere, cut opposite the centre. It has the
/// width of `frame`, or less if its height would exceed that of `frame`.
class LonLat : public View {
 public:
  LonLat(const Spot& centre, double radius, const Frame& frame);
  /// Shows this region, at the scale of its middle latitude.
  LonLat(const files::Region& region, const Frame& frame);

  double scale() const override;

  std::optional<Place> place(const Point& p) const override;
  std::vector<Outline> polygon(const std::vector<Point>& corners) const override;
  std::vector<Outline> arc(const Point& a, const Point& b) const override;

 private:
  void fill(const Frame& frame, double squeezed);
  Place on_paper(const Spot& s) const {
    return {frame_.left + (s.lon - bounds_.west) * per_lon_,
            frame_.bottom - (s.lat - bounds_.south) * per_lat_};
  }
  void add_arc(const Point& a, const Point& b, std::vector<Point>& points, int depth = 0) const;
  template <class Visit>
  void for_each_turn(double from, double to, const Visit& visit) const;

  double per_lon_, per_lat_;  ///< pixels per degree
};

}  // namespace pictures
