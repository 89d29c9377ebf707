#pragma once
// Named sets of nodes on the unit sphere, bit for bit the same on every IEEE machine: a generator of our
// own, and of the mathematical functions only sqrt and sines and cosines of our own.

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "geometry/point.h"

namespace point_sets {

/// The family `name` or `name:parameter` with n nodes; grids take the natural count nearest to n.
/// Throws std::invalid_argument, naming the families, if there is no such family or the parameter is bad.
///
///   family              nodes          what (parameter in brackets, radians, with its default)
///   random              n              uniform
///   single              n              uniform, coordinates rounded to single precision
///   fibonacci           n              golden-angle spiral
///   icosahedral         10 m^2 + 2     geodesic subdivision of the icosahedron: corners, edges, faces
///   latlon              2 m^2 + 2      m rows of 2 m, south to north, one node at each pole (first, last)
///   reduced-gaussian    4 m (m + 9)    octahedral reduced Gaussian grid, north to south
///   healpix             12 m^2         HEALPix centres, ring order
///   cubed-sphere        6 m^2          equiangular cell centres, panel after panel
///   tripolar            about n        ocean grid: rows 80 S to 65 N, then a bipolar cap (poles on no node)
///   ring                n              n - 1 nodes on the parallel 60 N (exactly cocircular), and the pole
///   variable[:1e4]      n              smooth density, its largest over its smallest value
///   clusters[:1e-3]     n              half uniform, half in eight caps of that radius
///   dense-cap[:1e-5]    n              half uniform, half in one cap of that radius
///   antipodal[:0.1]     n              two caps of that radius, opposite each other
///   cap[:0.0175]        n              uniform in a cap of that radius
///   box[:0.00175]       m^2            regional box of that width, row after row
///   strip[:1e-9]        n              along a tilted great circle, within a strip of that width
///   pairs[:1e-10]       2 m            uniform, each node with a neighbour at that distance
///   hemisphere          n              uniform in the open hemisphere z > 0
///   hemisphere-rim      n              half of them exactly on the equator
std::vector<pstripack::Point> make(const std::string& family, std::size_t n, std::uint64_t seed = 1);

/// The names of all families, without parameters.
const std::vector<std::string>& families();

/// Nodes from a text file, `-` for stdin: a line `lon lat` (degrees) or `x y z` (taken as they are), the
/// same in all lines; decimal or hexadecimal, also with Fortran's D exponents; commas count as blanks,
/// `#` and `!` start comments. Throws std::runtime_error with file and line number on anything else.
std::vector<pstripack::Point> read(const std::string& file);

/// SplitMix64.
class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(seed) {}
  std::uint64_t bits();
  double uniform() { return static_cast<double>(bits() >> 11) * 0x1p-53; }  ///< in [0,1)
  double uniform(double low, double high) { return low + (high - low) * uniform(); }
  std::size_t below(std::size_t n) { return static_cast<std::size_t>(bits() % n); }
  pstripack::Point direction();  ///< uniform on the sphere

 private:
  std::uint64_t state_;
};

/// A random order of the nodes (Fisher-Yates).
void shuffle(std::vector<pstripack::Point>& points, std::uint64_t seed);

double sin_degrees(double angle);
double cos_degrees(double angle);
pstripack::Point from_degrees(double longitude, double latitude);
pstripack::Point normalized(const pstripack::Point& p);

}  // namespace point_sets
