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
    if (!options_.title.empty()) sheet_.centred(30, 18, options_.title);
    top_ = options_.title.empty() ? 14 : 48;
    choose_view();
    count_nodes_in_view();
    const bool cells = options_.what == What::cells;
    faces_ = cells ? files::voronoi_faces(mesh_) : files::triangle_faces(mesh_);
    draw_frame("#fbfcfd", "none");
    draw_faces();
    draw_graticule();
    draw_lines();
    draw_coasts();
    draw_stations();
    draw_boundary();
    draw_frame("none", "#8a949e");
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
    const bool has_labels = options_.lonlat || radius_ < 90;
    decimals_ = std::max(2, 1 - static_cast<int>(std::floor(std::log10(radius_))));
    label_width_ = text_width(name_of_latitude(-88.88888888, decimals_), kLabel);
    const double margin = has_labels ? std::max(60.0, 10 + label_width_) : 0.075 * sheet_.width();
    const double right = sheet_.width() - (options_.lonlat ? 36 : margin);
    if (has_labels && !options_.lonlat) top_ += 16;  // space for labels above it
    const Frame frame{margin, top_, right, top_ + (options_.lonlat ? 620 : right - margin)};
    if (!options_.lonlat)
      view_ = std::make_unique<Orthographic>(centre, radius_, frame);
    else if (options_.region)
      view_ = std::make_unique<LonLat>(*options_.region, frame);
    else
      view_ = std::make_unique<LonLat>(centre, radius_, frame);
    centre_ = centre;
    top_ = view_->frame().bottom + (has_labels ? 25 : 8);
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

  /// Meridians and parallels, which a disc of colours does without, and their names where they meet a border
  /// that is no circle.
  void draw_graticule() {
    if (view_->is_disc() && options_.colour != Colour::none) return;
    const auto& [west, east, south, north] = view_->bounds();
    // So many meridians leave space for their names.
    const double most = std::min(9.0, view_->frame().width() / (label_width_ + 10));
    const double across = graticule_step(east - west, options_.lonlat || east - west < 360 ? most : 12);
    Path path;
    for (const double lon : multiples(west, east, across))
      add_meridian_or_parallel(
          true, name_of_longitude(lon, decimals_), path,
          [&, s = south, n = north](double t) { return point_sets::from_degrees(lon, s + (n - s) * t); });
    for (const double lat : multiples(south, north, graticule_step(north - south, 7)))
      add_meridian_or_parallel(
          false, name_of_latitude(lat, decimals_), path, [&, w = west, e = east](double t) {
            constexpr double kPole = 90 - 1e-6;  // all longitudes have a place
            return point_sets::from_degrees(w + (e - w) * t, std::clamp(lat, -kPole, kPole));
          });
    sheet_.path(path, fmt::format("fill=\"none\" stroke=\"{}\" stroke-width=\"0.8\"",
                                  options_.colour == Colour::none ? "#d5dce3" : "#00000040"));
  }

  /// at(0) ... at(1): the line.
  template <class At>
  void add_meridian_or_parallel(bool is_meridian, const std::string& name, Path& path, const At& at) {
    constexpr int kPieces = 120;
    constexpr double kNear = 1e-6;
    std::vector<Place> ends;
    for (int k = 0; k < kPieces; ++k)
      for (const Outline& part : view_->arc(at(k / double{kPieces}), at((k + 1) / double{kPieces}))) {
        add({part}, false, path);
        ends.insert(ends.end(), {part.front(), part.back()});
      }
    if (view_->is_disc()) return;
    const Frame& frame = view_->frame();
    bool found = false;
    for (const bool first : {true, false})  // below, else above; on the left, else on the right
      for (const Place& p : ends) {
        const double side =
            is_meridian ? (first ? frame.bottom : frame.top) : (first ? frame.left : frame.right);
        if ((found && !first) || std::fabs((is_meridian ? p.y : p.x) - side) > kNear) continue;
        found = true;
        const Place text =
            is_meridian ? Place{p.x, side + (first ? 17 : -6)} : Place{side + (first ? -7 : 7), p.y + 4};
        const bool is_free = std::none_of(labels_.begin(), labels_.end(), [&](const Place& label) {
          return std::fabs(text.x - label.x) < label_width_ && std::fabs(text.y - label.y) < kLabel;
        });
        if (!is_free) continue;
        labels_.push_back(text);
        sheet_.text(text, kLabel,
                    is_meridian ? Anchor::middle
                    : first     ? Anchor::end
                                : Anchor::start,
                    name, kGrey);
      }
  }

  static std::vector<double> multiples(double low, double high, double step) {
    std::vector<double> values;
    for (double k = std::ceil(low / step - 1e-9); k * step <= high + 1e-9; ++k) values.push_back(k * step);
    return values;
  }

  /// The drawing's ground or border.
  void draw_frame(const char* fill, const char* stroke) {
    const Frame& frame = view_->frame();
    if (!view_->is_disc())
      return sheet_.rectangle(frame.left, frame.top, frame.width(), frame.height(), fill, stroke);
    const double radius = frame.width() / 2;
    sheet_.add(fmt::format("<circle cx=\"{:.2f}\" cy=\"{:.2f}\" r=\"{:.2f}\" fill=\"{}\" stroke=\"{}\"/>\n",
                           frame.left + radius, frame.top + radius, radius, fill, stroke));
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
    shading_ = shading_of_numbers(values, title, unit, options_.range, bar_width());
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

  void add_face(std::size_t shade) {
    shading_.of_face.push_back(shade);
    ++shading_.shades[shade].count;
  }

  /// The most frequent words have a colour each; all others share one.
  void shade_by_words(const std::vector<std::string>& words, const std::string& title) {
    if (options_.what != What::cells)
      throw std::runtime_error(fmt::format("{} is a column of words: say --what cells", options_.value));
    if (options_.range)
      throw std::runtime_error(fmt::format("{} is a column of words: it has no --range", options_.value));
    std::map<std::string, std::size_t> counts;
    for (const std::string& word : words) ++counts[word];
    counts.erase("");
    std::vector<std::pair<std::string, std::size_t>> sorted(counts.begin(), counts.end());
    std::stable_sort(sorted.begin(), sorted.end(),
                     [](const auto& a, const auto& b) { return a.second > b.second; });
    const std::size_t coloured = std::min(sorted.size(), kCategories.size());
    std::map<std::string, std::size_t> shade_of{{"", coloured + 1}};
    for (std::size_t i = 0; i < sorted.size(); ++i) {
      shade_of[sorted[i].first] = std::min(i, coloured);
      if (i < coloured) shading_.shades.push_back({kCategories[i], sorted[i].first});
    }
    shading_.shades.push_back({kOtherWords, fmt::format("{} others", grouped(sorted.size() - coloured))});
    shading_.shades.push_back({kNoColour, "no value"});
    for (const std::string& word : words) add_face(shade_of[word]);
    shading_.title = title + kHowMany;
  }

  void shade_by_degree() {
    // White for six neighbours, blue for fewer, red for more.
    shading_.shades = {{"#2166ac", "4 or fewer"},
                       {"#92c5de", "5"},
                       {"#f7f7f7", "6"},
                       {"#f4a582", "7"},
                       {"#b2182b", "8 or more"}};
    for (std::int32_t node = 1; node <= reader_.size(); ++node) {
      const std::int32_t degree = pstripack::nbcnt(reader_.last_slot(node), mesh_.lptr.data());
      add_face(static_cast<std::size_t>(std::clamp(degree, 4, 8) - 4));
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
    for (const std::string& colour : distinct_colours(beside))
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
                               : shading_.scale                ? "#ffffff"
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
    for (const std::size_t node : boundary_)
      add(view_->arc(nodes_[node],
                     nodes_[index(reader_.first_neighbour(static_cast<std::int32_t>(node) + 1))]),
          false, path);
    sheet_.path(path,
                fmt::format("fill=\"none\" stroke=\"{}\" stroke-width=\"{:.2f}\" stroke-linecap=\"round\"",
                            kVermilion, std::clamp(0.1 * spacing_, 0.4, 1.6)));
  }

  /// The place below the eye, or a scale bar.
  void draw_footer() {
    if (view_->is_disc()) {
      sheet_.text({sheet_.width() - 14, top_ + 8}, kLabel, Anchor::end,
                  "above " + name_of_longitude(centre_.lon) + " " + name_of_latitude(centre_.lat), kGrey);
      top_ += 16;
    }
    if (radius_ == 90) return;
    // The bar's length is 1, 2 or 5 times a power of ten, at most a quarter of the width.
    const double pixels_per_km = view_->scale() / files::kEarthRadius;
    const double longest = view_->frame().width() / 4 / pixels_per_km;
    const double power = std::pow(10, std::floor(std::log10(longest)));
    const double km = power * (longest >= 5 * power ? 5 : longest >= 2 * power ? 2 : 1);
    const double left = view_->frame().left, right = left + km * pixels_per_km, y = top_ + 14;
    sheet_.rectangle(left, y - 1, right - left, 2, kBlack);
    for (const double x : {left, right}) sheet_.rectangle(x - 0.75, y - 5, 1.5, 10, kBlack);
    sheet_.text(
        {right + 8, y + 4}, kLabel, Anchor::start,
        fmt::format("{} {}",
                    km < 1 ? fmt::format("{:g} m", 1000 * km)
                           : grouped(static_cast<std::size_t>(std::lround(km))) + " km",
                    options_.lonlat ? "at " + name_of_latitude(centre_.lat, decimals_) : "in the middle"));
    top_ += 24;
  }

  /// Draws the number of each rank in the middle of its nodes.
  void draw_ranks() {
    constexpr std::size_t kMostNumbers = 100;
    if (options_.colour != Colour::owner || shading_.shades.size() > kMostNumbers) return;
    std::vector<Point> sums(shading_.shades.size(), Point{0, 0, 0});
    for (std::size_t i = 0; i < nodes_.size(); ++i) {
      Point& sum = sums[owner_[i]];
      sum = {sum.x + nodes_[i].x, sum.y + nodes_[i].y, sum.z + nodes_[i].z};
    }
    sheet_.add("<g stroke=\"#ffffff\" stroke-width=\"3\" paint-order=\"stroke\" font-weight=\"bold\">\n");
    for (std::size_t rank = 0; rank < sums.size(); ++rank)
      if (const auto at = view_->place(files::unit(sums[rank])); at && files::length(sums[rank]) > 0)
        sheet_.text({at->x, at->y + 5}, 15, Anchor::middle, std::to_string(rank));
    sheet_.add("</g>\n");
  }

  // ---- legend ----

  double bar_width() const { return std::min(400.0, sheet_.width() - 60); }

  void draw_legend() {
    if (options_.colour == Colour::owner) {
      draw_legend_of_owners();
    } else if (options_.colour != Colour::none) {
      sheet_.centred(top_ + 14, 14, shading_.title);
      top_ += 22;
      if (shading_.scale)
        draw_colour_bar();
      else
        draw_shades();
    }
    const std::size_t missing = shading_.scale ? shading_.shades.back().count : 0;
    if (options_.colour == Colour::value && missing > 0)
      draw_note(kNoColour,
                fmt::format("no value: {} {}{}", grouped(missing), what(), missing == 1 ? "" : "s"));
    if (boundary_.empty()) return;
    const bool grey = options_.what == What::cells && options_.colour == Colour::size;
    draw_note(kVermilion, fmt::format("{} boundary nodes{}", grouped(boundary_.size()),
                                      grey ? "; grey: their cells, which share the rest of the sphere" : ""));
  }

  void draw_colour_bar() {
    constexpr int kStops = 20;
    const double width = bar_width(), left = (sheet_.width() - width) / 2;
    sheet_.add("<defs><linearGradient id=\"palette\">");
    for (int k = 0; k <= kStops; ++k)
      sheet_.add(fmt::format("<stop offset=\"{}\" stop-color=\"{}\"/>", k / double{kStops},
                             viridis(k / double{kStops})));
    sheet_.add("</linearGradient></defs>\n");
    sheet_.rectangle(left, top_, width, 12, "url(#palette)");
    for (const Scale::Tick& tick : shading_.scale->ticks()) {
      const double x = left + width * (*shading_.scale)(tick.value);
      sheet_.rectangle(x - 0.5, top_ + 12, 1, 4, kGrey);
      sheet_.text({x, top_ + 28}, kTickLabels, Anchor::middle, tick.label);
    }
    top_ += 36;
  }

  /// In as many columns as fit.
  void draw_shades() {
    const double room = sheet_.width() - 24;
    std::vector<std::pair<std::string, std::string>> keys;
    double width = 0;
    for (const Shade& shade : shading_.shades)
      if (shade.count > 0) {
        keys.emplace_back(shade.colour, fmt::format("{} ({})", shade.label, grouped(shade.count)));
        width = std::max(width, std::min(room, 36 + text_width(keys.back().second, 13)));
      }
    const std::size_t columns = std::min(keys.size(), static_cast<std::size_t>(room / width));
    for (std::size_t k = 0; k < keys.size(); ++k) {
      const double left = (sheet_.width() - width * static_cast<double>(columns)) / 2;
      sheet_.key(left + width * static_cast<double>(k % columns), top_, width, keys[k].first, keys[k].second);
      if (k % columns + 1 == columns || k + 1 == keys.size()) top_ += 20;
    }
  }

  void draw_note(const char* colour, const std::string& words) {
    const double width = std::min(sheet_.width() - 24, 24 + text_width(words, 13));
    sheet_.key((sheet_.width() - width) / 2, top_, width, colour, words);
    top_ += 22;
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

  const Mesh& mesh_;
  const MeshOptions& options_;
  const pstripack::ListReader<std::int32_t> reader_;
  const std::vector<Point> nodes_;  ///< of length 1
  std::vector<std::size_t> boundary_;
  Sheet sheet_;
  double top_ = 0;  ///< top of the next element
  std::unique_ptr<View> view_;
  Spot centre_{0, 0};
  double radius_ = 90;
  int decimals_ = 2;        ///< decimals of degrees in labels
  double label_width_ = 0;  ///< of the longest label of a meridian or parallel
  std::vector<Place> labels_;
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
