#include "picture_of_differences.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <set>
#include <stdexcept>
#include <utility>

#include "files/output_file.h"
#include "only_in.h"
#include "point_sets.h"

namespace comparison {
namespace {

using point_sets::normalized;
using pstripack::cross;
using pstripack::dot;
using pstripack::index_t;
using pstripack::minus;
using pstripack::Point;
using pstripack::Triangles;

constexpr double kPanel = 360, kMargin = 12, kTitle = 22, kCaption = 66, kRow = kTitle + kPanel + kCaption;
constexpr double kWidth = 2 * kPanel + 3 * kMargin;
constexpr std::size_t kMostRows = 60, kMostArcs = 4000, kMostNumbers = 80;

using Arc = std::pair<index_t, index_t>;
using pictures::Path;
using pictures::Place;

/// A stereographic projection around the nodes of a decision. Circles on the sphere are circles in the
/// picture, so it shows which node lies inside. In pixels, 0..kPanel in both directions.
class View {
 public:
  View(const std::vector<Point>& points, const std::vector<index_t>& nodes) : points_(points) {
    Point sum{0, 0, 0};
    for (const index_t node : nodes) {
      const Point p = normalized(points[node]);
      sum = {sum.x + p.x, sum.y + p.y, sum.z + p.z};
    }
    centre_ = normalized(dot(sum, sum) > 1e-6 ? sum : points[nodes[0]]);
    const Point axis = std::fabs(centre_.z) < 0.9 ? Point{0, 0, 1} : Point{0, 1, 0};
    east_ = normalized(cross(axis, centre_));
    north_ = cross(centre_, east_);

    Place low = project(points[nodes[0]]), high = low;
    for (const index_t node : nodes) {
      const Place p = project(points[node]);
      low = {std::min(low.x, p.x), std::min(low.y, p.y)};
      high = {std::max(high.x, p.x), std::max(high.y, p.y)};
    }
    const double extent = std::max({high.x - low.x, high.y - low.y, 1e-15});
    scale_ = 0.6 * kPanel / extent;
    origin_ = {kPanel / 2 - scale_ * (low.x + high.x) / 2, kPanel / 2 + scale_ * (low.y + high.y) / 2};
  }

  bool in_front(const Point& p) const { return dot(normalized(p), centre_) > -0.95; }
  Place operator()(const Point& p) const {
    const Place q = project(p);
    return {origin_.x + scale_ * q.x, origin_.y - scale_ * q.y};
  }
  Place operator()(index_t node) const { return (*this)(points_[node]); }
  const Point& point(index_t node) const { return points_[node]; }

 private:
  /// Subtracts the centre first, so that close nodes keep their digits.
  Place project(const Point& given) const {
    const Point p = normalized(given), d = minus(p, centre_);
    const double factor = 2 / (1 + dot(p, centre_));
    return {factor * dot(d, east_), factor * dot(d, north_)};
  }

  const std::vector<Point>& points_;
  Point centre_, east_, north_;
  double scale_ = 1;
  Place origin_{0, 0};
};

bool in_panel(const Place& p) { return p.x >= 0 && p.x <= kPanel && p.y >= 0 && p.y <= kPanel; }

/// The arcs whose bounding box intersects the panel, in increasing order.
std::vector<Arc> arcs_in_view(const Triangles& triangles, const View& view) {
  std::set<Arc> arcs;
  for (const auto& t : triangles)
    for (int i = 0; i < 3; ++i) {
      const auto [u, v] = std::minmax(t[i], t[(i + 1) % 3]);
      if (!view.in_front(view.point(u)) || !view.in_front(view.point(v))) continue;
      const Place a = view(u), b = view(v);
      if (std::max(a.x, b.x) >= 0 && std::min(a.x, b.x) <= kPanel && std::max(a.y, b.y) >= 0 &&
          std::min(a.y, b.y) <= kPanel)
        arcs.emplace(u, v);
    }
  return {arcs.begin(), arcs.end()};
}

/// The arcs, in pieces short enough to show their curvature.
std::string drawn(const std::vector<Arc>& arcs, const View& view, const char* kind) {
  Path path;
  for (std::size_t k = 0; k < std::min(arcs.size(), kMostArcs); ++k) {
    const Point a = normalized(view.point(arcs[k].first)), b = normalized(view.point(arcs[k].second));
    const int pieces = 1 + static_cast<int>(std::acos(std::clamp(dot(a, b), -1.0, 1.0)) / 0.05);
    path.move(view(a));
    for (int i = 1; i <= pieces; ++i) {
      const double t = static_cast<double>(i) / pieces;
      path.line(view(Point{(1 - t) * a.x + t * b.x, (1 - t) * a.y + t * b.y, (1 - t) * a.z + t * b.z}));
    }
  }
  return path.empty() ? ""
                      : fmt::format("<path class=\"{}{}\" d=\"{}\"/>\n", kind,
                                    arcs.size() > 100 ? " many" : "", path.data());
}

/// The circle through u, v and the node on their left; empty if it looks straight.
std::string deciding_circle(const std::vector<index_t>& nodes, const View& view) {
  if (nodes.size() != 4) return "";
  const Place a = view(nodes[0]), b = view(nodes[1]), c = view(nodes[2]);
  const double bx = b.x - a.x, by = b.y - a.y, cx = c.x - a.x, cy = c.y - a.y, d = 2 * (bx * cy - by * cx);
  const double x = (cy * (bx * bx + by * by) - by * (cx * cx + cy * cy)) / d;
  const double y = (bx * (cx * cx + cy * cy) - cx * (bx * bx + by * by)) / d;
  const double radius = std::hypot(x, y);
  if (!(radius < 1e5)) return "";
  return fmt::format("<circle class=\"deciding\" cx=\"{:.2f}\" cy=\"{:.2f}\" r=\"{:.2f}\"/>\n", a.x + x,
                     a.y + y, radius);
}

/// The deciding nodes, and the others if they are few, with their numbers.
std::string numbers(const std::vector<Arc>& arcs, const std::vector<index_t>& deciding, const View& view) {
  std::set<index_t> others;
  for (const Arc& arc : arcs)
    for (const index_t node : {arc.first, arc.second})
      if (in_panel(view(node))) others.insert(node);
  for (const index_t node : deciding) others.erase(node);
  if (others.size() > kMostNumbers) others.clear();

  std::string text;
  const auto write = [&](index_t node, const char* kind, double radius) {
    const Place p = view(node);
    text += fmt::format(
        "<circle class=\"{0}\" cx=\"{1:.2f}\" cy=\"{2:.2f}\" r=\"{3}\"/>\n"
        "<text class=\"{0}\" x=\"{1:.2f}\" y=\"{2:.2f}\" dx=\"4\" dy=\"-4\">{4}</text>\n",
        kind, p.x, p.y, radius, node + 1);
  };
  for (const index_t node : others) write(node, "node", 1.5);
  for (const index_t node : deciding) write(node, "decided", 3);
  return text;
}

std::string panel(double x, double y, const std::string& title, const std::string& content) {
  return fmt::format(
      "<text class=\"title\" x=\"{0}\" y=\"{1}\">{2}</text>\n<svg x=\"{0}\" y=\"{3}\" width=\"{4}\" "
      "height=\"{4}\">\n<rect class=\"panel\" width=\"{4}\" height=\"{4}\"/>\n{5}</svg>\n",
      x, y + 14, title, y + kTitle, kPanel, content);
}

/// At most three lines.
std::string caption(double y, const std::string& text) {
  constexpr std::size_t kLines = 3, kLetters = 105;  // of a line
  std::string result;
  std::size_t begin = 0;
  for (std::size_t line = 1; line <= kLines && begin < text.size(); ++line) {
    std::size_t end = std::min(begin + kLetters, text.size());
    if (end < text.size())
      if (const std::size_t blank = text.rfind(' ', end); blank != text.npos && blank > begin) end = blank;
    result += fmt::format("<text class=\"caption\" x=\"{}\" y=\"{}\">{}</text>\n", kMargin,
                          y + 16 * static_cast<double>(line),
                          pictures::escaped_for_xml(text.substr(begin, end - begin)));
    begin = text[std::min(end, text.size() - 1)] == ' ' ? end + 1 : end;
  }
  return result;
}

}  // namespace

Plot::Plot(const std::string& file) : file_(file) {
  if (std::filesystem::path(file).extension() != ".svg")
    throw std::invalid_argument("--plot " + file + ": expected FILE.svg (rsvg-convert makes PNG)");
}

void Plot::add(const Result& result, const std::vector<Point>& points) {
  for (const Decision& decision : result.differences.decisions) {
    if (decision.nodes.empty() || rows_ == kMostRows) continue;
    const View view(points, decision.nodes);
    const std::vector<Arc> theirs = arcs_in_view(result.original_checked.triangles, view);
    const std::vector<Arc> ours = arcs_in_view(result.ours_checked.triangles, view);
    const std::string circle = deciding_circle(decision.nodes, view);
    const auto content = [&](const std::vector<Arc>& own, const std::vector<Arc>& other, const char* kind) {
      return drawn(own, view, "arc") + circle + drawn(only_in(own, other), view, kind) +
             numbers(own, decision.nodes, view);
    };
    const double y = kMargin + static_cast<double>(rows_) * kRow;
    body_ += panel(kMargin, y, "original", content(theirs, ours, "theirs"));
    body_ += panel(2 * kMargin + kPanel, y, "PSTRIPACK", content(ours, theirs, "ours"));
    body_ += caption(y + kTitle + kPanel,
                     fmt::format("{}: {}: {}", result.points_name, name(decision.cause), decision.text));
    ++rows_;
  }
}

std::string Plot::svg() const {
  const double height = kMargin + static_cast<double>(rows_) * kRow;
  return fmt::format(
      R"(<svg xmlns="http://www.w3.org/2000/svg" width="{0}" height="{1}" font-family="DejaVu Sans, Verdana, sans-serif">
<style>
.panel {{ fill: white; stroke: #888 }}
path {{ fill: none; stroke-linejoin: round }}
.arc {{ stroke: #aaa; stroke-width: 1 }}
.theirs {{ stroke: #c81e1e; stroke-width: 2.5 }}
.ours {{ stroke: #1e50c8; stroke-width: 2.5 }}
.many {{ stroke-width: 1 }}
.deciding {{ fill: none; stroke: #555; stroke-dasharray: 5 4 }}
text {{ paint-order: stroke; stroke: white; stroke-width: 2.5px }}
.node {{ fill: #777; font-size: 9px }}
.decided {{ fill: black; font-size: 12px; font-weight: bold }}
.title {{ fill: black; font-size: 14px }}
.caption {{ fill: black; font-size: 12px }}
</style>
<rect width="100%" height="100%" fill="white"/>
{2}</svg>
)",
      kWidth, height, body_);
}

void Plot::write() const {
  files::OutputFile file(file_);
  const std::string text = svg();
  file.write(text.data(), text.size());
  file.commit();
}

}  // namespace comparison
