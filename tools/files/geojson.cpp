#include "files/geojson.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string_view>

#include "files/nodes.h"
#include "files/text_file.h"

namespace files {
namespace {

/// What the parser says, without the place, and with an excerpt of the text that it read last.
std::string reason_of(const Json::parse_error& e) {
  std::string what = e.what();
  if (const std::size_t column = what.find(", column "); column != what.npos)
    what.erase(0, what.find(": ", column) + 2);
  constexpr std::string_view kRead = "last read: '";
  const std::size_t begin = what.find(kRead), end = what.rfind('\'');
  if (begin == what.npos) return what;
  const std::size_t word = begin + kRead.size();
  return what.substr(0, word) + excerpt(what.substr(word, end - word)) + what.substr(end);
}

/// Throws if a member "crs", which RFC 7946 removed, names another system than longitudes and latitudes of
/// WGS 84.
void check_reference_system(const Json& root, const std::string& file) {
  const auto crs = root.find("crs");
  if (crs == root.end() || !crs->is_object() || !crs->contains("properties")) return;
  const std::string name = text_of((*crs)["properties"], "name");
  const auto has = [&](const char* word) { return name.find(word) != name.npos; };
  if (!name.empty() && !has("CRS84") && !has("4326"))
    fail(file, "coordinates are in {}: write the file in longitudes and latitudes, EPSG:4326", excerpt(name));
}

std::string name_of(const Json& feature, const Json& properties) {
  const auto text = [](const Json& value) {
    return value.is_string() ? value.get<std::string>() : value.is_number() ? value.dump() : "";
  };
  for (const char* const name : {"name", "Name", "NAME", "id", "Id", "ID"})
    if (properties.contains(name) && !text(properties[name]).empty()) return text(properties[name]);
  return feature.contains("id") ? text(feature["id"]) : "";
}

}  // namespace

std::string text_of(const Json& object, const char* key) {
  const auto found = object.find(key);
  return found != object.end() && found->is_string() ? found->get<std::string>() : "";
}

Json read_features(const std::string& text, const std::string& file, const char* what,
                   std::initializer_list<const char*> geometries,
                   const std::function<void(const Json&, std::size_t)>& add) {
  constexpr int kMostLevels = 100;  // a value is written by a recursion over its levels
  bool in_features = false;
  std::size_t count = 0;
  const auto see = [&](int depth, Json::parse_event_t event, Json& value) {
    if (depth > kMostLevels)
      fail(file, "JSON with more than {} levels of brackets, which no {} have", kMostLevels, what);
    if (depth == 1 && event == Json::parse_event_t::key) in_features = value == "features";
    if (depth != 2 || event != Json::parse_event_t::object_end || !in_features) return true;
    add(value, ++count);
    return false;
  };
  Json root;
  try {
    root = Json::parse(text, see);
  } catch (const Json::parse_error& e) {
    refuse_foreign(file, text);
    const auto end = text.begin() + static_cast<std::ptrdiff_t>(std::min(e.byte, text.size()));
    fail(line_of(file, 1 + static_cast<std::size_t>(std::count(text.begin(), end, '\n'))),
         "not valid JSON: {}", reason_of(e));
  } catch (const Json::out_of_range&) {
    fail(file, "feature {}: a number is larger than 1e308", count + 1);
  }
  const std::string type = root.is_object() ? text_of(root, "type") : "";
  if (type == "FeatureCollection") {
    const auto rest = root.find("features");
    if (rest == root.end() || !rest->is_array() || !rest->empty())
      fail(file, "\"features\" must be an array of features");
  } else if (type == "Feature") {
    add(root, 1);
  } else if (std::find(geometries.begin(), geometries.end(), type) != geometries.end()) {
    add({{"type", "Feature"}, {"geometry", root}}, 1);
  } else {
    fail(file, "not GeoJSON of {}: the type is '{}', expected FeatureCollection, Feature, {} or {}", what,
         excerpt(type), geometries.begin()[0], geometries.begin()[1]);
  }
  check_reference_system(root, file);
  return root;
}

std::vector<Shape> read_shapes(const std::string& file, const char* what,
                               std::initializer_list<const char*> types) {
  std::vector<Shape> shapes;
  read_features(contents_of(file), file, what, types, [&](const Json& feature, std::size_t number) {
    Shape& shape = shapes.emplace_back();
    shape.number = number;
    shape.where = fmt::format("{}: feature {}", file, number);
    const auto require = [&](bool condition, const std::string& expected) {
      if (!condition) fail(shape.where, "{}", expected);
    };
    const auto geometry = feature.find("geometry");
    const std::string type =
        geometry != feature.end() && geometry->is_object() ? text_of(*geometry, "type") : "";
    require(std::find(types.begin(), types.end(), type) != types.end(),
            fmt::format("'{}' is not a {}", excerpt(type), fmt::join(types, " or ")));
    const auto coordinates = geometry->find("coordinates");
    require(coordinates != geometry->end(), "its geometry has no coordinates");
    const auto add = [&](const auto& add_those_in, const Json& list, std::vector<Line>& lines) -> void {
      require(list.is_array() && !list.empty() && list[0].is_array() && !list[0].empty(),
              "expected lists of [longitude, latitude]");
      if (!list[0][0].is_number()) {
        for (const Json& part : list) add_those_in(add_those_in, part, lines);
        return;
      }
      Line& line = lines.emplace_back();
      for (const Json& place : list) {
        require(place.is_array() && place.size() >= 2 && place[0].is_number() && place[1].is_number(),
                "expected lists of [longitude, latitude]");
        const auto [lon, lat] = line.emplace_back(place[0].get<double>(), place[1].get<double>());
        require(std::fabs(lat) <= 90, fmt::format("latitude {:g} is beyond the pole", lat));
        require(std::fabs(lon) <= 540, fmt::format("longitude {:g} is not within -540 to 540", lon));
      }
    };
    if (type.rfind("Multi", 0) == 0 && coordinates->is_array())
      for (const Json& part : *coordinates) add(add, part, shape.parts.emplace_back());
    else
      add(add, *coordinates, shape.parts.emplace_back());
    require(!shape.parts.empty(), fmt::format("a {} without parts", type));
    const auto properties = feature.find("properties");
    if (properties != feature.end() && properties->is_object()) shape.properties = *properties;
    shape.name = name_of(feature, shape.properties);
  });
  if (shapes.empty()) fail(file, "no {}: there are no features", what);
  return shapes;
}

}  // namespace files
