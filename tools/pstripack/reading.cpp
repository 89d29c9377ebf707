#include "pstripack/reading.h"

#include <fmt/format.h>

#include "files/nearest.h"

namespace program {

std::string is_none_of(const std::string& word, const std::vector<std::string>& words) {
  return fmt::format("'{}' is none of {}{}", word, fmt::join(words, ", "), files::did_you_mean(word, words));
}

void add_reading(CLI::App& app, files::ReadOptions& read) {
  read.lengths_decide = true;
  using namespace files;
  add_choice(app, "--from", read.container,
             {{"text", Container::text},
              {"netcdf", Container::netcdf},
              {"geojson", Container::geojson},
              {"raw", Container::raw}},
             "text, netcdf, geojson or raw (doubles in this machine's byte order) [detected, but for raw]");
  add_choice(
      app, "--coordinates", read.coordinates, {{"xyz", Coordinates::xyz}, {"lonlat", Coordinates::lonlat}},
      "xyz: three columns, any lengths; lonlat: two columns, geodetic latitudes taken as those of a sphere: "
      "up to 0.19 degrees, 21 km, off [by their names or number]");
  app.add_option("--columns", read.columns,
                 "lon,lat or x,y,z, then other columns to keep: names, or in text numbers [all]")
      ->type_name("NAMES");
  add_choice(app, "--units", read.units, {{"degrees", Units::degrees}, {"radians", Units::radians}},
             "degrees or radians, where the file does not say");
}

}  // namespace program
