#pragma once
// Named sets of nodes, of unit length unless otherwise stated, bit for bit the same on every IEEE machine:
// they use our own generator, sines and cosines, and of the mathematical library only sqrt.

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "geometry/point.h"

namespace point_sets {

/// The family `name` or `name:parameter` with n nodes; grids take the natural count nearest to n.
/// Throws std::invalid_argument, naming the families, if there is no such family or the parameter is bad.
/// `pstripack points --help` lists them.
std::vector<pstripack::Point> make(const std::string& family, std::size_t n, std::uint64_t seed = 1);

/// The names of the families, without parameters: those that every test uses; and those that are hard for
/// rounded arithmetic, or nodes as instruments deliver them.
const std::vector<std::string>& families();
const std::vector<std::string>& hard_families();

/// Nodes from a text file, `-` for stdin: lines of `lon lat` (degrees) or of `x y z` (any lengths); decimal
/// or hexadecimal, also with Fortran's D exponents; commas count as blanks, `#` and `!` start comments. The
/// first line may hold the number of nodes alone. Throws std::runtime_error with file and line number on
/// anything else.
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
template <class Item>
void shuffle(std::vector<Item>& items, std::uint64_t seed) {
  Random random(seed);
  for (std::size_t i = items.size(); i > 1; --i) std::swap(items[i - 1], items[random.below(i)]);
}

double sin_degrees(double angle);
double cos_degrees(double angle);
pstripack::Point from_degrees(double longitude, double latitude);
pstripack::Point normalized(const pstripack::Point& p);
pstripack::Point rounded_to_single(const pstripack::Point& p);

}  // namespace point_sets
