#pragma once
// Numbers that mean something on one rank only, and those of ranks and patches. All count from 0. The number
// of a node that all ranks know is a GlobalNumber.

#include <cstddef>
#include <cstdint>

namespace pstripack {

/// A rank: < Communicator::size(). Communicator and Homes count in int, as MPI does.
using RankNumber = std::size_t;
/// The same in an array or a message that has it for every node.
using RankOfNode = std::uint32_t;

/// A patch among those of all ranks: < PatchRanges::count(); -1: none, or several.
using PatchNumber = std::int32_t;
/// The same in an array that has it for every node: an index, so without -1.
using PatchOfNode = std::uint32_t;

/// A patch among those of this rank: its PatchNumber less PatchRanges::first(this rank).
using PatchHere = std::size_t;

/// A node among LocalNodes, those that this rank brings: < 2^29. Loops count in std::size_t.
using LocalNode = std::uint32_t;

/// A node among those that this rank brought in the last call.
using LastNode = std::uint32_t;

/// A node among PatchNodes, those that a patch is given: first its own ones, then its margin. The nodes from
/// everywhere come after these. Its HullNode is another number: the hull has them along a curve.
using PatchNode = std::uint32_t;

/// A node that another rank brings and that is a neighbour of nodes here: which of the nodes outside. In the
/// cached mesh it is MeshNode (mesh/flips.h) count + j, after the LocalNodes.
enum class OutsideNode : std::uint32_t {};
constexpr std::uint32_t index_of(OutsideNode node) { return static_cast<std::uint32_t>(node); }

}  // namespace pstripack
