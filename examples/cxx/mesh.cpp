// Triangulates 1000 nodes on the unit sphere and adds up the areas of the triangles; built by CMake.
//
// $ cmake -B build
// $ cmake --build build
// $ build/mesh
#include <pstripack.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <stdexcept>
#include <vector>

struct Nodes {
  std::vector<double> x, y, z;
};

struct Triangle {
  std::int32_t a, b, c;  // counterclockwise, from 0
};

std::vector<Triangle> triangulate(const Nodes& nodes) {
  const auto n = static_cast<std::int32_t>(nodes.x.size());
  if (n < 3) throw std::invalid_argument(pstripack_strerror(PSTRIPACK_TOO_FEW_NODES));
  std::vector<std::int32_t> list(6 * n - 12), lptr(6 * n - 12), lend(n);
  std::int32_t lnew;
  const std::int32_t ier = pstripack_trmesh(n, nodes.x.data(), nodes.y.data(), nodes.z.data(), list.data(),
                                            lptr.data(), lend.data(), &lnew);
  if (ier != PSTRIPACK_OK) throw std::runtime_error(pstripack_strerror(ier));

  // Node k and two consecutive neighbours form a triangle. List it only at its smallest corner. (If the nodes
  // lie in a hemisphere, the last neighbour of a boundary node is negative and forms no triangle with the
  // first.)
  std::vector<Triangle> triangles;
  triangles.reserve(2 * n - 4);
  for (std::int32_t k = 1; k <= n; ++k) {
    std::int32_t slot = lend[k - 1];
    do {
      const std::int32_t neighbour = list[slot - 1];
      slot = lptr[slot - 1];
      const std::int32_t next = std::abs(list[slot - 1]);
      if (neighbour > k && next > k) triangles.push_back({k - 1, neighbour - 1, next - 1});
    } while (slot != lend[k - 1]);
  }
  return triangles;
}

// Area on the unit sphere (Van Oosterom and Strackee).
double area(const Nodes& nodes, const Triangle& t) {
  const auto& [x, y, z] = nodes;
  const auto dot = [&](int i, int j) { return x[i] * x[j] + y[i] * y[j] + z[i] * z[j]; };
  const double det = x[t.a] * (y[t.b] * z[t.c] - z[t.b] * y[t.c]) +
                     y[t.a] * (z[t.b] * x[t.c] - x[t.b] * z[t.c]) +
                     z[t.a] * (x[t.b] * y[t.c] - y[t.b] * x[t.c]);
  return 2 * std::atan2(det, 1 + dot(t.a, t.b) + dot(t.b, t.c) + dot(t.c, t.a));
}

int main() try {
  // A spiral from pole to pole, a golden angle from node to node.
  constexpr int n = 1000;
  Nodes nodes;
  for (int k = 0; k < n; ++k) {
    const double longitude = k * std::acos(-1.0) * (3 - std::sqrt(5.0)), z = 1 - (2 * k + 1.0) / n;
    nodes.x.push_back(std::sqrt(1 - z * z) * std::cos(longitude));
    nodes.y.push_back(std::sqrt(1 - z * z) * std::sin(longitude));
    nodes.z.push_back(z);
  }

  const std::vector<Triangle> triangles = triangulate(nodes);
  double sum = 0;
  for (const Triangle& triangle : triangles) sum += area(nodes, triangle);
  std::printf("%d nodes, %zu triangles, area %.6f\n", n, triangles.size(), sum);
} catch (const std::exception& error) {
  std::fprintf(stderr, "%s\n", error.what());
  return EXIT_FAILURE;
}
