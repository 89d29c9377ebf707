#include "node_sets.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <numeric>
#include <stdexcept>
#include <string_view>

#include "point_sets.h"

namespace comparison {
namespace {

using pstripack::Point;

/// NetCDF's own formats, and HDF5's.
bool is_netcdf(const std::string& file) {
  char begin[4] = "";
  std::ifstream(file, std::ios::binary).read(begin, sizeof begin);
  const std::string_view magic(begin, sizeof begin);
  return magic.substr(0, 3) == "CDF" || magic == "\x89HDF";
}

}  // namespace

std::vector<Point> read_nodes(const std::string& file) {
  if (file == "-" || !is_netcdf(file)) return point_sets::read(file);
#ifdef HAVE_NETCDF
  return read_netcdf(file);
#else
  throw std::runtime_error(file + ": a NetCDF file, but this build has no NetCDF (Debian: libnetcdf-dev)");
#endif
}

void put_in_order(std::vector<Point>& points, const std::string& order, std::uint64_t seed) {
  if (order == "shuffled") point_sets::shuffle(points, seed);
  if (order != "sorted") return;
  std::stable_sort(points.begin(), points.end(), [](const Point& a, const Point& b) {
    return a.z != b.z ? a.z < b.z : std::atan2(a.y, a.x) < std::atan2(b.y, b.x);
  });
}

void round_to_single(std::vector<Point>& points) {
  for (Point& p : points) p = point_sets::rounded_to_single(p);
}

}  // namespace comparison
