#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <iostream>
#include <stdexcept>

#include "numbers.h"
#include "point_sets.h"

namespace point_sets {
namespace {

using Points = std::vector<pstripack::Point>;

std::string numbers(std::size_t count) {
  return std::to_string(count) + (count == 1 ? " number" : " numbers");
}

Points read(std::istream& in, const std::string& name) {
  Points points;
  std::size_t columns = 0, number = 0, line_of_count = 0;
  double count = 0;
  const auto fail = [&](std::size_t at, const std::string& what) {
    throw std::runtime_error(name + ":" + std::to_string(at) + ": " + what);
  };
  std::vector<double> v;
  for (std::string line; std::getline(in, line);) {
    ++number;
    line.resize(std::min(line.size(), line.find_first_of("#!")));
    v.clear();
    const char* const between = " \t\r\f\v,";
    for (std::size_t begin = 0, end; (begin = line.find_first_not_of(between, begin)) != line.npos;
         begin = end) {
      end = std::min(line.size(), line.find_first_of(between, begin));
      const std::string word = line.substr(begin, end - begin);
      double value;
      if (!parse(word, value)) fail(number, "'" + word + "' is not a finite number");
      v.push_back(value);
    }
    if (v.empty()) continue;
    if (columns == 0 && line_of_count == 0 && v.size() == 1 && v[0] >= 1 && v[0] == std::floor(v[0])) {
      line_of_count = number;
      count = v[0];
      continue;
    }
    if (columns == 0) columns = v.size();
    if (columns != 2 && columns != 3)
      fail(number, "expected 'lon lat' or 'x y z', found " + numbers(v.size()));
    if (v.size() != columns)
      fail(number, "found " + numbers(v.size()) + " where the lines before have " + std::to_string(columns));
    if (columns == 3) {
      points.push_back({v[0], v[1], v[2]});
    } else {
      if (std::fabs(v[1]) > 90) fail(number, "latitude outside -90..90 degrees");
      points.push_back(from_degrees(v[0], v[1]));
    }
  }
  if (in.bad()) throw std::runtime_error(name + ": read error");
  if (points.empty()) throw std::runtime_error(name + ": no points: expected lines 'lon lat' or 'x y z'");
  if (line_of_count > 0 && count != static_cast<double>(points.size()))
    fail(line_of_count, "a single number is the count of the points that follow; there are " +
                            std::to_string(points.size()));
  return points;
}

}  // namespace

bool parse(std::string text, double& value) {
  const bool hexadecimal = text.find_first_of("xX") != std::string::npos;
  if (!hexadecimal)
    for (char& c : text)
      if (c == 'd' || c == 'D') c = 'e';
  char* end = nullptr;
  value = std::strtod(text.c_str(), &end);
  return end != text.c_str() && *end == '\0' && std::isfinite(value);
}

Points read(const std::string& file) {
  if (file == "-") return read(std::cin, "stdin");
  std::ifstream in(file);
  if (!in) throw std::runtime_error(file + ": cannot be opened");
  return read(in, file);
}

}  // namespace point_sets
