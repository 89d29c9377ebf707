#include "triangulation.h"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <limits>
#include <new>
#include <numeric>
#include <sstream>

#include "base/parallel_for.h"
#include "base/workspace.h"
#include "capi/pstripack.h"
#include "files/near_nodes.h"
#include "geometry/measures.h"
#include "geometry/predicates.h"
#include "lists/limits.h"
#include "lists/rings.h"
#include "mesh/delaunay.h"
#include "methods/gradients.h"
#include "stripack/triangle_list.h"
#include "stripack/voronoi.h"

namespace bindings {
namespace {

using files::unit;
using pstripack::parallel_pieces;
using pstripack::threads_for;
using Cause = NoTriangulation::Cause;
using Reader = pstripack::ListReader<std::int32_t>;

/// `pairs`: of a node and the first one in its direction.
NoTriangulation coincidence(const std::vector<files::Duplicate>& pairs) {
  constexpr std::size_t kTold = 5;
  std::vector<std::int64_t> both;
  std::string told;
  for (const auto& [node, first] : pairs) {
    if (both.size() < 2 * kTold)
      told += (both.empty() ? "" : ", ") + std::to_string(first) + " and " + std::to_string(node);
    both.insert(both.end(), {static_cast<std::int64_t>(first), static_cast<std::int64_t>(node)});
  }
  if (pairs.size() == 1)
    told = "nodes " + told + " (counted from 0) point in the same direction: remove one of them";
  else
    told = std::to_string(pairs.size()) + " nodes point in the same direction as earlier ones: nodes " +
           told + (pairs.size() > kTold ? ", ..." : "") +
           " (counted from 0): remove them, or join them by duplicates='first' or 'mean'";
  return {Cause::coincident, told, std::move(both)};
}

}  // namespace

/// The directions of the given coordinates.
struct Triangulation::Exact {
  explicit Exact(const Triangulation& mesh) : points(copy(mesh)), directions(points.data(), mesh.n_) {}
  /// Of the corners some triangles after corners[k], which may lie anywhere in memory.
  [[gnu::always_inline]] void prefetch(const Buffer<std::int32_t>& corners, std::size_t k) const {
    constexpr std::size_t kAhead = 3 * 16;
    if (k + kAhead + 2 >= corners.size()) return;
    for (std::size_t i = k + kAhead + 1; i < k + kAhead + 3; ++i) directions.prefetch(corners[i]);
  }

  Buffer<Point> points;
  pstripack::Directions directions;

 private:
  static Buffer<Point> copy(const Triangulation& mesh) {
    Buffer<Point> points(mesh.n_);
    parallel_pieces(mesh.n_, threads_for(mesh.n_), [&](std::size_t begin, std::size_t end, int) {
      for (std::size_t i = begin; i < end; ++i) points[i] = mesh.given(i);
    });
    return points;
  }
};

Triangulation::~Triangulation() = default;

Triangulation::Triangulation(const Coordinates& given) : n_(given.n) {
  if (n_ < 3)
    throw NoTriangulation(Cause::too_few, "a triangulation needs three nodes, not " + std::to_string(n_));
  constexpr auto most = static_cast<std::size_t>(pstripack::most_nodes<std::int32_t>());
  if (n_ > most)
    throw NoTriangulation(Cause::too_many,
                          std::to_string(n_) + " nodes are too many: at most " + std::to_string(most));
  read(given);
  triangulate();
  make_directions();
  interpolation_.emplace(view());
}

/// Copies the coordinates and checks each node.
void Triangulation::read(const Coordinates& given) {
  columns_ = Buffer<double>(3 * n_);
  for (std::size_t axis = 0; axis < 3; ++axis) given_[axis] = columns_.data() + axis * n_;
  std::atomic<std::size_t> first_bad{n_};
  parallel_pieces(n_, threads_for(n_), [&](std::size_t begin, std::size_t end, int) {
    for (std::size_t i = begin; i < end; ++i) {
      const auto from = static_cast<std::ptrdiff_t>(i) * given.stride;
      const Point p{given.axis[0][from], given.axis[1][from], given.axis[2][from]};
      double* const column = columns_.data() + i;
      column[0] = p.x, column[n_] = p.y, column[2 * n_] = p.z;
      if (has_direction(p)) continue;
      std::size_t before = first_bad;
      while (i < before && !first_bad.compare_exchange_weak(before, i)) {
      }
    }
  });
  if (const std::size_t bad = first_bad; bad < n_) {
    const Point p = this->given(bad);
    std::ostringstream message;
    message << "node " << bad << " (counted from 0) is (" << p.x << ", " << p.y << ", " << p.z
            << "): coordinates must be finite and not all zero";
    throw NoTriangulation(Cause::bad_coordinate, message.str(), {static_cast<std::int64_t>(bad)});
  }
}

void Triangulation::triangulate() {
  list_ = Buffer<std::int32_t>(6 * n_ - 12), lptr_ = Buffer<std::int32_t>(6 * n_ - 12);
  lend_ = Buffer<std::int32_t>(n_);
  std::fill(lend_.begin(), lend_.end(), 0);
  const std::int32_t ier = pstripack_delaunay(static_cast<std::int32_t>(n_), given_[0], given_[1], given_[2],
                                              list_.data(), lptr_.data(), lend_.data(), &lnew_);
  if (ier == 0) return;
  if (ier == PSTRIPACK_OUT_OF_MEMORY) throw std::bad_alloc();
  if (ier < 0 && ier != PSTRIPACK_COLLINEAR) throw std::runtime_error(pstripack_strerror(ier));
  // TRMESH refuses nodes whose first three lie on one great circle, and names two nodes that coincide. The
  // kernel takes any three, and names all.
  const Exact nodes(*this);
  pstripack::Workspace workspace(pstripack::workspace_bytes(n_));
  try {
    const pstripack::Hull hull =
        pstripack::delaunay(nodes.points.data(), n_, workspace, pstripack::Lengths::directions);
    if (!hull.coincident.empty()) throw coincidence(files::coincident_nodes(hull));
    lnew_ = pstripack::write_lists(hull, list_.data(), lptr_.data(), lend_.data(), workspace);
  } catch (const std::domain_error&) {
    throw NoTriangulation(Cause::collinear, "all nodes lie on one great circle: they have no triangulation");
  }
}

void Triangulation::make_directions() {
  std::atomic<bool> are_given{true};
  const int threads = threads_for(n_);
  parallel_pieces(n_, threads, [&](std::size_t begin, std::size_t end, int) {
    bool all = true;
    for (std::size_t i = begin; i < end; ++i) all &= has_unit_length(given(i));
    if (!all) are_given = false;
  });
  std::copy(given_, given_ + 3, direction_);
  if (are_given) return;
  own_directions_ = Buffer<double>(3 * n_);
  for (std::size_t axis = 0; axis < 3; ++axis) direction_[axis] = own_directions_.data() + axis * n_;
  parallel_pieces(n_, threads, [&](std::size_t begin, std::size_t end, int) {
    for (std::size_t i = begin; i < end; ++i) {
      const Point p = direction(given(i));
      double* const column = own_directions_.data() + i;
      column[0] = p.x, column[n_] = p.y, column[2 * n_] = p.z;
    }
  });
}

Buffer<std::int32_t> Triangulation::triangles() const {
  constexpr auto pairs = pstripack::FirstPair::first_and_second;
  const int threads = threads_for(n_);
  pstripack::Rings<std::int32_t> rings;
  if (!rings.read(lists(), threads)) throw std::logic_error("the lists are not those of a triangulation");
  // The index of the first triangle of each piece of the nodes.
  std::vector<std::size_t> first(static_cast<std::size_t>(threads));
  if (threads > 1)
    parallel_pieces(n_, threads, [&](std::size_t begin, std::size_t end, int piece) {
      std::size_t count = 0;
      rings.for_each_triangle<pairs>(begin, end, [&](auto...) { ++count; });
      first[static_cast<std::size_t>(piece)] = count;
    });
  std::exclusive_scan(first.begin(), first.end(), first.begin(), std::size_t{0});
  const std::size_t boundary_nodes = boundary().size();
  Buffer<std::int32_t> corners(3 * (boundary_nodes > 0 ? 2 * n_ - 2 - boundary_nodes : 2 * n_ - 4));
  parallel_pieces(n_, threads, [&](std::size_t begin, std::size_t end, int piece) {
    std::int32_t* to = corners.data() + 3 * first[static_cast<std::size_t>(piece)];
    rings.for_each_triangle<pairs>(begin, end,
                                   [&](std::int32_t a, std::int32_t b, std::int32_t c, auto, auto) {
                                     to[0] = a - 1, to[1] = b - 1, to[2] = c - 1;
                                     to += 3;
                                   });
  });
  return corners;
}

Buffer<std::int32_t> Triangulation::opposite_triangles() const {
  Buffer<std::int32_t> columns(6 * (2 * n_ - 4));
  std::int32_t count = 0;
  if (pstripack::triangle_list(lists(), 6, count, columns.data()) != pstripack::TriangleListStatus::done)
    throw std::logic_error("the lists are not those of a triangulation");
  const auto triangles = static_cast<std::size_t>(count);
  Buffer<std::int32_t> opposite(3 * triangles);
  parallel_pieces(triangles, threads_for(triangles), [&](std::size_t begin, std::size_t end, int) {
    for (std::size_t t = begin; t < end; ++t)
      for (std::size_t k = 0; k < 3; ++k) opposite[3 * t + k] = columns[6 * t + 3 + k] - 1;
  });
  return opposite;
}

Runs Triangulation::neighbours() const {
  // Canonical lists are these runs, apart from signs.
  Runs runs{Buffer<std::int32_t>(n_ + 1), Buffer<std::int32_t>(static_cast<std::size_t>(lnew_) - 1)};
  runs.begin[0] = 0;
  std::copy(lend_.begin(), lend_.end(), runs.begin.begin() + 1);
  std::transform(list_.begin(), list_.begin() + lnew_ - 1, runs.values.begin(),
                 [](std::int32_t neighbour) { return std::abs(neighbour) - 1; });
  return runs;
}

std::vector<std::int32_t> Triangulation::boundary() const {
  std::vector<std::int32_t> nodes(n_);
  nodes.resize(static_cast<std::size_t>(pstripack::boundary_nodes(lists(), nodes.data()).boundary_nodes));
  for (std::int32_t& node : nodes) --node;
  return nodes;
}

const Triangulation::Exact& Triangulation::exact() const {
  std::call_once(exact_once_, [this] { exact_ = std::make_unique<const Exact>(*this); });
  return *exact_;
}

template <class Measure>
auto Triangulation::of_triangles(const Measure& measure) const {
  const Buffer<std::int32_t> corners = triangles();
  const Exact& at = exact();
  Buffer<decltype(measure(at.directions, 0, 0, 0))> values(corners.size() / 3);
  pstripack::parallel_for(values.size(), 4 * values.size(), [&](std::size_t t) {
    const std::int32_t* const c = corners.data() + 3 * t;
    at.prefetch(corners, 3 * t);
    values[t] = measure(at.directions, c[0], c[1], c[2]);
  });
  return values;
}

Buffer<Point> Triangulation::circumcentres() const {
  return of_triangles([](const auto&... corners) { return circumcentre(corners...); });
}

Buffer<double> Triangulation::triangle_areas() const {
  return of_triangles([](const auto&... corners) { return triangle_area(corners...); });
}

Buffer<double> Triangulation::circumradii() const {
  return of_triangles([](const pstripack::Directions& at, auto a, auto b, auto c) {
    return circumcircle(direction_of(at, a), direction_of(at, b), direction_of(at, c)).radius;
  });
}

Buffer<Point> Triangulation::midpoints(const std::int32_t* nodes, std::size_t arcs) const {
  Buffer<Point> middle(arcs);
  parallel_pieces(arcs, threads_for(10 * arcs), [&](std::size_t begin, std::size_t end, int) {
    for (std::size_t k = begin; k < end; ++k) {
      const auto direction = [&](std::size_t i) { return view().direction(nodes[i] + 1); };
      const pstripack::Direction a = direction(2 * k), b = direction(2 * k + 1);
      middle[k] =
          unit({(a.high.x + b.high.x) + (a.low.x + b.low.x),  // nearly opposite nodes need the low parts
                (a.high.y + b.high.y) + (a.low.y + b.low.y), (a.high.z + b.high.z) + (a.low.z + b.low.z)});
    }
  });
  return middle;
}

std::vector<Point> Triangulation::gradients(const double* values, std::size_t columns) const {
  return methods::gradients(view(), {values, columns, columns});
}

files::Faces Triangulation::cells(double cosine) const {
  return files::voronoi_cells(lists(), exact().directions, false, cosine);
}

std::vector<Point> Triangulation::cell_centroids() const { return files::centroids(cells(-0.9)); }

Buffer<double> Triangulation::cell_areas() const {
  Buffer<double> areas(n_);
  if (!pstripack::cell_areas(lists(), exact().directions, areas.data()))
    throw std::logic_error("the lists are not those of a triangulation");
  return areas;
}

ClosestPair Triangulation::closest_pair() const {
  const Reader reader(lists());
  const auto direction = [this](std::size_t node) { return pstripack::direction_of(given(node)); };
  ClosestPair best{std::numeric_limits<double>::infinity(), 0, 0};
  double limit =
      best.distance;  // of squares; the rounding of unit vectors changes distances by 6e-16 at most
  for (std::size_t k = 0; k < n_; ++k)
    files::for_each_neighbour(reader, k, [&](std::size_t other) {
      const Point d = minus(at(static_cast<std::int32_t>(other)), at(static_cast<std::int32_t>(k)));
      if (other < k || dot(d, d) > limit) return;
      const double distance = 2 * std::sin(arc_length(direction(k), direction(other)) / 2);
      if (distance < best.distance)
        best = {distance, static_cast<std::int64_t>(k), static_cast<std::int64_t>(other)};
      limit = (best.distance + 1e-15) * (best.distance + 1e-15);
    });
  return best;
}

}  // namespace bindings
