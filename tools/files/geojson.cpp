#include "files/geojson.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <stdexcept>
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
    throw std::runtime_error(
        fmt::format("{}: coordinates are in {}: write the file in longitudes and latitudes, EPSG:4326", file,
                    excerpt(name)));
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
      throw std::runtime_error(fmt::format("{}: JSON with more than {} levels of brackets, which no {} have",
                                           file, kMostLevels, what));
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
    throw std::runtime_error(fmt::format("{}:{}: not valid JSON: {}", file,
                                         1 + std::count(text.begin(), end, '\n'), reason_of(e)));
  } catch (const Json::out_of_range&) {
    throw std::runtime_error(fmt::format("{}: feature {}: a number is larger than 1e308", file, count + 1));
  }
  const std::string type = root.is_object() ? text_of(root, "type") : "";
  if (type == "FeatureCollection") {
    const auto rest = root.find("features");
    if (rest == root.end() || !rest->is_array() || !rest->empty())
      throw std::runtime_error(file + ": \"features\" must be an array of features");
  } else if (type == "Feature") {
    add(root, 1);
  } else if (std::find(geometries.begin(), geometries.end(), type) != geometries.end()) {
    add({{"type", "Feature"}, {"geometry", root}}, 1);
  } else {
    throw std::runtime_error(
        fmt::format("{}: not GeoJSON of {}: the type is '{}', expected FeatureCollection, Feature, {} or {}",
                    file, what, excerpt(type), geometries.begin()[0], geometries.begin()[1]));
  }
  check_reference_system(root, file);
  return root;
}

std::vector<std::vector<std::pair<double, double>>> read_lines(const std::string& file) {
  std::vector<std::vector<std::pair<double, double>>> lines;
  const std::initializer_list<const char*> types{"LineString", "Polygon", "MultiLineString", "MultiPolygon"};
  read_features(contents_of(file), file, "lines", types, [&](const Json& feature, std::size_t k) {
    const auto require = [&](bool condition, const char* what) {
      if (!condition) throw std::runtime_error(fmt::format("{}: feature {}: expected {}", file, k, what));
    };
    const auto geometry = feature.find("geometry");
    require(geometry != feature.end() && geometry->is_object() &&
                std::find(types.begin(), types.end(), text_of(*geometry, "type")) != types.end() &&
                geometry->contains("coordinates"),
            "lines or polygons");
    const auto add = [&](const auto& add_those_in, const Json& list) -> void {
      require(list.is_array() && !list.empty() && list[0].is_array() && !list[0].empty(),
              "lists of [longitude, latitude]");
      if (!list[0][0].is_number()) {
        for (const Json& part : list) add_those_in(add_those_in, part);
        return;
      }
      auto& line = lines.emplace_back();
      for (const Json& place : list) {
        require(place.is_array() && place.size() >= 2 && place[0].is_number() && place[1].is_number(),
                "lists of [longitude, latitude]");
        line.emplace_back(place[0].get<double>(), place[1].get<double>());
        require(std::fabs(line.back().first) <= 540 && std::fabs(line.back().second) <= 90,
                "longitudes within -540 to 540, latitudes within -90 to 90");
      }
    };
    add(add, (*geometry)["coordinates"]);
  });
  if (lines.empty()) throw std::runtime_error(file + ": no lines: there are no features");
  return lines;
}

}  // namespace files
