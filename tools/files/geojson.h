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

/// The lines of a file, and the outlines and holes of its polygons: longitudes and latitudes in degrees.
/// Throws std::runtime_error: one line.
std::vector<std::vector<std::pair<double, double>>> read_lines(const std::string& file);

}  // namespace files
