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

/// The normal equations of a least-squares fit with K functions: sums of their weighted products with each
/// other and with the values.
template <int K>
class LeastSquares {
 public:
  void add(const std::array<double, K>& f, double value, double weight) {
    for (int i = 0; i < K; ++i) {
      for (int j = 0; j <= i; ++j) matrix_[i][j] += weight * f[i] * f[j];
      right_[i] += weight * f[i] * value;
    }
  }

  /// The coefficients, by Cholesky's method. False if the nodes do not determine them.
  bool solve(std::array<double, K>& x) {
    constexpr double kLeast = 1e-9;  // least pivot, relative to its diagonal element
    for (int i = 0; i < K; ++i) {
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
    for (int i = 0; i < K; ++i) {
      x[i] = right_[i];
      for (int k = 0; k < i; ++k) x[i] -= matrix_[i][k] * x[k];
      x[i] /= matrix_[i][i];
    }
    for (int i = K - 1; i >= 0; --i) {
      for (int k = i + 1; k < K; ++k) x[i] -= matrix_[k][i] * x[k];
      x[i] /= matrix_[i][i];
    }
    return true;
  }

 private:
  double matrix_[K][K] = {}, right_[K] = {};  // the lower triangle
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

}  // namespace

std::vector<Point> gradients(const Triangulated& mesh, const std::vector<double>& values) {
  const pstripack::ListReader<std::int32_t> reader(mesh.lists);
  const auto index = [](std::int32_t node) { return static_cast<std::size_t>(node) - 1; };
  std::vector<pstripack::UnitVector> unit(values.size());
  pstripack::parallel_pieces(unit.size(), pstripack::threads_for(unit.size()),
                             [&](std::size_t first, std::size_t last, int) {
                               for (std::size_t i = first; i < last; ++i)
                                 unit[i] = pstripack::unit_vector(mesh.at(static_cast<std::int32_t>(i) + 1));
                             });
  struct Around {
    std::vector<std::int32_t> rings;
    std::vector<Point> sides;  // from the node to these
  };
  const auto gradient = [&](std::int32_t node, Around& around) {
    auto& [rings, sides] = around;
    const pstripack::Direction p{unit[index(node)], mesh.at(node)};
    const std::array<Point, 2> tangent = tangents(p.high);
    two_rings(reader, node, rings);
    sides.clear();
    double longest = 0;  // squared
    for (const std::int32_t other : rings) {
      Point d = difference(unit[index(other)], p);
      if (dot(d, d) < 0x1p-90) d = accurate_difference(mesh.direction(other), p);
      sides.push_back(d);
      longest = std::max(longest, dot(d, d));
    }
    const double scale = std::sqrt(longest);
    LeastSquares<5> quadratic;
    LeastSquares<2> linear;
    for (std::size_t k = 0; k < rings.size(); ++k) {
      const Point& d = sides[k];
      const double u = dot(d, tangent[0]) / scale, v = dot(d, tangent[1]) / scale;
      const double weight = longest / dot(d, d);
      const double value = values[index(rings[k])] - values[index(node)];
      quadratic.add({u, v, u * u, u * v, v * v}, value, weight);
      linear.add({u, v}, value, weight);
    }
    std::array<double, 5> five{};
    std::array<double, 2> two{};
    if (rings.size() > 5 && quadratic.solve(five))
      two = {five[0], five[1]};
    else if (!linear.solve(two))
      two = {0, 0};
    const double u = two[0] / scale, v = two[1] / scale;
    return Point{u * tangent[0].x + v * tangent[1].x, u * tangent[0].y + v * tangent[1].y,
                 u * tangent[0].z + v * tangent[1].z};
  };
  std::vector<Point> result(values.size());
  const int threads = pstripack::threads_for(100 * result.size());
  pstripack::ErrorsOfThreads errors(static_cast<std::size_t>(threads));
  pstripack::parallel_pieces(result.size(), threads, [&](std::size_t first, std::size_t last, int piece) {
    errors.keep(static_cast<std::size_t>(piece), [&] {
      Around around;
      for (std::size_t i = first; i < last; ++i)
        result[i] = gradient(static_cast<std::int32_t>(i) + 1, around);
    });
  });
  errors.rethrow();
  return result;
}

}  // namespace methods
