#pragma once
// Slices of a mesh: patches for nodes along lines and curves and in nests. There neighbours in the mesh may
// be far from each other in space, so borders of boxes cut most triangles. Neighbours are close in
// Cuthill-McKee order: breadth first through the mesh of a sample, from a node at its end. Slices of that
// order have borders that are as short as a level is narrow.
//
//       boxes                 slices                 Lines that cross: triangles lead from each arm to the
//         :                                          next. Levels are as far from the middle on all arms.
//      \  :  /                \     /
//       \ : /                 1\___/1                 Nodes with very many neighbours, hubs, are left out:
//     ...\:/...               2 \_/ 2                 through them everything is near to everything.
//        /:\                  2 / \ 2
//       / : \                 1/   \1
//      /  :  \                /     \                                                                   .

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "parallel/partition.h"
#include "parallel/record.h"

namespace pstripack {

/// The mesh of a few nodes, which stands for that of all.
class CoarseMesh {
 public:
  /// Has no triangle if all nodes are on one great circle. Throws std::bad_alloc.
  explicit CoarseMesh(const std::vector<Point>& nodes);

  const std::vector<SampleNode>& hubs() const { return hubs_; }
  /// The corners of the triangles without a hub.
  const std::vector<std::array<SampleNode, 3>>& triangles() const { return triangles_; }
  std::size_t triangles_at_hubs() const { return at_hubs_; }

  /// How many triangles without a hub have corners of different owners.
  template <class Owner>
  std::size_t mixed(const Owner& owner) const {
    std::size_t mixed = 0;
    for (const auto& [a, b, c] : triangles_) mixed += owner(a) != owner(b) || owner(b) != owner(c);
    return mixed;
  }

 private:
  std::vector<SampleNode> hubs_;
  std::vector<std::array<SampleNode, 3>> triangles_;
  std::size_t at_hubs_ = 0;
};

/// Cells of a sample, about one node each, in the order in which they are cut into slices.
class Levels {
 public:
  /// `cells` holds the nodes of the mesh, which lie at these places.
  Levels(const CoarseMesh& mesh, const std::vector<Point>& places, const Partition& cells);

  /// The slice that each cell belongs to; slices have about equal weight.
  std::vector<PatchNumber> slices(int count, const std::vector<std::int64_t>& weight) const;

  /// The cell of each node of the mesh.
  const std::vector<CellNumber>& cell_of() const { return cell_of_; }
  /// Cells that share edges of the mesh: those next to cell c are beside()[begin()[c] .. begin()[c + 1] - 1],
  /// perhaps more than once.
  const std::vector<std::uint32_t>& begin() const { return begin_; }
  const std::vector<CellNumber>& beside() const { return beside_; }

 private:
  /// Appends all cells that can be reached from `start`, breadth first, and marks them.
  void reach(CellNumber start, std::uint32_t mark, std::vector<std::uint32_t>& marked,
             std::vector<CellNumber>& order) const;

  std::vector<CellNumber> cell_of_;
  std::vector<std::uint32_t> begin_;
  std::vector<CellNumber> beside_, order_;
};

}  // namespace pstripack
