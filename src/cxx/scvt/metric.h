#pragma once
// The initial metric of the quasi-Newton method: about the inverse of the energy's Hessian, for a few passes
// over the arcs.
//
// Without it, where it is Lloyd's 1/(2 mass), steps are slow on long waves. On a lattice of regular hexagons
// of width d the Hessian over 2 mass has the eigenvalues 0.18 (k d)^2 for longitudinal and 0.042 (k d)^2 for
// transverse waves of the number k, and about 1 for short ones: its condition number is about N.
//
// The Hessian is known (Du and Emelianenko 2006; Liu et al. 2009): with y on the face between the cells of i
// and j, which is l long, and d = |g_j - g_i|,
//     H_ij = 2/d integral of density (g_i-y) (g_j-y)^T = -density (l d/2 n n^T - l^3/(6 d) t t^T)
// where n = (g_j-g_i)/d, t is along the face, and the face is halfway; rotations change nothing. A is what is
// left without t, which is what can make H indefinite, and is small (1 to 9 in hexagons): each arc is a
// spring,
//     u.A u = sum over arcs of k (n.(u_i-u_j))^2,   k = density l d/2.
// Each half of l d/2 is the part of a cell between its generator and the face, so k is about
// mass_i/sides_i + mass_j/sides_j, which is never 0. In long waves the eigenvalues of H over those of A are
// between 2/3 (transverse) and 0.96 (longitudinal): what is left for L-BFGS has a small condition number.
//
// A z = v is solved by kPasses steps of Chebyshev's semi-iteration (Golub and Varga 1961) with the diagonal
// D, D_i the largest eigenvalue of i's springs, sum of k n n^T. The eigenvalues of A/D are at most 2, since
// (n.(u_i-u_j))^2 <= 2 (n.u_i)^2 + 2 (n.u_j)^2, and those above 2/kPasses^2 are solved within 27 %. So
// z = P v, P is symmetric and positive definite, and the condition number is smaller by about kPasses^2. All
// of it needs sums over neighbours only: same bits for any number of threads and ranks.

#include <cstddef>
#include <vector>

#include "scvt/cells.h"
#include "scvt/evaluator.h"
#include "scvt/halo.h"

namespace pstripack::scvt {

/// Of the generators of a level. Collective; throws AgreedFailure.
class Metric {
 public:
  explicit Metric(Communicator& ranks) : ranks_(ranks), halo_(ranks) {}

  /// From now on that of these generators; their lists must stay as they are until the last solve().
  void set(const Neighbourhood& here, const Cells& cells);
  /// A vector v for each generator becomes P v, at right angles to the generator within rounding of floats.
  void solve(std::vector<Point>& v);

 private:
  /// Four floats in one register: those of a vector, and 0. The metric needs no more digits.
  struct Vector {
    float f __attribute__((vector_size(16)));
  };

  Communicator& ranks_;
  Halo halo_;
  NeighbourLists stars_;
  std::vector<double> share_;     ///< of the mass of each point: that of a spring
  std::vector<double> diagonal_;  ///< D of each generator
  std::vector<float> spring_;     ///< of each arc of i: k/(d^2 D_i)
  std::vector<Vector> points_, rest_, step_, next_, sum_;
};

}  // namespace pstripack::scvt
