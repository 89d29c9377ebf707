// TRPLOT, VRPLOT: the test reads the file back and compares its lines with the arcs of the triangulation, or
// the edges of the cells, that have an end in the window. Ghostscript renders the file.

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <fstream>
#include <limits>
#include <map>
#include <random>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "support/child.h"
#include "support/fortran_mesh.h"
#include "support/fortran_unit.h"
#include "support/sanitizer.h"

namespace {

using Vec = std::array<double, 3>;
constexpr int unit = 42;
const double degree = std::acos(-1.0) / 180;

double dot(const Vec& a, const Vec& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }
Vec scaled(const Vec& a, double s) { return {a[0] * s, a[1] * s, a[2] * s}; }
Vec plus(const Vec& a, const Vec& b) { return {a[0] + b[0], a[1] + b[1], a[2] + b[2]}; }
Vec direction(const Vec& a) { return scaled(a, 1 / std::sqrt(dot(a, a))); }

/// Random nodes within `reach` degrees of a place.
Nodes random_nodes(std::size_t n, double reach, unsigned seed) {
  std::mt19937_64 bits(seed);
  std::uniform_real_distribution<double> uniform(-1, 1);
  const Vec middle = direction({0.3, -0.8, 0.5});
  Nodes nodes;
  while (nodes.size() < n) {
    const Vec v{uniform(bits), uniform(bits), uniform(bits)};
    if (dot(v, v) > 1 || dot(v, v) < 0.01) continue;
    const Vec p = direction(reach > 30 ? v : plus(middle, scaled(v, std::sin(reach * degree))));
    if (dot(p, middle) >= std::cos(reach * degree)) nodes.push_back({p[0], p[1], p[2]});
  }
  return nodes;
}

/// Such nodes, their triangulation and their Voronoi diagram.
struct Sphere : FortranMesh {
  Sphere(int nodes, double reach, unsigned seed)
      : FortranMesh(random_nodes(static_cast<std::size_t>(nodes), reach, seed)), nt(2 * nodes - 4) {
    const auto size = static_cast<std::size_t>(6 * n);
    listc.resize(size);
    for (std::vector<double>* array : {&xc, &yc, &zc}) array->resize(size);
    std::vector<int> ltri(size);
    std::vector<double> rc(size);
    int ier, nb;
    voronoi_lptr = lptr;
    crlist_(&n, &n, x.data(), y.data(), z.data(), list.data(), lend.data(), voronoi_lptr.data(), &lnew,
            ltri.data(), listc.data(), &nb, xc.data(), yc.data(), zc.data(), rc.data(), &ier);
    EXPECT_EQ(ier, 0);
  }

  Vec node(int k) const { return {x[k - 1], y[k - 1], z[k - 1]}; }
  Vec vertex(int k) const { return {xc[k - 1], yc[k - 1], zc[k - 1]}; }

  /// The arcs and the edges of cells, by the numbers of their ends.
  std::set<std::pair<int, int>> arcs() const {
    std::set<std::pair<int, int>> all;
    for (int k = 1; k <= n; ++k) {
      int slot = lend[k - 1];
      do {
        all.insert(std::minmax(k, std::abs(list[slot - 1])));
        slot = lptr[slot - 1];
      } while (slot != lend[k - 1]);
    }
    return all;
  }
  std::set<std::pair<int, int>> edges() const {
    std::set<std::pair<int, int>> all;
    for (int k = 1; k <= n; ++k) {
      int slot = lend[k - 1];
      do {
        const int next = voronoi_lptr[slot - 1];
        all.insert(std::minmax(listc[slot - 1], listc[next - 1]));
        slot = next;
      } while (slot != lend[k - 1]);
    }
    return all;
  }

  int nt;
  std::vector<double> xc, yc, zc;
  std::vector<int> listc, voronoi_lptr;
};

/// A view of the sphere.
struct Look {
  double size, latitude, longitude, angle;

  Vec eye() const {
    return {std::cos(latitude * degree) * std::cos(longitude * degree),
            std::cos(latitude * degree) * std::sin(longitude * degree), std::sin(latitude * degree)};
  }
  /// Right, up, and depth.
  Vec seen(const Vec& p) const {
    const Vec right{-std::sin(longitude * degree), std::cos(longitude * degree), 0}, e = eye();
    const Vec up{e[1] * right[2] - e[2] * right[1], e[2] * right[0] - e[0] * right[2],
                 e[0] * right[1] - e[1] * right[0]};
    return {dot(right, p), dot(up, p), dot(e, p)};
  }
  bool in_window(const Vec& p) const { return std::acos(std::min(1.0, dot(eye(), p))) <= angle * degree; }
  /// Where the arc from a, in front, to b, behind, meets the horizon: by bisection.
  Vec horizon(const Vec& a, const Vec& b) const {
    double low = 0, high = 1;
    Vec p = a;
    for (int i = 0; i < 60; ++i) {
      const double middle = (low + high) / 2;
      p = direction(plus(scaled(a, 1 - middle), scaled(b, middle)));
      (dot(eye(), p) >= 0 ? low : high) = middle;
    }
    return p;
  }
};

struct Line {
  double x1, y1, x2, y2;
};

/// The lines that a picture shows of arcs between points.
template <class Point>
std::vector<Line> expected_lines(const std::set<std::pair<int, int>>& arcs, Point point, const Look& look) {
  std::vector<Line> lines;
  for (const auto& [i, j] : arcs) {
    Vec a = point(i), b = point(j);
    if (!look.in_window(a)) std::swap(a, b);
    if (!look.in_window(a)) continue;
    if (dot(look.eye(), b) < 0) b = look.horizon(a, b);
    const Vec from = look.seen(a), to = look.seen(b);
    lines.push_back({from[0], from[1], to[0], to[1]});
  }
  return lines;
}

/// A file of TRPLOT or VRPLOT.
struct File {
  explicit File(const std::string& text) : records(::lines(text)) {
    for (const std::string& record : records) {
      Line line;
      double x, y;
      int number, end = 0;
      if (std::sscanf(record.c_str(), "%lf %lf moveto %lf %lf lineto%n", &line.x1, &line.y1, &line.x2,
                      &line.y2, &end) == 4 &&
          end == static_cast<int>(record.size()))
        lines.push_back(line);
      end = 0;
      if (std::sscanf(record.c_str(), "%lf %lf moveto (%d) show%n", &x, &y, &number, &end) == 3 && end > 0)
        labels[number] = {x, y};
    }
  }
  bool has(const std::string& record) const {
    return std::find(records.begin(), records.end(), record) != records.end();
  }

  std::vector<std::string> records;
  std::vector<Line> lines;
  std::map<int, std::pair<double, double>> labels;
};

/// Every line of one side is a line of the other, once.
::testing::AssertionResult same_lines(const std::vector<Line>& found, const std::vector<Line>& expected,
                                      double tolerance) {
  if (found.size() != expected.size())
    return ::testing::AssertionFailure() << found.size() << " lines instead of " << expected.size();
  std::vector<bool> used(found.size());
  const auto near = [&](double a, double b) { return std::abs(a - b) <= tolerance; };
  for (const Line& e : expected) {
    std::size_t i = 0;
    for (; i < found.size(); ++i) {
      const Line& f = found[i];
      if (used[i]) continue;
      if (near(f.x1, e.x1) && near(f.y1, e.y1) && near(f.x2, e.x2) && near(f.y2, e.y2)) break;
      if (near(f.x1, e.x2) && near(f.y1, e.y2) && near(f.x2, e.x1) && near(f.y2, e.y1)) break;
    }
    if (i == found.size())
      return ::testing::AssertionFailure()
             << "no line " << e.x1 << " " << e.y1 << " - " << e.x2 << " " << e.y2;
    used[i] = true;
  }
  return ::testing::AssertionSuccess();
}

const std::string title = "(A \\(small\\) test)";

int trplot(const Sphere& s, const Look& look, int numbr, int lun = unit) {
  int ier = 99;
  trplot_(&lun, &look.size, &look.latitude, &look.longitude, &look.angle, &s.n, s.x.data(), s.y.data(),
          s.z.data(), s.list.data(), s.lptr.data(), s.lend.data(), title.data(), &numbr, &ier, title.size());
  return ier;
}
int vrplot(const Sphere& s, const Look& look, int numbr, int lun = unit) {
  int ier = 99;
  vrplot_(&lun, &look.size, &look.latitude, &look.longitude, &look.angle, &s.n, s.x.data(), s.y.data(),
          s.z.data(), &s.nt, s.listc.data(), s.voronoi_lptr.data(), s.lend.data(), s.xc.data(), s.yc.data(),
          s.zc.data(), title.data(), &numbr, &ier, title.size());
  return ier;
}

using Routine = int (*)(const Sphere&, const Look&, int, int);
struct NamedRoutine {
  const char* name;
  Routine call;
};
constexpr NamedRoutine routines[] = {{"TRPLOT", trplot}, {"VRPLOT", vrplot}};

std::string plotted(Routine routine, const Sphere& sphere, const Look& look, int numbr) {
  return written_to_unit(unit, [&] { EXPECT_EQ(routine(sphere, look, numbr, unit), 0); });
}

const std::vector<Look>& looks() {
  static const std::vector<Look> all = [] {
    std::vector<Look> result;
    for (const double latitude : {-90.0, -33.3, 0.0, 40.0, 90.0})
      for (const double longitude : {-180.0, -69.5, 0.0, 75.0, 180.0})
        for (const double angle : {90.0, 61.5, 20.0, 3.0})
          result.push_back({7.5, latitude, longitude, angle});
    for (const double size : {1.0, 3.21, 8.5}) result.push_back({size, 30, -60, 45});
    return result;
  }();
  return all;
}

const std::vector<Sphere>& spheres() {
  static const std::vector<Sphere> all{{3, 180, 1},   {7, 180, 2}, {60, 180, 3},
                                       {120, 180, 4}, {40, 85, 5}, {90, 20, 6}};
  return all;
}

TEST(Plot, DrawsEveryArcOrEdgeWithAnEndInTheWindowOnce) {
  for (const Sphere& sphere : spheres())
    for (const Look& look : looks()) {
      const auto expect_lines = [&](const Routine& routine, const std::set<std::pair<int, int>>& arcs,
                                    const auto& point) {
        EXPECT_TRUE(same_lines(File(plotted(routine, sphere, look, 0)).lines,
                               expected_lines(arcs, point, look), 1e-6))
            << sphere.n << " nodes, " << look.latitude << " " << look.longitude << " " << look.angle;
      };
      expect_lines(trplot, sphere.arcs(), [&](int k) { return sphere.node(k); });
      if (sphere.n == 3) continue;  // three edges between two antipodal vertices: no pairs of numbers
      expect_lines(vrplot, sphere.edges(), [&](int k) { return sphere.vertex(k); });
    }
}

TEST(Plot, NumbersTheNodesInTheWindow) {
  const Sphere sphere(1200, 180, 8);
  for (const auto& [name, routine] : routines)
    for (const Look& look : {Look{7.5, 12, 34, 90}, Look{7.5, -70, -100, 25}}) {
      EXPECT_TRUE(File(plotted(routine, sphere, look, 0)).labels.empty()) << name;
      const File file(plotted(routine, sphere, look, 1));
      std::size_t in_window = 0;
      for (int k = 1; k <= sphere.n; ++k) {
        const Vec p = look.seen(sphere.node(k));
        const bool shown = look.in_window(sphere.node(k));
        in_window += shown;
        ASSERT_EQ(file.labels.count(k), shown) << name << " " << k;
        if (!shown) continue;
        EXPECT_NEAR(file.labels.at(k).first, p[0], 1e-6);
        EXPECT_NEAR(file.labels.at(k).second, p[1], 1e-6);
      }
      EXPECT_EQ(file.labels.size(), in_window);
    }
}

// The records around the lines that readers of the file, and of the picture, need.
TEST(Plot, SetsUpThePage) {
  const Sphere sphere(60, 180, 3);
  for (const auto& [name, routine] : routines) {
    const File file(plotted(routine, sphere, {7.5, -33.3, 151.25, 30}, 0));
    EXPECT_EQ(file.records.at(0), "%!PS-Adobe-3.0 EPSF-3.0") << name;
    EXPECT_EQ(file.records.at(1), "%%BoundingBox:  36 126 576 666") << name;
    EXPECT_EQ(file.records.back(), "%%EOF") << name;
    const std::string padded = std::string(80 - title.size(), ' ') + title;
    for (const std::string& record :
         {std::string(routine == trplot ? "%%Title: Delaunay triangulation" : "%%Title: Voronoi diagram"),
          std::string("0 0    0.500000 0 360 arc clip newpath"), padded + " show",
          std::string("(Centre of the window: latitude  -33.30, longitude   151.25) show"),
          std::string("(From centre to rim: 30.00 degrees) show"), std::string("showpage")})
      EXPECT_TRUE(file.has(record)) << name << ": " << record;
    EXPECT_EQ(file.records.size(), 13 + file.lines.size() + 13) << name;
  }
}

TEST(Plot, HasMoreDecimalsInSmallWindows) {
  const Sphere sphere(60, 1e-3, 9);
  const Vec middle = direction({0.3, -0.8, 0.5});
  const Look look{7.5, std::asin(middle[2]) / degree, std::atan2(middle[1], middle[0]) / degree, 1.1e-3};
  const File file(plotted(trplot, sphere, look, 1));
  EXPECT_TRUE(same_lines(file.lines,
                         expected_lines(
                             sphere.arcs(), [&](int k) { return sphere.node(k); }, look),
                         1e-8));
  EXPECT_EQ(file.labels.size(), 60u);
  for (const std::string& record : file.records) EXPECT_EQ(record.find('*'), std::string::npos) << record;
}

// Any title is shown unchanged; no part of it is executed as PostScript.
TEST(Plot, TitlesAreStrings) {
  const Sphere sphere(7, 180, 2);
  const Look look{7.5, 0, 0, 90};
  const auto shown = [&](const std::string& given) {
    const int numbr = 0;
    int ier = 99;
    const File file(written_to_unit(unit, [&] {
      trplot_(&unit, &look.size, &look.latitude, &look.longitude, &look.angle, &sphere.n, sphere.x.data(),
              sphere.y.data(), sphere.z.data(), sphere.list.data(), sphere.lptr.data(), sphere.lend.data(),
              given.data(), &numbr, &ier, given.size());
    }));
    EXPECT_EQ(ier, 0);
    std::string record = file.records.at(file.records.size() - 8);
    EXPECT_EQ(record.substr(record.size() - 5), " show");
    record.erase(record.size() - 5);
    return record.substr(record.find_first_not_of(' '));
  };
  EXPECT_EQ(shown("(plain)"), "(plain)");
  EXPECT_EQ(shown("  (plain)         "), "(plain)");
  EXPECT_EQ(shown("(of (two) parts)"), "(of (two) parts)");
  EXPECT_EQ(shown("(a \\(half)"), "(a \\(half)");
  EXPECT_EQ(shown("no parentheses"), "(no parentheses)");
  EXPECT_EQ(shown(") showpage quit ("), "(\\) showpage quit \\()");
  EXPECT_EQ(shown("(f(x)"), "(f\\(x)");
  EXPECT_EQ(shown("(back\\)"), "(back\\\\)");
  EXPECT_EQ(shown("(two\nlines)"), "(two lines)");
  EXPECT_EQ(shown(""), "()");
  EXPECT_EQ(shown("("), "()");
  EXPECT_EQ(shown("(" + std::string(100, 'x') + ")"), "(" + std::string(78, 'x') + ")");
  EXPECT_EQ(shown("(" + std::string(77, 'x') + "\\(y)"), "(" + std::string(77, 'x') + "\\\\)");
}

const Look good{7.5, 0, 0, 90};
const double nan = std::numeric_limits<double>::quiet_NaN();

TEST(Plot, ArgumentsOutOfRangeAreIer1And2AndWriteNothing) {
  const Sphere sphere(7, 180, 2);
  const double tiny = std::numeric_limits<double>::denorm_min();
  Sphere few = sphere, triangles = sphere;
  few.n = 2, few.nt = 0;
  for (const auto& [name, routine] : routines) {
    for (const int lun : {-1, 100}) EXPECT_EQ(routine(sphere, good, 0, lun), 1) << name;
    const auto expect_nothing = [&, r = routine](const Sphere& s, const Look& look, int ier) {
      EXPECT_EQ(written_to_unit(unit, [&] { EXPECT_EQ(r(s, look, 0, unit), ier); }), "");
    };
    for (const double size : {0.999, 8.501, -3.0, nan}) expect_nothing(sphere, {size, 0, 0, 90}, 1);
    expect_nothing(few, good, 1);
    expect_nothing(sphere, {0, 91, 0, 90}, 1);  // IER 1 before 2
    for (const Look& look : {Look{7.5, 90.001, 0, 90}, Look{7.5, -90.001, 0, 90}, Look{7.5, nan, 0, 90},
                             Look{7.5, 0, 180.001, 90}, Look{7.5, 0, -180.001, 90}, Look{7.5, 0, nan, 90},
                             Look{7.5, 0, 0, 90.001}, Look{7.5, 0, 0, 0}, Look{7.5, 0, 0, -1},
                             Look{7.5, 0, 0, nan}, Look{7.5, 0, 0, tiny}})
      expect_nothing(sphere, look, 2);
  }
  for (const int nt : {9, 11, 0, -10}) {
    triangles.nt = nt;
    EXPECT_EQ(vrplot(triangles, {7.5, 91, 0, 90}, 0), 1) << nt;
  }
}

TEST(Plot, Ier3) {
  const Sphere sphere(60, 180, 2);
  const TemporaryFile file;
  for (const auto& [name, routine] : routines) {
    {
      const FortranUnit read_only(unit, file.path(), "read");
      EXPECT_EQ(routine(sphere, good, 0, unit), 3) << name << ", read only";
    }
    {
      const FortranUnit unformatted(unit, file.path(), "unformatted");
      EXPECT_EQ(routine(sphere, good, 0, unit), 3) << name << ", unformatted";
    }
  }
}

/// The code, and that one line about it is written to stderr and nothing to the unit.
void expect_refused(const NamedRoutine& routine, const Sphere& sphere, int ier) {
  EXPECT_EQ(written_to_unit(unit,
                            [&] {
                              testing::internal::CaptureStderr();
                              EXPECT_EQ(routine.call(sphere, good, 1, unit), ier) << routine.name;
                              const std::string said = testing::internal::GetCapturedStderr();
                              EXPECT_EQ(said.find(std::string("pstripack: ") + routine.name +
                                                  ": IER = " + std::to_string(ier)),
                                        0u)
                                  << said;
                              EXPECT_EQ(std::count(said.begin(), said.end(), '\n'), 1) << said;
                            }),
            "");
}

TEST(Plot, Ier_5) {
  for (const double value : {nan, std::numeric_limits<double>::infinity(), -1e300, 2000.0}) {
    for (const NamedRoutine& routine : routines) {
      Sphere sphere(7, 180, 2);
      sphere.y[6] = value;
      expect_refused(routine, sphere, -5);
    }
    Sphere sphere(7, 180, 2);
    sphere.zc[9] = value;
    expect_refused(routines[1], sphere, -5);
  }
  Sphere sphere(7, 180, 2);
  sphere.x[0] = sphere.y[0] = sphere.z[0] = 0;
  for (const NamedRoutine& routine : routines) expect_refused(routine, sphere, -5);
}

TEST(Plot, Ier_6) {
  if (kAddressSanitizer || kThreadSanitizer)
    GTEST_SKIP() << "a sanitizer needs the memory that is taken away here";
  const Sphere sphere(200000, 180, 2);
  for (const NamedRoutine& routine : routines)
    EXPECT_EQ(in_child([&] {
                long pages = 0;
                std::ifstream("/proc/self/statm") >> pages;
                const rlim_t most = static_cast<rlim_t>(pages) * 4096 + (4u << 20);
                const rlimit limit{most, most};
                setrlimit(RLIMIT_AS, &limit);
                void* volatile block;  // take what is left, and what was freed before
                do block = std::malloc(1 << 16);
                while (block != nullptr);
                return -routine.call(sphere, good, 0, unit);
              }),
              6)
        << routine.name;
}

TEST(Plot, BrokenLists) {
  const auto expect_broken = [](const auto& damage) {
    Sphere sphere(7, 180, 2);  // the whole sphere: lists behind the horizon are not read
    for (double& x : sphere.x) x = std::abs(x);
    damage(sphere);
    for (const NamedRoutine& routine : routines) expect_refused(routine, sphere, -13);
  };
  constexpr int most = std::numeric_limits<int>::max();
  for (const int slot : {0, -1, 31, most, 1})
    expect_broken([=](Sphere& s) { s.lptr[s.lend[3] - 1] = s.voronoi_lptr[s.lend[3] - 1] = slot; });
  for (const int number : {0, 99, -99, most})
    expect_broken([=](Sphere& s) { s.list[s.lptr[s.lend[3] - 1] - 1] = s.listc[s.lend[3] - 1] = number; });
}

// Ghostscript accepts the file, and finds marks where the window, the title and the captions are.
TEST(Plot, GhostscriptRendersIt) {
  if (std::string(GHOSTSCRIPT).empty()) GTEST_SKIP() << "there is no Ghostscript (package ghostscript)";
  for (const int n : {60, 3000}) {
    const Sphere whole(n, 180, 3), half(n, 85, 4);
    for (const Sphere* sphere : {&whole, &half})
      for (const auto& [name, routine] : routines)
        for (const Look& look :
             {Look{7.5, 40, -100, 90}, Look{4, -20, 10, 30}, Look{8.5, 90, 0, 5}, Look{6, 0, 0, 1e-3}}) {
          const TemporaryFile file;
          {
            const FortranUnit open(unit, file.path());
            ASSERT_EQ(routine(*sphere, look, 1, unit), 0);
          }
          const std::string gs = std::string(GHOSTSCRIPT) + " -q -dSAFER -dBATCH -dNOPAUSE ";
          const TemporaryFile box;
          ASSERT_EQ(std::system((gs + "-sDEVICE=bbox " + file.path() + " > " + box.path() + " 2>&1").c_str()),
                    0)
              << box.text();
          double left, bottom, right, top;
          const std::string said = box.text();
          ASSERT_EQ(said.compare(0, 14, "%%BoundingBox:"), 0) << said;
          ASSERT_EQ(std::sscanf(said.c_str() + said.find("%%HiRes"), "%%%%HiResBoundingBox: %lf %lf %lf %lf",
                                &left, &bottom, &right, &top),
                    4);
          const double rim = std::lround(0.88 * std::lround(36 * look.size));
          EXPECT_NEAR(left, 306 - rim - 1, 1) << name;
          EXPECT_GT(right, 306 + rim) << name;  // a caption can be wider than a small window
          EXPECT_LT(right, 612) << name;
          EXPECT_GT(top, 396 + rim + 40) << name;
          EXPECT_LT(top, 396 + rim + 80) << name;
          EXPECT_LT(bottom, 396 - rim - 80) << name;
          EXPECT_GT(bottom, 396 - rim - 100) << name;
        }
  }
}

}  // namespace
