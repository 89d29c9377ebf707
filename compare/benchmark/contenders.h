#pragma once
// The contenders: STRIPACK's routines, ours and the original's; CGAL and Qhull for comparison.

#include <functional>
#include <string>
#include <vector>

#include "geometry/point.h"
#include "library.h"

namespace benchmark {

struct Nodes {
  explicit Nodes(const std::vector<pstripack::Point>& points) : all(points) {
    for (const pstripack::Point& p : points) x.push_back(p.x), y.push_back(p.y), z.push_back(p.z);
  }
  int n() const { return static_cast<int>(all.size()); }
  std::vector<pstripack::Point> all;
  std::vector<double> x, y, z;
};

/// The caller's arrays of TRMESH, written once.
struct Lists {
  explicit Lists(int n)
      : list(6 * std::size_t(n) - 12), lptr(list.size()), lend(n), near(n), next(n), dist(n) {}
  std::vector<int> list, lptr, lend, near, next;
  std::vector<double> dist;
  int lnew = 0, ier = 0;
};

/// STRIPACK's routines of one library. They throw std::runtime_error if IER is not 0.
struct Stripack {
  std::function<void(const Nodes&, Lists&)> trmesh;
  std::function<void(int n, const Lists&, int rows, std::vector<int>& ltri)> trlist;
  std::function<void(const Nodes&, Lists&, std::vector<int>& listc, std::vector<double>& centres)> crlist;
};

enum class Routine { trmesh, trlist, crlist };

/// Works like seconds_a_call of measuring.h, into arrays of its own. `lists`: what the routine reads, not for
/// TRMESH.
double seconds_a_call(Routine routine, const Stripack& library, const Nodes& nodes, Lists* lists, int calls);

Stripack ours();
Stripack original(const legacy_stripack::Library& library);
/// A library that triangulates without writing lists.
struct Witness {
  std::string description;  ///< "none found" if the build found none
  /// Returns seconds; sets the number of points that became vertices. Null if the build did not find the
  /// library.
  double (*seconds)(const std::vector<pstripack::Point>& points, std::size_t& vertices);
};
extern const Witness cgal, qhull;

/// Works like seconds_a_call of measuring.h. Throws std::runtime_error if a point does not become a vertex.
double seconds_a_call(const Witness& witness, const std::vector<pstripack::Point>& points, int calls);

}  // namespace benchmark
