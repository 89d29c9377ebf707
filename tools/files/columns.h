#pragma once
// Values of nodes or faces that are carried from the input file to the output file.

#include <cstddef>
#include <limits>
#include <string>
#include <vector>

#include "geometry/point.h"

namespace files {

constexpr double kMissing = std::numeric_limits<double>::quiet_NaN();

/// One value for each node, or for each face.
struct Column {
  std::string name, long_name = "", units = "";
  std::vector<double> numbers = {};     ///< or kMissing
  std::vector<std::string> texts = {};  ///< empty: missing; beside numbers: these as they stand in the file
  bool whole = false;                   ///< every number is a 32-bit integer and none is missing

  bool is_text() const { return numbers.empty() && !texts.empty(); }
  std::size_t size() const { return is_text() ? texts.size() : numbers.size(); }
};
using Columns = std::vector<Column>;

const Column* find(const Columns& columns, const std::string& name);

/// Appends `_given` to names of these columns that repeat an earlier name or a word in `taken`.
void make_names_differ(Columns& columns, std::vector<std::string> taken);

/// A column of integers.
Column whole_numbers(std::string name, std::string long_name, std::vector<double> numbers);

/// What the text of a unit says of angles: udunits' and CF's spellings (CF 1.11, sections 4.1 and 4.2),
/// without regard to case, blanks and underscores.
struct AngleUnit {
  bool degrees = false, radians = false;  ///< neither: no unit of angles
  char axis = '\0';                       ///< 'o': longitudes, 'a': latitudes

  explicit AngleUnit(const std::string& text);
};

/// Longitudes and latitudes, all in degrees or all in radians.
struct LonLat {
  LonLat() = default;
  /// The angles of vectors: longitudes -180 to 180 and latitudes -90 to 90 degrees, or the same in radians.
  LonLat(const std::vector<pstripack::Point>& points, bool in_degrees);

  std::vector<double> lon, lat;
  bool degrees = true;

  bool empty() const { return lon.empty(); }
};

/// The unit vectors; missing where an angle is not finite.
std::vector<pstripack::Point> points_of(const LonLat& angles);

/// The given angles, converted to the requested unit; the angles of the vectors if none were given.
LonLat angles_of(const std::vector<pstripack::Point>& points, const LonLat& given, bool degrees);

/// The values with these indices.
template <class Value>
std::vector<Value> values_at(const std::vector<Value>& values, const std::vector<std::size_t>& indices) {
  std::vector<Value> found;
  if (values.empty()) return found;
  found.reserve(indices.size());
  for (const std::size_t i : indices) found.push_back(values[i]);
  return found;
}

/// The columns and the angles at these nodes.
Columns at_nodes(const Columns& columns, const std::vector<std::size_t>& nodes);
LonLat at_nodes(const LonLat& angles, const std::vector<std::size_t>& nodes);

}  // namespace files
