#include "methods/gradients.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "base/parallel_for.h"
#include "files/measures.h"
#include "stripack/list_queries.h"

namespace methods {
namespace {

/// The functions of a fit: u, v, u^2, u v, v^2. The first two are linear.
constexpr int kLinear = 2, kQuadratic = 5;
using Numbers = std::array<double, kQuadratic>;

/// A least-squares fit.
class LeastSquares {
 public:
  void add(const Numbers& f, double weight) {
    for (int i = 0; i < kQuadratic; ++i)
      for (int j = 0; j <= i; ++j) matrix_[i][j] += weight * f[i] * f[j];
  }

  /// After all places are added: Cholesky's factors of the normal equations, of which the first rows are
  /// those of the first functions. False if the nodes do not determine all coefficients.
  bool factor() {
    constexpr double kLeast = 1e-9;  // least pivot, relative to its diagonal element
    for (int i = 0; i < kQuadratic; ++i) {
      const double diagonal = matrix_[i][i];
      for (int j = 0; j <= i; ++j) {
        double sum = matrix_[i][j];
        for (int k = 0; k < j; ++k) sum -= matrix_[i][k] * matrix_[j][k];
        if (j < i) {
          matrix_[i][j] = sum / matrix_[j][j];
        } else {
          if (!(sum > kLeast * diagonal)) return false;
          matrix_[i][i] = std::sqrt(sum);
        }
      }
    }
    return true;
  }

  /// The coefficients of the first `count` functions. `right`: the sums of products of the functions, values
  /// and weights.
  Numbers solve(const Numbers& right, int count) const {
    Numbers x{};
    for (int i = 0; i < count; ++i) {
      x[i] = right[i];
      for (int k = 0; k < i; ++k) x[i] -= matrix_[i][k] * x[k];
      x[i] /= matrix_[i][i];
    }
    for (int i = count - 1; i >= 0; --i) {
      for (int k = i + 1; k < count; ++k) x[i] -= matrix_[k][i] * x[k];
      x[i] /= matrix_[i][i];
    }
    return x;
  }

 private:
  double matrix_[kQuadratic][kQuadratic] = {};  // the lower triangle
};

/// Two perpendicular tangents at p.
std::array<Point, 2> tangents(const Point& p) {
  const double x = std::fabs(p.x), y = std::fabs(p.y), z = std::fabs(p.z);
  const Point least = x <= y && x <= z ? Point{1, 0, 0} : y <= z ? Point{0, 1, 0} : Point{0, 0, 1};
  const Point first = files::unit(cross(p, least));
  return {first, cross(p, first)};
}

/// The neighbours of a node and their neighbours.
void two_rings(const pstripack::ListReader<std::int32_t>& reader, std::int32_t node,
               std::vector<std::int32_t>& rings) {
  rings.clear();
  const auto add_ring = [&](std::int32_t of) {
    reader.for_each_neighbour(of, [&](std::int32_t neighbour) { rings.push_back(neighbour); });
  };
  add_ring(node);
  for (std::size_t i = 0, first_ring = rings.size(); i < first_ring; ++i) add_ring(rings[i]);
  std::sort(rings.begin(), rings.end());
  rings.erase(std::unique(rings.begin(), rings.end()), rings.end());
  rings.erase(std::find(rings.begin(), rings.end(), node));
}

std::vector<pstripack::UnitVector> unit_vectors_of(const Triangulated& mesh) {
  std::vector<pstripack::UnitVector> unit(mesh.lists.n);
  pstripack::parallel_for(unit.size(), unit.size(), [&](std::size_t i) {
    unit[i] = pstripack::unit_vector(mesh.at(static_cast<std::int32_t>(i) + 1));
  });
  return unit;
}

/// What the gradient at a node is for any values around it.
class Fit {
 public:
  Fit(const Triangulated& mesh, const std::vector<pstripack::UnitVector>& unit) : mesh_(mesh), unit_(unit) {}

  /// Prepares the fit at a node.
  void at(std::int32_t node) {
    const auto index = [](std::int32_t i) { return static_cast<std::size_t>(i) - 1; };
    const pstripack::Direction p{unit_[index(node)], mesh_.at(node)};
    tangent_ = tangents(p.high);
    two_rings(pstripack::ListReader<std::int32_t>(mesh_.lists), node, rings_);
    places_.clear();
    double longest = 0;  // squared
    for (const std::int32_t other : rings_) {
      Point d = difference(unit_[index(other)], p);
      if (dot(d, d) < 0x1p-90) d = accurate_difference(mesh_.direction(other), p);
      places_.push_back({dot(d, tangent_[0]), dot(d, tangent_[1]), dot(d, d)});
      longest = std::max(longest, dot(d, d));
    }
    scale_ = std::sqrt(longest);
    fit_ = {};
    for (Place& at : places_) {
      at = {at.u / scale_, at.v / scale_, longest / at.weight};
      fit_.add(functions(at), at.weight);
    }
    if (!find_line()) count_ = fit_.factor() && rings_.size() > kQuadratic ? kQuadratic : kLinear;
  }

  /// Of the last node: its neighbours and their neighbours.
  const std::vector<std::int32_t>& nodes() const { return rings_; }

  /// The gradient, if the value at nodes()[k] exceeds that of the node itself by excess(k).
  template <class Excess>
  Point gradient(const Excess& excess) const {
    Numbers right{};
    for (std::size_t k = 0; k < places_.size(); ++k) {
      const Numbers f = count_ == 0 ? Numbers{along(places_[k])} : functions(places_[k]);
      for (int i = 0; i < std::max(count_, 1); ++i) right[i] += places_[k].weight * f[i] * excess(k);
    }
    const double slope = right[0] / spread_;
    const Numbers x = count_ == 0 ? Numbers{slope * axis_[0], slope * axis_[1]} : fit_.solve(right, count_);
    const double u = x[0] / scale_, v = x[1] / scale_;
    return {u * tangent_[0].x + v * tangent_[1].x, u * tangent_[0].y + v * tangent_[1].y,
            u * tangent_[0].z + v * tangent_[1].z};
  }

 private:
  struct Place {
    double u, v, weight;
  };
  static Numbers functions(const Place& p) { return {p.u, p.v, p.u * p.u, p.u * p.v, p.v * p.v}; }

  /// The length of the arc to a place on the line.
  double along(const Place& p) const {
    const double sine = scale_ * (axis_[0] * p.u + axis_[1] * p.v);
    return std::asin(std::clamp(sine, -1.0, 1.0)) / scale_;
  }

  /// True if the nodes lie on a great circle through the node, up to 1e-4 of their distances: they do not
  /// determine the slope across it.
  bool find_line() {
    constexpr double kMostAcross = 1e-8;  // squared, relative
    double uu = 0, uv = 0, vv = 0;
    for (const Place& p : places_)
      uu += p.weight * p.u * p.u, uv += p.weight * p.u * p.v, vv += p.weight * p.v * p.v;
    const double angle = 0.5 * std::atan2(2 * uv, uu - vv);
    axis_ = {std::cos(angle), std::sin(angle)};
    double across = 0;
    spread_ = 0;
    for (const Place& p : places_) {
      const double off = axis_[0] * p.v - axis_[1] * p.u;
      across += p.weight * off * off;
      spread_ += p.weight * along(p) * along(p);
    }
    count_ = 0;
    return across <= kMostAcross * spread_;
  }

  const Triangulated& mesh_;
  const std::vector<pstripack::UnitVector>& unit_;
  std::array<Point, 2> tangent_{};
  std::vector<std::int32_t> rings_;
  std::vector<Place> places_;  // of these in the tangents, over scale_
  double scale_ = 1;
  LeastSquares fit_;
  int count_ = 0;                 // of its functions; 0: a straight line is fitted
  std::array<double, 2> axis_{};  // principal axis of the places
  double spread_ = 0;             // along it
};

/// Calls use(node, fit) for all nodes, from 1, on threads.
template <class Use>
void for_each_fit(const Triangulated& mesh, const Use& use) {
  const std::vector<pstripack::UnitVector> unit = unit_vectors_of(mesh);
  const int threads = pstripack::threads_for(100 * unit.size());
  pstripack::ErrorsOfThreads errors(static_cast<std::size_t>(threads));
  pstripack::parallel_pieces(unit.size(), threads, [&](std::size_t first, std::size_t last, int piece) {
    errors.keep(static_cast<std::size_t>(piece), [&] {
      Fit fit(mesh, unit);
      for (auto i = first; i < last; ++i) {
        fit.at(static_cast<std::int32_t>(i) + 1);
        use(i, fit);
      }
    });
  });
  errors.rethrow();
}

}  // namespace

std::vector<Point> gradients(const Triangulated& mesh, const NodeValues& values) {
  std::vector<Point> result(mesh.lists.n * values.columns);
  for_each_fit(mesh, [&](std::size_t i, const Fit& fit) {
    for (std::size_t column = 0; column < values.columns; ++column) {
      const auto value = [&](std::size_t node) { return values.first[node * values.stride + column]; };
      result[i * values.columns + column] = fit.gradient(
          [&](std::size_t k) { return value(static_cast<std::size_t>(fit.nodes()[k]) - 1) - value(i); });
    }
  });
  return result;
}

GradientTerms gradient_terms(const Triangulated& mesh) {
  GradientTerms all(mesh.lists.n);
  for_each_fit(mesh, [&](std::size_t i, const Fit& fit) {
    for (std::size_t k = 0; k < fit.nodes().size(); ++k)
      all[i].push_back(
          {fit.nodes()[k], fit.gradient([&](std::size_t other) { return other == k ? 1.0 : 0.0; })});
  });
  return all;
}

}  // namespace methods
