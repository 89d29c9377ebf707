#pragma once
// A mesh whose nodes move, and new triangulations to compare with.

#include <algorithm>
#include <cstdint>
#include <optional>
#include <vector>

#include "hull_rings.h"
#include "mesh/flips.h"

/// The canonical lists of a new triangulation. Empty unless a moving mesh may have these nodes: they surround
/// the centre, the predicates are those on coordinates unless those on directions are wanted, and no two
/// coincide.
inline std::optional<Lists> made_anew(const Nodes& nodes,
                                      pstripack::Lengths lengths = pstripack::Lengths::automatic) {
  const bool ones = std::all_of(nodes.begin(), nodes.end(), pstripack::length_is_one);
  using namespace pstripack;
  Workspace workspace(workspace_bytes(nodes.size()) + 48 * nodes.size());
  const Hull hull = delaunay(nodes.data(), nodes.size(), workspace, lengths);
  const Lengths wanted = lengths == Lengths::automatic ? Lengths::as_given : lengths;
  if (!ones || !hull.surrounds_centre || hull.lengths != wanted || !hull.coincident.empty()) return {};
  return canonical_lists(rings_of_hull(hull, nodes.size()));
}

/// A mesh, and its lists, which are updated from the changes.
class Follower {
 public:
  Follower(const Nodes& nodes, const Lists& lists)
      : mesh_(nodes.data(), nodes.size(), lists.list.data(), lists.lend.data()), rings_(*rings_of(lists)) {}

  /// The lists of these nodes if the mesh can follow. Refuses lengths other than 1, as users of the mesh
  /// must.
  std::optional<Lists> follow(const Nodes& nodes, pstripack::Confirm confirm = pstripack::Confirm::nothing) {
    const auto fits = [&](const pstripack::Point& p) { return has_length_for(confirm, p); };
    if (!std::all_of(nodes.begin(), nodes.end(), fits)) return {};
    for (std::size_t k = 0; k < nodes.size(); ++k) mesh_.node(k) = nodes[k];
    if (!mesh_.repair(confirm)) return {};
    for (const auto& [k, count] : mesh_.changes()) {
      std::vector<std::int32_t> ring(count);
      mesh_.write_ring(k, ring.data());
      for (std::int32_t& v : ring) --v;
      rings_.neighbours[k] = ring;
    }
    flips += mesh_.flips();
    Lists lists = canonical_lists(rings_);
    if (mesh_.changes().size() > nodes.size() / 4) mesh_.forget_changes();
    return lists;
  }
  std::size_t flips = 0;

 private:
  pstripack::MovingMesh mesh_;
  Rings rings_;
};
