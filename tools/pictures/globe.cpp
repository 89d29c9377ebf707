#include "pictures/globe.h"

#include <charconv>
#include <cmath>
#include <string_view>
#include <utility>

#include "files/measures.h"

namespace pictures {
namespace {

/// A text of JSON that may stand in an element <script>.
std::string quoted(const std::string& text) {
  std::string result = "\"";
  for (const char c : text) {
    if (const auto code = static_cast<unsigned char>(c); code < 0x20 || c == '"' || c == '\\' || c == '<') {
      constexpr const char* kDigits = "0123456789abcdef";
      result += "\\u00";
      result += kDigits[code >> 4];
      result += kDigits[code & 15];
    } else {
      result += c;
    }
  }
  return result + '"';
}

/// NaN is null.
std::string number(double value) {
  char text[32];
  return std::isnan(value) ? "null" : std::string(text, std::to_chars(text, text + sizeof text, value).ptr);
}

/// [f(item),f(item),...]
template <class Items, class Text>
std::string list(const Items& items, const Text& f) {
  std::string text = "[";
  for (const auto& item : items) text += (text.size() > 1 ? "," : "") + f(item);
  return text + "]";
}

/// In degrees, to 0.1 mm on the Earth.
std::string list_of_angles(const std::vector<double>& angles) {
  return list(angles, [](double angle) { return number(std::round(angle * 1e9) / 1e9); });
}

/// Of each triangle: the smallest corner less that of the triangle before, and the other corners less it.
std::string list_of_triangles(const std::vector<std::int32_t>& corners) {
  std::int32_t first = 0;
  std::size_t k = 0;
  return list(corners, [&](std::int32_t corner) {
    const std::int32_t difference = corner - first;
    if (k++ % 3 == 0) first = corner;
    return std::to_string(difference);
  });
}

/// Of each line: the longitudes and latitudes of its places in 1e-5 degrees, which is a metre, less those of
/// the place before.
std::string list_of_lines(const Lines& lines) {
  return list(lines, [](const std::vector<pstripack::Point>& line) {
    long lon = 0, lat = 0;
    return list(line, [&](const pstripack::Point& p) {
      const long x = std::lround(files::longitude(p) * 1e5), y = std::lround(files::latitude(p) * 1e5);
      return std::to_string(x - std::exchange(lon, x)) + "," + std::to_string(y - std::exchange(lat, y));
    });
  });
}

std::string data_of(const Globe& globe) {
  std::string text = "{\"title\":" + quoted(globe.title) +
                     ",\"first\":" + std::to_string(globe.first_number) +
                     ",\"cells\":" + (globe.cells ? "true" : "false");
  const auto add = [&](const char* name, const std::string& json) {
    text += std::string(",\n\"") + name + "\":" + json;
  };
  add("lon", list_of_angles(globe.lon));
  add("lat", list_of_angles(globe.lat));
  add("triangles", list_of_triangles(globe.triangles));
  if (const Shading& shading = globe.shading; !shading.of_face.empty()) {
    add("shades", list(shading.of_face, [](std::size_t shade) { return std::to_string(shade); }));
    add("legend", quoted(shading.title));
    add("colours", list(shading.shades, [](const Shade& s) { return quoted(s.colour); }));
    add("labels", list(shading.shades, [](const Shade& s) { return quoted(s.label); }));
    add("counts", list(shading.shades, [](const Shade& s) { return std::to_string(s.count); }));
    if (const auto& scale = shading.scale)
      add("ticks", list(scale->ticks(), [&](const Scale::Tick& tick) {
            return '[' + number((*scale)(tick.value)) + ',' + quoted(tick.label) + ']';
          }));
  }
  if (!globe.numbers.empty() || !globe.words.empty()) {
    add("name", quoted(globe.value_name));
    add("unit", quoted(globe.value_unit));
    if (globe.words.empty())
      add("numbers", list(globe.numbers, number));
    else
      add("words", list(globe.words, quoted));
  }
  if (!globe.coasts.empty()) add("coasts", list_of_lines(globe.coasts));
  if (const auto& centre = globe.centre)
    add("centre", '[' + number((*centre)[0]) + ',' + number((*centre)[1]) + ']');
  if (globe.radius) add("radius", number(*globe.radius));
  return text + '}';
}

}  // namespace

std::string globe_page(const Globe& globe) {
  constexpr std::string_view kMark = "/*DATA*/";
  std::string page(kGlobeHtml);
  return page.replace(page.find(kMark), kMark.size(), data_of(globe));
}

}  // namespace pictures
