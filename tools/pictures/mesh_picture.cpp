#include "pictures/mesh_picture.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <memory>
#include <set>
#include <stdexcept>

#include "files/map_rings.h"
#include "files/measures.h"
#include "parallel/sample.h"
#include "pictures/coasts.h"
#include "pictures/colours.h"
#include "pictures/font.h"
#include "pictures/legend.h"
#include "pictures/scale.h"
#include "pictures/sheet.h"
#include "point_sets.h"
#include "stripack/list_queries.h"

namespace pictures {
namespace {

using Colour = MeshOptions::Colour;
using What = MeshOptions::What;
using files::Faces;
using files::Mesh;
using pstripack::cross;
using pstripack::dot;

constexpr const char* kLine = "#1f5f8b";
constexpr const char* kGraticule = "#d5dce3";

std::size_t index(std::int32_t number) { return static_cast<std::size_t>(number) - 1; }

constexpr double kLabel = 12;  ///< font size around the drawing
constexpr auto kHowMany = " (how many nodes)";

/// For a picture of this radius in degrees. Empty: none are to be drawn.
Lines coasts_of(const MeshOptions& options, double radius) {
  if (!options.coast_file.empty()) return read_shapefile(options.coast_file);
  return options.coasts ? read_shapefile(natural_earth(radius)) : Lines();
}

class MeshPicture {
 public:
  MeshPicture(const Mesh& mesh, const MeshOptions& options)
      : mesh_(mesh),
        options_(options),
        reader_(mesh.lists()),
        nodes_(files::unit(mesh.points)),
        sheet_(options.width) {
    for (std::int32_t node = 1; node <= reader_.size(); ++node)
      if (reader_.on_boundary(node)) boundary_.push_back(index(node));
  }

  std::string svg() {
    top_ = sheet_.title(options_.title);
    choose_view();
    count_nodes_in_view();
    const bool cells = options_.what == What::cells;
    faces_ = cells ? files::voronoi_faces(mesh_) : files::triangle_faces(mesh_);
    if (cells) files::divide_half_turns(faces_);
    draw_ground();
    draw_faces();
    draw_graticule_again();
    draw_lines();
    draw_coasts();
    draw_stations();
    draw_boundary();
    draw_border();
    draw_labels();
    draw_footer();
    draw_ranks();
    draw_legend();
    return sheet_.svg(top_ + 8);
  }

  /// The colours of the faces, without a picture.
  Shading shading() {
    faces_ = options_.what == What::cells ? files::voronoi_faces(mesh_, false) : files::triangle_faces(mesh_);
    if (options_.colour != Colour::none) choose_shades();
    return std::move(shading_);
  }

 private:
  // ---- view ----

  void choose_view() {
    Spot centre = options_.centre ? *options_.centre : default_centre();
    if (const auto& region = options_.region; region) {
      centre = {(region->west + region->east) / 2, (region->south + region->north) / 2};
      radius_ = std::max((region->east - region->west) * std::cos(centre.lat / files::kRadian),
                         region->north - region->south) /
                2;
    } else {
      radius_ = options_.radius ? *options_.radius : radius_of_nodes(centre);
    }
    radius_ = std::min(90.0, radius_);
    zoomed_ = radius_ < 90;
    decimals_ = std::max(2, 1 - static_cast<int>(std::floor(std::log10(radius_))));
    // Space for the longest label beside the drawing.
    const double least = options_.lonlat ? 56.0 : zoomed_ ? 60.0 : 0.075 * sheet_.width();
    const double margin =
        options_.lonlat || zoomed_
            ? std::max(least, 10 + text_width(name_of_latitude(-88.88888888, decimals_), kLabel))
            : least;
    if (options_.lonlat) {
      const Frame frame{margin, top_, sheet_.width() - 24, top_ + 620};
      auto map = options_.region ? std::make_unique<LonLat>(*options_.region, frame)
                                 : std::make_unique<LonLat>(centre, radius_, frame);
      lonlat_ = map.get();
      view_ = std::move(map);
    } else {
      if (zoomed_) top_ += 16;  // space for labels above it
      auto sphere = std::make_unique<Orthographic>(
          centre, radius_, Frame{margin, top_, sheet_.width() - margin, top_ + sheet_.width() - 2 * margin});
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
    return spot_of(dot(sum, sum) > 1e-12 ? sum : nodes_[0]);
  }

  /// The radius that shows all nodes; 90 if it would exceed 70 degrees.
  double radius_of_nodes(const Spot& centre) const {
    if (boundary_.empty()) return 90;
    const Point eye = point_sets::from_degrees(centre.lon, centre.lat);
    double farthest = 0;
    for (const Point& p : nodes_) farthest = std::max(farthest, files::angle_between(eye, p));
    const double radius = 1.06 * farthest * files::kRadian;
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
                    "{}:{:g},{:g} --zoom {:.2g}",
                    grouped(count), grouped(kMostNodesInView), options_.lonlat ? "lonlat" : "orthographic",
                    centre_.lon, centre_.lat, fewer));
  }

  /// Spacing in degrees of meridians or parallels, so that about `lines` of them are visible over `span`
  /// degrees.
  static double graticule_step(double span, double lines) {
    constexpr double kSteps[] = {90, 60, 30, 15, 10, 5, 2, 1};
    double step = 90;
    for (const double s : kSteps)
      if (span / s <= lines) step = s;
    if (span / step >= lines / 2.5) return step;
    return round_step(span, static_cast<int>(lines));
  }

  /// The background with the graticule.
  void draw_ground() {
    Path& path = graticule_path_;
    const auto at = point_sets::from_degrees;
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
      if (!zoomed_)
        sheet_.add(circle("#fbfcfd", "none"));
      else
        sheet_.rectangle(frame.left, frame.top, frame.width(), frame.height(), "#fbfcfd");
      // The corners of the square are farther from the centre than its sides.
      const double reach =
          files::kRadian * std::asin(std::min(1.0, std::sqrt(2.0) * std::sin(radius_ / files::kRadian)));
      const double south = std::max(-90.0, centre_.lat - reach), north = std::min(90.0, centre_.lat + reach);
      const bool pole = std::fabs(centre_.lat) + reach > 85;
      const double half = pole ? 180
                               : files::kRadian * std::asin(std::sin(reach / files::kRadian) /
                                                            std::cos(centre_.lat / files::kRadian));
      const double step = graticule_step(2 * radius_, 6);
      const double across = pole ? std::max(30.0, step) : graticule_step(2 * half, meridians());
      constexpr int kPieces = 60;
      for (const double lon : multiples(centre_.lon - half, centre_.lon + half - 1e-9, across)) {
        graticule_.push_back({true, name_of_longitude(lon, decimals_), {}});
        for (int k = 0; k < kPieces; ++k)
          add_graticule(at(lon, south + (north - south) * k / kPieces),
                        at(lon, south + (north - south) * (k + 1) / kPieces), path);
      }
      for (const double lat : multiples(south, north, step)) {
        graticule_.push_back({false, name_of_latitude(lat, decimals_), {}});
        for (int k = 0; k < kPieces && std::fabs(lat) < 90; ++k)
          add_graticule(at(centre_.lon - half + 2 * half * k / kPieces, lat),
                        at(centre_.lon - half + 2 * half * (k + 1) / kPieces, lat), path);
      }
    }
    sheet_.path(path, fmt::format("fill=\"none\" stroke=\"{}\" stroke-width=\"0.8\"", kGraticule));
  }

  /// Over coloured faces, where its lines lead to labels.
  void draw_graticule_again() {
    if (options_.colour != Colour::none && (lonlat_ != nullptr || zoomed_))
      sheet_.path(graticule_path_,
                  "fill=\"none\" stroke=\"#000000\" stroke-opacity=\"0.35\" stroke-width=\"0.8\"");
  }

  /// Adds a piece of the current line of the graticule to the path and remembers its ends.
  void add_graticule(const Point& a, const Point& b, Path& path) {
    const std::vector<Outline> parts = view_->arc(a, b);
    add(parts, false, path);
    for (const Outline& part : parts)
      for (const Place& end : {part.front(), part.back()}) graticule_.back().ends.push_back(end);
  }

  /// Number of meridians that leaves space for their labels.
  double meridians() const {
    constexpr double kGap = 10;
    return std::min(9.0, view_->frame().width() /
                             (text_width(name_of_longitude(-88.88888888, decimals_), kLabel) + kGap));
  }
  double lon_step() const { return graticule_step(lonlat_->east() - lonlat_->west(), meridians()); }
  double lat_step() const { return graticule_step(lonlat_->north() - lonlat_->south(), 7); }

  static std::vector<double> multiples(double low, double high, double step) {
    std::vector<double> values;
    for (double k = std::ceil(low / step - 1e-9); k * step <= high + 1e-9; ++k) values.push_back(k * step);
    return values;
  }

  std::string circle(const char* fill, const char* stroke) const {
    return fmt::format(
        "<circle class=\"{}\" cx=\"{:.2f}\" cy=\"{:.2f}\" r=\"{:.2f}\" fill=\"{}\" stroke=\"{}\"/>\n",
        Sheet::kDrawing, orthographic_->middle().x, orthographic_->middle().y, orthographic_->scale(), fill,
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
    choose_shades();
    std::vector<Path> paths(shading_.shades.size());
    std::vector<Point> corners;
    for (std::size_t f = 0; f < faces_.size(); ++f) {
      corners.clear();
      for (std::size_t k = faces_.begin[f]; k < faces_.begin[f + 1]; ++k)
        if (corners.empty() || faces_.point(k) != corners.back()) corners.push_back(faces_.point(k));
      while (corners.size() > 1 && corners.front() == corners.back()) corners.pop_back();
      add(view_->polygon(corners), true, paths[shading_.of_face[f]]);
    }
    // Stroke each face in its own colour; otherwise the background shows between neighbours.
    for (std::size_t s = 0; s < paths.size(); ++s)
      sheet_.path(paths[s],
                  fmt::format("fill=\"{0}\" stroke=\"{0}\" stroke-width=\"0.4\"", shading_.shades[s].colour));
  }

  void choose_shades() {
    switch (options_.colour) {
      case Colour::size:
        return shade_by_size();
      case Colour::degree:
        return shade_by_degree();
      case Colour::value:
        return shade_by_value();
      default:
        return shade_by_owner();
    }
  }

  /// Cells of boundary nodes have no area: they are grey.
  void shade_by_size() {
    std::vector<double> area = files::areas(faces_);
    for (double& a : area) a *= files::kEarthRadius * files::kEarthRadius;
    if (options_.what == What::cells)
      for (const std::size_t node : boundary_) area[node] = NAN;
    shade_by_numbers(area, fmt::format("area of a {}", what()), "km²");
  }

  const char* what() const { return options_.what == What::cells ? "cell" : "triangle"; }

  void shade_by_numbers(const std::vector<double>& values, const std::string& title,
                        const std::string& unit) {
    shading_ = shading_of_numbers(values, title, unit, {options_.palette, options_.range, bar_width(sheet_)});
  }

  /// By the values of a column. A triangle gets the mean of its corners.
  void shade_by_value() {
    const files::Column* const column = files::find(mesh_.columns, options_.value);
    if (column == nullptr) throw std::runtime_error("no column is named " + options_.value);
    const std::string& title = column->long_name.empty() ? column->name : column->long_name;
    if (column->is_text()) return shade_by_words(column->texts, title);
    if (options_.what == What::cells) return shade_by_numbers(column->numbers, title, column->units);
    std::vector<double> means(faces_.size());
    faces_.for_each_corner(
        [&](std::size_t f, std::size_t k) { means[f] += column->numbers[index(faces_.corner[k])] / 3; });
    shade_by_numbers(means, title, column->units);
  }

  /// The most frequent words have a colour each; all others share one.
  void shade_by_words(const std::vector<std::string>& words, const std::string& title) {
    if (options_.what != What::cells)
      throw std::runtime_error(fmt::format("{} is a column of words: say --what cells", options_.value));
    if (options_.range)
      throw std::runtime_error(fmt::format("{} is a column of words: it has no --range", options_.value));
    std::map<std::string, std::size_t> counts;
    for (const std::string& word : words) ++counts[word];
    const Shade missing{kNoColour, "no value", counts[""]};
    counts.erase("");
    std::vector<std::pair<std::string, std::size_t>> sorted(counts.begin(), counts.end());
    std::stable_sort(sorted.begin(), sorted.end(),
                     [](const auto& a, const auto& b) { return a.second > b.second; });
    const std::size_t coloured = std::min(sorted.size(), kCategories.size());
    std::map<std::string, std::size_t> shade_of{{"", coloured + 1}};
    Shade others{kOtherWords, fmt::format("{} others", grouped(sorted.size() - coloured))};
    for (std::size_t i = 0; i < sorted.size(); ++i) {
      const auto& [word, count] = sorted[i];
      shade_of[word] = std::min(i, coloured);
      if (i < coloured)
        shading_.shades.push_back({kCategories[i], word, count});
      else
        others.count += count;
    }
    shading_.shades.push_back(others);
    shading_.shades.push_back(missing);
    for (const std::string& word : words) shading_.of_face.push_back(shade_of[word]);
    shading_.title = title + kHowMany;
  }

  void shade_by_degree() {
    constexpr const char* kLabels[] = {"4 or fewer", "5", "6", "7", "8 or more"};
    for (int degree = 4; degree <= 8; ++degree)
      shading_.shades.push_back({colour_of_degree(degree), kLabels[degree - 4]});
    for (std::int32_t node = 1; node <= reader_.size(); ++node) {
      const std::int32_t degree = pstripack::nbcnt(reader_.last_slot(node), mesh_.lptr.data());
      shading_.of_face.push_back(static_cast<std::size_t>(std::clamp(degree, 4, 8) - 4));
      ++shading_.shades[shading_.of_face.back()].count;
    }
    shading_.title = std::string("neighbours of a node") + kHowMany;
  }

  /// A triangle belongs to the owner of its smallest corner, as in pstripack_mesh_triangles.
  void shade_by_owner() {
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
    for (const std::string& colour : distinct_colours(lists))
      shading_.shades.push_back({colour, std::to_string(shading_.shades.size())});
    for (const std::size_t owner : owner_) ++shading_.shades[owner].count;
    shading_.of_face = owner_;
    if (options_.what == What::triangles) {
      shading_.of_face.clear();
      for (std::size_t f = 0; f < faces_.size(); ++f)
        shading_.of_face.push_back(owner_[index(faces_.corner[faces_.begin[f]])]);
    }
    shading_.title = std::string("rank that owns a node") + kHowMany;
  }

  template <class Visit>
  void for_each_arc(const Visit& visit) const {
    for (std::int32_t node = 1; node <= reader_.size(); ++node)
      reader_.for_each_neighbour(node, [&](std::int32_t neighbour) {
        if (neighbour > node) visit(index(node), index(neighbour));
      });
  }

  /// Draws each side of a face once. Two faces share a side; it is drawn in the one where it leads to the
  /// larger number. Shorter sides get thinner lines, so that dense parts do not become blots.
  void draw_lines() {
    constexpr int kClasses = 10;  // each class is twice as long as the previous one, from 1 pixel on
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
      faces_.for_each_corner([&](std::size_t f, std::size_t k) {
        const std::size_t next = faces_.after(f, k);
        if (faces_.corner[k] < faces_.corner[next] && faces_.point(k) != faces_.point(next))
          draw(faces_.point(k), faces_.point(next));
      });
    }
    spacing_ = count == 0 ? 10 : length / static_cast<double>(count);
    const char* const colour = options_.colour == Colour::none ? kLine
                               : shading_.scale                ? options_.palette->lines
                                                               : "#555555";
    sheet_.add(fmt::format(
        "<g fill=\"none\" stroke=\"{}\" stroke-linecap=\"round\" stroke-linejoin=\"round\">\n", colour));
    const double usual = std::clamp(0.045 * spacing_, 0.1, 0.9);
    for (int k = 0; k < kClasses; ++k)
      sheet_.path(paths[static_cast<std::size_t>(k)],
                  fmt::format("stroke-width=\"{:.2f}\"",
                              usual * std::clamp(std::sqrt(std::ldexp(1.5, k) / spacing_), 0.2, 1.2)));
    sheet_.add("</g>\n");
    if (options_.what == What::cells && options_.colour == Colour::none && spacing_ > 4 && !options_.dots)
      draw_dots(nodes_, kBlack, std::clamp(0.1 * spacing_, 0.8, 3.0));
  }

  /// Black with a white rim: seen on every colour.
  void draw_stations() {
    if (!options_.dots) return;
    const double size = std::clamp(0.2 * spacing_, 1.5, 5.0);
    draw_dots(nodes_, "#ffffff", 1.5 * size);
    draw_dots(nodes_, kBlack, size);
  }

  void draw_dots(const std::vector<Point>& points, const char* colour, double diameter) {
    Path path;
    for (const Point& p : points)
      if (const auto place = view_->place(p)) path.dot(*place);
    sheet_.path(path,
                fmt::format("fill=\"none\" stroke=\"{}\" stroke-width=\"{:.2f}\" stroke-linecap=\"round\"",
                            colour, diameter));
  }

  void draw_coasts() {
    const Lines coasts = coasts_of(options_, radius_);
    if (coasts.empty()) return;
    const double shortest = 0.4 / view_->scale();  // steps below 0.4 pixels are left out
    Path path;
    for (const auto& line : coasts) {
      const Point* last = &line[0];
      for (const Point& p : line) {
        if (&p == last || (&p != &line.back() && files::length(minus(p, *last)) < shortest)) continue;
        add(view_->arc(*last, p), false, path);
        last = &p;
      }
    }
    sheet_.add("<defs><g id=\"coasts\">");
    sheet_.path(path, "fill=\"none\" stroke-linejoin=\"round\"");
    sheet_.add(
        "</g></defs>\n<use href=\"#coasts\" stroke=\"#ffffff\" stroke-opacity=\"0.6\" "
        "stroke-width=\"2.4\"/>\n"
        "<use href=\"#coasts\" stroke=\"#1c1c1c\" stroke-width=\"0.9\"/>\n");
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
    if (lonlat_ == nullptr && !zoomed_)
      sheet_.add(circle("none", "#8a949e"));
    else
      sheet_.rectangle(frame.left, frame.top, frame.width(), frame.height(), "none", "#8a949e",
                       Sheet::kDrawing);
  }

  /// Draws longitudes and latitudes around a map, or where the graticule meets the border of a zoomed view.
  void draw_labels() {
    const Frame& frame = view_->frame();
    constexpr double kTick = 4;
    // Each draws a label and its tick at a side of the frame, unless there is no space.
    const auto beside = [&](double y, const std::string& name, bool left) {
      const double x = left ? frame.left : frame.right, out = left ? -1 : 1;
      if (!sheet_.text_if_free({x + 7 * out, y + 4}, kLabel, left ? Anchor::end : Anchor::start, name, kGrey))
        return false;
      sheet_.rectangle(left ? x - kTick : x, y - 0.5, kTick, 1, kGrey);
      return true;
    };
    const auto above_or_below = [&](double x, const std::string& name, bool above) {
      const double y = above ? frame.top : frame.bottom;
      if (!sheet_.text_if_free({x, above ? y - 6 : y + 17}, kLabel, Anchor::middle, name, kGrey))
        return false;
      sheet_.rectangle(x - 0.5, above ? y - kTick : y, 1, kTick, kGrey);
      return true;
    };
    if (lonlat_ != nullptr) {
      for (const double lon : multiples(lonlat_->west(), lonlat_->east(), lon_step()))
        above_or_below(lonlat_->on_paper({lon, 0}).x, name_of_longitude(lon, decimals_), false);
      for (const double lat : multiples(lonlat_->south(), lonlat_->north(), lat_step()))
        beside(lonlat_->on_paper({0, lat}).y, name_of_latitude(lat, decimals_), true);
      top_ += 17;
      return;
    }
    if (!zoomed_) return;
    constexpr double kNear = 1e-6;
    for (const GraticuleLine& line : graticule_)
      for (const bool first : {true, false}) {  // below, else above; left, else right
        const auto end = std::find_if(line.ends.begin(), line.ends.end(), [&](const Place& p) {
          return line.is_meridian ? (first ? p.y > frame.bottom - kNear : p.y < frame.top + kNear)
                                  : (first ? p.x < frame.left + kNear : p.x > frame.right - kNear);
        });
        if (end == line.ends.end()) continue;
        if (line.is_meridian ? above_or_below(end->x, line.name, !first) : beside(end->y, line.name, first))
          break;
      }
    top_ += 17;
  }

  /// Draws the position below the eye and a scale bar.
  void draw_footer() {
    const Frame& frame = view_->frame();
    const std::string eye = "above " + name_of(centre_, decimals_);
    if (!zoomed_) {
      if (lonlat_ != nullptr) return;
      // Beside the circle, or below it, where the picture is narrow.
      const Place middle = orthographic_->middle();
      const double right = sheet_.width() - 14, left = right - text_width(eye, kLabel) - 4;
      const bool is_beside =
          std::hypot(left - middle.x, frame.bottom - 18 - middle.y) > orthographic_->scale() &&
          left > middle.x;
      if (!is_beside) top_ += 18;
      sheet_.text({right, is_beside ? frame.bottom - 4 : top_ - 4}, kLabel, Anchor::end, eye, kGrey);
      return;
    }
    // The bar's length is 1, 2 or 5 times a power of ten, at most a quarter of the width.
    const double pixels_per_km = view_->scale() / files::kEarthRadius;
    const double longest = frame.width() / 4 / pixels_per_km;
    const double power = std::pow(10, std::floor(std::log10(longest)));
    const double km = power * (longest >= 5 * power ? 5 : longest >= 2 * power ? 2 : 1);
    const double left = frame.left, right = left + km * pixels_per_km, y = top_ + 14;
    sheet_.rectangle(left, y - 1, right - left, 2, kBlack);
    for (const double x : {left, right}) sheet_.rectangle(x - 0.75, y - 5, 1.5, 10, kBlack);
    const std::string length = km < 1 ? fmt::format("{:g} m", 1000 * km)
                                      : grouped(static_cast<std::size_t>(std::lround(km))) + " km";
    sheet_.text({right + 8, y + 4}, kLabel, Anchor::start,
                lonlat_ != nullptr ? length + " at " + name_of_latitude(centre_.lat, decimals_)
                                   : length + " in the middle");
    if (lonlat_ == nullptr) sheet_.text_if_free({frame.right, y + 4}, kLabel, Anchor::end, eye, kGrey);
    top_ += 24;
  }

  /// Draws the number of each rank at its node in the middle of its visible nodes if there is space.
  void draw_ranks() {
    constexpr int kMostNumbers = 100;
    constexpr double kNumber = 15;
    if (options_.colour != Colour::owner || options_.ranks > kMostNumbers) return;
    const auto ranks = static_cast<std::size_t>(options_.ranks);
    std::vector<std::vector<Place>> places(ranks);
    for (std::size_t i = 0; i < nodes_.size(); ++i)
      if (const auto place = view_->place(nodes_[i])) places[owner_[i]].push_back(*place);
    sheet_.add("<g stroke=\"#ffffff\" stroke-width=\"3\" paint-order=\"stroke\" font-weight=\"bold\">\n");
    for (std::size_t rank = 0; rank < ranks; ++rank) {
      Place middle{0, 0};
      const auto count = static_cast<double>(places[rank].size());
      for (const Place& p : places[rank]) middle.x += p.x / count, middle.y += p.y / count;
      const auto from_middle = [&](const Place& p) { return std::hypot(p.x - middle.x, p.y - middle.y); };
      const auto nearest =
          std::min_element(places[rank].begin(), places[rank].end(),
                           [&](const Place& p, const Place& q) { return from_middle(p) < from_middle(q); });
      if (nearest == places[rank].end()) continue;
      const std::string number = std::to_string(rank);
      const Place at{nearest->x, nearest->y + 5};
      if (is_inside(box_of(at, kNumber, Anchor::middle, number)))
        sheet_.text_if_free(at, kNumber, Anchor::middle, number);
    }
    sheet_.add("</g>\n");
  }

  /// True if the box lies in the drawing, at least a line width from its border.
  bool is_inside(const Box& box) const {
    const Frame& frame = view_->frame();
    constexpr double kLine = 2;
    if (lonlat_ != nullptr || zoomed_)
      return box.left > frame.left + kLine && box.right < frame.right - kLine &&
             box.top > frame.top + kLine && box.bottom < frame.bottom - kLine;
    const Place middle = orthographic_->middle();
    const double x = std::max(middle.x - box.left, box.right - middle.x),
                 y = std::max(middle.y - box.top, box.bottom - middle.y);
    return std::hypot(x, y) < orthographic_->scale() - kLine;
  }

  // ---- legend ----

  void draw_legend() {
    if (shading_.scale) {
      top_ = draw_colour_bar(sheet_, top_, shading_, *options_.palette);
      if (const std::size_t missing = shading_.shades.back().count;
          options_.colour == Colour::value && missing > 0)
        top_ = draw_note(sheet_, top_ + 2, kNoColour,
                         fmt::format("no value: {} {}{}", grouped(missing), what(), missing == 1 ? "" : "s"));
    } else if (options_.colour == Colour::degree || options_.colour == Colour::value) {
      top_ = draw_shades(sheet_, top_, shading_);
    } else if (options_.colour == Colour::owner) {
      draw_legend_of_owners();
    }
    if (boundary_.empty()) return;
    const bool grey = options_.what == What::cells && options_.colour == Colour::size;
    top_ = draw_note(sheet_, top_, kVermilion,
                     fmt::format("{} boundary nodes{}", grouped(boundary_.size()),
                                 grey ? "; grey: their cells, which share the rest of the sphere" : ""));
  }

  void draw_legend_of_owners() {
    const auto [fewest, most] =
        std::minmax_element(shading_.shades.begin(), shading_.shades.end(),
                            [](const Shade& a, const Shade& b) { return a.count < b.count; });
    sheet_.centred(
        top_ + 14, 14,
        fmt::format("{}: which of {} {} owns a {}; {} to {} nodes each", name_of(options_.partition),
                    options_.ranks, options_.ranks == 1 ? "rank" : "ranks",
                    options_.what == What::cells ? "node" : "triangle", grouped(fewest->count),
                    grouped(most->count)));
    top_ += 18;
  }

  /// A meridian or parallel, and the ends of its drawn pieces.
  struct GraticuleLine {
    bool is_meridian;
    std::string name;
    std::vector<Place> ends;
  };

  const Mesh& mesh_;
  const MeshOptions& options_;
  const pstripack::ListReader<std::int32_t> reader_;
  const std::vector<Point> nodes_;  ///< of length 1
  std::vector<std::size_t> boundary_;
  Sheet sheet_;
  double top_ = 0;  ///< top of the next element
  std::unique_ptr<View> view_;
  const Orthographic* orthographic_ = nullptr;  ///< view_ if it is orthographic, else null
  const LonLat* lonlat_ = nullptr;
  Spot centre_{0, 0};
  double radius_ = 90;
  bool zoomed_ = false;  ///< true if only a part of the sphere is shown
  int decimals_ = 2;     ///< decimals of degrees in labels
  std::vector<GraticuleLine> graticule_;
  Path graticule_path_;
  Faces faces_;
  Shading shading_;
  std::vector<std::size_t> owner_;  ///< of each node
  double spacing_ = 0;              ///< mean distance of the drawn lines in pixels
};

}  // namespace

Globe mesh_globe(const files::Mesh& mesh, const MeshOptions& options) {
  Globe globe;
  globe.title = options.title;
  globe.cells = options.what == MeshOptions::What::cells;
  files::LonLat angles = files::angles_of(mesh.points, mesh.given, true);
  globe.lon = std::move(angles.lon), globe.lat = std::move(angles.lat);
  globe.triangles = files::triangles_of(mesh);
  for (std::int32_t& corner : globe.triangles) --corner;
  globe.shading = MeshPicture(mesh, options).shading();
  if (options.colour == MeshOptions::Colour::value)
    if (const files::Column* const column = files::find(mesh.columns, options.value)) {
      globe.value_name = column->long_name.empty() ? column->name : column->long_name;
      globe.value_unit = column->units;
      globe.numbers = column->numbers;
      if (column->is_text()) globe.words = column->texts;
    }
  if (options.colour == MeshOptions::Colour::owner && globe.cells) {
    globe.value_name = "rank";
    globe.numbers.assign(globe.shading.of_face.begin(), globe.shading.of_face.end());
  }
  globe.coasts = coasts_of(options, kGlobeDetail);
  if (options.centre) globe.centre = {options.centre->lon, options.centre->lat};
  globe.radius = options.radius;
  return globe;
}

std::string mesh_picture(const Mesh& mesh, const MeshOptions& options) {
  return MeshPicture(mesh, options).svg();
}

}  // namespace pictures
