#include "pictures/mesh_picture.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <set>
#include <stdexcept>

#include "files/measures.h"
#include "parallel/sample.h"
#include "pictures/colours.h"
#include "pictures/scale.h"
#include "pictures/sheet.h"
#include "stripack/list_queries.h"

namespace pictures {
namespace {

using Colour = MeshOptions::Colour;
using What = MeshOptions::What;
using files::Faces;
using files::Mesh;
using pstripack::cross;
using pstripack::dot;

constexpr double kDegree = 57.295779513082321;
constexpr const char* kLine = "#1f5f8b";
constexpr const char* kGraticule = "#d5dce3";
constexpr const char* kNoColour = "#e6e6e6";

std::size_t index(std::int32_t number) { return static_cast<std::size_t>(number) - 1; }

/// Faces of one colour.
struct Shade {
  std::string colour, label;
  std::size_t count = 0;
};

class MeshPicture {
 public:
  MeshPicture(const Mesh& mesh, const MeshOptions& options)
      : mesh_(mesh), options_(options), reader_(mesh.lists()), nodes_(files::unit(mesh.points)) {
    for (std::int32_t node = 1; node <= reader_.size(); ++node)
      if (reader_.on_boundary(node)) boundary_.push_back(index(node));
  }

  std::string svg() {
    top_ = sheet_.title(options_.title);
    choose_view();
    count_nodes_in_view();
    const bool cells = options_.what == What::cells;
    faces_ = cells ? files::voronoi_faces(mesh_) : files::triangle_faces(mesh_);
    expect_sides_shorter_than_a_half_turn();
    draw_ground();
    draw_faces();
    draw_lines();
    draw_boundary();
    draw_border();
    draw_ranks();
    draw_legend();
    return sheet_.svg(top_ + 8, options_.width);
  }

 private:
  // ---- view ----

  void choose_view() {
    const Spot centre = options_.centre ? *options_.centre : default_centre();
    radius_ = std::min(90.0, options_.radius ? *options_.radius : radius_of_nodes(centre));
    if (options_.lonlat) {
      auto map = std::make_unique<LonLat>(centre, radius_, Frame{56, top_, kWidth - 24, top_ + 620});
      lonlat_ = map.get();
      view_ = std::move(map);
    } else {
      auto sphere = std::make_unique<Orthographic>(centre, radius_, Frame{60, top_, kWidth - 60, top_ + 680});
      orthographic_ = sphere.get();
      view_ = std::move(sphere);
    }
    centre_ = centre;
    top_ = view_->frame().bottom + 8;
  }

  Spot default_centre() const {
    if (boundary_.empty()) return options_.lonlat ? Spot{0, 0} : Spot{0, 30};
    Point sum{0, 0, 0};
    for (const Point& p : nodes_) sum = {sum.x + p.x, sum.y + p.y, sum.z + p.z};
    Spot spot = spot_of(dot(sum, sum) > 1e-12 ? sum : nodes_[0]);
    for (double* angle : {&spot.lon, &spot.lat})  // round numbers, if they fit as well
      for (const double unit : {1e-4, 1e-3, 1e-2, 0.1, 1.0})
        if (const double rounded = std::round(*angle / unit) * unit; std::fabs(rounded - *angle) < 1e-9)
          *angle = rounded;
    return spot;
  }

  /// 90 unless all nodes are well inside a hemisphere.
  double radius_of_nodes(const Spot& centre) const {
    if (boundary_.empty()) return 90;
    const double lon = centre.lon / kDegree, lat = centre.lat / kDegree;
    const Point eye{std::cos(lat) * std::cos(lon), std::cos(lat) * std::sin(lon), std::sin(lat)};
    double farthest = 0;
    for (const Point& p : nodes_) farthest = std::max(farthest, files::angle_between(eye, p));
    const double radius = 1.06 * farthest * kDegree;
    return radius < 70 ? radius : 90;
  }

  void count_nodes_in_view() const {
    const auto count = static_cast<std::size_t>(std::count_if(
        nodes_.begin(), nodes_.end(), [&](const Point& p) { return view_->place(p).has_value(); }));
    if (count <= kMostNodesInView) return;
    const double fewer =
        0.8 * radius_ * std::sqrt(static_cast<double>(kMostNodesInView) / static_cast<double>(count));
    throw std::runtime_error(
        fmt::format("{} nodes are in view, at most {} can be drawn: zoom in, for example by --view "
                    "{}:{:g},{:g} --radius {:.2g}, or say --what histograms",
                    grouped(count), grouped(kMostNodesInView), options_.lonlat ? "lonlat" : "orthographic",
                    centre_.lon, centre_.lat, fewer));
  }

  /// Cells of nodes on one small circle, for example of three nodes, are lunes: the ends of a side do not
  /// determine its direction.
  void expect_sides_shorter_than_a_half_turn() const {
    for (std::size_t f = 0; f < faces_.size(); ++f)
      for (std::size_t k = faces_.begin[f]; k < faces_.begin[f + 1]; ++k) {
        const std::size_t next = k + 1 < faces_.begin[f + 1] ? k + 1 : faces_.begin[f];
        if (dot(faces_.points[index(faces_.corner[k])], faces_.points[index(faces_.corner[next])]) <
            -1 + 1e-12)
          throw std::runtime_error(
              "around some nodes, which lie on one circle, cells reach from its centre to the opposite "
              "point, "
              "which is not drawn: say --what triangles");
      }
  }

  /// Spacing in degrees of lines of longitude or latitude, so that about `lines` are visible over `span`.
  static double graticule_step(double span, double lines) {
    constexpr double kSteps[] = {90, 60, 30, 15, 10, 5, 2, 1};
    double step = 90;
    for (const double s : kSteps)
      if (span / s <= lines) step = s;
    if (span / step >= lines / 2.5) return step;
    return round_values(0, span, static_cast<int>(lines)).at(1);
  }

  /// Paper, and the lines of longitude and latitude on it.
  void draw_ground() {
    Path path;
    const auto line = [&](const Point& a, const Point& b) { add(view_->arc(a, b), false, path); };
    const auto at = [](double lon, double lat) {
      lon /= kDegree, lat /= kDegree;
      return Point{std::cos(lat) * std::cos(lon), std::cos(lat) * std::sin(lon), std::sin(lat)};
    };
    const Frame& frame = view_->frame();
    if (lonlat_ != nullptr) {
      sheet_.rectangle(frame.left, frame.top, frame.width(), frame.height(), "#fbfcfd");
      for (const double lon : multiples(lonlat_->west(), lonlat_->east(), lon_step())) {
        path.move(lonlat_->on_paper({lon, lonlat_->south()}));
        path.line(lonlat_->on_paper({lon, lonlat_->north()}));
      }
      for (const double lat : multiples(lonlat_->south(), lonlat_->north(), lat_step())) {
        path.move(lonlat_->on_paper({lonlat_->west(), lat}));
        path.line(lonlat_->on_paper({lonlat_->east(), lat}));
      }
    } else {
      if (orthographic_->shows_limb())
        sheet_.add(circle("#fbfcfd", "none"));
      else
        sheet_.rectangle(frame.left, frame.top, frame.width(), frame.height(), "#fbfcfd");
      // The corners of the square are farther away than its sides.
      const double reach = kDegree * std::asin(std::min(1.0, std::sqrt(2.0) * std::sin(radius_ / kDegree)));
      const double south = std::max(-90.0, centre_.lat - reach), north = std::min(90.0, centre_.lat + reach);
      const bool pole = std::fabs(centre_.lat) + reach > 85;
      const double half =
          pole ? 180 : kDegree * std::asin(std::sin(reach / kDegree) / std::cos(centre_.lat / kDegree));
      const double step = graticule_step(2 * radius_, 6);
      const double across = pole ? std::max(30.0, step) : graticule_step(2 * half, 9);
      constexpr int kPieces = 60;
      for (const double lon : multiples(centre_.lon - half, centre_.lon + half - 1e-9, across))
        for (int k = 0; k < kPieces; ++k)
          line(at(lon, south + (north - south) * k / kPieces),
               at(lon, south + (north - south) * (k + 1) / kPieces));
      for (const double lat : multiples(south, north, step))
        for (int k = 0; k < kPieces && std::fabs(lat) < 90; ++k)
          line(at(centre_.lon - half + 2 * half * k / kPieces, lat),
               at(centre_.lon - half + 2 * half * (k + 1) / kPieces, lat));
    }
    sheet_.path(path, fmt::format("fill=\"none\" stroke=\"{}\" stroke-width=\"0.8\"", kGraticule));
  }

  double lon_step() const { return graticule_step(lonlat_->east() - lonlat_->west(), 9); }
  double lat_step() const { return graticule_step(lonlat_->north() - lonlat_->south(), 7); }

  static std::vector<double> multiples(double low, double high, double step) {
    std::vector<double> values;
    for (double k = std::ceil(low / step - 1e-9); k * step <= high + 1e-9; ++k) values.push_back(k * step);
    return values;
  }

  std::string circle(const char* fill, const char* stroke) const {
    return fmt::format("<circle cx=\"{:.2f}\" cy=\"{:.2f}\" r=\"{:.2f}\" fill=\"{}\" stroke=\"{}\"/>\n",
                       orthographic_->middle().x, orthographic_->middle().y, orthographic_->scale(), fill,
                       stroke);
  }

  // ---- what is in it ----

  static void add(const std::vector<Outline>& outlines, bool closed, Path& path) {
    for (const Outline& outline : outlines) {
      path.move(outline[0]);
      for (std::size_t i = 1; i < outline.size(); ++i) path.line(outline[i]);
      if (closed) path.close();
    }
  }

  void draw_faces() {
    if (options_.colour == Colour::none) return;
    const std::vector<std::size_t> shade_of = choose_shades();
    std::vector<Path> paths(shades_.size());
    std::vector<Point> corners;
    for (std::size_t f = 0; f < faces_.size(); ++f) {
      corners.clear();
      for (std::size_t k = faces_.begin[f]; k < faces_.begin[f + 1]; ++k) {
        const Point& p = faces_.points[index(faces_.corner[k])];
        if (corners.empty() || p != corners.back()) corners.push_back(p);
      }
      while (corners.size() > 1 && corners.front() == corners.back()) corners.pop_back();
      add(view_->polygon(corners), true, paths[shade_of[f]]);
    }
    // Stroke each face in its own colour; otherwise paper shows between neighbours.
    for (std::size_t s = 0; s < shades_.size(); ++s)
      sheet_.path(paths[s],
                  fmt::format("fill=\"{0}\" stroke=\"{0}\" stroke-width=\"0.4\"", shades_[s].colour));
  }

  /// Fills shades_; returns the shade of each face.
  std::vector<std::size_t> choose_shades() {
    switch (options_.colour) {
      case Colour::size:
        return shades_of_size();
      case Colour::degree:
        return shades_of_degree();
      default:
        return shades_of_owner();
    }
  }

  /// Cells of boundary nodes have no size.
  std::vector<std::size_t> shades_of_size() {
    std::vector<double> area(faces_.size());
    for (std::size_t f = 0; f < area.size(); ++f) {
      const auto corner = [&](std::size_t k) { return faces_.points[index(faces_.corner[k])]; };
      const std::size_t begin = faces_.begin[f], end = faces_.begin[f + 1];
      for (std::size_t k = begin; k < end; ++k)
        area[f] +=
            faces_.centres.empty()
                ? (k == begin ? files::triangle_area(corner(k), corner(k + 1), corner(k + 2)) : 0)
                : files::triangle_area(faces_.centres[f], corner(k), corner(k + 1 < end ? k + 1 : begin));
    }
    std::vector<bool> unbounded(faces_.size(), false);
    if (options_.what == What::cells)
      for (const std::size_t node : boundary_) unbounded[node] = true;
    std::vector<double> known;
    for (std::size_t f = 0; f < area.size(); ++f)
      if (!unbounded[f]) known.push_back(area[f]);
    constexpr std::size_t kShades = 64;
    if (!known.empty()) scale_.emplace(known);
    for (std::size_t s = 0; s < kShades; ++s)
      shades_.push_back({viridis(static_cast<double>(s) / (kShades - 1)), ""});
    shades_.push_back({kNoColour, ""});
    std::vector<std::size_t> shade(faces_.size(), kShades);
    for (std::size_t f = 0; f < area.size(); ++f)
      if (!unbounded[f]) shade[f] = static_cast<std::size_t>(std::lround((*scale_)(area[f]) * (kShades - 1)));
    return shade;
  }

  std::vector<std::size_t> shades_of_degree() {
    for (int degree = 4; degree <= 8; ++degree)
      shades_.push_back({colour_of_degree(degree), std::to_string(degree) + (degree == 4   ? " or fewer"
                                                                             : degree == 8 ? " or more"
                                                                                           : "")});
    std::vector<std::size_t> shade(faces_.size());
    for (std::size_t f = 0; f < shade.size(); ++f) {
      const auto node = static_cast<std::int32_t>(f) + 1;
      const std::int32_t degree = pstripack::nbcnt(reader_.last_slot(node), mesh_.lptr.data());
      shade[f] = static_cast<std::size_t>(std::clamp(degree, 4, 8) - 4);
      ++shades_[shade[f]].count;
    }
    return shade;
  }

  /// A triangle belongs to the owner of its smallest corner, as in pstripack_mesh_triangles.
  std::vector<std::size_t> shades_of_owner() {
    const auto ranks = static_cast<std::size_t>(options_.ranks);
    const pstripack::Partition partition =
        pstripack::partition_over_ranks(options_.partition, options_.ranks, nodes_);
    for (const Point& p : nodes_) owner_.push_back(static_cast<std::size_t>(partition.owner(p)));
    std::vector<std::set<std::size_t>> beside(ranks);
    for_each_arc([&](std::size_t a, std::size_t b) {
      if (owner_[a] == owner_[b]) return;
      beside[owner_[a]].insert(owner_[b]);
      beside[owner_[b]].insert(owner_[a]);
    });
    std::vector<std::vector<std::size_t>> lists;
    for (const auto& set : beside) lists.emplace_back(set.begin(), set.end());
    for (const std::string& colour : distinct_colours(lists)) shades_.push_back({colour, ""});
    for (const std::size_t owner : owner_) ++shades_[owner].count;
    if (options_.what == What::cells) return owner_;
    std::vector<std::size_t> shade(faces_.size());
    for (std::size_t f = 0; f < shade.size(); ++f) shade[f] = owner_[index(faces_.corner[faces_.begin[f]])];
    return shade;
  }

  template <class Visit>
  void for_each_arc(const Visit& visit) const {
    for (std::int32_t node = 1; node <= reader_.size(); ++node) {
      std::int32_t slot = reader_.last_slot(node);
      do {
        if (reader_.neighbour(slot) > node) visit(index(node), index(reader_.neighbour(slot)));
        slot = reader_.next(slot);
      } while (slot != reader_.last_slot(node));
    }
  }

  /// Each side of a face once: it has two faces, in one of which it leads to the larger number. Shorter sides
  /// are finer, so that dense parts do not become blots.
  void draw_lines() {
    constexpr int kClasses = 10;  // each twice as long as the previous one, from 1 pixel on
    std::vector<Path> paths(kClasses);
    double length = 0;
    std::size_t count = 0;
    const auto draw = [&](const Point& a, const Point& b) {
      for (const Outline& outline : view_->arc(a, b)) {
        double own = 0;
        for (std::size_t i = 0; i + 1 < outline.size(); ++i)
          own += std::hypot(outline[i + 1].x - outline[i].x, outline[i + 1].y - outline[i].y);
        length += own;
        ++count;
        add({outline}, false, paths[static_cast<std::size_t>(std::clamp(std::ilogb(own), 0, kClasses - 1))]);
      }
    };
    if (options_.what == What::triangles) {
      for_each_arc([&](std::size_t a, std::size_t b) { draw(nodes_[a], nodes_[b]); });
    } else {
      for (std::size_t f = 0; f < faces_.size(); ++f)
        for (std::size_t k = faces_.begin[f]; k < faces_.begin[f + 1]; ++k) {
          const std::int32_t u = faces_.corner[k],
                             v = faces_.corner[k + 1 < faces_.begin[f + 1] ? k + 1 : faces_.begin[f]];
          if (u < v && faces_.points[index(u)] != faces_.points[index(v)])
            draw(faces_.points[index(u)], faces_.points[index(v)]);
        }
    }
    spacing_ = count == 0 ? 10 : length / static_cast<double>(count);
    const char* const colour = options_.colour == Colour::none   ? kLine
                               : options_.colour == Colour::size ? "#ffffff"
                                                                 : "#555555";
    sheet_.add(fmt::format(
        "<g fill=\"none\" stroke=\"{}\" stroke-linecap=\"round\" stroke-linejoin=\"round\">\n", colour));
    const double usual = std::clamp(0.045 * spacing_, 0.1, 0.9);
    for (int k = 0; k < kClasses; ++k)
      sheet_.path(paths[static_cast<std::size_t>(k)],
                  fmt::format("stroke-width=\"{:.2f}\"",
                              usual * std::clamp(std::sqrt(std::ldexp(1.5, k) / spacing_), 0.2, 1.2)));
    sheet_.add("</g>\n");
    if (options_.what == What::cells && options_.colour == Colour::none && spacing_ > 4)
      draw_dots(nodes_, kBlack, std::clamp(0.1 * spacing_, 0.8, 3.0));
  }

  void draw_dots(const std::vector<Point>& points, const char* colour, double diameter) {
    Path path;
    for (const Point& p : points)
      if (const auto place = view_->place(p)) path.dot(*place);
    sheet_.path(path,
                fmt::format("fill=\"none\" stroke=\"{}\" stroke-width=\"{:.2f}\" stroke-linecap=\"round\"",
                            colour, diameter));
  }

  void draw_boundary() {
    if (boundary_.empty()) return;
    Path path;
    std::vector<Point> nodes;
    for (const std::size_t node : boundary_) {
      const auto next = index(reader_.first_neighbour(static_cast<std::int32_t>(node) + 1));
      add(view_->arc(nodes_[node], nodes_[next]), false, path);
      nodes.push_back(nodes_[node]);
    }
    if (options_.what == What::triangles)
      sheet_.path(path,
                  fmt::format("fill=\"none\" stroke=\"{}\" stroke-width=\"{:.2f}\" stroke-linecap=\"round\"",
                              kVermilion, std::clamp(0.1 * spacing_, 0.4, 1.6)));
    draw_dots(nodes, kVermilion, std::clamp(0.25 * spacing_, 1.2, 5.0));
  }

  void draw_border() {
    const Frame& frame = view_->frame();
    if (orthographic_ != nullptr && orthographic_->shows_limb())
      sheet_.add(circle("none", "#8a949e"));
    else
      sheet_.rectangle(frame.left, frame.top, frame.width(), frame.height(), "none", "#8a949e");
    if (lonlat_ == nullptr) {
      const bool zoomed = !orthographic_->shows_limb();
      sheet_.text({zoomed ? frame.right : kWidth - 14, frame.bottom + (zoomed ? 16 : -4)}, 12, Anchor::end,
                  "above " + name_of(centre_), kGrey);
      if (zoomed) top_ += 14;
      return;
    }
    for (const double lon : multiples(lonlat_->west(), lonlat_->east(), lon_step()))
      sheet_.text({lonlat_->on_paper({lon, 0}).x, frame.bottom + 16}, 12, Anchor::middle,
                  name_of_longitude(lon), kGrey);
    for (const double lat : multiples(lonlat_->south(), lonlat_->north(), lat_step()))
      sheet_.text({frame.left - 6, lonlat_->on_paper({0, lat}).y + 4}, 12, Anchor::end, name_of_latitude(lat),
                  kGrey);
    top_ += 14;
  }

  /// The number of each rank in the middle of its nodes.
  void draw_ranks() {
    constexpr int kMostNumbers = 100;
    if (options_.colour != Colour::owner || options_.ranks > kMostNumbers) return;
    std::vector<Point> sum(static_cast<std::size_t>(options_.ranks), Point{0, 0, 0});
    for (std::size_t i = 0; i < nodes_.size(); ++i) {
      Point& s = sum[owner_[i]];
      s = {s.x + nodes_[i].x, s.y + nodes_[i].y, s.z + nodes_[i].z};
    }
    sheet_.add("<g stroke=\"#ffffff\" stroke-width=\"3\" paint-order=\"stroke\" font-weight=\"bold\">\n");
    for (std::size_t rank = 0; rank < sum.size(); ++rank) {
      if (dot(sum[rank], sum[rank]) == 0) continue;
      const auto place = view_->place(files::unit(sum[rank]));
      if (!place) continue;
      const double x = std::clamp(place->x, view_->frame().left + 14, view_->frame().right - 14);
      sheet_.text({x, place->y + 5}, 15, Anchor::middle, std::to_string(rank));
    }
    sheet_.add("</g>\n");
  }

  // ---- legend ----

  void draw_legend() {
    switch (options_.colour) {
      case Colour::none:
        break;
      case Colour::size:
        if (scale_) legend_of_sizes();
        break;
      case Colour::degree:
        legend_of_degrees();
        break;
      case Colour::owner:
        legend_of_owners();
        break;
    }
    if (boundary_.empty()) return;
    const bool grey = options_.what == What::cells && options_.colour == Colour::size;
    top_ += 20;
    sheet_.add(
        fmt::format("<text x=\"{}\" y=\"{:.2f}\" font-size=\"13\" text-anchor=\"middle\" fill=\"{}\"><tspan "
                    "fill=\"{}\">●</tspan> {} boundary nodes{}</text>\n",
                    kWidth / 2, top_, kBlack, kVermilion, grouped(boundary_.size()),
                    grey ? "; grey: their cells, which share the rest of the sphere" : ""));
    top_ += 4;
  }

  void legend_of_sizes() {
    constexpr double kBar = 400, kLeft = (kWidth - kBar) / 2;
    constexpr int kStops = 20;
    sheet_.text({kWidth / 2, top_ + 14}, 14, Anchor::middle,
                fmt::format("area of a {}, {}sr", options_.what == What::cells ? "cell" : "triangle",
                            scale_->name_of_factor()));
    sheet_.add("<defs><linearGradient id=\"viridis\">");
    for (int k = 0; k <= kStops; ++k)
      sheet_.add(fmt::format("<stop offset=\"{}\" stop-color=\"{}\"/>", k / double{kStops},
                             viridis(k / double{kStops})));
    sheet_.add("</linearGradient></defs>\n");
    sheet_.rectangle(kLeft, top_ + 22, kBar, 12, "url(#viridis)");
    for (const Scale::Tick& tick : scale_->ticks(6)) {
      const double x = kLeft + kBar * (*scale_)(tick.value);
      sheet_.rectangle(x - 0.5, top_ + 34, 1, 4, kGrey);
      sheet_.text({x, top_ + 50}, 12, Anchor::middle, tick.label);
    }
    top_ += 54;
  }

  void legend_of_degrees() {
    sheet_.text({kWidth / 2, top_ + 14}, 14, Anchor::middle, "neighbours of a node (how many nodes)");
    double x = 90;
    for (const Shade& shade : shades_) {
      sheet_.rectangle(x, top_ + 24, 14, 14, shade.colour, kGrey);
      sheet_.text({x + 20, top_ + 36}, 13, Anchor::start,
                  fmt::format("{} ({})", shade.label, grouped(shade.count)));
      x += 130;
    }
    top_ += 40;
  }

  void legend_of_owners() {
    const auto [fewest, most] = std::minmax_element(
        shades_.begin(), shades_.end(), [](const Shade& a, const Shade& b) { return a.count < b.count; });
    const char* const kind =
        options_.partition == pstripack::PartitionKind::stripes ? "stripes" : "bisection";
    sheet_.text({kWidth / 2, top_ + 14}, 14, Anchor::middle,
                fmt::format("{}: which of {} {} owns a {}; {} to {} nodes each", kind, options_.ranks,
                            options_.ranks == 1 ? "rank" : "ranks",
                            options_.what == What::cells ? "node" : "triangle", grouped(fewest->count),
                            grouped(most->count)));
    top_ += 18;
  }

  const Mesh& mesh_;
  const MeshOptions& options_;
  const pstripack::ListReader<std::int32_t> reader_;
  const std::vector<Point> nodes_;  ///< of length 1
  std::vector<std::size_t> boundary_;
  Sheet sheet_;
  double top_ = 0;  ///< where the next thing goes
  std::unique_ptr<View> view_;
  const Orthographic* orthographic_ = nullptr;  ///< view_, if it is one
  const LonLat* lonlat_ = nullptr;
  Spot centre_{0, 0};
  double radius_ = 90;
  Faces faces_;
  std::vector<Shade> shades_;
  std::vector<std::size_t> owner_;  ///< of each node
  std::optional<Scale> scale_;
  double spacing_ = 0;  ///< of lines, in pixels
};

}  // namespace

std::string mesh_picture(const Mesh& mesh, const MeshOptions& options) {
  return MeshPicture(mesh, options).svg();
}

}  // namespace pictures
