#pragma once
// TRPLOT, VRPLOT: a triangulation or a Voronoi diagram as an Encapsulated PostScript picture, seen from far
// away. For Real = float, double and Int = int32_t, int64_t.

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <string_view>

#include "capi/pstripack.h"
#include "lists/adjacency_lists.h"
#include "lists/list_walk.h"
#include "stripack/expressions.h"
#include "stripack/formatted_text.h"

namespace pstripack {

/// IER of TRPLOT and VRPLOT, except 3, output errors. The text is a picture only if the result is `done`.
enum class PlotStatus {
  done = 0,
  bad_size = 1,  ///< lun not in 0..99, plot_size not in 1..8.5, n < 3, VRPLOT: nt not 2n-4
  bad_view = 2,  ///< |latitude| > 90, |longitude| > 180, angle not in (0,90] or too small to draw
  bad_node = PSTRIPACK_BAD_COORDINATE,  ///< a point is not finite, or its length is not within 0.001..1000
  broken_lists =
      PSTRIPACK_BAD_LISTS,  ///< not the lists of a triangulation or Voronoi diagram, as far as they are read
};

/// The view and its size. Lengths on paper in inches, angles in degrees.
template <class Real, class Int>
struct PlotFrame {
  Int lun;                   ///< Fortran unit; used only to check its range
  Real plot_size;            ///< side of the bounding box
  Real latitude, longitude;  ///< the centre of the window, in the middle of the picture
  Real angle;                ///< from the centre of the window to its rim
  std::string_view title;    ///< a PostScript string, (...); 80 characters at most are shown
  bool numbers;              ///< show the numbers of the nodes
};

// On paper, in points (1/72 inch)            From the left, a sphere of radius 1
//
//       title                                        up |
//  +----------------+                                .--|--.     rim of the window
//  |    .------.    |                              /    |  _-`.
//  |   |   y    |   |  window: the circle         |     |_-    |  angle, between rim and line of sight
//  |   |   |    |   |  round the middle of        |     +------|------> depth, to the eye
//  |   |   +--x |   |  the page, scaled to        |     |      |
//  |    '------'    |  radius sin(angle)           '.   |    .'
//  +----------------+  bounding box                  '--|--'  horizon: depth = 0
//     annotation
constexpr int page_x = 306, page_y = 396;  // the middle of the page

/// A point in the orthographic view: x to the right and y up in the picture, depth towards the eye.
template <class Real>
struct Seen {
  Real x, y, depth;
};

/// The orthographic view from the direction of the frame's latitude and longitude to the centre of the
/// sphere.
template <class Real>
class View {
 public:
  template <class Int>
  explicit View(const PlotFrame<Real, Int>& frame) {
    const Real degree = std::atan(Real(1)) / Real(45);
    const Real latitude = degree * frame.latitude, longitude = degree * frame.longitude;
    const Real cosine = std::cos(latitude);
    eye_ = {cosine * std::cos(longitude), cosine * std::sin(longitude), std::sin(latitude)};
    if (cosine != 0) right_ = {-eye_.y / cosine, eye_.x / cosine, Real(0)};
    up_ = {-eye_.z * right_.y, eye_.z * right_.x, cosine};
    radius_ = std::sin(degree * frame.angle);
  }

  Real radius() const { return radius_; }
  Seen<Real> operator()(const Vector<Real>& p) const {
    return {right_.x * p.x + right_.y * p.y, dot(up_, p), dot(eye_, p)};
  }
  bool in_window(const Seen<Real>& p) const {
    return p.depth >= 0 && p.x * p.x + p.y * p.y <= radius_ * radius_;
  }

 private:
  Vector<Real> eye_, right_{Real(0), Real(1), Real(0)}, up_;
  Real radius_;
};

/// Moves b to where the arc from a to b meets the horizon. a is in front of it, b behind. False if a and b
/// are antipodal.
template <class Real>
bool meet_horizon(const Seen<Real>& a, Seen<Real>& b) {
  const Real x = a.depth * b.x - b.depth * a.x, y = a.depth * b.y - b.depth * a.y;
  const Real length = std::sqrt(x * x + y * y);
  if (length == 0) return false;
  b = {x / length, y / length, Real(0)};
  return true;
}

template <class Real, class Int>
bool can_be_drawn(Int count, const Nodes<Real>& points) {
  for (Int i = 1; i <= count; ++i) {
    const Real square = dot(points[i], points[i]);
    if (!(square >= Real(1e-6) && square <= Real(1e6))) return false;  // also for NaN
  }
  return true;
}

/// TITLE as a PostScript string of at most `most` characters in parentheses. If the string would end early or
/// never (an unmatched parenthesis, a backslash at the end), all special characters in it are escaped.
inline std::string postscript_string(std::string_view title, std::size_t most) {
  const std::size_t begin = std::min(title.find_first_not_of(' '), title.size());
  title = title.substr(begin, title.find_last_not_of(' ') + 1 - begin);
  if (!title.empty() && title.front() == '(') {
    title.remove_prefix(1);
    if (!title.empty() && title.back() == ')') title.remove_suffix(1);
  }
  title = title.substr(0, most);

  int depth = 0;
  bool escaped = false, whole = true;
  for (const char c : title) {
    if (!escaped && (c == '(' || c == ')')) depth += c == '(' ? 1 : -1;
    whole = whole && depth >= 0;
    escaped = !escaped && c == '\\';
  }
  whole = whole && depth == 0 && !escaped;

  std::string quoted = "(";
  for (const char c : title) {
    if (!whole && (c == '(' || c == ')' || c == '\\')) quoted += '\\';
    quoted += static_cast<unsigned char>(c) < ' ' ? ' ' : c;
  }
  return quoted + ')';
}

/// A picture: begin(), then lines, then finish().
template <class Real, class Int>
class Picture {
 public:
  Picture(const PlotFrame<Real, Int>& frame, FormattedText& out) : view(frame), frame_(frame), out_(out) {}

  const View<Real> view;

  /// Checks the frame. A NaN is an error.
  PlotStatus check(bool counts_are_good) const {
    const auto within = [](Real value, Real low, Real high) { return value >= low && value <= high; };
    if (frame_.lun < 0 || frame_.lun > 99 || !within(frame_.plot_size, Real(1), Real(8.5)) ||
        !counts_are_good)
      return PlotStatus::bad_size;
    if (!within(frame_.latitude, -90, 90) || !within(frame_.longitude, -180, 180) || !(frame_.angle > 0) ||
        frame_.angle > 90 || !(scale() < largest_scale))
      return PlotStatus::bad_view;
    return PlotStatus::done;
  }

  void begin(std::string_view what) {
    const int half = static_cast<int>(std::lround(36 * frame_.plot_size));
    out_.add("%!PS-Adobe-3.0 EPSF-3.0").end();
    out_.add("%%BoundingBox:").integer(page_x - half, 4).integer(page_y - half, 4);
    out_.integer(page_x + half, 4).integer(page_y + half, 4).end();
    out_.add("%%Title: ").add(what).end().add("%%Creator: PSTRIPACK").end().add("%%EndComments").end();

    // The rim in points; then the sphere's own coordinates, lines one point wide, clipped to the rim.
    number(2).add(" setlinewidth").end();
    number(page_x);
    number(page_y).integer(rim(), 4).add(" 0 360 arc").end().add("stroke").end();
    const Real middle = scale() * view.radius();
    number(static_cast<Real>(page_x - rim()) + middle);
    number(static_cast<Real>(page_y - rim()) + middle).add(" translate").end();
    number(scale());
    number(scale()).add(" scale").end();
    on_paper(1).add(" setlinewidth").end();
    out_.add("gsave").end().add("0 0");
    number(view.radius()).add(" 0 360 arc clip newpath").end();
  }

  /// A line from a, which is in the window, to b.
  void line(const Seen<Real>& a, Seen<Real> b) {
    if (b.depth < 0 && !meet_horizon(a, b)) return;
    position(a).add(" moveto");
    position(b).add(" lineto").end();
  }

  void finish(Int n, const Nodes<Real>& nodes) {
    out_.add("stroke").end().add("grestore").end();
    if (frame_.numbers) {
      font(10);
      for (Int node = 1; node <= n; ++node) {
        const Seen<Real> p = view(nodes[node]);
        if (view.in_window(p)) position(p).add(" moveto (").integer(node, 3).add(") show").end();
      }
    }

    constexpr int title_length = 80, title_size = 16;
    std::string title = postscript_string(frame_.title, title_length - 2);
    if (title.size() < title_length) title.insert(0, title_length - title.size(), ' ');
    font(title_size);
    out_.add(title).add(" stringwidth pop 2 div neg");
    number(view.radius() + 3 * length(title_size)).add(" moveto").end().add(title).add(" show").end();

    const Real left = -view.radius(), bottom = -view.radius() - length(50);
    number(left);
    number(bottom).add(" moveto").end();
    out_.add("(Centre of the window: latitude ").fixed(static_cast<double>(frame_.latitude), 7, 2);
    out_.add(", longitude ").fixed(static_cast<double>(frame_.longitude), 8, 2).add(") show").end();
    number(left);
    number(bottom - 2 * length(title_size)).add(" moveto").end();
    out_.add("(From centre to rim: ")
        .fixed(static_cast<double>(frame_.angle), 5, 2)
        .add(" degrees) show")
        .end();
    out_.add("stroke").end().add("showpage").end().add("%%EOF").end();
  }

 private:
  static constexpr Real largest_scale = Real(1e30);  // PostScript's largest number is 1e38

  /// Radius of the window on paper, in points.
  int rim() const {
    const auto half = static_cast<Real>(std::lround(36 * frame_.plot_size));
    return static_cast<int>(std::lround(Real(0.88) * half));
  }
  Real scale() const { return static_cast<Real>(rim()) / view.radius(); }
  /// A length on paper, given in points, in units of the sphere's radius.
  Real length(int points) const { return static_cast<Real>(points) / scale(); }

  /// Six decimals in twelve columns; more for a small window, where six would show as steps. The largest
  /// number written is the scale, which leaves one column blank.
  FormattedText& number(Real value) {
    int decimals = 6;
    for (Real s = scale(); s >= Real(1e4); s /= 10) ++decimals;
    return out_.fixed(static_cast<double>(value), 2 * decimals, decimals);
  }
  FormattedText& on_paper(int points) { return number(length(points)); }
  FormattedText& position(const Seen<Real>& p) {
    number(p.x);
    return number(p.y);
  }
  void font(int points) {
    out_.add("/Helvetica findfont").end();
    on_paper(points).add(" scalefont setfont").end();
  }

  const PlotFrame<Real, Int>& frame_;
  FormattedText& out_;
};

/// Draws a picture of lists: calls line(node, slot, next slot) for all slots of the nodes for which
/// is_wanted(node). line() is false if it cannot read a slot.
template <class Real, class Int, class IsWanted, class Line>
PlotStatus draw(Picture<Real, Int>& picture, std::string_view what, Int n, const Nodes<Real>& nodes,
                const Int* lptr, const Int* lend, const IsWanted& is_wanted, const Line& line) {
  picture.begin(what);
  ListWalk<Int> walk(n, lptr);
  for (Int node = 1; node <= n; ++node) {
    bool readable = true;
    const auto visit = [&](Int slot, Int next) { readable = readable && line(node, slot, next); };
    if (is_wanted(node) && !(walk(lend[node - 1], visit) && readable)) return PlotStatus::broken_lists;
  }
  picture.finish(n, nodes);
  return PlotStatus::done;
}

/// TRPLOT: the arcs with at least one end in the window, as straight lines, cut at the horizon and the rim.
template <class Real, class Int>
PlotStatus plot_triangulation(const PlotFrame<Real, Int>& frame, const ListsView<Int>& lists,
                              const Nodes<Real>& nodes, FormattedText& out) {
  const Int n = static_cast<Int>(lists.n);
  Picture<Real, Int> picture(frame, out);
  if (const PlotStatus status = picture.check(n >= 3); status != PlotStatus::done) return status;
  if (!can_be_drawn(n, nodes)) return PlotStatus::bad_node;
  const auto is_seen = [&](Int node) { return picture.view.in_window(picture.view(nodes[node])); };
  return draw(picture, "Delaunay triangulation", n, nodes, lists.lptr, lists.lend, is_seen,
              [&](Int a, Int slot, Int) {
                const Int entry = lists.list[slot - 1], b = entry < 0 ? -entry : entry;
                if (b < 1 || b > n) return false;
                if (b > a || !is_seen(b))  // each arc is met from both ends
                  picture.line(picture.view(nodes[a]), picture.view(nodes[b]));
                return true;
              });
}

/// VRPLOT: the edges of the Voronoi cells with at least one end in the window, likewise. listc, lptr, lend,
/// vertices: as CRLIST gives them, nt vertices.
template <class Real, class Int>
PlotStatus plot_voronoi(const PlotFrame<Real, Int>& frame, Int n, const Nodes<Real>& nodes, Int nt,
                        const Int* listc, const Int* lptr, const Int* lend, const Nodes<Real>& vertices,
                        FormattedText& out) {
  Picture<Real, Int> picture(frame, out);
  const bool counts_are_good = n >= 3 && nt % 2 == 0 && nt / 2 == n - 2;
  if (const PlotStatus status = picture.check(counts_are_good); status != PlotStatus::done) return status;
  if (!can_be_drawn(n, nodes) || !can_be_drawn(nt, vertices)) return PlotStatus::bad_node;
  const auto is_any = [](Int) { return true; };
  return draw(picture, "Voronoi diagram", n, nodes, lptr, lend, is_any, [&](Int, Int slot, Int next) {
    const Int g = listc[slot - 1], h = listc[next - 1];
    if (g < 1 || g > nt || h < 1 || h > nt) return false;
    const Seen<Real> from = picture.view(vertices[g]), to = picture.view(vertices[h]);
    // An edge is met in both directions, once in each of its two cells.
    if (picture.view.in_window(from) && (h > g || !picture.view.in_window(to))) picture.line(from, to);
    return true;
  });
}

}  // namespace pstripack
