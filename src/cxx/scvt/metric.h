#pragma once
// The initial metric of the quasi-Newton method: an approximate inverse of the energy's Hessian, at the
// cost of a few passes over the arcs.
//
// With the simpler metric 1/(2 mass), which is Lloyd's step, long waves converge slowly. On a lattice of
// regular hexagons of width d the Hessian over 2 mass has the eigenvalues 0.18 (k d)^2 for longitudinal and
// 0.042 (k d)^2 for transverse waves of wave number k, and about 1 for short waves: its condition number is
// about N.
//
// The Hessian is known (Du and Emelianenko 2006; Liu et al. 2009). With y on the edge between the cells of i
// and j, which has the length l, and d = |g_j - g_i|,
//     H_ij = 2/d integral of density (g_i-y) (g_j-y)^T = -density (l d/2 n n^T - l^3/(6 d) t t^T)
// where n = (g_j-g_i)/d, t is the direction of the edge, and the edge is taken to be halfway; rotations
// change nothing. A is H without the terms in t, which can make H indefinite and are small (1 to 9 in
// hexagons). Then each arc is a spring,
//     u.A u = sum over arcs of k (n.(u_i-u_j))^2,   k = density l d/2.
// Each half of l d/2 is the part of a cell between its generator and the edge, so k is about mass_i/sides_i
// + mass_j/sides_j, which is never 0. For long waves the ratios of the eigenvalues of H to those of A are
// between 2/3 (transverse) and 0.96 (longitudinal): the condition number left for L-BFGS is small.
//
// A z = v is solved by kPasses steps of Chebyshev's semi-iteration (Golub and Varga 1961) with the diagonal
// D, where D_i is the largest eigenvalue of the sum of k n n^T over i's springs. The eigenvalues of A/D are
// at most 2, since (n.(u_i-u_j))^2 <= 2 (n.u_i)^2 + 2 (n.u_j)^2, and components with eigenvalues above
// 2/kPasses^2 are solved within 27 %. So z = P v with P symmetric and positive definite, and the condition
// number is smaller by about kPasses^2. All this needs sums over neighbours only, so it has the same bits
// for any number of threads and ranks. (Preconditioned L-BFGS: Jiang, Byrd, Eskow and Schnabel, University of
// Colorado CU-CS-982-04, 2004; for centroidal tessellations, with a graph Laplacian, Hateley, Wei and Chen,
// J. Sci. Comput. 63, 2015.)

#include <vector>

#include "parallel/halo.h"
#include "scvt/cells.h"
#include "scvt/evaluator.h"

namespace pstripack::scvt {

/// The metric of the generators of one level. All members are collective and throw AgreedFailure.
class Metric {
 public:
  explicit Metric(Communicator& ranks) : ranks_(ranks) {}

  /// Sets the metric to that of these generators. Their lists must stay unchanged until the last solve().
  void set(const Neighbourhood& here, const Cells& cells);
  /// Replaces v, a vector for each generator, by P v, which is perpendicular to the generators up to float
  /// rounding.
  void solve(std::vector<Point>& v);

 private:
  /// x, y, z and 0 in one register. Single precision is enough for the metric.
  struct Vector {
    float f __attribute__((vector_size(16)));
  };

  /// values: by point, those of the halo are set to what their owners have.
  template <class Value>
  void fill(std::vector<Value>& values, Halo::Transfer& transfer) {
    halo_->fetch<Value>(
        ranks_, transfer, [&](LocalNode k) { return values[k]; },
        [&](OutsideNode j, const Value& value) { values[stars_.count + index_of(j)] = value; });
  }

  Communicator& ranks_;
  const Halo* halo_ = nullptr;
  Halo::Transfer of_doubles_, of_vectors_;
  NeighbourLists stars_;
  std::vector<double> share_;     ///< by point: mass / sides
  std::vector<double> diagonal_;  ///< by generator: D
  std::vector<float> spring_;     ///< by arc of i: k/(d^2 D_i)
  std::vector<Vector> points_, rest_, step_, next_;
};

}  // namespace pstripack::scvt
