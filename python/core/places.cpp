// Queries at places: the triangle, the nearest nodes, an interpolated value, weights.

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <thread>
#include <utility>
#include <vector>

#include "base/parallel_for.h"
#include "geometry/insertion_order.h"
#include "methods/by_distance.h"
#include "methods/gradients.h"
#include "stripack/list_queries.h"
#include "triangulation.h"

namespace bindings {
namespace {

constexpr double kMissing = std::numeric_limits<double>::quiet_NaN();

}  // namespace

/// Calls visit(i, place, near, state) for each place that has a direction. `near` is a node near it, from 1,
/// which visit may update. Returns the states, one for each thread. Places are visited along a space-filling
/// curve. Searches restart in each block of places, so results do not depend on the number of threads.
template <class State, class Visit>
std::vector<State> Triangulation::visit_places(const Point* places, std::size_t count, const Visit& visit) {
  constexpr std::size_t kBlock = 512, kMost = std::size_t{1} << 28;
  constexpr std::chrono::milliseconds kPause(200);
  const int threads = pstripack::threads_for(20 * count);
  std::vector<State> states(static_cast<std::size_t>(threads));
  for (std::size_t first = 0; first < count; first += kMost) {
    const std::size_t part = std::min(count - first, kMost);
    Buffer<Point> known(part);
    for (std::size_t i = 0; i < part; ++i) {
      const Point& p = places[first + i];
      known[i] = has_direction(p) ? direction(p) : Point{0, 0, 1};
    }
    Buffer<std::uint32_t> order(part);
    pstripack::Workspace workspace(16 * part);
    pstripack::insertion_order(known.data(), part, order.data(), workspace);
    const std::size_t blocks = (part + kBlock - 1) / kBlock;
    pstripack::ErrorsOfThreads errors(states.size());
    std::atomic<bool> is_over{false};
    const std::thread::id caller = std::this_thread::get_id();
    auto last = std::chrono::steady_clock::now();
    const auto pause = [&] {
      const auto now = std::chrono::steady_clock::now();
      if (between_places == nullptr || std::this_thread::get_id() != caller || now - last < kPause) return;
      last = now;
      try {
        between_places();
      } catch (...) {
        is_over = true;
        throw;
      }
    };
    pstripack::parallel_pieces(blocks, threads, [&](std::size_t begin, std::size_t end, int piece) {
      const auto thread = static_cast<std::size_t>(piece);
      errors.keep(thread, [&] {
        for (std::size_t block = begin; block < end && !is_over; ++block) {
          pause();
          std::int32_t near = 1;
          for (std::size_t k = block * kBlock; k < std::min((block + 1) * kBlock, part); ++k) {
            const std::size_t i = order[k];
            if (has_direction(places[first + i])) visit(first + i, places[first + i], near, states[thread]);
          }
        }
      });
    });
    errors.rethrow();
  }
  return states;
}

namespace {
struct Nothing {};

/// The terms of a cubic value.
struct Cubic {
  std::vector<methods::Share> shares;
  std::vector<Point> ways;
};

/// Of each thread: what it found, place after place, and what it needs for that.
template <class State>
struct alignas(64) Found {
  std::vector<methods::Share> shares;
  State state;
};
}  // namespace

/// The rows that find(place, near, shares, state) finds. It may change `near`, as visit_places says.
template <class State, class Find>
Rows Triangulation::rows(const Point* places, std::size_t count, const Find& find) {
  struct Row {
    const Found<State>* by;
    std::size_t begin, size;
  };
  Buffer<Row> found(count);
  std::fill(found.begin(), found.end(), Row{nullptr, 0, 0});
  const std::vector<Found<State>> threads = visit_places<Found<State>>(
      places, count, [&](std::size_t i, const Point& p, std::int32_t& near, Found<State>& thread) {
        thread_local std::vector<methods::Share> shares;
        find(p, near, shares, thread.state);
        found[i] = {&thread, thread.shares.size(), shares.size()};
        thread.shares.insert(thread.shares.end(), shares.begin(), shares.end());
      });
  Rows rows;
  rows.begin = Buffer<std::int32_t>(count + 1);
  std::size_t all = 0;
  for (std::size_t i = 0; i < count; ++i) {
    rows.begin[i] = static_cast<std::int32_t>(all);
    all += found[i].size;
    if (all > std::numeric_limits<std::int32_t>::max())
      throw std::length_error("more than 2^31 - 1 pairs of a place and a node: pass the places in parts");
  }
  rows.begin[count] = static_cast<std::int32_t>(all);
  rows.nodes = Buffer<std::int32_t>(all);
  rows.numbers = Buffer<double>(all);
  pstripack::parallel_pieces(count, pstripack::threads_for(count),
                             [&](std::size_t first, std::size_t last, int) {
                               for (std::size_t i = first; i < last; ++i)
                                 for (std::size_t k = 0; k < found[i].size; ++k) {
                                   const auto& [node, part] = found[i].by->shares[found[i].begin + k];
                                   const std::size_t to = static_cast<std::size_t>(rows.begin[i]) + k;
                                   rows.nodes[to] = node - 1, rows.numbers[to] = part;
                                 }
                             });
  return rows;
}

Buffer<std::int32_t> Triangulation::find(const Point* places, std::size_t count, const std::int32_t* corners,
                                         std::size_t triangles, double* weights) const {
  struct Row {
    std::int32_t node[3];
  };
  static_assert(sizeof(Row) == 3 * sizeof(std::int32_t));
  const auto* const rows = reinterpret_cast<const Row*>(corners);
  Buffer<std::int32_t> result(count);
  std::fill(result.begin(), result.end(), -1);
  if (weights != nullptr) std::fill(weights, weights + 3 * count, kMissing);
  visit_places<Nothing>(places, count, [&](std::size_t i, const Point& p, std::int32_t& near, Nothing&) {
    methods::Interpolation::Corners found;
    double weight[3];
    if (weights == nullptr ? !interpolation_->triangle(p, near, found)
                           : !interpolation_->barycentric(p, near, found, weight))
      return;
    const std::int32_t a = found[0] - 1, b = found[1] - 1, c = found[2] - 1;
    const Row* row = std::lower_bound(rows, rows + triangles, a,
                                      [](const Row& r, std::int32_t node) { return r.node[0] < node; });
    while (row < rows + triangles && row->node[0] == a && row->node[1] != b) ++row;
    if (row == rows + triangles || row->node[2] != c) return;
    result[i] = static_cast<std::int32_t>(row - rows);
    if (weights != nullptr) std::copy(weight, weight + 3, weights + 3 * i);
  });
  return result;
}

Buffer<double> Triangulation::interpolate(Method method, const Point* places, std::size_t count,
                                          const double* values, std::size_t columns) const {
  Buffer<double> result(count * columns);
  std::fill(result.begin(), result.end(), kMissing);
  using Shares = std::vector<methods::Share>;
  const auto visit_shares = [&](const auto& visit) {
    visit_places<Shares>(places, count,
                         [&](std::size_t i, const Point& p, std::int32_t& near, Shares& shares) {
                           if (method == Method::linear ? interpolation_->linear(p, near, shares)
                                                        : interpolation_->natural(p, near, shares))
                             visit(i, p, shares);
                         });
  };
  if (method != Method::cubic) {
    visit_shares([&](std::size_t i, const Point&, const Shares& shares) {
      for (std::size_t column = 0; column < columns; ++column) {
        double value = 0;
        for (const auto& [node, part] : shares)
          value += part * values[(static_cast<std::size_t>(node) - 1) * columns + column];
        result[i * columns + column] = value;
      }
    });
    return result;
  }
  constexpr std::size_t kMost = 32;  // columns at a time: their gradients are three times as large
  for (std::size_t from = 0; from < columns; from += kMost) {
    const std::size_t these = std::min(kMost, columns - from);
    const std::vector<Point> slopes = methods::gradients(view(), {values + from, these, columns});
    visit_places<Cubic>(places, count, [&](std::size_t i, const Point& p, std::int32_t& near, Cubic& at) {
      if (!interpolation_->natural(p, near, at.shares)) return;
      interpolation_->cubic_terms(p, at.shares, at.ways);
      for (std::size_t column = 0; column < these; ++column) {
        double sum = 0;
        for (std::size_t k = 0; k < at.shares.size(); ++k) {
          const auto node = static_cast<std::size_t>(at.shares[k].node) - 1;
          sum += at.shares[k].part * values[node * columns + from + column];
          if (at.shares.size() > 1) sum += dot(at.ways[k], slopes[node * these + column]);
        }
        result[i * columns + from + column] = sum;
      }
    });
  }
  return result;
}

Rows Triangulation::weights(Method method, const Point* places, std::size_t count) const {
  const methods::GradientTerms gradients =
      method == Method::cubic ? methods::gradient_terms(view()) : methods::GradientTerms{};
  return rows<Nothing>(
      places, count, [&](const Point& p, std::int32_t& near, std::vector<methods::Share>& shares, Nothing&) {
        if (method == Method::linear)
          interpolation_->linear(p, near, shares);
        else
          interpolation_->natural(p, near, shares);
        if (method == Method::cubic) interpolation_->cubic_shares(p, gradients, shares);
      });
}

// ---- several nodes near a place -----------------------------------------------------------------------
//
// A node x has a neighbour nearer to the place p, unless x is nearest to p itself: the segment from x to p
// leaves the cell of x at a point m of its border. There it enters the cell of a neighbour y, and the way
// from y by m to p is as long as the segment, but not straight. (If m is a corner of several cells, take any
// neighbour of x whose cell has this corner.) So the search begins with the nearest node and looks at
// neighbours of what it has found.
//
// If the nodes lie in a hemisphere, x and y can be boundary nodes without an arc in the lists. Then m is at
// least 90 degrees from x, and so is p. So all boundary nodes are looked at before one so far away.

namespace {

using Reader = pstripack::ListReader<std::int32_t>;
using methods::ByDistance;
using methods::Candidate;

/// A search from a place; keeps its memory for the next one.
class Neighbourhood {
 public:
  void start(const pstripack::ListsView<std::int32_t>& lists, std::int32_t boundary) {
    lists_ = lists, boundary_ = boundary;
    seen_.resize(lists.n);
    if (++search_ == 0) std::fill(seen_.begin(), seen_.end(), search_++);
    open_.clear(), found_.clear();
  }

  /// The k nearest nodes. `nearest`: that of order.
  const std::vector<Candidate>& find(const ByDistance& order, std::int32_t nearest, std::size_t k) {
    const auto later = [&](const Candidate& a, const Candidate& b) { return order(b, a); };
    const auto look_at = [&](std::int32_t node) {
      if (!is_new(node)) return;
      open_.push_back(order.at(node));
      std::push_heap(open_.begin(), open_.end(), later);
    };
    look_at(nearest);
    // Of nodes that are all as near as the nearest, the first may be found last.
    while (!open_.empty() && (found_.size() < k || order.are_as_near(open_.front(), found_.front()))) {
      if (is_far(open_.front())) add_boundary(look_at);
      const Candidate next = open_.front();
      std::pop_heap(open_.begin(), open_.end(), later);
      open_.pop_back();
      found_.push_back(next);
      Reader(lists_).for_each_neighbour(next.node, look_at);
    }
    std::sort(found_.begin(), found_.end(), order);
    found_.resize(k);
    return found_;
  }

  /// Calls take(node, distance) for the nodes up to `radius` from the place, the nearest first.
  template <class Take>
  void within(const methods::Triangulated& mesh, const ByDistance& order, std::int32_t nearest, double radius,
              const Take& take) {
    // So that a rounded distance does not cut the way to others.
    const double reach = radius * (1 + 1e-12), chord = reach < kPi ? 2 * std::sin(reach / 2) : 3,
                 most = chord * chord * (1 + 1e-11) + ByDistance::kTiny;
    const auto look_at = [&](std::int32_t node) {
      if (!is_new(node)) return;
      if (const Candidate c = order.at(node); c.square <= most) found_.push_back(c);
    };
    look_at(nearest);
    if (is_far({0, most})) add_boundary(look_at);
    for (std::size_t i = 0; i < found_.size(); ++i) {
      const std::int32_t node = found_[i].node;
      Reader(lists_).for_each_neighbour(node, look_at);
    }
    std::sort(found_.begin(), found_.end(), order);
    for (const Candidate& c : found_)
      if (const double distance = arc_length(order.place(), mesh.direction(c.node)); distance <= radius)
        take(c.node, distance);
  }

 private:
  static constexpr double kPi = 3.14159265358979323846;
  bool is_new(std::int32_t node) {
    std::uint32_t& mark = seen_[static_cast<std::size_t>(node) - 1];
    return std::exchange(mark, search_) != search_;
  }
  /// True if the node may be 90 degrees away.
  static bool is_far(const Candidate& c) { return c.square > 2 - 1e-11; }
  template <class Visit>
  void add_boundary(const Visit& visit) {
    const std::int32_t first = std::exchange(boundary_, 0);
    for (std::int32_t node = first; node != 0;) {
      visit(node);
      node = Reader(lists_).first_neighbour(node);
      if (node == first) break;
    }
  }

  pstripack::ListsView<std::int32_t> lists_{};
  std::int32_t boundary_ = 0;        ///< a boundary node; 0: none, or they have been looked at
  std::vector<std::uint32_t> seen_;  ///< of each node the last search that has looked at it
  std::uint32_t search_ = 0;         ///< its number
  std::vector<Candidate> open_, found_;
};

}  // namespace

Buffer<std::int32_t> Triangulation::nearest(const Point* places, std::size_t count) const {
  Buffer<std::int32_t> result(count);
  std::fill(result.begin(), result.end(), -1);
  visit_places<Nothing>(places, count, [&](std::size_t i, const Point& p, std::int32_t& near, Nothing&) {
    near = interpolation_->nearest(p, near);
    result[i] = near - 1;
  });
  return result;
}

Buffer<std::int32_t> Triangulation::nearest(const Point* places, std::size_t count, std::size_t k) const {
  Buffer<std::int32_t> result(count * k);
  std::fill(result.begin(), result.end(), -1);
  const methods::Triangulated mesh = view();
  visit_places<Neighbourhood>(places, count,
                              [&](std::size_t i, const Point& p, std::int32_t& near, Neighbourhood& around) {
                                near = interpolation_->nearest(p, near);
                                around.start(mesh.lists, interpolation_->first_boundary_node());
                                std::int32_t* to = result.data() + i * k;
                                for (const Candidate& c : around.find(ByDistance(mesh, p), near, k))
                                  *to++ = c.node - 1;
                              });
  return result;
}

Rows Triangulation::within(const Point* places, std::size_t count, double radius) const {
  const methods::Triangulated mesh = view();
  return rows<Neighbourhood>(
      places, count,
      [&](const Point& p, std::int32_t& near, std::vector<methods::Share>& shares, Neighbourhood& around) {
        shares.clear();
        near = interpolation_->nearest(p, near);
        around.start(mesh.lists, interpolation_->first_boundary_node());
        around.within(mesh, ByDistance(mesh, p), near, radius, [&](std::int32_t node, double distance) {
          shares.push_back({node, distance});
        });
      });
}

Buffer<double> Triangulation::distances(const Point* places, std::size_t count, const std::int32_t* nodes,
                                        std::size_t k) const {
  Buffer<double> result(count * k);
  const methods::Triangulated mesh = view();
  pstripack::parallel_pieces(
      count, pstripack::threads_for(10 * count * k), [&](std::size_t first, std::size_t last, int) {
        for (std::size_t i = first; i < last; ++i) {
          const bool is_missing = !has_direction(places[i]);
          const pstripack::Direction place =
              is_missing ? pstripack::Direction{} : pstripack::direction_of(places[i]);
          for (std::size_t j = i * k; j < (i + 1) * k; ++j)
            result[j] = is_missing ? kMissing : arc_length(place, mesh.direction(nodes[j] + 1));
        }
      });
  return result;
}

}  // namespace bindings
