#include "pstripack/reading.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

#include "files/nearest.h"

namespace program {

CLI::Validator one_of(std::vector<std::string> words) {
  const auto check = [words = std::move(words)](const std::string& word) {
    return std::find(words.begin(), words.end(), word) != words.end()
               ? ""
               : fmt::format("'{}' is none of {}{}", word, fmt::join(words, ", "),
                             files::did_you_mean(word, words));
  };
  return CLI::Validator(check, "");
}

void add_reading(CLI::App& app, files::ReadOptions& read) {
  read.lengths_decide = true;
  using namespace files;
  add_choice(
      app, "--from", read.container,
      {{"text", Container::text},
       {"netcdf", Container::netcdf},
       {"geojson", Container::geojson},
       {"raw", Container::raw}},
      "text, netcdf, geojson or raw (doubles in this machine's byte order) [detected; raw must be named]");
  add_choice(
      app, "--coordinates", read.coordinates, {{"xyz", Coordinates::xyz}, {"lonlat", Coordinates::lonlat}},
      "xyz: three columns, any lengths; lonlat: two columns. Geodetic latitudes are taken as latitudes "
      "of a sphere, from which they differ by up to 0.19 degrees, 21 km [what names or number tell]");
  option(app, "--columns NAMES", read.columns,
         "lon,lat or x,y,z, then other columns to keep: their names; in text also their numbers, or "
         "first and last characters of fixed widths, as in 22-30,13-20 [all]");
  add_choice(app, "--separator", read.text.separator,
             {{"tab", '\t'}, {"comma", ','}, {"semicolon", ';'}, {"blank", ' '}},
             "what separates columns of text: tab, comma, semicolon or blank [detected]");
  add_choice(
      app, "--quote", read.text.has_quotes, {{"double", true}, {"none", false}},
      "double: text may stand in double quotes; none: double quotes are characters like others [double]");
  add_choice(app, "--units", read.units, {{"degrees", Units::degrees}, {"radians", Units::radians}},
             "degrees or radians, where the file does not say");
}

}  // namespace program
