#include "pictures/svg.h"

#include <fmt/format.h>

#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <iterator>
#include <map>
#include <nlohmann/json.hpp>
#include <stdexcept>

namespace pictures {
namespace {

/// The text with U+FFFD in place of what is not UTF-8.
std::string valid_utf8(const std::string& text) {
  using nlohmann::json;
  return json::parse(json(text).dump(-1, ' ', false, json::error_handler_t::replace));
}

void write_png(files::OutputFile& file, const std::string& svg) {
  setenv("PSTRIPACK_PICTURE", file.path().c_str(), 1);
  std::FILE* const converter = popen("rsvg-convert --unlimited --output \"$PSTRIPACK_PICTURE\"", "w");
  if (converter == nullptr || std::fwrite(svg.data(), 1, svg.size(), converter) != svg.size() ||
      pclose(converter) != 0)
    throw std::runtime_error(file.name() + ": cannot be written: rsvg-convert has failed");
}

}  // namespace

std::optional<Kind> kind_of(const std::string& file) {
  const std::filesystem::path suffix = std::filesystem::path(file).extension();
  if (suffix == ".svg") return Kind::svg;
  if (suffix == ".png") return Kind::png;
  return std::nullopt;
}

void expect_converter(Kind kind) {
  if (kind == Kind::png && std::system("rsvg-convert --version > /dev/null 2>&1") != 0)
    throw std::runtime_error("PNG needs rsvg-convert (Debian: librsvg2-bin); write SVG without it");
}

void write(files::OutputFile& file, Kind kind, const std::string& svg) {
  if (kind == Kind::png) return write_png(file, svg);
  file.write(svg.data(), svg.size());
}

std::string escaped_for_xml(const std::string& text) {
  static const std::map<char, const char*> names{
      {'&', "&amp;"}, {'<', "&lt;"}, {'>', "&gt;"}, {'"', "&quot;"}};
  std::string result;
  for (const char c : valid_utf8(text))
    if (const auto name = names.find(c); name != names.end())
      result += name->second;
    else
      result += static_cast<unsigned char>(c) < 0x20 && c != '\n' && c != '\t' ? '?' : c;
  return result;
}

void Path::move(const Place& p) {
  const Hundredths to = rounded(p);
  if (to.x == last_.x && to.y == last_.y) return;
  last_ = to;
  add('M', last_);
}

void Path::line(const Place& p) {
  const Hundredths to = rounded(p), by{to.x - last_.x, to.y - last_.y};
  if (by.x == 0 && by.y == 0) return;
  add('l', by);
  last_ = to;
}

void Path::add(char command, const Hundredths& p) {
  fmt::format_to(std::back_inserter(data_), "{}{} {}", command, static_cast<double>(p.x) / 100,
                 static_cast<double>(p.y) / 100);
}

}  // namespace pictures
