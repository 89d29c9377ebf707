#include "scvt/widths.h"

#include <algorithm>
#include <cmath>
#include <vector>

#include "scvt/errors.h"
#include "scvt/vectors.h"

namespace pstripack::scvt {
namespace {

/// A square on a face of the cube around the unit sphere.
struct Square {
  int face;
  double u, v, side;  ///< its corner with the smallest u and v
  double integral;
};

/// The integrals of width^-2 over the parts of the sphere in front of the squares, by Gauss' rule with 3 x 3
/// points.
void integrate(const Density& widths, std::vector<Square>& squares) {
  constexpr double kPlaces[] = {0.1127016653792583, 0.5, 0.8872983346207417}, kWeights[] = {5, 8, 5};  // / 18
  constexpr std::size_t kTogether = 4096;
  std::vector<Point> places;
  std::vector<double> weights, values;
  for (std::size_t first = 0; first < squares.size(); first += kTogether) {
    const std::size_t last = std::min(first + kTogether, squares.size());
    places.clear(), weights.clear();
    for (std::size_t s = first; s < last; ++s)
      for (int i = 0; i < 3; ++i)
        for (int j = 0; j < 3; ++j) {
          const Square& square = squares[s];
          const double u = square.u + kPlaces[i] * square.side, v = square.v + kPlaces[j] * square.side;
          const double length = 1 + u * u + v * v;
          places.push_back(on_face(square.face, u, v));
          weights.push_back(kWeights[i] * kWeights[j] / 324 * square.side * square.side /
                            (length * std::sqrt(length)));
        }
    values.resize(places.size());
    widths.at(places.size(), places.data(), values.data());
    for (std::size_t s = first; s < last; ++s) {
      squares[s].integral = 0;
      for (std::size_t k = 9 * (s - first); k < 9 * (s - first + 1); ++k) {
        if (!(values[k] > 0 && std::isfinite(values[k]))) throw BadDensity(places[k], values[k], 1, true);
        squares[s].integral += weights[k] / (values[k] * values[k]);
      }
    }
  }
}

}  // namespace

double cells_of_widths(const Density& widths, double radius) {
  constexpr int kAcross = 64, kLevels = 7;
  constexpr double kNegligible = 1e-8;  ///< change of the integral by a square's four quarters, of the whole
  constexpr std::size_t kMost = 300000;
  std::vector<Square> squares, quarters;
  for (int face = 0; face < 6; ++face)
    for (int i = 0; i < kAcross; ++i)
      for (int j = 0; j < kAcross; ++j)
        squares.push_back({face, 2.0 * i / kAcross - 1, 2.0 * j / kAcross - 1, 2.0 / kAcross, 0});
  integrate(widths, squares);
  double settled = 0;
  for (int level = 0; level < kLevels && !squares.empty(); ++level) {
    quarters.clear();
    for (const Square& s : squares)
      for (const double u : {s.u, s.u + s.side / 2})
        for (const double v : {s.v, s.v + s.side / 2}) quarters.push_back({s.face, u, v, s.side / 2, 0});
    integrate(widths, quarters);
    double whole = settled;
    for (const Square& q : quarters) whole += q.integral;
    std::vector<Square> next;
    for (std::size_t i = 0; i < squares.size(); ++i) {
      double sum = 0;
      for (std::size_t k = 4 * i; k < 4 * i + 4; ++k) sum += quarters[k].integral;
      if (std::fabs(sum - squares[i].integral) <= kNegligible * whole)
        settled += sum;
      else
        next.insert(next.end(), &quarters[4 * i], &quarters[4 * i] + 4);
    }
    squares = std::move(next);
    if (squares.size() > kMost) break;
  }
  for (const Square& s : squares) settled += s.integral;
  return settled * radius * radius / (std::sqrt(3.0) / 2);
}

void densities_of_widths(std::size_t n, const Point* p, double* widths) {
  for (std::size_t i = 0; i < n; ++i) {
    if (!(widths[i] > 0 && std::isfinite(widths[i]))) throw BadDensity(p[i], widths[i], 1, true);
    const double square = 1 / (widths[i] * widths[i]);
    widths[i] = square * square;
  }
}

}  // namespace pstripack::scvt
