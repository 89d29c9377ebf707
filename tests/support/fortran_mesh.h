#pragma once
// A triangulation in the arrays of Fortran programs, made and changed by the public symbols of libstripack.

#include <stdexcept>
#include <vector>

#include "differential/routines.h"
#include "lists.h"

struct FortranMesh {
  int n = 0, lnew = 0;
  std::vector<double> x, y, z;
  std::vector<int> list, lptr, lend;

  /// Room for `most` nodes.
  explicit FortranMesh(std::size_t most)
      : x(most), y(most), z(most), list(6 * most - 12), lptr(6 * most - 12), lend(most) {}
  /// The triangulation of these, which must have one.
  explicit FortranMesh(const Nodes& nodes) : FortranMesh(nodes.size()) {
    if (triangulate(nodes) != 0) throw std::runtime_error("IER != 0");
  }

  void place(int node, const pstripack::Point& p) { x[node - 1] = p.x, y[node - 1] = p.y, z[node - 1] = p.z; }
  pstripack::Point node(int k) const { return {x[k - 1], y[k - 1], z[k - 1]}; }

  /// Calls TRMESH; returns IER.
  int triangulate(const Nodes& nodes) {
    n = static_cast<int>(nodes.size());
    for (int k = 1; k <= n; ++k) place(k, nodes[k - 1]);
    int near, next, ier;
    double dist;
    trmesh_(&n, x.data(), y.data(), z.data(), list.data(), lptr.data(), lend.data(), &lnew, &near, &next,
            &dist, &ier);
    return ier;
  }

  int last_neighbour(int k) const { return list[lend[k - 1] - 1]; }  ///< negative at the boundary

  Lists lists() const {
    Lists copy;
    copy.list.assign(list.begin(), list.begin() + 6 * n - 12);
    copy.lptr.assign(lptr.begin(), lptr.begin() + 6 * n - 12);
    copy.lend.assign(lend.begin(), lend.begin() + n);
    copy.lnew = lnew;
    return copy;
  }
};
