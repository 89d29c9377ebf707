#include "files/mpas_mesh.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

#include "base/parallel_for.h"
#include "files/limited_area.h"
#include "files/measures.h"

namespace files {
namespace {

using Index = std::int32_t;
using Two = MpasMesh::Two;
using Three = MpasMesh::Three;
constexpr Index kNone = MpasMesh::kNone;

std::size_t at(Index i) { return static_cast<std::size_t>(i); }

template <class Body>
void for_each(std::size_t n, const Body& body) {
  pstripack::parallel_for(n, 10 * n, body);
}

/// The place of the cell among those of the vertex.
std::size_t place_of(Index cell, const Three& around) {
  return around[0] == cell ? 0 : around[1] == cell ? 1 : 2;
}

Point normalised(const Point& p) {
  const double scale = 1 / std::sqrt(dot(p, p));
  return {scale * p.x, scale * p.y, scale * p.z};
}

// ---- cells ------------------------------------------------------------------------------------------------

/// A vertex of a cell c, between two neighbours of c: its cells are c, `from`, `to`. The edge to the next
/// vertex of c lies between c and `to`, so the next vertex is the one with `from` = our `to`.
struct Corner {
  Index from, to, vertex;
};

/// The angle from v to w at c, counterclockwise, 0 to 2 pi.
double turn(const Point& c, const Point& v, const Point& w) {
  const Point a = minus(v, c), b = minus(w, c);
  const double angle = std::atan2(dot(c, cross(a, b)), dot(a, b) - dot(a, c) * dot(b, c));
  return angle > 0 ? angle : angle + 6.2831853071795865;
}

/// Puts the vertices of a cell in order, counterclockwise from the first.
void order_ring(const MpasMesh& mesh, Index cell, std::vector<Corner>& corners, Index* ring) {
  const auto fail = [&] { throw NoMesh(fmt::format("cell {}: its vertices are not one cycle", cell + 1)); };
  std::sort(corners.begin(), corners.end(), [](const Corner& a, const Corner& b) {
    return std::pair(a.from, a.vertex) < std::pair(b.from, b.vertex);
  });
  const auto first = std::find_if(corners.begin(), corners.end(),
                                  [&](const Corner& corner) { return corner.vertex == ring[0]; });
  auto now = first;
  for (std::size_t k = 0; k < corners.size(); ++k) {
    ring[k] = now->vertex;
    auto next = std::lower_bound(corners.begin(), corners.end(), now->to,
                                 [](const Corner& corner, Index from) { return corner.from < from; });
    if (next == corners.end() || next->from != now->to) fail();
    if (now->to == kNone) {  // the next vertex that has nothing on the same side
      double least = 7;
      for (auto other = next; other != corners.end() && other->from == kNone; ++other) {
        const double angle = other == now ? 6.5
                                          : turn(mesh.cells[at(cell)], mesh.vertices[at(now->vertex)],
                                                 mesh.vertices[at(other->vertex)]);
        if (angle < least) least = angle, next = other;
      }
    }
    now = next;
    if ((now == first) != (k + 1 == corners.size())) fail();
  }
}

/// Sets `begin` and the vertices of each cell, from the one with the smallest number.
void find_cells(MpasMesh& mesh) {
  const std::size_t n = mesh.cells.size();
  mesh.begin.assign(n + 1, 0);
  for (std::size_t v = 0; v < mesh.cells_on_vertex.size(); ++v) {
    const auto [a, b, c] = mesh.cells_on_vertex[v];
    if (a == kNone && b == kNone && c == kNone) throw NoMesh(fmt::format("vertex {}: has no cell", v + 1));
    if ((a == b && a != kNone) || (b == c && b != kNone) || (c == a && c != kNone))
      throw NoMesh(fmt::format("vertex {}: a cell is named twice", v + 1));
    for (const Index cell : {a, b, c})
      if (cell != kNone) ++mesh.begin[at(cell) + 1];
  }
  std::partial_sum(mesh.begin.begin(), mesh.begin.end(), mesh.begin.begin());
  mesh.vertices_on_cell.resize(at(mesh.begin[n]));
  {
    std::vector<Index> next(mesh.begin.begin(), mesh.begin.end() - 1);
    for (std::size_t v = 0; v < mesh.cells_on_vertex.size(); ++v)
      for (const Index cell : mesh.cells_on_vertex[v])
        if (cell != kNone) mesh.vertices_on_cell[at(next[at(cell)]++)] = static_cast<Index>(v);
  }
  std::vector<Corner> corners;
  for (std::size_t c = 0; c < n; ++c) {
    Index* const ring = mesh.vertices_on_cell.data() + mesh.begin[c];
    if (mesh.sides(c) == 0) throw NoMesh(fmt::format("cell {}: has no vertex", c + 1));
    corners.clear();
    for (std::size_t k = 0; k < mesh.sides(c); ++k) {
      const Three& around = mesh.cells_on_vertex[at(ring[k])];
      const std::size_t place = place_of(static_cast<Index>(c), around);
      corners.push_back({around[(place + 1) % 3], around[(place + 2) % 3], ring[k]});
    }
    order_ring(mesh, static_cast<Index>(c), corners, ring);
  }
}

// ---- edges ------------------------------------------------------------------------------------------------

/// Jenkins' one-at-a-time hash of the two vertices, the smaller first, as 16 bytes.
std::uint32_t hash_of(const Two& vertices) {
  const auto [less, more] = std::minmax(vertices[0], vertices[1]);
  const std::uint64_t key[] = {static_cast<std::uint64_t>(less), static_cast<std::uint64_t>(more)};
  std::uint32_t hash = 0;
  for (const std::uint64_t number : key)
    for (int byte = 0; byte < 8; ++byte) {
      hash += static_cast<std::uint32_t>(number >> (8 * byte) & 255);
      hash += hash << 10;
      hash ^= hash >> 6;
    }
  hash += hash << 3;
  hash ^= hash >> 11;
  return hash + (hash << 15);
}

/// The order in which MPAS' converter numbers edges that it finds in the order 0, 1, ...: that of its hash
/// table, a std::unordered_set of libstdc++. Files of the converter and ours agree edge for edge.
///
/// The table is one list. A new entry goes to the front of its bucket's entries; if it is the first of its
/// bucket, to the front of the list. So the buckets follow each other from the one that got its first entry
/// last to the one that got it first, and in each the entries from the newest to the oldest. When there are
/// as many entries as buckets, all are put one after another, in the order of the list, into a larger table.
std::vector<Index> order_of_converter(const std::vector<std::uint32_t>& hash) {
  constexpr std::uint32_t kBuckets[] = {
      13,      29,       59,       127,      257,       541,       1109,      2357,      5087,
      10273,   20753,    42043,    85229,    172933,    351061,    712697,    1447153,   2938679,
      5967347, 12117689, 24607243, 49969847, 101473717, 206062531, 418451333, 849749479, 1725587117};
  const std::size_t n = hash.size();
  std::vector<Index> list, sequence(n), first, before;
  std::iota(sequence.begin(), sequence.end(), 0);
  for (const std::uint32_t buckets : kBuckets) {
    const std::size_t entries = std::min<std::size_t>(n, buckets);
    std::copy(list.begin(), list.end(), sequence.begin());
    // first[b]: when bucket b got its first entry. before[t]: entries in buckets that got theirs after t.
    first.assign(buckets, kNone);
    before.assign(entries, 0);
    for (std::size_t t = 0; t < entries; ++t) {
      Index& begun = first[hash[at(sequence[t])] % buckets];
      if (begun == kNone) begun = static_cast<Index>(t);
      ++before[at(begun)];
    }
    Index all = 0;
    for (std::size_t t = entries; t-- > 0;) all += std::exchange(before[t], all);
    list.resize(entries);
    for (std::size_t t = entries; t-- > 0;)
      list[at(before[at(first[hash[at(sequence[t])] % buckets])]++)] = sequence[t];
    if (entries == n) break;
  }
  return list;
}

/// Sets the cells and vertices of all edges. They are found cell by cell, each at its first cell.
void find_edges(MpasMesh& mesh) {
  std::vector<Two> cells, vertices;
  for (std::size_t c = 0; c < mesh.cells.size(); ++c) {
    const Index* const ring = mesh.vertices_on_cell.data() + mesh.begin[c];
    for (std::size_t k = 0; k < mesh.sides(c); ++k) {
      const Three& around = mesh.cells_on_vertex[at(ring[k])];
      const auto cell = static_cast<Index>(c), other = around[(place_of(cell, around) + 2) % 3];
      if (other != kNone && other < cell) continue;
      cells.push_back({cell, other});
      vertices.push_back({ring[k], ring[k + 1 < mesh.sides(c) ? k + 1 : 0]});
    }
  }
  std::vector<std::uint32_t> hash(cells.size());
  for_each(hash.size(), [&](std::size_t i) { hash[i] = hash_of(vertices[i]); });
  const std::vector<Index> order = order_of_converter(hash);
  hash = {};
  mesh.cells_on_edge.resize(cells.size());
  mesh.vertices_on_edge.resize(cells.size());
  for_each(order.size(), [&](std::size_t e) {
    mesh.cells_on_edge[e] = cells[at(order[e])];
    mesh.vertices_on_edge[e] = vertices[at(order[e])];
  });
}

/// Sets the edges of vertices and cells; all then begin with the smallest edge.
void attach_edges(MpasMesh& mesh) {
  const std::size_t n = mesh.cells.size();
  mesh.edges_on_vertex.assign(mesh.vertices.size(), {kNone, kNone, kNone});
  for_each(mesh.cells_on_edge.size(), [&](std::size_t e) {
    const Index cell = mesh.cells_on_edge[e][0];
    const std::size_t v = at(mesh.vertices_on_edge[e][0]), w = at(mesh.vertices_on_edge[e][1]);
    mesh.edges_on_vertex[v][place_of(cell, mesh.cells_on_vertex[v])] = static_cast<Index>(e);
    mesh.edges_on_vertex[w][(place_of(cell, mesh.cells_on_vertex[w]) + 1) % 3] = static_cast<Index>(e);
  });
  mesh.edges_on_cell.resize(mesh.vertices_on_cell.size());
  for_each(n, [&](std::size_t c) {
    Index *const vertices = mesh.vertices_on_cell.data() + mesh.begin[c], *const edges =
                                                                              mesh.edges_on_cell.data() +
                                                                              mesh.begin[c];
    const std::size_t sides = mesh.sides(c);
    for (std::size_t k = 0; k < sides; ++k) {
      const std::size_t v = at(vertices[k]);
      edges[k] = mesh.edges_on_vertex[v][place_of(static_cast<Index>(c), mesh.cells_on_vertex[v])];
    }
    const auto first = std::min_element(edges, edges + sides) - edges;
    std::rotate(edges, edges + first, edges + sides);
    std::rotate(vertices, vertices + (first + 1) % static_cast<std::ptrdiff_t>(sides), vertices + sides);
  });
  for_each(mesh.vertices.size(), [&](std::size_t v) {
    Three &cells = mesh.cells_on_vertex[v], &edges = mesh.edges_on_vertex[v];
    auto first = std::min_element(edges.begin(), edges.end()) - edges.begin();
    if (std::find(cells.begin(), cells.end(), kNone) != cells.end())
      for (first = 0; cells[at(static_cast<Index>(first))] == kNone ||
                      cells[at(static_cast<Index>(first) + 2) % 3] != kNone;)
        ++first;
    std::rotate(edges.begin(), edges.begin() + first, edges.end());
    std::rotate(cells.begin(), cells.begin() + first, cells.end());
  });
}

// ---- measures ---------------------------------------------------------------------------------------------

/// The angle between two unit vectors, which may be the same.
double arc(const Point& a, const Point& b) {
  return a == b ? 0 : arc_length(pstripack::direction_of(a), pstripack::direction_of(b));
}

/// Kites of a vertex share the points of its edges, and so do those of a cell: they add up to the triangle
/// and to the cell up to rounding, also where the triangle is obtuse and a kite or a part of it is negative.
std::array<double, 3> kites_of(const MpasMesh& mesh, std::size_t vertex) {
  const Point& v = mesh.vertices[vertex];
  std::array<Point, 3> point{};
  for (std::size_t j = 0; j < 3; ++j)
    if (const Index e = mesh.edges_on_vertex[vertex][j]; e != kNone) point[j] = mesh.edge_point(at(e));
  std::array<double, 3> areas{};
  for (std::size_t j = 0; j < 3; ++j)
    if (const Index cell = mesh.cells_on_vertex[vertex][j]; cell != kNone)
      areas[j] = triangle_area(v, point[j], mesh.cells[at(cell)]) +
                 triangle_area(v, mesh.cells[at(cell)], point[(j + 1) % 3]);
  return areas;
}

/// Sets areas, kites, shares, outflows, widths and distances.
void measure(MpasMesh& mesh) {
  mesh.distances.resize(mesh.cells_on_edge.size());
  mesh.widths.resize(mesh.cells_on_edge.size());
  for_each(mesh.distances.size(), [&](std::size_t e) {
    const auto [c, d] = mesh.cells_on_edge[e];
    const auto [v, w] = mesh.vertices_on_edge[e];
    const Point& cell = mesh.cells[at(c)];
    mesh.distances[e] = d == kNone ? 2 * arc(cell, mesh.edge_point(e)) : arc(cell, mesh.cells[at(d)]);
    mesh.widths[e] = arc(mesh.vertices[at(v)], mesh.vertices[at(w)]);
  });
  mesh.areas.resize(mesh.cells.size());
  mesh.outflows.resize(mesh.edges_on_cell.size());
  for_each(mesh.cells.size(), [&](std::size_t c) {
    double area = 0;
    for (std::size_t j = 0, sides = mesh.sides(c); j < sides; ++j) {
      const auto vertex = [&](std::size_t k) -> const Point& {
        return mesh.vertices[at(mesh.vertices_on_cell[mesh.row(c, k)])];
      };
      area += triangle_area(mesh.cells[c], vertex(j), vertex(j + 1));
      const std::size_t row = mesh.row(c, j + 1);  // of the edge between the two
      const std::size_t edge = at(mesh.edges_on_cell[row]);
      const bool points_outwards = mesh.cells_on_edge[edge][0] == static_cast<Index>(c);
      mesh.outflows[row] = points_outwards ? mesh.widths[edge] : -mesh.widths[edge];
    }
    mesh.areas[c] = area;
  });
  mesh.shares.resize(mesh.vertices_on_cell.size());
  mesh.kites.resize(mesh.vertices.size());
  for_each(mesh.vertices.size(), [&](std::size_t v) {
    mesh.kites[v] = kites_of(mesh, v);
    for (std::size_t j = 0; j < 3; ++j) {
      const Index cell = mesh.cells_on_vertex[v][j];
      if (cell == kNone) continue;
      // Seen from the cell, the vertex comes after edge j+1 and before edge j.
      const Index before = mesh.edges_on_vertex[v][(j + 1) % 3];
      const std::size_t row = mesh.row(at(cell), mesh.place(at(before), at(cell)));
      mesh.shares[row] = mesh.kites[v][j] / mesh.areas[at(cell)];
    }
  });
}

}  // namespace

std::size_t MpasMesh::most_sides() const {
  std::size_t most = 0;
  for (std::size_t c = 0; c < cells.size(); ++c) most = std::max(most, sides(c));
  return most;
}

Point MpasMesh::edge_point(std::size_t edge) const {
  const auto [c, d] = cells_on_edge[edge];
  const Point& a = cells[at(c)];
  if (d != kNone) {
    const Point& b = cells[at(d)];
    return normalised({a.x + b.x, a.y + b.y, a.z + b.z});
  }
  // The point of the great circle through both vertices that is nearest to the cell. If the vertices are too
  // close to tell the circle, they are that point.
  const Point &v = vertices[at(vertices_on_edge[edge][0])], &w = vertices[at(vertices_on_edge[edge][1])];
  const Point side = minus(w, v), normal = cross(v, side), to_cell = minus(a, v);
  const double square = dot(normal, normal), height = dot(normal, to_cell);
  if (!(square > 1e-16 * dot(to_cell, to_cell))) return normalised({v.x + w.x, v.y + w.y, v.z + w.z});
  const double part = height / square;
  return normalised({a.x - part * normal.x, a.y - part * normal.y, a.z - part * normal.z});
}

double MpasMesh::angle(std::size_t edge, const Point& e) const {
  const auto [c, d] = cells_on_edge[edge];
  // Both cells are equally far from e, so d - c is tangent there.
  const Point n = minus(d == kNone ? e : cells[at(d)], cells[at(c)]);
  const double across = std::hypot(e.x, e.y);  // 0: a pole, whose longitude is 0
  const Point east = across > 0 ? Point{-e.y / across, e.x / across, 0} : Point{0, 1, 0};
  return std::atan2(dot(cross(e, east), n), dot(east, n));
}

double MpasMesh::triangle_area(std::size_t vertex) const {
  const auto [a, b, c] = cells_on_vertex[vertex];
  if (c == kNone) return kites[vertex][0] + kites[vertex][1];
  return pstripack::triangle_area(pstripack::direction_of(cells[at(a)]),
                                  pstripack::direction_of(cells[at(b)]),
                                  pstripack::direction_of(cells[at(c)]));
}

pstripack::Angles MpasMesh::angles(std::size_t vertex) const {
  const auto [a, b, c] = cells_on_vertex[vertex];
  return pstripack::angles_of(pstripack::direction_of(cells[at(a)]), pstripack::direction_of(cells[at(b)]),
                              pstripack::direction_of(cells[at(c)]));
}

MpasMesh mpas_mesh(std::vector<Point> cells, std::vector<Point> vertices,
                   std::vector<Three> cells_on_vertex) {
  MpasMesh mesh;
  mesh.cells = std::move(cells);
  mesh.vertices = std::move(vertices);
  mesh.cells_on_vertex = std::move(cells_on_vertex);
  find_cells(mesh);
  find_edges(mesh);
  attach_edges(mesh);
  measure(mesh);
  return mesh;
}

MpasMesh mpas_mesh(const Mesh& mesh, std::vector<std::size_t>& kept) {
  const std::size_t n = mesh.points.size();
  std::vector<Point> cells = unit(mesh.points), vertices;
  std::vector<Three> cells_on_vertex;
  {
    const std::vector<Index> corners = triangles_of(mesh);
    vertices = circumcentres(mesh.points, corners);
    cells_on_vertex.resize(vertices.size());
    for (std::size_t k = 0; k < corners.size(); ++k) cells_on_vertex[k / 3][k % 3] = corners[k] - 1;
  }
  kept.clear();
  const std::vector<std::int32_t>& layers = mesh.layers;
  if (!mesh.has_boundary() && std::find(layers.begin(), layers.end(), kLeftOut) == layers.end())
    return mpas_mesh(std::move(cells), std::move(vertices), std::move(cells_on_vertex));

  // The last neighbour of a node at the boundary is negative.
  std::vector<Index> cell_of(n, kNone);
  for (std::size_t node = 0; node < n; ++node)
    if (mesh.list[at(mesh.lend[node]) - 1] > 0 && (layers.empty() || layers[node] != kLeftOut)) {
      cell_of[node] = static_cast<Index>(kept.size());
      kept.push_back(node);
    }
  if (kept.empty())
    throw NoMesh("all nodes lie at the boundary of the mesh: none has a whole cell, which MPAS needs");
  std::size_t count = 0;
  for (std::size_t v = 0; v < vertices.size(); ++v) {
    Three around = cells_on_vertex[v];
    for (Index& cell : around) cell = cell_of[at(cell)];
    if (around == Three{kNone, kNone, kNone}) continue;
    cells_on_vertex[count] = around;
    vertices[count++] = vertices[v];
  }
  cells_on_vertex.resize(count);
  vertices.resize(count);
  return mpas_mesh(values_at(cells, kept), std::move(vertices), std::move(cells_on_vertex));
}

}  // namespace files
