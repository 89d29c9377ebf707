#pragma once
// What patches ask each other. Why the stars are final when no question is left: docs/parallel.md.

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "parallel/partition.h"
#include "parallel/patch_hull.h"
#include "parallel/record.h"

namespace pstripack {

/// "Does any of your nodes lie above this triangle?" Or, of an arc a -> b of the boundary, where the third
/// corner is the centre: "Is it an arc of your boundary?"
struct Question {
  Record corner[3];
  PatchNumber from, to;

  bool is_about_arc() const { return corner[2].point == Point{0, 0, 0}; }
  int corners() const { return is_about_arc() ? 2 : 3; }
};

/// What a patch is not certain of yet.
struct Doubts {
  std::vector<Question> questions;
  std::size_t arcs = 0;          ///< number of the questions that are about arcs of the boundary
  bool has_grown = false;        ///< the patch has taken in nodes since it asked last
  bool has_many_claims = false;  ///< to compare with another patch, or has settled some
  bool has_new_claims = false;   ///< it has grown, or there are new hubs: see Patch::claim
  bool left_out = false;         ///< it has more questions than it asks
};

/// What a patch has asked about.
struct Asked {
  std::size_t nodes = 0;          ///< number of nodes when it asked last; 0: it has not asked yet
  std::vector<BoundaryArc> arcs;  ///< when it asked last
  std::vector<HullNode> around;   ///< nodes of others that were neighbours of own ones when it asked
  std::vector<bool> is_around;

  void meet(HullNode v) {
    if (is_around[v]) return;
    is_around[v] = true;
    around.push_back(v);
  }
};

/// One of the patches, and what it knows.
template <class Int>
struct PatchView {
  PatchNumber id;
  const Partition& partition;
  const PatchHull<Int>& hull;
  PatchNumber owner(HullNode v) const { return hull.is_own(v) ? id : partition.owner(hull.place(v)); }
};

/// The vertex of face t with the smallest number. Names of triangles begin there, so that each has one.
template <class Int>
std::uint32_t first_vertex(const PatchHull<Int>& hull, HullFace t) {
  const auto& vertex = hull.face(t).vertex;
  std::uint32_t first = 0;
  for (const std::uint32_t i : {1, 2})
    if (hull.number(vertex[i]) < hull.number(vertex[first])) first = i;
  return first;
}

/// A question about face t of the hull. The caller sets `to`.
template <class Int>
Question question_about(const PatchView<Int>& patch, HullFace t);

/// Asks about the arcs of the boundary. Throws std::bad_alloc.
template <class Int>
void ask_about_arcs(const PatchView<Int>& patch, const std::array<Record, 3>& corners, Asked& asked,
                    Doubts& doubts);

/// See Patch::ask. Throws std::bad_alloc.
template <class Int>
Doubts ask(const PatchView<Int>& patch, const std::array<Record, 3>& corners, double stretch,
           std::size_t most, Asked& asked);

/// See Patch::answer. Throws HiddenNode, std::bad_alloc.
template <class Int>
std::vector<Record> answer(PatchHull<Int>& hull, const Question& question);

}  // namespace pstripack
