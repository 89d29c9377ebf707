#include "pictures/coasts.h"

#include <cerrno>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
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

/// The bytes of a file; every access is checked against its length.
class Bytes {
 public:
  explicit Bytes(const std::string& file) : file_(file) {
    std::ifstream in(file, std::ios::binary);
    if (!in) throw std::runtime_error(file + ": cannot be opened: " + std::strerror(errno));
    bytes_.assign(std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>());
  }
  std::size_t size() const { return bytes_.size(); }

  std::int32_t integer(std::size_t at, bool big_endian = false) const {
    expect(at, 4);
    std::uint32_t value = 0;
    for (std::size_t k = 0; k < 4; ++k) value |= byte(at + k) << 8 * (big_endian ? 3 - k : k);
    return static_cast<std::int32_t>(value);
  }
  double number(std::size_t at) const {
    expect(at, 8);
    std::uint64_t bits = 0;
    for (std::size_t k = 0; k < 8; ++k) bits |= std::uint64_t{byte(at + k)} << 8 * k;
    double value;
    std::memcpy(&value, &bits, sizeof value);
    return value;
  }
  /// Reads a count at `at`; fails if so many items of `size` bytes cannot fit the file.
  std::size_t count(std::size_t at, std::size_t size) const {
    const std::int32_t n = integer(at);
    if (n < 0 || static_cast<std::size_t>(n) > bytes_.size() / size) fail();
    return static_cast<std::size_t>(n);
  }
  [[noreturn]] void fail() const {
    throw std::runtime_error(file_ +
                             ": not a shapefile (.shp) of lines or polygons in degrees, or cut short");
  }

 private:
  std::uint32_t byte(std::size_t at) const { return static_cast<unsigned char>(bytes_[at]); }
  void expect(std::size_t at, std::size_t size) const {
    if (at > bytes_.size() || size > bytes_.size() - at) fail();
  }
  std::string file_, bytes_;
};

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
  constexpr std::int32_t kMagic = 9994, kNull = 0;
  constexpr std::size_t kHeader = 100;
  const Bytes bytes(file);
  if (bytes.integer(0, true) != kMagic || bytes.size() < kHeader) bytes.fail();
  Lines lines;
  for (std::size_t record = kHeader; record < bytes.size();) {
    const std::int32_t words = bytes.integer(record + 4, true), kind = bytes.integer(record + 8);
    if (words < 2) bytes.fail();
    const std::size_t shape = record + 8;
    record = shape + 2 * static_cast<std::size_t>(words);
    if (kind == kNull) continue;
    // Lines and polygons, also with heights and measures: these follow the points and are ignored.
    if (kind % 10 != 3 && kind % 10 != 5) bytes.fail();
    const std::size_t parts = bytes.count(shape + 36, 4), points = bytes.count(shape + 40, 16);
    const std::size_t first = shape + 44 + 4 * parts;
    for (std::size_t part = 0; part < parts; ++part) {
      const std::size_t begin = bytes.count(shape + 44 + 4 * part, 16),
                        end = part + 1 < parts ? bytes.count(shape + 48 + 4 * part, 16) : points;
      if (begin > end || end > points) bytes.fail();
      Degrees last{0, 0};
      for (std::size_t i = begin; i < end; ++i) {
        const Degrees here{bytes.number(first + 16 * i), bytes.number(first + 16 * i + 8)};
        if (!(std::fabs(here.lon) <= 360 && std::fabs(here.lat) <= 90 + 1e-6)) bytes.fail();
        if (i == begin || is_cut(last, here)) lines.emplace_back();
        lines.back().push_back(point_sets::from_degrees(here.lon, here.lat));
        last = here;
      }
    }
  }
  return lines;
}

}  // namespace pictures
