// Pictures: drawn faces have the right area on each map, wherever they are cut.

#include <gtest/gtest.h>

#include <algorithm>
#include <boost/property_tree/xml_parser.hpp>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <set>
#include <sstream>

#include "error_of.h"
#include "files/measures.h"
#include "pictures/coasts.h"
#include "pictures/mesh_picture.h"
#include "pictures/scale.h"
#include "pictures/svg.h"
#include "pictures/view.h"
#include "point_sets.h"

namespace pictures {
namespace {

using files::Faces;
using files::Mesh;

constexpr double kPi = 3.14159265358979324;

/// The area of an outline; positive if it looks counterclockwise (y points down).
double area_of(const Outline& outline) {
  double twice = 0;
  for (std::size_t i = 0; i < outline.size(); ++i) {
    const Place &p = outline[i], &q = outline[(i + 1) % outline.size()];
    twice -= p.x * q.y - q.x * p.y;
  }
  return twice / 2;
}

std::vector<std::vector<Point>> polygons_of(const Faces& faces) {
  std::vector<std::vector<Point>> polygons(faces.size());
  for (std::size_t f = 0; f < faces.size(); ++f)
    for (std::size_t k = faces.begin[f]; k < faces.begin[f + 1]; ++k)
      polygons[f].push_back(faces.points[static_cast<std::size_t>(faces.corner[k]) - 1]);
  return polygons;
}

/// The sum of areas. No polygon may be drawn inside out, except invisibly thin slivers at the limb.
double area_of_all(const std::vector<std::vector<Point>>& polygons, const View& view) {
  const Frame& frame = view.frame();
  double sum = 0;
  for (const auto& polygon : polygons)
    for (const Outline& outline : view.polygon(polygon)) {
      const double area = area_of(outline);
      EXPECT_GT(area, -1);
      sum += area;
      for (const Place& p : outline) {
        EXPECT_TRUE(p.x >= frame.left - 1e-6 && p.x <= frame.right + 1e-6);
        EXPECT_TRUE(p.y >= frame.top - 1e-6 && p.y <= frame.bottom + 1e-6);
      }
    }
  return sum;
}

const Frame kPaper{10, 20, 730, 1000};

Mesh mesh_of_family(const std::string& family, std::size_t n) {
  return files::triangulate(point_sets::make(family, n));
}

/// Families that cover the sphere, with nodes at the poles, on the antimeridian and on the limb, and arcs
/// through poles and along meridians.
const char* const kFamilies[] = {"random",       "fibonacci",   "latlon",
                                 "cubed-sphere", "icosahedral", "variable:10"};

TEST(lonlat, faces_cover_the_map_or_a_part_of_it_once) {
  using Window = std::pair<Spot, double>;
  for (const char* family : kFamilies)
    for (const std::size_t n : {20, 800}) {
      const Mesh mesh = mesh_of_family(family, n);
      for (const auto& [centre, radius] :
           {Window({0, 0}, 90), Window({77.7, 0}, 90), Window({-180, 0}, 90), Window({175, 40}, 3),
            Window({-100, -85}, 20), Window({180, 90}, 60)}) {
        const LonLat map(centre, radius, kPaper);
        // Pieces are straight to 0.05 pixels on both sides alike.
        for (const Faces& faces : {files::triangle_faces(mesh), files::voronoi_faces(mesh)})
          EXPECT_NEAR(area_of_all(polygons_of(faces), map), map.frame().width() * map.frame().height(), 1e-3)
              << family << " " << n << " " << centre.lon << " " << radius;
      }
    }
}

TEST(lonlat, a_corner_at_a_pole_is_a_line_and_an_arc_over_a_pole_ends_there) {
  const LonLat map({0, 0}, 90, kPaper);
  const std::vector<Point> triangle{
      point_sets::from_degrees(10, 0), point_sets::from_degrees(50, 0), {0, 0, 1}};
  const std::vector<Outline> parts = map.polygon(triangle);
  ASSERT_EQ(parts.size(), 1u);
  EXPECT_NEAR(area_of(parts[0]) / 4, 40 * 90, 1e-6);
  const std::vector<Outline> arcs =
      map.arc(point_sets::from_degrees(20, 70), point_sets::from_degrees(-160, 80));
  ASSERT_EQ(arcs.size(), 2u);
  for (const Outline& arc : arcs) {
    const double x = arc.front().x;
    for (const Place& p : arc) EXPECT_NEAR(p.x, x, 1e-9);
    EXPECT_NEAR(std::min(arc.front().y, arc.back().y), map.frame().top, 1e-9);
  }
}

TEST(lonlat, an_arc_over_the_antimeridian_is_cut_there) {
  const LonLat map({0, 0}, 90, kPaper);
  const std::vector<Outline> parts =
      map.arc(point_sets::from_degrees(170, 10), point_sets::from_degrees(-170, 10));
  ASSERT_EQ(parts.size(), 2u);
  double length = 0;
  std::vector<double> ends;
  for (const Outline& part : parts) {
    for (const Place& p : {part.front(), part.back()})
      if (std::fabs(p.x - map.frame().left) < 1e-6 || std::fabs(p.x - map.frame().right) < 1e-6)
        ends.push_back(p.y);
    length += std::fabs(part.back().x - part.front().x);
  }
  EXPECT_NEAR(length, 2 * 20, 1e-9);
  ASSERT_EQ(ends.size(), 2u);
  EXPECT_NEAR(ends[0], ends[1], 1e-9);
}

TEST(orthographic, faces_cover_the_disc_or_a_part_of_it_once) {
  for (const char* family : kFamilies)
    for (const std::size_t n : {20, 800})
      for (const Spot eye : {Spot{0, 30}, Spot{0, 0}, Spot{45, 90}, Spot{-90, -45}}) {
        const Orthographic sphere(eye, 90, kPaper), part(eye, 30, kPaper);
        const Mesh mesh = mesh_of_family(family, n);
        for (const Faces& faces : {files::triangle_faces(mesh), files::voronoi_faces(mesh)}) {
          // Straight pieces of the limb miss at most 2/3 of 0.05 pixels along 2 pi 360 pixels.
          EXPECT_NEAR(area_of_all(polygons_of(faces), sphere) / (360 * 360), kPi, 6e-4)
              << family << " " << n << " " << eye.lon << " " << eye.lat;
          EXPECT_NEAR(area_of_all(polygons_of(faces), part), 720 * 720, 1e-3);
        }
      }
}

TEST(orthographic, arcs_end_at_the_limb_and_hidden_ones_are_not_drawn) {
  const Orthographic sphere({0, 0}, 90, kPaper);
  const auto distance = [&](const Place& p) {
    return std::hypot(p.x - sphere.middle().x, p.y - sphere.middle().y) / sphere.scale();
  };
  const std::vector<Outline> cut =
      sphere.arc(point_sets::from_degrees(70, 20), point_sets::from_degrees(120, 40));
  ASSERT_EQ(cut.size(), 1u);
  EXPECT_NEAR(distance(cut[0].back()), 1, 1e-12);
  EXPECT_LT(distance(cut[0].front()), 0.99);
  EXPECT_TRUE(sphere.arc(point_sets::from_degrees(100, 0), point_sets::from_degrees(150, 0)).empty());
  EXPECT_FALSE(sphere.place(point_sets::from_degrees(91, 0)));
  EXPECT_TRUE(sphere.place(point_sets::from_degrees(89, 0)));
  EXPECT_LT(sphere.place(point_sets::from_degrees(0, 10))->y, sphere.middle().y);  // north is up
  EXPECT_GT(sphere.place(point_sets::from_degrees(10, 0))->x, sphere.middle().x);  // east is right
}

TEST(views, pieces_of_an_arc_look_straight) {
  const Point a = point_sets::from_degrees(-60, 40), b = point_sets::from_degrees(50, 55);
  const LonLat map({0, 0}, 90, kPaper);
  const Orthographic sphere({0, 30}, 90, kPaper);
  for (const View* view : {static_cast<const View*>(&map), static_cast<const View*>(&sphere)}) {
    const std::vector<Outline> line = view->arc(a, b);
    ASSERT_EQ(line.size(), 1u);
    for (double t = 0; t <= 1; t += 0.001) {
      const Point p =
          point_sets::normalized({(1 - t) * a.x + t * b.x, (1 - t) * a.y + t * b.y, (1 - t) * a.z + t * b.z});
      const Place on = *view->place(p);
      double nearest = 1e9;
      for (std::size_t i = 0; i + 1 < line[0].size(); ++i) {
        const Place &u = line[0][i], &v = line[0][i + 1];
        const double dx = v.x - u.x, dy = v.y - u.y;
        const double s = std::clamp(((on.x - u.x) * dx + (on.y - u.y) * dy) / (dx * dx + dy * dy), 0.0, 1.0);
        nearest = std::min(nearest, std::hypot(u.x + s * dx - on.x, u.y + s * dy - on.y));
      }
      EXPECT_LT(nearest, 0.1);
    }
  }
}

TEST(views, name_longitudes_and_latitudes) {
  EXPECT_EQ(name_of_longitude(-12.5), "12.5°W");
  EXPECT_EQ(name_of_longitude(190), "170°W");
  EXPECT_EQ(name_of_longitude(540), "180°");
  EXPECT_EQ(name_of_latitude(-0.25), "0.25°S");
}

// ---- scales, colours ----

TEST(scale, has_round_ticks_in_its_range_that_are_labelled_with_their_values) {
  const std::vector<std::vector<double>> all{{0.123, 0.127}, {3e-7, 5e-7}, {1, 19}, {2e-5, 9e-4}, {1e-9, 3},
                                             {7, 7},         {0, 0},       {-3, 5}, {1e8, 3e8}};
  for (const auto& values : all) {
    const Scale scale(values, 5);
    const auto ticks = scale.ticks();
    EXPECT_GE(ticks.size(), 2u) << values[0];
    EXPECT_LE(ticks.size(), 11u) << values[0];
    // The ends of the range are ticks, beyond which no value lies.
    const double step = ticks.size() == 2 ? 1 : 1e-6;
    EXPECT_EQ(scale(ticks.front().value), 0) << values[0];
    EXPECT_EQ(scale(ticks.back().value), 1) << values[0];
    EXPECT_LE(ticks.front().value, values.front() + step * std::fabs(values.front()));
    EXPECT_GE(ticks.back().value, values.back() - step * std::fabs(values.back()));
    // No more than one step beyond the values.
    if (values.front() < values.back() && ticks.size() > 2) {
      EXPECT_GT(ticks[1].value, values.front()) << values[0];
      EXPECT_LT(ticks[ticks.size() - 2].value, values.back()) << values[0];
    }
    for (std::size_t i = 1; i < ticks.size(); ++i) {
      EXPECT_LT(ticks[i - 1].value, ticks[i].value);
      EXPECT_NE(ticks[i - 1].label, ticks[i].label);
    }
  }
  const Scale small({2e-5, 4e-5}, 2);
  EXPECT_EQ(small.name_of_factor(), "10⁻⁵ ");
  EXPECT_DOUBLE_EQ(small.factor(), 1e-5);
  EXPECT_EQ(small.ticks()[0].label, "2");
  EXPECT_NEAR(small.ticks()[0].value, 2e-5, 1e-18);
  EXPECT_EQ(Scale({1e-9, 3}, 4).ticks().front().label, "10⁻⁹");
  EXPECT_EQ(grouped(1234567), "1,234,567");
  EXPECT_EQ(grouped(999), "999");
}

TEST(scale, has_fewer_ticks_where_labels_are_wide) {
  const std::vector<double> wide{1.6e9, 1.6e9 + 300};
  const Scale fitting = Scale::fitting(wide, false, 6, 200, 12);
  EXPECT_LT(fitting.ticks().size(), Scale(wide, 6).ticks().size());
  EXPECT_TRUE(std::isfinite(Scale({-1.7e308, 1.7e308}, 6).ticks()[1].value));  // the difference overflows
}

TEST(scale, between_given_ends_has_round_ticks_that_need_not_be_the_ends) {
  const Scale scale = Scale::fitting({273, 310}, true, 6, 400, 12);
  EXPECT_EQ(scale(273), 0);
  EXPECT_EQ(scale(310), 1);
  EXPECT_EQ(scale(250), 0);
  EXPECT_EQ(scale(320), 1);
  EXPECT_EQ(scale.ticks().front().value, 275);
  EXPECT_EQ(scale.ticks().back().value, 310);
  const Scale decades = Scale::fitting({2, 700}, true, 6, 400, 12);
  EXPECT_NEAR(decades(std::sqrt(2.0 * 700)), 0.5, 1e-15);
  EXPECT_EQ(decades(-1), 0);
  EXPECT_EQ(decades.ticks().front().value, 10);
}

TEST(colours, of_neighbours_differ) {
  // A wheel: eight in a ring, each beside the two next to it and the hub.
  std::vector<std::set<std::size_t>> beside(9);
  for (std::size_t i = 0; i < 8; ++i) {
    beside[i] = {(i + 1) % 8, (i + 7) % 8, 8};
    beside[8].insert(i);
  }
  const std::vector<std::string> colours = distinct_colours(beside);
  for (std::size_t i = 0; i < beside.size(); ++i)
    for (const std::size_t other : beside[i]) EXPECT_NE(colours[i], colours[other]);
  EXPECT_EQ(viridis(0), "#440154");
  EXPECT_EQ(viridis(1), "#fde725");
}

// ---- whole pictures ----

boost::property_tree::ptree parsed(const std::string& svg) {
  std::istringstream in(svg);
  boost::property_tree::ptree tree;
  boost::property_tree::read_xml(in, tree);  // throws unless well-formed
  return tree;
}

std::size_t count(const std::string& text, const std::string& what) {
  std::size_t found = 0;
  for (std::size_t at = text.find(what); at != text.npos; at = text.find(what, at + 1)) ++found;
  return found;
}

TEST(mesh_picture, of_every_kind_is_well_formed_and_without_nan) {
  using Colour = MeshOptions::Colour;
  using What = MeshOptions::What;
  for (const char* family : {"latlon", "hemisphere-rim", "cap", "ring"})
    for (const auto& [what, colour] : {std::pair(What::triangles, Colour::none),
                                       {What::triangles, Colour::size},
                                       {What::triangles, Colour::owner},
                                       {What::cells, Colour::none},
                                       {What::cells, Colour::size},
                                       {What::cells, Colour::degree},
                                       {What::cells, Colour::owner}})
      for (const bool lonlat : {false, true})
        for (const std::size_t n : {5, 100}) {
          MeshOptions options;
          options.what = what;
          options.colour = colour;
          options.ranks = 3;
          options.lonlat = lonlat;
          options.title = "a < b & \"c\"";
          const std::string svg = mesh_picture(mesh_of_family(family, n), options);
          parsed(svg);
          EXPECT_EQ(count(svg, "nan") + count(svg, "inf"), 0u) << family << n;
          EXPECT_EQ(count(svg, "a &lt; b &amp; &quot;c&quot;"), 1u);
          EXPECT_EQ(count(svg, "boundary nodes"), family[0] == 'l' ? 0u : 1u) << family << n;
        }
}

TEST(mesh_picture, counts_neighbours_and_nodes_of_ranks_in_its_legend) {
  const Mesh mesh = mesh_of_family("icosahedral", 162);  // twelve nodes have five neighbours, the others six
  MeshOptions options;
  options.what = MeshOptions::What::cells;
  options.colour = MeshOptions::Colour::degree;
  const std::string by_degree = mesh_picture(mesh, options);
  EXPECT_EQ(count(by_degree, ">5 (12)<"), 1u);
  EXPECT_EQ(count(by_degree, ">6 (150)<"), 1u);
  options.colour = MeshOptions::Colour::owner;
  options.ranks = 1;
  EXPECT_EQ(count(mesh_picture(mesh, options), "162 to 162 nodes each"), 1u);
  options.ranks = 2;
  options.partition = pstripack::PartitionKind::stripes;
  EXPECT_EQ(count(mesh_picture(mesh, options), "stripes: which of 2 ranks owns a node"), 1u);
}

/// The colours of the faces, and how many paths are drawn in each.
std::vector<std::string> fills(const std::string& svg) {
  std::vector<std::string> found;
  const std::string begin = "<path fill=\"#";
  for (std::size_t at = svg.find(begin); at != svg.npos; at = svg.find(begin, at + 1))
    found.push_back(svg.substr(at + begin.size() - 1, 7));
  return found;
}

TEST(mesh_picture, has_the_colours_of_a_column) {
  Mesh mesh = mesh_of_family("icosahedral", 162);
  files::Column depth{"depth", "depth of the sea", "km"}, kind{"kind"};
  for (std::size_t i = 0; i < mesh.points.size(); ++i) {
    depth.numbers.push_back(i < 12 ? NAN : i < 80 ? 10 : 20);
    kind.texts.push_back(i < 12 ? "" : i < 80 ? "a" : "b");
  }
  mesh.columns = {depth, kind};
  MeshOptions options;
  options.what = MeshOptions::What::cells;
  options.colour = MeshOptions::Colour::value;
  options.value = "depth";
  const std::string numbers = mesh_picture(mesh, options);
  EXPECT_EQ(count(numbers, ">depth of the sea, km<"), 1u);
  EXPECT_EQ(count(numbers, "boundary"), 0u);
  EXPECT_EQ(count(numbers, ">no value: 12 cells<"), 1u);
  EXPECT_EQ(fills(numbers), (std::vector<std::string>{viridis(0), viridis(1), "#e6e6e6"}));
  options.range = {12, 20};
  EXPECT_EQ(fills(mesh_picture(mesh, options)), fills(numbers));
  options.value = "kind";
  EXPECT_THROW(mesh_picture(mesh, options), std::runtime_error);
  options.range.reset();
  const std::string words = mesh_picture(mesh, options);
  for (const char* label : {">a (68)<", ">b (82)<", ">no value (12)<"}) EXPECT_EQ(count(words, label), 1u);
  options.what = MeshOptions::What::triangles;
  EXPECT_THROW(mesh_picture(mesh, options), std::runtime_error);
  // A triangle has the mean of its corners: 10, 20 or two in between.
  mesh.columns[0].numbers.assign(162, 10);
  for (std::size_t i = 80; i < 162; ++i) mesh.columns[0].numbers[i] = 20;
  options.value = "depth";
  EXPECT_EQ(fills(mesh_picture(mesh, options)).size(), 4u);
  options.value = "none";
  EXPECT_THROW(mesh_picture(mesh, options), std::runtime_error);
}

TEST(mesh_picture, has_areas_in_km2_and_when_zoomed_a_scale_and_coordinates) {
  const Mesh mesh = mesh_of_family("icosahedral", 642);
  MeshOptions options;
  options.what = MeshOptions::What::cells;
  options.colour = MeshOptions::Colour::size;
  const std::string whole = mesh_picture(mesh, options);
  EXPECT_EQ(count(whole, ">area of a cell, 10⁵ km²<"), 1u);  // 5.1e8 km2 in 642 parts
  EXPECT_EQ(count(whole, " in the middle<"), 0u);
  options.centre = Spot{10, 50};
  options.radius = 20;
  const std::string part = mesh_picture(mesh, options);
  // 40 degrees are 680 pixels: 1,000 km, 9 degrees, fit into a quarter, 2,000 km do not.
  EXPECT_EQ(count(part, ">1,000 km in the middle<"), 1u);
  for (const char* label : {">0°<", ">15°E<", ">40°N<", ">50°N<", ">60°N<"})
    EXPECT_EQ(count(part, label), 1u) << label;
  options.radius = 0.0002;
  const std::string tiny = mesh_picture(mesh, options);
  EXPECT_EQ(count(tiny, ">10 m in the middle<"), 1u);
  EXPECT_EQ(count(tiny, ">50.0001°N<"), 1u);
  options.radius = 20;
  options.lonlat = true;
  EXPECT_EQ(count(mesh_picture(mesh, options), ">1,000 km at 50°N<"), 1u);
}

TEST(mesh_picture, narrow_has_texts_as_large_as_a_wide_one_and_a_long_title_fits) {
  MeshOptions options;
  for (const double width : {330.0, 800.0, 1600.0}) {
    options.width = width;
    options.title = "title";
    const auto tree = parsed(mesh_picture(mesh_of_family("icosahedral", 42), options));
    EXPECT_EQ(tree.get<double>("svg.<xmlattr>.width"), width);
    EXPECT_EQ(tree.get<std::string>("svg.<xmlattr>.viewBox").substr(0, 8),
              width < 800 ? "0 0 330 " : "0 0 800 ");
    EXPECT_EQ(tree.get<double>("svg.text.<xmlattr>.font-size"), 18);
  }
  options.title = std::string(200, 'm');
  const auto tree = parsed(mesh_picture(mesh_of_family("icosahedral", 42), options));
  EXPECT_LE(text_width(options.title, tree.get<double>("svg.text.<xmlattr>.font-size")), 800);
}

TEST(mesh_picture, of_a_region_shows_it_and_its_nodes_as_dots) {
  const Mesh mesh = mesh_of_family("icosahedral", 642);
  MeshOptions options;
  options.lonlat = true;
  options.region = files::Region{170, 190, -30, -10};
  const std::string without = mesh_picture(mesh, options);
  for (const char* label : {">170°E<", ">180°<", ">170°W<", ">10°S<", ">30°S<"})
    EXPECT_EQ(count(without, label), 1u) << label;
  options.dots = true;
  const auto in_region = std::count_if(mesh.points.begin(), mesh.points.end(), [](const Point& p) {
    return std::fabs(files::longitude(p)) >= 170 && files::latitude(p) > -30 && files::latitude(p) < -10;
  });
  EXPECT_EQ(count(mesh_picture(mesh, options), "h0") - count(without, "h0"),
            2 * static_cast<std::size_t>(in_region));
}

TEST(mesh_picture, of_too_many_nodes_in_view_says_how_to_zoom) {
  const Mesh mesh = mesh_of_family("fibonacci", 2 * kMostNodesInView + 2000);
  MeshOptions options;
  EXPECT_EQ(count(error_of([&] { mesh_picture(mesh, options); }), "--view orthographic:0,30 --zoom 72"), 1u);
  options.radius = 2;
  EXPECT_NO_THROW(parsed(mesh_picture(mesh, options)));
}

// ---- coasts ----

TEST(coasts, of_natural_earth_are_as_fine_as_needed_or_there_is_a_remedy) {
  const std::filesystem::path folder = testing::TempDir() + "natural_earth";
  std::filesystem::remove_all(folder);
  EXPECT_EQ(count(error_of([&] { natural_earth(90, folder); }),
                  "install them (Debian: libmagics++-data), or name a shapefile by --coast-file"),
            1u);
  for (const char* scale : {"110m", "10m"}) {
    std::filesystem::create_directories(folder / scale);
    std::ofstream(folder / scale / ("ne_" + std::string(scale) + "_land.shp"));
  }
  EXPECT_EQ(natural_earth(1, folder), folder / "10m/ne_10m_land.shp");
  EXPECT_EQ(natural_earth(20, folder), folder / "110m/ne_110m_land.shp");  // 50m is missing
}

// ---- files ----

TEST(xml, is_escaped_and_holds_no_byte_that_xml_forbids) {
  const char* const odd = "a<b>&\"c'd\" \x01\xff\xc3\xa9,.txt";  // one control byte, one that is not UTF-8
  EXPECT_EQ(escaped_for_xml(odd), "a&lt;b&gt;&amp;&quot;c'd&quot; ?\xef\xbf\xbd\xc3\xa9,.txt");
  EXPECT_EQ(escaped_for_xml("two\nlines\t"), "two\nlines\t");
}

TEST(path, is_exact_to_hundredths) {
  Path path;
  path.move({12.347, -7});
  path.line({12.349, -7});  // shorter than a hundredth of a pixel
  path.line({13.5, -7.104});
  path.close();
  path.dot({1, 2});
  EXPECT_EQ(path.data(), "M12.35 -7l1.15 -0.1ZM1 2h0");
}

}  // namespace
}  // namespace pictures
