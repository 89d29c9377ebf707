#include "scvt/front.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <queue>
#include <utility>

#include "scvt/evaluator.h"
#include "scvt/first_generators.h"
#include "scvt/vectors.h"

namespace pstripack::scvt {
namespace {

constexpr std::size_t kFewest = 1000;  ///< for fewer generators a front is no better than random ones
constexpr double kInCircle = 0.934172358962716;  ///< cosine of the inradius of an icosahedron's face
constexpr double kSqrt3 = 1.7320508075688772;

// Distances in units of the size h; between two nodes, of the smaller size.
constexpr double kTooNear = 0.75;  ///< a new node must not be closer to another
constexpr double kLinked = 1.3;    ///< nodes closer than this have an edge
constexpr double kCovered = 0.9;   ///< no front begins closer to a node

constexpr double kSmallest = 4e-6, kLargest = 1;  ///< bounds of the size h

/// Random places, evenly distributed, and the area that each represents.
struct Samples {
  explicit Samples(std::size_t about) {
    // One place in each square of a lattice on the faces of a cube.
    const int m = std::max(16, static_cast<int>(std::sqrt(static_cast<double>(about) / 6)));
    std::uint64_t state = 1;
    const auto random = [&] {  // Knuth's MMIX
      state = state * 6364136223846793005 + 1442695040888963407;
      return static_cast<double>(state >> 11) * 0x1p-53;
    };
    for (int face = 0; face < 6; ++face)
      for (int i = 0; i < m; ++i)
        for (int j = 0; j < m; ++j) {
          const double u = 2 * (i + random()) / m - 1, v = 2 * (j + random()) / m - 1;
          const double square = 1 + u * u + v * v;
          place.push_back(on_face(face, u, v));
          area.push_back(4 / (static_cast<double>(m) * m * square * std::sqrt(square)));
        }
  }
  std::vector<Point> place;
  std::vector<double> area;
};

/// The 20 face centres of an icosahedron, one corner of each face, and the 12 corners.
struct Icosahedron {
  Icosahedron() {
    const double golden = (1 + std::sqrt(5.0)) / 2;
    for (const double a : {1.0, -1.0})
      for (const double b : {golden, -golden})
        for (const Point& p : {Point{0, a, b}, Point{a, b, 0}, Point{b, 0, a}})
          corner.push_back(normalized(p));
    const auto neighbours = [&](std::size_t i, std::size_t j) { return dot(corner[i], corner[j]) > 0.4; };
    for (std::size_t i = 0; i < 12; ++i)
      for (std::size_t j = 0; j < i; ++j)
        for (std::size_t k = 0; k < j; ++k)
          if (neighbours(i, j) && neighbours(j, k) && neighbours(k, i)) {
            centre.push_back(normalized(plus(plus(corner[i], corner[j]), corner[k])));
            corner_of.push_back(corner[i]);
          }
  }
  std::vector<Point> centre, corner_of, corner;
};

std::pair<std::size_t, double> nearest(const std::vector<Point>& places, const Point& p) {
  std::pair<std::size_t, double> best{0, -2};
  for (std::size_t i = 0; i < places.size(); ++i)
    if (const double cosine = dot(places[i], p); cosine > best.second) best = {i, cosine};
  return best;
}

struct Node {
  Point p;
  double size;
};

/// A hash grid of nodes. There is a grid of cubes for each power of two of the nodes' sizes; a node is in
/// the grid of its size.
class PointGrid {
 public:
  /// For about n nodes. `size`: a usual size.
  PointGrid(double size, std::size_t n) : unit_(size) {
    std::size_t buckets = 64;
    while (buckets < n / 2) buckets *= 2;
    first_.assign(buckets, kNone);
    nodes.reserve(n);
    links_.reserve(n);
  }

  std::vector<Node> nodes;  ///< in the order in which they were added

  void add(const Node& node) {
    const int level = level_of(node.size);
    lowest_ = std::min(lowest_, level);
    highest_ = std::max(highest_, level);
    const double per_length = 1 / width(level);
    const std::uint64_t cube =
        cube_of(level, cell(node.p.x, per_length), cell(node.p.y, per_length), cell(node.p.z, per_length));
    std::uint32_t& first = first_[bucket(cube)];
    links_.push_back({cube, first});
    first = static_cast<std::uint32_t>(nodes.size());
    nodes.push_back(node);
  }

  /// Calls visit(node, squared distance) for the nodes that are nearer to centre.p than `reach` times the
  /// smaller of the two sizes, until visit returns false.
  template <class Visit>
  void for_each_near(const Node& centre, double reach, Visit visit) const {
    const Point& p = centre.p;
    for (int level = lowest_; level <= highest_; ++level) {
      const double per_length = 1 / width(level);
      const double r = reach * std::min(centre.size, std::ldexp(unit_, level));
      const std::uint64_t x1 = cell(p.x + r, per_length), y1 = cell(p.y + r, per_length),
                          z1 = cell(p.z + r, per_length);
      for (std::uint64_t x = cell(p.x - r, per_length); x <= x1; ++x)
        for (std::uint64_t y = cell(p.y - r, per_length); y <= y1; ++y)
          for (std::uint64_t z = cell(p.z - r, per_length); z <= z1; ++z) {
            const std::uint64_t cube = cube_of(level, x, y, z);
            for (std::uint32_t i = first_[bucket(cube)]; i != kNone; i = links_[i].next) {
              if (links_[i].cube != cube) continue;
              const Node& node = nodes[i];
              const Point d = minus(node.p, p);
              const double square = dot(d, d), limit = reach * std::min(centre.size, node.size);
              if (square < limit * limit && !visit(node, square)) return;
            }
          }
    }
  }

  bool has_near(const Node& centre, double reach) const {
    bool found = false;
    for_each_near(centre, reach, [&](const Node&, double) {
      found = true;
      return false;
    });
    return found;
  }

 private:
  static constexpr std::uint32_t kNone = 0xffffffff;
  struct Link {
    std::uint64_t cube;
    std::uint32_t next;
  };

  /// The level of a size: unit_ * 2^(level-1) <= size < unit_ * 2^level.
  int level_of(double size) const {
    int level;
    std::frexp(size / unit_, &level);
    return level;
  }
  double width(int level) const { return std::ldexp(2.5 * unit_, level); }  // width of a cube, found by trial
  static std::uint64_t cell(double x, double per_length) {
    return static_cast<std::uint64_t>((x + 4) * per_length);
  }
  static std::uint64_t cube_of(int level, std::uint64_t x, std::uint64_t y, std::uint64_t z) {
    return ((static_cast<std::uint64_t>(level + 64) << 57) ^ (x << 38) ^ (y << 19)) ^ z;
  }
  std::size_t bucket(std::uint64_t cube) const {
    return static_cast<std::size_t>(cube * 0x9e3779b97f4a7c15 >> 32) & (first_.size() - 1);
  }

  double unit_;
  int lowest_ = 64, highest_ = -64;
  std::vector<std::uint32_t> first_;  ///< by bucket: the node added last
  std::vector<Link> links_;           ///< by node: its cube, and the node added to its bucket before it
};

class Front {
 public:
  Front(const Density& density, double scale, double usual_size, std::size_t limit)
      : density_(density), scale_(scale), limit_(limit), grid_(usual_size, limit) {}

  const std::vector<Node>& nodes() const { return grid_.nodes; }

  /// Begins a front with an edge from p in the direction of q, unless p is near a node.
  void begin(const Point& p, double density, const Point& q) {
    const Node first{p, size_of(density)};
    if (grid_.has_near(first, kCovered)) return;
    add(first);
    const Point d = normalized(minus(q, scaled(dot(p, q), p)));
    const Node second{normalized(plus(p, scaled(first.size, d))), first.size};
    if (!grid_.has_near(second, kTooNear)) add(second);
  }

  void grow() {
    // Queue by queue, so that nodes near on the sphere are near in memory.
    for (;;) {
      const auto queue =
          std::find_if(queues_.begin(), queues_.end(), [](const auto& q) { return !q.empty(); });
      if (queue == queues_.end()) return;
      while (!queue->empty()) {
        if (grid_.nodes.size() >= limit_) return;
        Node node = queue->top().node;
        queue->pop();
        if (grid_.has_near(node, kTooNear)) continue;
        look_around(node, kLinked + kTooNear);
        node.p = fitted(node);
        if (!grid_.has_near(node, kTooNear)) add(node);
      }
    }
  }

 private:
  struct Candidate {
    Node node;
    double cosine;  ///< of the distance to the nearest face centre
    std::uint64_t number;
    bool operator<(const Candidate& other) const {  // a priority queue returns the largest first
      return cosine != other.cosine ? cosine < other.cosine : number > other.number;
    }
  };

  double size_of(double density) const {
    return std::clamp(scale_ / std::sqrt(std::sqrt(density)), kSmallest, kLargest);
  }

  bool is_free(const Node& node) const {  // considers the nodes in near_ only
    return std::none_of(near_.begin(), near_.end(), [&](const Node& other) {
      const Point d = minus(other.p, node.p);
      const double limit = kTooNear * std::min(node.size, other.size);
      return dot(d, d) < limit * limit;
    });
  }
  static bool are_linked(const Node& a, const Node& b) {
    const Point d = minus(a.p, b.p);
    const double limit = kLinked * std::min(a.size, b.size);
    return dot(d, d) < limit * limit;
  }
  void look_around(const Node& node, double reach) {
    near_.clear();
    grid_.for_each_near(node, reach, [&](const Node& other, double) {
      near_.push_back(other);
      return true;
    });
  }
  /// Two steps towards the place where the distances to the linked nodes differ least from the wanted
  /// distances.
  Point fitted(Node node) const {
    for (int step = 0; step < 2; ++step) {
      Point sum{0, 0, 0};
      int count = 0;
      for (const Node& other : near_) {
        if (!are_linked(node, other)) continue;
        const Point d = minus(other.p, node.p);
        const double distance = std::sqrt(dot(d, d)), wanted = (node.size + other.size) / 2;
        sum = plus(sum, scaled(1 - wanted / distance, d));
        ++count;
      }
      if (count < 3) break;  // the apex of an equilateral triangle fits
      node.p = normalized(plus(node.p, scaled(2.0 / count, sum)));
    }
    return node.p;
  }
  void add(const Node& node) {
    look_around(node, kLinked + kTooNear);
    grid_.add(node);
    apexes_.clear();
    for (const Node& other : near_) {
      if (!are_linked(node, other)) continue;
      const Point middle = normalized(plus(node.p, other.p)), across = normalized(cross(node.p, other.p));
      const Point d = minus(node.p, other.p);
      const double size = (node.size + other.size) / 2, square = size * size;
      const double height = std::sqrt(std::max(square - dot(d, d) / 4, square / 4));
      apexes_.push_back(normalized(plus(middle, scaled(height, across))));
      apexes_.push_back(normalized(minus(middle, scaled(height, across))));
    }
    const std::vector<double> values = values_at(apexes_, density_);
    for (std::size_t i = 0; i < apexes_.size(); ++i) {
      const Node apex{apexes_[i], size_of(values[i])};
      if (!is_free(apex)) continue;
      const auto [face, cosine] = nearest(icosahedron_.centre, apex.p);
      const std::size_t queue = cosine > kInCircle ? face : 20 + nearest(icosahedron_.corner, apex.p).first;
      queues_[queue].push({apex, cosine, candidates_++});
    }
  }

  const Density& density_;
  const double scale_;
  const std::size_t limit_;
  const Icosahedron icosahedron_;
  PointGrid grid_;
  std::array<std::priority_queue<Candidate>, 32> queues_;  ///< of 20 incircles of faces and 12 corners
  std::uint64_t candidates_ = 0;
  std::vector<Node> near_;  ///< nodes found by look_around()
  std::vector<Point> apexes_;
};

/// Places where a front may begin: the face centres, then sampled places, those of highest density first.
struct FrontSeeds {
  FrontSeeds(std::size_t n, const Icosahedron& icosahedron, const Density& rho) {
    const Samples samples(n / 2 + 10000);
    const std::vector<double> values = values_at(samples.place, rho);
    std::vector<std::size_t> order(values.size());
    for (std::size_t i = 0; i < order.size(); ++i) {
      order[i] = i;
      integral += samples.area[i] * std::sqrt(values[i]);
    }
    std::stable_sort(order.begin(), order.end(),
                     [&](std::size_t a, std::size_t b) { return values[a] > values[b]; });
    place = icosahedron.centre;
    density = values_at(place, rho);
    for (const std::size_t i : order) {
      place.push_back(samples.place[i]);
      density.push_back(values[i]);
    }
  }
  std::vector<Point> place;
  std::vector<double> density;
  double integral = 0;  ///< of the square root of the density
};

/// The nodes of fronts that cover the sphere, or the first `limit` of them.
std::vector<Point> advance(std::size_t limit, const Icosahedron& icosahedron, const FrontSeeds& seeds,
                           const Density& density, double scale) {
  const std::size_t faces = icosahedron.centre.size();
  const double highest = seeds.density[faces];
  Front front(density, scale, scale / std::sqrt(std::sqrt(highest)), limit);
  for (std::size_t i = 0; i < faces; ++i)
    front.begin(seeds.place[i], seeds.density[i], icosahedron.corner_of[i]);
  front.grow();
  for (std::size_t i = faces; i < seeds.place.size(); ++i) {
    front.begin(seeds.place[i], seeds.density[i], icosahedron.corner[0]);
    front.grow();
  }
  std::vector<Point> points;
  points.reserve(front.nodes().size());
  for (const Node& node : front.nodes()) points.push_back(node.p);
  return points;
}

/// n of the points. Those left out are ends of rows, spread evenly over the sphere.
std::vector<Point> thinned(std::vector<Point> points, std::size_t n) {
  std::vector<std::int32_t> list, lptr, lend;
  while (points.size() > n) {
    const NeighbourLists stars = triangulate(points, list, lptr, lend);
    const auto sides = [&](std::size_t i) { return stars.end_of(i) - stars.begin_of(i); };
    std::vector<std::size_t> ends;
    for (std::size_t i = 0; i < points.size(); ++i) {
      if (sides(i) != 5) continue;
      int six = 0, seven = 0;
      for (std::size_t j = stars.begin_of(i); j < stars.end_of(i); ++j) {
        const std::size_t other = sides(static_cast<std::size_t>(stars.neighbour[j]) - 1);
        six += other == 6;
        seven += other == 7;
      }
      if (six == 4 && seven == 1) ends.push_back(i);
    }
    const std::size_t excess = points.size() - n;
    if (ends.empty())
      for (std::size_t i = 0; i < points.size(); ++i) ends.push_back(i);
    const std::size_t taken = std::min(excess, ends.size());
    std::vector<bool> leave(points.size());
    for (std::size_t k = 0; k < taken; ++k) leave[ends[k * ends.size() / taken]] = true;
    std::size_t kept = 0;
    for (std::size_t i = 0; i < points.size(); ++i)
      if (!leave[i]) points[kept++] = points[i];
    points.resize(kept);
  }
  return points;
}

}  // namespace

std::vector<Point> front_generators(std::size_t n, const Density& density) {
  if (n < kFewest) return random_generators(n, density, 1);
  const Icosahedron icosahedron;
  const FrontSeeds seeds(n, icosahedron, density);
  // The number of nodes that a scale leads to is known beforehand within one percent only. About sqrt(n)
  // nodes too many are wanted, since there are about 1.2 sqrt(n) ends of rows.
  const double count = static_cast<double>(n), wanted = count + std::sqrt(count),
               most = wanted + std::sqrt(count);
  const std::size_t limit = n + n / 4;
  double scale = std::sqrt(2 / kSqrt3 * seeds.integral / wanted), too_fine = 0, too_coarse = 0;
  std::vector<Point> best;
  for (int trial = 0; trial < 8; ++trial) {
    std::vector<Point> points = advance(limit, icosahedron, seeds, density, scale);
    const std::size_t found = points.size();
    (found < n ? too_coarse : too_fine) = scale;
    scale *= std::sqrt(static_cast<double>(found) / wanted);
    if (too_fine != 0 && too_coarse != 0 && !(scale > too_fine && scale < too_coarse))
      scale = (too_fine + too_coarse) / 2;
    if (found >= n && found < limit && (best.empty() || found < best.size())) best = std::move(points);
    if (!best.empty() && static_cast<double>(best.size()) <= most) break;
  }
  if (best.empty()) return random_generators(n, density, 1);
  return thinned(along_a_curve(best), n);
}

}  // namespace pstripack::scvt
