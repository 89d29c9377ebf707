#pragma once
// What all readers of GeoJSON (RFC 7946) share.

#include <cstddef>
#include <functional>
#include <initializer_list>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

namespace files {

using Json = nlohmann::ordered_json;

/// The text `key` of the object; empty if it has none.
std::string text_of(const Json& object, const char* key);

/// Parses the text and hands each feature with its number, from 1, to add(), without keeping it: those of a
/// FeatureCollection, a single Feature, or a geometry of one of these types. `what`: "points". Returns the
/// rest. Throws std::runtime_error: one line.
Json read_features(const std::string& text, const std::string& file, const char* what,
                   std::initializer_list<const char*> geometries,
                   const std::function<void(const Json&, std::size_t)>& add);

using Line = std::vector<std::pair<double, double>>;  ///< longitudes and latitudes, degrees

/// A feature with lines or polygons.
struct Shape {
  std::size_t number = 0;  ///< from 1
  std::string where = {};  ///< in messages
  std::string name = {};   ///< its property `name` or `id`, or its member `id`; empty: it has none
  Json properties = {};
  /// The lines, each alone, or of each polygon the outline, then its holes.
  std::vector<std::vector<Line>> parts = {};
};
/// The features of a file, which have one of these types. `what`: "polygons". Throws std::runtime_error: one
/// line with file, feature, and what is wrong.
std::vector<Shape> read_shapes(const std::string& file, const char* what,
                               std::initializer_list<const char*> types);

}  // namespace files
