#include "pictures/coasts.h"

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <stdexcept>

#include "point_sets.h"

namespace pictures {

std::string natural_earth(double radius, const std::string& folder) {
  // From the finest scale that the picture needs to the coarsest.
  constexpr const char* kScales[] = {"10m", "50m", "110m"};
  for (int k = radius < 8 ? 0 : radius < 40 ? 1 : 2; k < 3; ++k)
    if (std::string file = folder + "/" + kScales[k] + "/ne_" + kScales[k] + "_land.shp";
        std::filesystem::exists(file))
      return file;
  throw std::runtime_error(folder +
                           ": Natural Earth's coast lines are not installed: install them (Debian: "
                           "libmagics++-data), or name a shapefile by --coast-file");
}

namespace {

struct Degrees {
  double lon, lat;
  bool at_pole() const { return std::fabs(lat) > 90 - 1e-6; }
  bool at_antimeridian() const { return std::fabs(std::fabs(lon) - 180) < 1e-6; }
};

/// True if the side only results from cutting a polygon at the antimeridian or a pole.
bool is_cut(const Degrees& a, const Degrees& b) {
  return a.at_pole() || b.at_pole() || (a.at_antimeridian() && b.at_antimeridian());
}

}  // namespace

// ESRI Shapefile Technical Description (1998): a header of 100 bytes; records of number and length in 16-bit
// words (big-endian), the kind of shape, a box, counts of parts and points, the first point of each part, the
// points.
Lines read_shapefile(const std::string& file) {
  std::ifstream in(file, std::ios::binary);
  if (!in) throw std::runtime_error(file + ": cannot be opened: " + std::strerror(errno));
  const auto require = [&](bool condition) {
    if (!condition)
      throw std::runtime_error(file +
                               ": not a shapefile (.shp) of lines or polygons in degrees, or cut short");
  };
  const auto read = [&](auto value) {  // in this machine's byte order, little-endian
    require(!!in.read(reinterpret_cast<char*>(&value), sizeof value));
    return value;
  };
  const auto integer = [&] { return read(std::int32_t{}); };
  constexpr int kMagic = 0x0A270000, kNull = 0, kHeader = 100;
  require(integer() == kMagic);
  Lines lines;
  require(!!in.ignore(kHeader - 4) && !in.eof());
  while (in.peek() != EOF) {
    in.ignore(4);
    const auto begin = in.tellg();
    const auto words = static_cast<std::int32_t>(__builtin_bswap32(read(std::uint32_t{})));
    const std::int32_t kind = integer();
    // Lines and polygons, also with heights and measures: these follow the points and are ignored.
    require(words >= 2 && (kind == kNull || kind % 10 == 3 || kind % 10 == 5));
    if (kind != kNull) {
      in.ignore(32);
      const std::int32_t parts = integer(), points = integer();
      std::vector<std::int32_t> first;
      for (std::int32_t part = 0; part < parts; ++part) first.push_back(integer());
      Degrees last{0, 0};
      for (std::int32_t i = 0; i < points; ++i) {
        const Degrees here = read(Degrees{});
        require(std::fabs(here.lon) <= 360 && std::fabs(here.lat) <= 90 + 1e-6);
        if (i == 0 || std::binary_search(first.begin(), first.end(), i) || is_cut(last, here))
          lines.emplace_back();
        lines.back().push_back(point_sets::from_degrees(here.lon, here.lat));
        last = here;
      }
    }
    in.seekg(begin + std::streamoff{4} + 2 * std::streamoff{words});
  }
  return lines;
}

}  // namespace pictures
