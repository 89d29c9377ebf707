#pragma once
// Polygons of the sphere on a map: longitude to the right, latitude upwards, in degrees.

#include <vector>

#include "files/mesh.h"

namespace files {

/// Points closer than this, in radians, are one corner; a corner this close to a pole is the pole. 6
/// micrometres on the Earth.
constexpr double kSamePlace = 1e-12;

/// The equal longitude from -180 to 180; unchanged if `lon` is in this range.
double wrapped(double lon);

struct MapCorner {
  Point p;
  double lon, lat;  ///< of p
  int turn = 0;     ///< the corner's place on the map is lon + 360 turn
  bool straight =
      false;          ///< the line to the next corner is straight on the map; else an arc of a great circle
  bool seam = false;  ///< the line to the next corner only joins a ring around a pole to that pole

  double x() const { return lon + 360.0 * turn; }
};
/// A polygon, counterclockwise.
using MapRing = std::vector<MapCorner>;

/// The corners of a face, with longitudes from -180 to 180.
MapRing ring_of(const Faces& faces, std::size_t face, const LonLat& angles);

/// Throws NoMesh, naming the cell or triangle, if a side is a half turn: its ends do not determine its great
/// circle.
void expect_no_half_turn(const MapRing& ring, const Faces& faces, std::size_t face);

/// The map of a convex polygon whose sides are arcs; turns and flags of `ring` are ignored. A pole at a
/// corner or on a side becomes a line of the map. If the pole is inside, the ring reaches from `west` to
/// `west` + 360 and is closed along the pole. Empty if all corners coincide or lie on one arc.
MapRing unrolled(const MapRing& ring, double west);

/// The pieces of the ring between the meridians `west` and `west` + width, with longitudes of that window.
/// width <= 360. A meridian must cross the ring at most twice.
std::vector<MapRing> between_meridians(const MapRing& ring, double west, double width);

/// The pieces of the ring between two parallels.
std::vector<MapRing> between_parallels(const MapRing& ring, double south, double north);

/// Adds corners until straight lines on the map are within 0.001 degrees of the arcs, and closer in slivers.
/// Empty if the sliver is so thin, some 1e-7 radians, that the result would not be counterclockwise.
MapRing with_straight_lines(const MapRing& ring);

/// Adds corners until arcs of great circles are within 0.0001 degrees of the straight lines and no side is
/// longer than 90 degrees.
MapRing with_arcs(const MapRing& ring);

}  // namespace files
