#include "point_sets.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <functional>
#include <iostream>
#include <map>
#include <sstream>
#include <stdexcept>
#include <utility>

namespace point_sets {
namespace {

using pstripack::Point;
using Points = std::vector<Point>;

constexpr double degrees_per_radian = 57.295779513082320876798154814105;

Point operator+(const Point& a, const Point& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
Point operator*(double s, const Point& a) { return {s * a.x, s * a.y, s * a.z}; }

/// m >= least such that the number of nodes count(m), which increases, is nearest to n.
template <class Count>
std::size_t nearest(std::size_t n, std::size_t least, Count count) {
  std::size_t m = least;
  while (count(m) < n) ++m;
  return m > least && n - count(m - 1) <= count(m) - n ? m - 1 : m;
}

/// A uniform point in the unit disc: (u, v) with 0 < u^2 + v^2 < 1.
std::pair<double, double> in_disc(Random& random) {
  for (;;) {
    const double u = random.uniform(-1, 1), v = random.uniform(-1, 1), s = u * u + v * v;
    if (s > 0 && s < 1) return {u, v};
  }
}

/// A uniform point in the cap of the given radius around c. Accurate for the smallest radii.
Point in_cap(Random& random, const Point& c, double radius) {
  const Point axis = std::fabs(c.x) < 0.6 ? Point{1, 0, 0} : Point{0, 1, 0};
  const Point e1 = normalized(cross(c, axis)), e2 = cross(c, e1);
  const double half = sin_degrees(0.5 * radius * degrees_per_radian);
  const auto [u, v] = in_disc(random);
  const double s = u * u + v * v;
  const double drop = s * 2 * half * half;  // 1 - cos of the distance from c
  const double r = std::sqrt(drop * (2 - drop) / s);
  return normalized((1 - drop) * c + (r * u) * e1 + (r * v) * e2);
}

/// Of the caps: nothing special about it.
Point centre() { return normalized({0.3, -0.5, 0.8}); }

Points uniform(std::size_t n, Random& random) {
  Points p(n);
  for (Point& q : p) q = random.direction();
  return p;
}

Points single(std::size_t n, Random& random) {
  Points p = uniform(n, random);
  for (Point& q : p) q = {static_cast<float>(q.x), static_cast<float>(q.y), static_cast<float>(q.z)};
  return p;
}

Points fibonacci(std::size_t n) {
  Points p;
  for (std::size_t i = 0; i < n; ++i) {
    const double z = 1 - (2 * static_cast<double>(i) + 1) / static_cast<double>(n);
    const double r = std::sqrt((1 - z) * (1 + z));
    const double longitude = std::fmod(static_cast<double>(i) * 137.50776405003785464634873962837, 360);
    p.push_back({r * cos_degrees(longitude), r * sin_degrees(longitude), z});
  }
  return p;
}

Points icosahedral(std::size_t n) {
  const std::size_t m = nearest(n, 1, [](std::size_t k) { return 10 * k * k + 2; });
  const double g = (1 + std::sqrt(5.0)) / 2;
  const Points corner = {{-1, g, 0},  {-g, 0, 1}, {-1, -g, 0}, {1, -g, 0}, {0, -1, g},  {0, 1, g},
                         {0, -1, -g}, {0, 1, -g}, {g, 0, -1},  {g, 0, 1},  {-g, 0, -1}, {1, g, 0}};
  const std::size_t face[20][3] = {{0, 1, 5},  {0, 5, 11}, {0, 11, 7}, {0, 7, 10}, {0, 10, 1},
                                   {11, 5, 9}, {5, 1, 4},  {1, 10, 2}, {10, 7, 6}, {7, 11, 8},
                                   {3, 9, 4},  {3, 4, 2},  {3, 2, 6},  {3, 6, 8},  {3, 8, 9},
                                   {4, 9, 5},  {2, 4, 1},  {6, 2, 10}, {8, 6, 7},  {9, 8, 11}};
  Points p;
  for (const Point& c : corner) p.push_back(normalized(c));
  const auto at = [m](std::size_t i) { return static_cast<double>(i) / static_cast<double>(m); };
  for (const auto& f : face)
    for (int k = 0; k < 3; ++k) {
      const std::size_t a = f[k], b = f[(k + 1) % 3];
      if (a < b)  // each edge once
        for (std::size_t i = 1; i < m; ++i)
          p.push_back(normalized(at(m - i) * corner[a] + at(i) * corner[b]));
    }
  for (const auto& f : face)
    for (std::size_t i = 1; i < m; ++i)
      for (std::size_t j = 1; i + j < m; ++j)
        p.push_back(normalized(at(m - i - j) * corner[f[0]] + at(i) * corner[f[1]] + at(j) * corner[f[2]]));
  return p;
}

Points latlon(std::size_t n) {
  const std::size_t rows = nearest(n, 2, [](std::size_t k) { return 2 * k * k + 2; });
  Points p{{0, 0, -1}};
  for (std::size_t j = 1; j <= rows; ++j)
    for (std::size_t i = 0; i < 2 * rows; ++i)
      p.push_back(from_degrees(360 * static_cast<double>(i) / static_cast<double>(2 * rows),
                               -90 + 180 * static_cast<double>(j) / static_cast<double>(rows + 1)));
  p.push_back({0, 0, 1});
  return p;
}

/// The root number i = 1, 2, ... (from the north) of the Legendre polynomial of the given degree.
double gaussian_sine(std::size_t i, std::size_t degree) {
  const double d = static_cast<double>(degree);
  double z = cos_degrees(180 * (static_cast<double>(i) - 0.25) / (d + 0.5));
  for (int newton = 0; newton < 6; ++newton) {
    double p0 = 1, p1 = z;
    for (std::size_t k = 2; k <= degree; ++k) {
      const double kk = static_cast<double>(k);
      const double p2 = ((2 * kk - 1) * z * p1 - (kk - 1) * p0) / kk;
      p0 = p1, p1 = p2;
    }
    z -= p1 * (z * z - 1) / (d * (z * p1 - p0));
  }
  return z;
}

Points reduced_gaussian(std::size_t n) {
  const std::size_t m = nearest(n, 1, [](std::size_t k) { return 4 * k * (k + 9); });
  Points p;
  for (std::size_t row = 1; row <= 2 * m; ++row) {
    const std::size_t from_pole = row <= m ? row : 2 * m + 1 - row, count = 4 * from_pole + 16;
    const double z = (row <= m ? 1 : -1) * gaussian_sine(from_pole, 2 * m), r = std::sqrt((1 - z) * (1 + z));
    for (std::size_t i = 0; i < count; ++i) {
      const double longitude = 360 * static_cast<double>(i) / static_cast<double>(count);
      p.push_back({r * cos_degrees(longitude), r * sin_degrees(longitude), z});
    }
  }
  return p;
}

Points healpix(std::size_t n) {
  const std::size_t m = nearest(n, 1, [](std::size_t k) { return 12 * k * k; });
  Points p;
  for (std::size_t ring = 1; ring < 4 * m; ++ring) {
    const std::size_t from_pole = std::min(ring, 4 * m - ring);
    const double mm = static_cast<double>(m), i = static_cast<double>(from_pole);
    double z, shift;
    std::size_t count;
    if (from_pole < m) {
      z = 1 - i * i / (3 * mm * mm), shift = 0.5, count = 4 * from_pole;
    } else {
      z = 4.0 / 3 - 2 * i / (3 * mm), shift = (ring - m) % 2 == 0 ? 0.5 : 0, count = 4 * m;
    }
    const double r = std::sqrt((1 - z) * (1 + z));
    for (std::size_t j = 0; j < count; ++j) {
      const double longitude = 360 * (static_cast<double>(j) + shift) / static_cast<double>(count);
      p.push_back({r * cos_degrees(longitude), r * sin_degrees(longitude), ring <= 2 * m ? z : -z});
    }
  }
  return p;
}

Points cubed_sphere(std::size_t n) {
  const std::size_t m = nearest(n, 1, [](std::size_t k) { return 6 * k * k; });
  const Points face[6] = {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}},   {{0, 1, 0}, {-1, 0, 0}, {0, 0, 1}},
                          {{-1, 0, 0}, {0, -1, 0}, {0, 0, 1}}, {{0, -1, 0}, {1, 0, 0}, {0, 0, 1}},
                          {{0, 0, 1}, {0, 1, 0}, {-1, 0, 0}},  {{0, 0, -1}, {0, 1, 0}, {1, 0, 0}}};
  const auto tangent = [m](std::size_t i) {
    const double angle = 90 * (static_cast<double>(2 * i + 1) / static_cast<double>(2 * m)) - 45;
    return sin_degrees(angle) / cos_degrees(angle);
  };
  Points p;
  for (const Points& f : face)
    for (std::size_t j = 0; j < m; ++j)
      for (std::size_t i = 0; i < m; ++i)
        p.push_back(normalized(f[0] + tangent(i) * f[1] + tangent(j) * f[2]));
  return p;
}

// In the cap north of 65 N, as the disc |w| < 1 of a stereographic map, the two poles sit at w = +-1; with
// zeta = (1+w)/(1-w) the grid lines are the rays and the circles around 0 of the half plane Re zeta > 0.
Points tripolar(std::size_t n) {
  const auto southern = [](std::size_t m) { return (m * 145 + 180) / 360 + 1; };  // rows 80 S .. 65 N
  const auto northern = [](std::size_t m) { return m / 8; };                      // rows up to the seam
  const std::size_t m =
      2 * nearest(n, 2, [&](std::size_t k) { return 2 * k * southern(2 * k) + 2 * k * northern(2 * k) + k; });
  const auto column = [m](std::size_t i) {
    return 360 * (static_cast<double>(i) + 0.5) / static_cast<double>(m);
  };
  Points p;
  for (std::size_t j = 0; j < southern(m); ++j)
    for (std::size_t i = 0; i < m; ++i)
      p.push_back(
          from_degrees(column(i), -80 + 145 * static_cast<double>(j) / static_cast<double>(southern(m) - 1)));
  const double edge = cos_degrees(65) / (1 + sin_degrees(65));  // stereographic radius of 65 N
  for (std::size_t j = 1; j <= northern(m) + 1; ++j) {
    const bool seam = j == northern(m) + 1;
    const double ray = 90 * (1 - static_cast<double>(j) / static_cast<double>(northern(m) + 1));
    for (std::size_t i = 0; i < (seam ? m / 2 : m); ++i) {
      const double half = 0.5 * column(i), radius = std::fabs(cos_degrees(half) / sin_degrees(half));
      const double a = radius * cos_degrees(ray), b = (i < m / 2 ? 1 : -1) * radius * sin_degrees(ray);
      const double scale = edge / ((a + 1) * (a + 1) + b * b);  // w = (zeta - 1)/(zeta + 1)
      const double u = scale * (a * a + b * b - 1), v = scale * 2 * b, s = u * u + v * v;
      p.push_back({2 * u / (1 + s), 2 * v / (1 + s), (1 - s) / (1 + s)});
    }
  }
  return p;
}

Points ring(std::size_t n) {
  Points p;
  const double z = sin_degrees(60), r = 0.5;
  for (std::size_t i = 0; i + 1 < n; ++i) {
    const double longitude = 360 * static_cast<double>(i) / static_cast<double>(n - 1);
    p.push_back({r * cos_degrees(longitude), r * sin_degrees(longitude), z});
  }
  if (n > 0) p.push_back({0, 0, 1});
  return p;
}

// Density 1/(b - z)^2 along the axis z: its integral is elementary, and so is the inverse of that.
Points variable(std::size_t n, double ratio, Random& random) {
  const double root = std::sqrt(ratio), b = (root + 1) / (root - 1), low = 1 / (b + 1), high = 1 / (b - 1);
  Points p(n);
  for (Point& q : p) {
    const double z = std::clamp(b - 1 / (low + random.uniform() * (high - low)), -1.0, 1.0);
    const auto [u, v] = in_disc(random);
    const double r = std::sqrt((1 - z) * (1 + z) / (u * u + v * v));
    q = {z, r * u, r * v};
  }
  return p;
}

/// Every other node uniform, the others in caps around the given centres in turn.
Points half_in_caps(std::size_t n, const Points& centres, double radius, Random& random) {
  Points p;
  for (std::size_t i = 0; i < n; ++i)
    p.push_back(i % 2 == 0 ? random.direction() : in_cap(random, centres[i / 2 % centres.size()], radius));
  return p;
}

Points caps(std::size_t n, const Points& centres, double radius, Random& random) {
  Points p;
  for (std::size_t i = 0; i < n; ++i) p.push_back(in_cap(random, centres[i % centres.size()], radius));
  return p;
}

Points box(std::size_t n, double width) {
  const std::size_t m = nearest(n, 2, [](std::size_t k) { return k * k; });
  const double step = width * degrees_per_radian / static_cast<double>(m - 1);
  Points p;
  for (std::size_t j = 0; j < m; ++j)
    for (std::size_t i = 0; i < m; ++i)
      p.push_back(from_degrees(10 + step * static_cast<double>(i), 50 + step * static_cast<double>(j)));
  return p;
}

Points strip(std::size_t n, double width, Random& random) {
  const Point e1 = normalized(cross(centre(), {1, 0, 0})), e2 = cross(centre(), e1);
  Points p;
  for (std::size_t i = 0; i < n; ++i) {
    const double longitude = random.uniform(0, 360), height = width * (random.uniform() - 0.5);
    p.push_back(normalized(cos_degrees(longitude) * e1 + sin_degrees(longitude) * e2 + height * centre()));
  }
  return p;
}

Points pairs(std::size_t n, double distance, Random& random) {
  Points p;
  for (std::size_t i = 0; i < (n + 1) / 2; ++i) {
    const Point q = random.direction();
    p.push_back(q);
    p.push_back(normalized(q + distance * normalized(cross(q, random.direction()))));
  }
  return p;
}

Points hemisphere(std::size_t n, bool rim, Random& random) {
  Points p;
  while (p.size() < n) {
    const Point q = random.direction();
    if (rim && p.size() % 2 == 0) {
      const double longitude = random.uniform(0, 360);
      p.push_back({cos_degrees(longitude), sin_degrees(longitude), 0});
    } else if (q.z > 0) {
      p.push_back(q);
    }
  }
  return p;
}

Points eight_centres() {
  Random random(8);
  return uniform(8, random);
}

struct Family {
  std::string name;
  double parameter;  // its default; 0: the family takes none
  std::function<Points(std::size_t n, double parameter, Random& random)> make;
};

const std::vector<Family>& table() {
  static const std::vector<Family> families = {
      {"random", 0, [](std::size_t n, double, Random& r) { return uniform(n, r); }},
      {"single", 0, [](std::size_t n, double, Random& r) { return single(n, r); }},
      {"fibonacci", 0, [](std::size_t n, double, Random&) { return fibonacci(n); }},
      {"icosahedral", 0, [](std::size_t n, double, Random&) { return icosahedral(n); }},
      {"latlon", 0, [](std::size_t n, double, Random&) { return latlon(n); }},
      {"reduced-gaussian", 0, [](std::size_t n, double, Random&) { return reduced_gaussian(n); }},
      {"healpix", 0, [](std::size_t n, double, Random&) { return healpix(n); }},
      {"cubed-sphere", 0, [](std::size_t n, double, Random&) { return cubed_sphere(n); }},
      {"tripolar", 0, [](std::size_t n, double, Random&) { return tripolar(n); }},
      {"ring", 0, [](std::size_t n, double, Random&) { return ring(n); }},
      {"variable", 1e4, [](std::size_t n, double ratio, Random& r) { return variable(n, ratio, r); }},
      {"clusters", 1e-3,
       [](std::size_t n, double radius, Random& r) { return half_in_caps(n, eight_centres(), radius, r); }},
      {"dense-cap", 1e-5,
       [](std::size_t n, double radius, Random& r) { return half_in_caps(n, {centre()}, radius, r); }},
      {"antipodal", 0.1,
       [](std::size_t n, double radius, Random& r) {
         return caps(n, {centre(), -1.0 * centre()}, radius, r);
       }},
      {"cap", 0.0175, [](std::size_t n, double radius, Random& r) { return caps(n, {centre()}, radius, r); }},
      {"box", 0.00175, [](std::size_t n, double width, Random&) { return box(n, width); }},
      {"strip", 1e-9, [](std::size_t n, double width, Random& r) { return strip(n, width, r); }},
      {"pairs", 1e-10, [](std::size_t n, double distance, Random& r) { return pairs(n, distance, r); }},
      {"hemisphere", 0, [](std::size_t n, double, Random& r) { return hemisphere(n, false, r); }},
      {"hemisphere-rim", 0, [](std::size_t n, double, Random& r) { return hemisphere(n, true, r); }},
  };
  return families;
}

/// The whole of `text` as a finite number; also 1.5D-3, as Fortran programs write it.
bool parse(std::string text, double& value) {
  const bool hexadecimal = text.find_first_of("xX") != std::string::npos;
  if (!hexadecimal)
    for (char& c : text)
      if (c == 'd' || c == 'D') c = 'e';
  char* end = nullptr;
  value = std::strtod(text.c_str(), &end);
  return end != text.c_str() && *end == '\0' && std::isfinite(value);
}

Points read(std::istream& in, const std::string& name) {
  Points points;
  std::size_t columns = 0, number = 0;
  for (std::string line; std::getline(in, line);) {
    ++number;
    const auto fail = [&](const std::string& what) {
      throw std::runtime_error(name + ":" + std::to_string(number) + ": " + what);
    };
    line.resize(std::min(line.size(), line.find_first_of("#!")));
    std::replace(line.begin(), line.end(), ',', ' ');
    std::istringstream words(line);
    std::vector<double> v;
    for (std::string word; words >> word;) {
      double value;
      if (!parse(word, value)) fail("'" + word + "' is not a finite number");
      v.push_back(value);
    }
    if (v.empty()) continue;
    if (columns == 0) columns = v.size();
    if (columns != 2 && columns != 3)
      fail("expected 'lon lat' or 'x y z', found " + std::to_string(v.size()) + " numbers");
    if (v.size() != columns)
      fail("found " + std::to_string(v.size()) + " numbers where the lines before have " +
           std::to_string(columns));
    if (columns == 3) {
      points.push_back({v[0], v[1], v[2]});
    } else {
      if (std::fabs(v[1]) > 90) fail("latitude outside -90..90 degrees");
      points.push_back(from_degrees(v[0], v[1]));
    }
  }
  if (in.bad()) throw std::runtime_error(name + ": read error");
  if (points.empty()) throw std::runtime_error(name + ": no points");
  return points;
}

}  // namespace

std::vector<Point> make(const std::string& family, std::size_t n, std::uint64_t seed) {
  const std::size_t colon = family.find(':');
  const std::string name = family.substr(0, colon);
  for (const Family& f : table()) {
    if (f.name != name) continue;
    double parameter = f.parameter;
    if (colon != std::string::npos) {
      const double least = name == "variable" ? 1 : 0;
      if (f.parameter == 0) throw std::invalid_argument("point set '" + name + "' takes no parameter");
      if (!parse(family.substr(colon + 1), parameter) || parameter <= least)
        throw std::invalid_argument("point set '" + family + "': the parameter must be a number above " +
                                    (least == 0 ? "0" : "1"));
    }
    Random random(seed);
    return f.make(n, parameter, random);
  }
  std::string known;
  for (const std::string& k : families()) known += (known.empty() ? "" : ", ") + k;
  throw std::invalid_argument("unknown point set '" + name + "'; there are: " + known);
}

const std::vector<std::string>& families() {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> v;
    for (const Family& f : table()) v.push_back(f.name);
    return v;
  }();
  return names;
}

std::vector<Point> read(const std::string& file) {
  if (file == "-") return read(std::cin, "stdin");
  std::ifstream in(file);
  if (!in) throw std::runtime_error(file + ": cannot be opened");
  return read(in, file);
}

std::uint64_t Random::bits() {
  std::uint64_t z = (state_ += 0x9e3779b97f4a7c15);
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9;
  z = (z ^ (z >> 27)) * 0x94d049bb133111eb;
  return z ^ (z >> 31);
}

Point Random::direction() {
  const auto [u, v] = in_disc(*this);
  const double s = u * u + v * v, r = 2 * std::sqrt(1 - s);  // Marsaglia 1972
  return {r * u, r * v, 1 - 2 * s};
}

void shuffle(std::vector<Point>& points, std::uint64_t seed) {
  Random random(seed);
  for (std::size_t i = points.size(); i > 1; --i) std::swap(points[i - 1], points[random.below(i)]);
}

// The angle is reduced to 45 degrees without rounding, so that symmetric angles have equal sines.
double sin_degrees(double angle) {
  const double turn = std::fmod(angle, 360);
  const double quarter = std::round(turn / 90);
  const double t = (turn - 90 * quarter) / degrees_per_radian, s = t * t;
  double sine = 0, cosine = 0;
  for (int k = 19; k >= 3; k -= 2) sine = (1 + sine) * (-s / (k * (k - 1)));
  for (int k = 18; k >= 2; k -= 2) cosine = (1 + cosine) * (-s / (k * (k - 1)));
  switch ((static_cast<int>(quarter) % 4 + 4) % 4) {
    case 0:
      return t + t * sine;
    case 1:
      return 1 + cosine;
    case 2:
      return -(t + t * sine);
    default:
      return -(1 + cosine);
  }
}

double cos_degrees(double angle) { return sin_degrees(90 - std::fabs(std::fmod(angle, 360))); }

Point from_degrees(double longitude, double latitude) {
  const double r = cos_degrees(latitude);
  return {r * cos_degrees(longitude), r * sin_degrees(longitude), sin_degrees(latitude)};
}

Point normalized(const Point& p) {
  const double length = std::sqrt(p.x * p.x + p.y * p.y + p.z * p.z);
  return {p.x / length, p.y / length, p.z / length};
}

}  // namespace point_sets
