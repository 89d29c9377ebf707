#include "pictures/svg.h"

#include <fmt/format.h>

#include <iterator>
#include <map>
#include <nlohmann/json.hpp>

namespace pictures {
namespace {

/// The text with U+FFFD in place of what is not UTF-8.
std::string valid_utf8(const std::string& text) {
  using nlohmann::json;
  return json::parse(json(text).dump(-1, ' ', false, json::error_handler_t::replace));
}

}  // namespace

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
