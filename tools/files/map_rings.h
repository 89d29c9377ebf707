#pragma once
// Polygons of the sphere on a map: longitude to the right, latitude upwards, in degrees.

#include <cstdint>
#include <vector>

#include "files/mesh.h"

namespace files {

/// The ends of sides shorter than this, in radians, are one corner. 6 micrometres on the Earth.
constexpr double kSamePlace = 1e-12;

/// The equal longitude from -180 to 180; unchanged if `lon` is in this range.
double wrapped(double lon);

struct MapCorner {
  Point p;
  double lon, lat;  ///< of p
  int turn = 0;     ///< the corner's place on the map is lon + 360 turn

  double x() const { return lon + 360.0 * turn; }
};
/// A polygon, counterclockwise.
using MapRing = std::vector<MapCorner>;

/// faces.corner, in which corners with a side shorter than kSamePlace between them are one: the same corner
/// in all faces.
std::vector<std::int32_t> merged_corners(const Faces& faces);

/// A point of the faces, numbered from 1, with its longitude from -180 to 180.
MapCorner corner_at(const Faces& faces, std::int32_t corner, const LonLat& angles);
/// The corners of a face, with longitudes from -180 to 180. `corner`: faces.corner, or merged.
MapRing ring_of(const Faces& faces, std::size_t face, const LonLat& angles,
                const std::vector<std::int32_t>& corner);

/// The map of a convex polygon; turns of `ring` are ignored. A pole at
/// a corner or on a side becomes a line of the map. If the pole is inside, the ring reaches from `west` to
/// `west` + 360 and is closed along the pole. Empty if all corners coincide or lie on one arc.
MapRing unrolled(const MapRing& ring, double west);

/// The pieces of the ring between -180 and 180, with longitudes of this range.
std::vector<MapRing> cut_at_dateline(MapRing ring);

/// Faces as polygons with straight sides on the map from -180 to 180. A straight line is within 0.001
/// degrees, and a hundredth of its length, of its arc: polygons of narrower faces may overlap by this. An arc
/// is cut in the same way in the faces on both sides, to the last bit.
class MapLines {
 public:
  /// `faces` must outlive the object.
  explicit MapLines(const Faces& faces);

  /// The polygons of a face, cut at the dateline. Empty if the face is narrower than rounding of its corners.
  std::vector<MapRing> polygons(std::size_t face) const;

 private:
  const Point& point(std::int32_t corner) const { return faces_.numbered(corner); }
  MapCorner at(std::int32_t corner) const { return corner_at(faces_, corner, angles_); }
  /// The corners that an arc gets between its ends.
  MapRing corners_between(std::int32_t from, std::int32_t to) const;

  const Faces& faces_;
  LonLat angles_;
  std::vector<std::int32_t> corner_;
};

}  // namespace files
