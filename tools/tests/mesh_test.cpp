#include "files/mesh.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "point_sets.h"

namespace files {
namespace {

using Points = std::vector<Point>;

bool same_lists(const Mesh& a, const Mesh& b) {
  const auto used = [](const Mesh& m, const std::vector<std::int32_t>& v) {
    return std::vector<std::int32_t>(v.begin(), v.begin() + m.lnew - 1);
  };
  return a.lnew == b.lnew && a.lend == b.lend && used(a, a.list) == used(b, b.list) &&
         used(a, a.lptr) == used(b, b.lptr);
}

TEST(mesh, of_its_own_triangles_has_the_same_lists) {
  for (const char* const family : {"random", "hemisphere", "icosahedral", "cap", "ring"}) {
    const Mesh mesh = triangulate(point_sets::make(family, 500));
    EXPECT_TRUE(same_lists(mesh, mesh_of(mesh.points, pstripack::triangles_of(mesh.lists())))) << family;
  }
}

TEST(mesh, does_not_need_its_first_three_nodes_off_one_great_circle) {
  Points points{{1, 0, 0}, {0, 1, 0}, {-1, 0, 0}};
  for (const Point& p : point_sets::make("random", 200)) points.push_back(p);
  const Mesh mesh = triangulate(points);
  EXPECT_TRUE(pstripack::is_valid(points.data(), mesh.lists()));
  EXPECT_TRUE(pstripack::lists_are_canonical(mesh.lists()));
}

TEST(duplicates, are_all_nodes_but_the_first_in_each_place) {
  Points points = point_sets::make("random", 100);
  points[50] = points[90] = points[7] = points[60];
  points[3] = points[2];
  std::vector<std::pair<std::size_t, std::size_t>> found;
  for (const Duplicate& d : duplicates(points)) found.emplace_back(d.node, d.first);
  EXPECT_EQ(found, (std::vector<std::pair<std::size_t, std::size_t>>{{3, 2}, {50, 7}, {60, 7}, {90, 7}}));
  EXPECT_TRUE(duplicates(point_sets::make("random", 100)).empty());
}

TEST(mesh_of_triangles, is_refused_where_they_are_none) {
  const Points points{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {-1, -1, -1}};
  EXPECT_THROW(mesh_of(points, {{0, 1, 2}}), NoMesh);  // a node without triangle
  EXPECT_THROW(mesh_of(points, {{0, 1, 2}, {0, 1, 3}, {0, 3, 2}}),
               NoMesh);  // an arc with two triangles on one side
  EXPECT_NO_THROW(mesh_of(points, {{0, 1, 2}, {0, 3, 1}, {0, 2, 3}, {1, 3, 2}}));
}

TEST(areas, are_those_of_the_sphere_and_columns_go_with_nodes_and_faces) {
  EXPECT_NEAR(triangle_area({1, 0, 0}, {1, 1e-9, 0}, {1, 0, 1e-9}) / 5e-19, 1, 1e-6);
  const Points points = point_sets::make("random", 300);
  Mesh mesh = triangulate(points);
  mesh.given = LonLat(points, true);
  mesh.columns = {whole_numbers("degree", "of education", std::vector<double>(300, 1))};
  for (const bool cells : {false, true}) {
    Faces faces = cells ? voronoi_faces(mesh) : triangle_faces(mesh);
    const std::vector<double> all = areas(faces);
    EXPECT_NEAR(std::accumulate(all.begin(), all.end(), 0.0), 4 * std::acos(-1), 1e-11);
    EXPECT_GT(*std::min_element(all.begin(), all.end()), 0);
    add_columns(faces, mesh);
    const Columns& of_nodes = cells ? faces.columns_of_faces : faces.columns_of_points;
    ASSERT_NE(find(of_nodes, "degree_given"), nullptr);
    EXPECT_EQ(find(of_nodes, "degree_given")->long_name, "of education");
    const std::vector<double>& degrees = find(of_nodes, "degree")->numbers;
    EXPECT_EQ(std::accumulate(degrees.begin(), degrees.end(), 0.0), 2.0 * (3 * 300 - 6));
    if (cells) {
      EXPECT_EQ(degrees[7], static_cast<double>(faces.corners(7)));
    }
    EXPECT_NEAR(find(faces.columns_of_faces, "area_km2")->numbers[5], all[5] * 6371 * 6371, 1e-6);
    EXPECT_EQ((cells ? faces.given_centres : faces.given_points).lon, mesh.given.lon);
    if (!cells) {
      const Point centre = circumcentres(points, faces.corner)[5];
      const Point& corner = points[static_cast<std::size_t>(faces.corner[15]) - 1];
      EXPECT_NEAR(find(faces.columns_of_faces, "circumradius_km")->numbers[5],
                  angle_between(centre, corner) * 6371, 1e-11);
    } else {
      const LonLat centroid({centroids(faces)[5]}, true);
      EXPECT_EQ(find(faces.columns_of_faces, "centroid_lon")->numbers[5], centroid.lon[0]);
      EXPECT_EQ(find(faces.columns_of_faces, "centroid_lat")->numbers[5], centroid.lat[0]);
    }
    mesh.columns = of_nodes;  // as read back from a file: a column of ours is not kept twice
    add_columns(faces, mesh);
    EXPECT_EQ(
        std::count_if(of_nodes.begin(), of_nodes.end(), [](const Column& c) { return c.name == "degree"; }),
        1);
    mesh.columns = {whole_numbers("degree", "of education", std::vector<double>(300, 1))};
  }
}

Faces polygon(std::vector<Point> corners) {
  Faces faces;
  faces.begin = {0, corners.size()};
  for (std::size_t k = 1; k <= corners.size(); ++k) faces.corner.push_back(static_cast<std::int32_t>(k));
  faces.points = std::move(corners);
  return faces;
}

TEST(centroids, of_large_thin_and_tiny_polygons) {
  const auto distance = [](const Point& p, const Point& q) { return length(minus(p, q)); };
  const double third = std::sqrt(1.0 / 3);
  EXPECT_LT(distance(centroids(polygon({{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}))[0], {third, third, third}), 1e-15);
  EXPECT_LT(distance(centroids(polygon({{1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}}))[0], {0, 0, 1}),
            1e-15);
  // A lune, whose corners are opposite each other: its centroid is in its middle.
  const Point low{0, 0, -1}, high{0, 0, 1}, east{0, 1, 0}, west{1, 0, 0};
  EXPECT_LT(distance(centroids(polygon({low, east, high, west}))[0], unit(Point{1, 1, 0})), 1e-15);
  // 1000 times as long as wide, and so small that it is plane.
  constexpr double kSize = 0x1p-40;
  const Faces tiny = polygon({{1, 0, 0}, {1, 3 * kSize, 0}, {1, 0, 3e-3 * kSize}});
  EXPECT_LT(distance(centroids(tiny)[0], {1, kSize, 1e-3 * kSize}), 1e-12 * kSize);
  EXPECT_EQ(centroids(polygon({west, west, west}))[0], west);
}

// Its sides are half turns, of which the ends do not tell the planes.
TEST(centroids, of_the_cells_of_three_nodes) {
  const std::vector<Point> nodes{{-2.7930614170300177e-05, 0.0013995585012127033, 1},
                                 {-0.0002689079324440259, 0.0031121462148417313, 1},
                                 {0.006287430128574454, -0.007060629239114831, 1}};
  const Mesh mesh = triangulate(nodes);
  const auto centres = centroids(voronoi_faces(mesh));
  for (std::size_t k = 0; k < 3; ++k) {
    const Point sum = minus(unit(minus(unit(nodes[k]), unit(nodes[(k + 1) % 3]))),
                            unit(minus(unit(nodes[(k + 2) % 3]), unit(nodes[k]))));
    EXPECT_LT(length(minus(centres[k], unit(sum))), 1e-12);
  }
  EXPECT_NEAR(longitude(centres[1]), 110.405452, 1e-6);
}

TEST(voronoi_faces, have_corners_as_far_from_their_node_as_from_the_neighbours) {
  const Mesh mesh = triangulate(point_sets::make("random", 300));
  const Faces cells = voronoi_faces(mesh);
  ASSERT_EQ(cells.size(), mesh.points.size());
  std::vector<double> nearest(cells.points.size(), -1);
  for (std::size_t c = 0; c < cells.points.size(); ++c)
    for (const Point& node : mesh.points) nearest[c] = std::max(nearest[c], dot(node, cells.points[c]));
  for (std::size_t f = 0; f < cells.size(); ++f)
    for (std::size_t k = cells.begin[f]; k < cells.begin[f + 1]; ++k) {
      const auto corner = static_cast<std::size_t>(cells.corner[k]) - 1;
      EXPECT_NEAR(dot(mesh.points[f], cells.points[corner]), nearest[corner], 1e-12);
    }
}

TEST(voronoi_faces, close_the_sphere_where_the_nodes_lie_in_a_hemisphere) {
  const Faces cells = voronoi_faces(triangulate(point_sets::make("hemisphere", 200)));
  EXPECT_EQ(cells.size(), 200u);
  EXPECT_EQ(cells.points.size(), 396u);
  for (const std::int32_t corner : cells.corner) EXPECT_TRUE(corner >= 1 && corner <= 396);
}

}  // namespace
}  // namespace files
