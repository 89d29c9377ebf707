#pragma once
// How nodes may be distributed over the ranks, and distributed meshes of them.

#include <algorithm>
#include <cstdint>
#include <functional>
#include <vector>

#include "capi/pstripack_mpi.h"
#include "mpi_test.h"
#include "support/lists.h"

/// The rank of each node (from 0), and whether a rank passes its nodes in reverse.
struct Distribution {
  const char* name;
  std::function<int(std::size_t node, std::size_t nodes)> rank_of_node;
  bool reversed;
};
inline const std::vector<Distribution>& distributions() {
  static const std::vector<Distribution> all = {
      {"slices", [](std::size_t i, std::size_t n) { return int(i * std::size_t(size_of()) / n); }, true},
      {"round robin", [](std::size_t i, std::size_t) { return int(i % std::size_t(size_of())); }, false},
      {"all on the last rank", [](std::size_t, std::size_t) { return size_of() - 1; }, true},
      {"scattered",
       [](std::size_t i, std::size_t) { return int(i * 2654435761u % 1009 % std::size_t(size_of())); }, true},
      {"none on even ranks",
       [](std::size_t i, std::size_t) {
         const std::size_t odd = std::size_t(size_of()) / 2;
         return odd == 0 ? 0 : int(2 * (i % odd) + 1);
       },
       false}};
  return all;
}

/// Those of this rank, in the order in which it passes them.
inline std::vector<std::size_t> nodes_here(const Distribution& d, std::size_t n) {
  std::vector<std::size_t> mine;
  for (std::size_t i = 0; i < n; ++i)
    if (d.rank_of_node(i, n) == rank_of()) mine.push_back(i);
  if (d.reversed) std::reverse(mine.begin(), mine.end());
  return mine;
}

using Number = std::function<std::int64_t(std::size_t)>;  // of the node (from 0)
inline std::int64_t from_one(std::size_t i) { return static_cast<std::int64_t>(i) + 1; }

/// A rank's points and their numbers, as distributed meshes take them.
struct Part {
  Part(const Nodes& nodes, const std::vector<std::size_t>& mine, const Number& number_of = from_one) {
    for (const std::size_t i : mine) {
      xyz.insert(xyz.end(), {nodes[i].x, nodes[i].y, nodes[i].z});
      number.push_back(number_of(i));
    }
  }
  /// Every n-th node on n ranks.
  explicit Part(const Nodes& nodes) : Part(nodes, nodes_here(distributions()[1], nodes.size())) {}
  std::int64_t count() const { return static_cast<std::int64_t>(number.size()); }
  std::int32_t triangulate(pstripack_mesh* mesh) const {
    return pstripack_mesh_triangulate(mesh, count(), xyz.data(), number.data());
  }
  std::vector<double> xyz;
  std::vector<std::int64_t> number;
};

class OfMesh {
 public:
  OfMesh() { EXPECT_EQ(pstripack_mesh_create(MPI_COMM_WORLD, &mesh_), 0); }
  ~OfMesh() { pstripack_mesh_free(mesh_); }
  OfMesh(const OfMesh&) = delete;
  OfMesh& operator=(const OfMesh&) = delete;
  operator pstripack_mesh*() const { return mesh_; }

 private:
  pstripack_mesh* mesh_ = nullptr;
};

struct Sizes {
  explicit Sizes(const pstripack_mesh* mesh) {
    pstripack_mesh_sizes(mesh, &points, &arcs, &triangles, &halo);
  }
  std::int64_t points, arcs, triangles, halo;
};
