#include "pictures/globe.h"

#include <cerrno>
#include <charconv>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string_view>

#include "files/measures.h"
#include "pictures/globe_html.h"

namespace pictures {
namespace {

constexpr const char* kThree = "/usr/share/javascript/three/three.min.js";

/// Bytes as the script reads them, as base64.
class Bytes {
 public:
  /// In little-endian order.
  void add(double value) {
    std::uint64_t bits;
    std::memcpy(&bits, &value, sizeof bits);
    for (int shift = 0; shift < 64; shift += 8) bytes_ += static_cast<char>((bits >> shift) & 255);
  }
  /// Seven bits a byte, the lowest first; all bytes but the last have the highest bit.
  void add(std::uint32_t value) {
    for (; value > 127; value >>= 7) bytes_ += static_cast<char>((value & 127) | 128);
    bytes_ += static_cast<char>(value);
  }
  /// Differences of either sign: 0, -1, 1, -2 are 0, 1, 2, 3.
  void add_signed(std::int32_t value) {
    const auto bits = static_cast<std::uint32_t>(value);
    add(value < 0 ? ~(bits << 1) : bits << 1);
  }
  std::string base64() const {
    constexpr const char* kDigits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    text.reserve(bytes_.size() / 3 * 4 + 4);
    for (std::size_t i = 0; i < bytes_.size(); i += 3) {
      unsigned bits = 0;
      for (std::size_t k = i; k < i + 3; ++k)
        bits = bits << 8 | (k < bytes_.size() ? static_cast<unsigned char>(bytes_[k]) : 0U);
      for (std::size_t k = 0; k < 4; ++k)
        text += i + k > bytes_.size() ? '=' : kDigits[(bits >> (18 - 6 * k)) & 63];
    }
    return text;
  }

 private:
  std::string bytes_;
};

std::string base64(const std::vector<double>& values) {
  Bytes bytes;
  for (const double value : values) bytes.add(value);
  return bytes.base64();
}

/// Of each triangle: the smallest corner less that of the triangle before, and the other corners less it.
std::string base64_of_triangles(const std::vector<std::int32_t>& corners) {
  Bytes bytes;
  std::int32_t last = 0;
  for (std::size_t k = 0; k < corners.size(); k += 3) {
    const std::int32_t first = corners[k];
    for (const std::int32_t difference : {first - last, corners[k + 1] - first, corners[k + 2] - first})
      bytes.add(static_cast<std::uint32_t>(difference));
    last = first;
  }
  return bytes.base64();
}

/// Of each line: how many places, and their longitudes and latitudes in 1e-5 degrees, which is a metre, less
/// those of the place before.
std::string base64_of_lines(const Lines& lines) {
  Bytes bytes;
  std::int32_t lon = 0, lat = 0;
  for (const auto& line : lines) {
    bytes.add(static_cast<std::uint32_t>(line.size()));
    for (const pstripack::Point& p : line) {
      const auto x = static_cast<std::int32_t>(std::lround(files::longitude(p) * 1e5)),
                 y = static_cast<std::int32_t>(std::lround(files::latitude(p) * 1e5));
      bytes.add_signed(x - lon), bytes.add_signed(y - lat);
      lon = x, lat = y;
    }
  }
  return bytes.base64();
}

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

std::string number(double value) {
  char text[32];
  return {text, std::to_chars(text, text + sizeof text, value).ptr};
}

/// [f(item),f(item),...]
template <class Items, class Text>
std::string list(const Items& items, const Text& f) {
  std::string text = "[";
  for (const auto& item : items) text += (text.size() > 1 ? "," : "") + f(item);
  return text + "]";
}

std::string data_of(const Globe& globe) {
  std::string text = "{\"title\":" + quoted(globe.title) +
                     ",\"first\":" + std::to_string(globe.first_number) +
                     ",\"cells\":" + (globe.cells ? "true" : "false");
  const auto add = [&](const char* name, const std::string& json) {
    text += std::string(",\n\"") + name + "\":" + json;
  };
  const auto add_bytes = [&](const char* name, const std::string& base64) { add(name, '"' + base64 + '"'); };
  add_bytes("lon", base64(globe.lon));
  add_bytes("lat", base64(globe.lat));
  add_bytes("triangles", base64_of_triangles(globe.triangles));
  if (!globe.areas.empty()) add_bytes("areas", base64(globe.areas));
  if (const Shading& shading = globe.shading; !shading.of_face.empty()) {
    Bytes bytes;
    for (const std::size_t shade : shading.of_face) bytes.add(static_cast<std::uint32_t>(shade));
    add_bytes("shades", bytes.base64());
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
      add_bytes("numbers", base64(globe.numbers));
    else
      add("words", list(globe.words, quoted));
  }
  if (!globe.coasts.empty()) add_bytes("coasts", base64_of_lines(globe.coasts));
  if (const auto& centre = globe.centre)
    add("centre", '[' + number((*centre)[0]) + ',' + number((*centre)[1]) + ']');
  if (globe.radius) add("radius", number(*globe.radius));
  return text + '}';
}

}  // namespace

std::string three_js(const std::string& file) {
  const char* const from_environment = std::getenv("PSTRIPACK_THREE");
  const std::string name = !file.empty() ? file : from_environment != nullptr ? from_environment : kThree;
  std::ifstream in(name, std::ios::binary);
  if (!in)
    throw std::runtime_error(
        name + ": cannot be opened: " + std::strerror(errno) +
        ": globes need three.js (Debian: libjs-three; npm: three@0.160, build/three.min.js); name it by "
        "--three-file, in Python three_file=, or PSTRIPACK_THREE");
  std::string text{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
  if (text.find(".WebGLRenderer=") == std::string::npos && text.find(".WebGLRenderer =") == std::string::npos)
    throw std::runtime_error(name +
                             ": not three.js as one script: three.min.js of a release from 111 to 160");
  // A script ends at this word, wherever it stands. In JavaScript it only occurs in texts.
  for (std::size_t at = 0; (at = text.find("</script", at)) != std::string::npos; at += 2)
    text.insert(at + 1, "\\");
  return text;
}

std::string globe_page(const Globe& globe, const std::string& three) {
  std::string page(kGlobeHtml);
  const auto insert = [&](std::string_view mark, const std::string& text) {
    page.replace(page.find(mark), mark.size(), text);
  };
  insert("/*DATA*/", data_of(globe));
  insert("/*THREE*/", three);
  return page;
}

}  // namespace pictures
