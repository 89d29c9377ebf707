#pragma once
// Named sets of nodes, of length 1 unless stated otherwise. Every IEEE machine makes the same bits: of the
// mathematical library only sqrt is used.

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "geometry/point.h"

namespace point_sets {

/// The family `name` or `name:parameter` with n nodes; grids have the possible number nearest to n. Throws
/// std::invalid_argument, listing the families, if the family does not exist or the parameter is wrong.
/// `pstripack points --help` lists them.
std::vector<pstripack::Point> make(const std::string& family, std::size_t n, std::uint64_t seed = 1);

/// Names of families without parameters: those that every test uses, and those that are hard for rounded
/// arithmetic or imitate measurements.
const std::vector<std::string>& families();
const std::vector<std::string>& hard_families();

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

/// Shuffles the nodes (Fisher-Yates).
template <class Item>
void shuffle(std::vector<Item>& items, std::uint64_t seed) {
  Random random(seed);
  for (std::size_t i = items.size(); i > 1; --i) std::swap(items[i - 1], items[random.below(i)]);
}

double sin_degrees(double angle);
double cos_degrees(double angle);
pstripack::Point from_degrees(double longitude, double latitude);

// Radians, by the mathematical library. The double nearest to a multiple of pi/2 means the multiple.
double sin_radians(double angle);
double cos_radians(double angle);
/// Of an angle of single precision: if it is the float nearest to a multiple of pi/2, the double nearest to
/// it; else the angle.
double radians_of_single(double angle);

pstripack::Point normalized(const pstripack::Point& p);
pstripack::Point rounded_to_single(const pstripack::Point& p);

}  // namespace point_sets
