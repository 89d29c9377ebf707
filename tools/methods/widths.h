#pragma once
// Widths of cells in km, and the densities of centroidal tessellations that have them.

#include <algorithm>
#include <cstddef>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "files/width_regions.h"
#include "methods/grid_values.h"
#include "scvt/density.h"

namespace methods {

using pstripack::scvt::Density;

/// The density of cells with some widths w, at most 1: (least / w)^4.
struct Widths {
  std::unique_ptr<Density> density;
  double least = 0;  ///< km
  double cells = 0;  ///< as cells_of_width()
};

/// Widths by a formula, lengths in km, angles in degrees:
///     disc:INNER,OUTER,RADIUS,TRANSITION,LON,LAT    INNER up to RADIUS from LON, LAT
///     band:INNER,OUTER,RADIUS,TRANSITION,LAT        INNER up to RADIUS from the parallel LAT
/// and then over TRANSITION smoothly to OUTER; or one width: a number, with or without "km", or with "m".
class WidthFormula {
 public:
  /// Throws std::invalid_argument.
  explicit WidthFormula(const std::string& text);

  /// Makes the transition so long that widths change by at most `gradient` km per km; the narrower cells keep
  /// their place. True if it was shorter.
  bool limit(double gradient);
  double transition() const { return transition_; }
  /// `distance` in km from the centre or the parallel.
  double width(double distance) const;
  Widths widths(double radius) const;
  bool is_one_width() const { return inner_ == outer_; }
  double least() const { return std::min(inner_, outer_); }
  double most() const { return std::max(inner_, outer_); }
  /// The width at a unit vector.
  double at(const files::Point& p, double radius) const;

 private:
  bool is_band_ = false;
  double inner_ = 0, outer_ = 0, radius_ = 0, transition_ = 0, lat_ = 0;
  files::Point centre_{0, 0, 0};
};

/// Widths by latitude that have a name: those of E3SM's ocean meshes ec60to30 and rrs18to6, by the formulas
/// EC_CellWidthVsLat and RRS_CellWidthVsLat of mpas_tools.mesh.creation.mesh_definition_tools. No values:
/// another name.
Table widths_of_name(const std::string& name);

/// What limit_gradient() changed.
struct Lowered {
  std::size_t places = 0, of = 0;  ///< a pole is one place
  double most = 0;                 ///< at lon, lat (degrees)
  double lon = 0, lat = 0;
};

/// Lowers values until
///     w(x) <= w(y) + gradient d(x,y)
/// for all places x, y of the table, d the length of the arc between them on a sphere of this radius, and no
/// further (Persson, Engineering with Computers 22, 2006). It holds for all neighbours on the grid; for
/// others it may lack a tenth of a spacing of the grid times the gradient.
Lowered limit_gradient(Table& table, double gradient, double radius);

/// Widths on a grid of 0.1 to 0.5 degrees, about as fine as the narrowest cell: `elsewhere`, but those of the
/// regions inside them; where regions overlap, the narrowest. From a narrower region outwards, and into a
/// wider one, widths change evenly over its transition. Throws std::runtime_error, with the number of a
/// region that is smaller than a cell.
Table widths_of_regions(const std::vector<files::WidthRegion>& regions, const WidthFormula& elsewhere,
                        double radius);

/// FILE:NEAR:FAR:KM: widths of NEAR km at the lines of a GeoJSON file, and at the sides of its polygons,
/// which grow evenly to FAR at the distance KM.
struct WidthDistance {
  std::string file;
  double near = 0, far = 0, distance = 0;
  /// Throws std::invalid_argument.
  explicit WidthDistance(const std::string& text);
};

/// Its widths at lines of longitudes and latitudes, on a grid as that of widths_of_regions(): up to the
/// change of widths over half of its spacing.
Table widths_of_distance(const std::vector<std::vector<std::pair<double, double>>>& lines,
                         const WidthDistance& given, double radius);

/// Sets the values of places that are not inside (the table's, without its last column): w(y) up to `flat`
/// widths w(y) and `more` km from a place y inside, then growing by `gradient` km per km up to `most`, or to
/// the largest value inside.
void set_outside(Table& table, const std::vector<bool>& inside, double gradient, double radius, double flat,
                 double more, double most);

/// How many cells have these widths. `radius` in km.
double cells_of(const Table& widths, double radius);
/// `radius` in km. Widths are bilinear in longitude and latitude.
Widths widths_of(Table km, double radius);

/// How many regular hexagons whose neighbours are `width` apart have the area of the sphere. Both in km.
double cells_of_width(double width, double radius);

}  // namespace methods
