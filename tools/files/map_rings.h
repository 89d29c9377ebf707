#pragma once
// Polygons of the sphere on a map: longitude to the right, latitude upwards, in degrees.

#include <vector>

#include "files/mesh.h"

namespace files {

/// Corners closer than this, in radians, are one corner, and at a pole if that is so close: 6 micrometres on
/// the Earth.
constexpr double kSamePlace = 1e-12;

/// Of equal longitudes that from -180 to 180; unchanged if it is one.
double wrapped(double lon);

struct MapCorner {
  Point p;
  double lon, lat;  ///< of p
  int turn = 0;     ///< on the map it is at lon + 360 turn
  bool straight =
      false;          ///< the line to the next corner is straight on the map; else an arc of a great circle
  bool seam = false;  ///< only joins a ring around a pole to the pole

  double x() const { return lon + 360.0 * turn; }
};
/// A polygon, counterclockwise.
using MapRing = std::vector<MapCorner>;

/// The corners of a face; longitudes from -180 to 180.
MapRing ring_of(const Faces& faces, std::size_t face, const LonLat& angles);

/// Throws NoMesh, which names the cell or triangle, if a side is a half turn: its ends do not tell where it
/// is.
void expect_no_half_turn(const MapRing& ring, const Faces& faces, std::size_t face);

/// The map of a convex polygon, whose sides are arcs (turns and flags of `ring` are ignored). A pole that is
/// a corner, or lies on a side, becomes a line of the map. With a pole inside, the ring reaches from `west`
/// to `west` + 360 and is closed along the pole. Empty if all corners are one place or lie on one arc.
MapRing unrolled(const MapRing& ring, double west);

/// What lies between the meridians `west` and `west` + width <= 360, in one piece or several; the turns of
/// the pieces are those of that window. Meridians must cross the ring at most twice.
std::vector<MapRing> between_meridians(const MapRing& ring, double west, double width);

/// What lies between two parallels.
std::vector<MapRing> between_parallels(const MapRing& ring, double south, double north);

/// The ring with further corners, so that straight lines of the map are within 0.001 degrees of the arcs, and
/// nearer in slivers. Empty where these are too thin to be counterclockwise then, some 1e-7 radians.
MapRing with_straight_lines(const MapRing& ring);

/// The ring with further corners, so that arcs of great circles are within 0.0001 degrees of straight lines
/// and no side is longer than 90 degrees.
MapRing with_arcs(const MapRing& ring);

}  // namespace files
