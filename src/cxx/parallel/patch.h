#pragma once
// One patch: the triangulation of its own nodes and of those around. In order: triangulate what it knows,
// compare lists with other patches, learn, read off the rings.

#include <array>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "base/workspace.h"
#include "parallel/local_numbers.h"
#include "parallel/partition.h"
#include "parallel/patch_hull.h"
#include "parallel/patch_lists.h"
#include "parallel/patch_questions.h"
#include "parallel/places.h"
#include "parallel/record.h"

namespace pstripack {

/// Sums over stars.
struct StarSums {
  std::int64_t nodes = 0, neighbours = 0, boundary = 0;  ///< boundary: nodes at the boundary

  void operator+=(const StarSums& other) {
    nodes += other.nodes, neighbours += other.neighbours, boundary += other.boundary;
  }
  /// Euler's formula. V nodes, F triangles and B boundary arcs of a sphere (B = 0) or a disc have
  /// V - (F + B)/2 = 2 or 1. A star has as many triangles as neighbours; at the boundary, one less.
  bool are_of_sphere_or_disc() const {
    return 6 * nodes - neighbours - 2 * boundary == (boundary > 0 ? 6 : 12);
  }
};

/// Int: a type that holds all node numbers. A patch without own nodes has no hull.
template <class Int>
class Patch {
 public:
  /// The nodes must outlive set_up().
  Patch(PatchNumber id, const Partition& partition, const Places& places, const PatchNodes& nodes)
      : id_(id), partition_(&partition), nodes_(nodes), hull_(places) {}

  /// Memory for set_up(). `closing`: nodes of the global sample.
  std::size_t workspace_bytes(std::size_t closing) const {
    return nodes_.own == 0 ? 0 : PatchHull<Int>::workspace_bytes(nodes_.count() + closing);
  }

  /// Sorts the patch's nodes and those of `closing` that it does not know: nodes of the sample, three of
  /// them not on one great circle, which close the hull on the far side of the sphere. The workspace must
  /// outlive the patch and its rings. Throws HiddenNode if a quick test finds one, std::bad_alloc.
  void set_up(const std::vector<Record>& closing, Workspace& workspace);
  /// Triangulates them. Throws HiddenNode, std::bad_alloc.
  void triangulate();

  /// Adds nodes of other patches to the triangulation, unless it has them. Many are added along a curve, so
  /// that the search for each begins near it. Throws HiddenNode, std::bad_alloc.
  void take_in(std::vector<Record> nodes);

  /// The answer of this patch to another's question: some nodes that lie above the triangle, if it knows any.
  /// A patch that answers takes in the corners of the question. Throws HiddenNode, std::bad_alloc.
  std::vector<Record> answer(const Question& question) {
    assert(nodes_.own > 0);  // among them is a corner
    if (!hull_.coincident().empty()) return {};
    return pstripack::answer(hull_, question);
  }

  /// Finds the triangles that other patches must have, too. Throws std::bad_alloc.
  void update_lists() {
    if (nodes_.own > 0 && partition_->patches() > 1) lists_.update(view());
    listed_ = known();
  }
  const PatchLists<Int>& lists() const { return lists_; }
  /// See PatchLists. Throws std::bad_alloc.
  std::vector<Question> lacking(const std::vector<ListOfOther<Int>>& lists) const {
    if (nodes_.own == 0) return {};
    return lists_.lacking(view(), lists);
  }

  /// After the last lists: the triangulation. Throws HiddenNode.
  void finish();
  /// After finish(): room enough for the entries of all rings of its own nodes: the corners of all triangles,
  /// and for each node one more at the boundary and its count.
  std::size_t entries() const {
    return nodes_.own == 0 ? 0 : 3 * finished_.face_count + 2 * finished_.node_count;
  }

  /// After finish(): room for `bytes` in the workspace, in place of what is not needed any more; null if
  /// there is not enough.
  void* room_for_rings(std::size_t bytes) const { return hull_.room_for_rings(bytes); }

  /// Writes the rings of its own nodes to `out`, which has room for all and 2*kBlock entries more; calls
  /// visit(i, place, count) for each: the ring of its node i lies at `place`; soon(i) some time before.
  template <class Visit, class Soon>
  StarSums write_rings(Int* out, const Visit& visit, const Soon& soon) const {
    const Int* const end = hull_.write_rings(finished_, out, visit, soon);
    const auto own = static_cast<std::int64_t>(nodes_.own);
    StarSums sums{own, end - out - own, 0};
    if (nodes_.own == 0 || finished_.surrounds_centre) return sums;
    for (HullNode v = 0; v < hull_.built(); ++v) sums.boundary += hull_.is_own(v) && finished_.at_back[v];
    return sums;
  }

  /// After finish(): calls visit(r, v) for each node v of the hull that rank r did not bring and that is a
  /// neighbour of a node that r brought, perhaps more than once. Rank r brought the own nodes [own_from[r],
  /// own_from[r+1]).
  template <class Visit>
  void for_each_missing_neighbour(const std::vector<std::size_t>& own_from, const Visit& visit) const;

  Record node(HullNode v) const { return hull_.node(v); }

  PatchNumber id() const { return id_; }
  std::size_t own() const { return nodes_.own; }
  std::size_t known() const { return nodes_.own > 0 ? hull_.growing().node_count() : 0; }
  /// The numbers of different nodes in the same direction, as far as it has found them.
  const CoincidentPairs& coincident() const { return hull_.coincident(); }

 private:
  PatchView<Int> view() const { return {id_, *partition_, hull_}; }

  PatchNumber id_;
  const Partition* partition_;
  PatchNodes nodes_;
  PatchHull<Int> hull_;
  PatchLists<Int> lists_;
  std::size_t listed_ = 0;  ///< known() when the lists were made
  Hull finished_;
};

template <class Int>
template <class Visit>
void Patch<Int>::for_each_missing_neighbour(const std::vector<std::size_t>& own_from,
                                            const Visit& visit) const {
  if (nodes_.own == 0) return;
  // Often one rank brought all own nodes. It misses nodes of other patches only.
  for (RankNumber r = 0; r + 1 < own_from.size(); ++r) {
    if (own_from[r + 1] - own_from[r] != nodes_.own) continue;
    std::vector<bool> is_told(finished_.node_count);
    lists_.for_each_face([&](HullFace t) {
      for (int i = 0; i < 3; ++i) {
        const HullNode v = hull_.face(t).vertex[i];
        if (hull_.is_own(v) || is_told[v]) continue;
        is_told[v] = true;
        visit(r, v);
      }
    });
    return;
  }
  constexpr RankOfNode kNoRank = UINT32_MAX;
  // The rank that brought each own node; by hull node, kNoRank for nodes of other patches.
  std::vector<RankOfNode> of_own(nodes_.own), bringer(finished_.node_count, kNoRank);
  for (RankNumber r = 0; r + 1 < own_from.size(); ++r)
    for (std::size_t i = own_from[r]; i < own_from[r + 1]; ++i) of_own[i] = static_cast<RankOfNode>(r);
  for (HullNode v = 0; v < hull_.built(); ++v)
    if (hull_.is_own(v)) bringer[v] = of_own[hull_.index(v)];
  // The two ranks that were told last of each node: most are missed by one or two, in several faces.
  std::vector<std::array<RankOfNode, 2>> told(finished_.node_count, {kNoRank, kNoRank});
  const auto tell = [&](RankOfNode r, HullNode v) {
    auto& [last, before] = told[v];
    if (r == kNoRank || r == last || r == before) return;
    before = std::exchange(last, r);
    visit(RankNumber{r}, v);
  };
  for (HullFace t = 0; t < finished_.face_count; ++t) {
    const HullNode* const v = hull_.face(t).vertex;
    const RankOfNode rank[3] = {bringer[v[0]], bringer[v[1]], bringer[v[2]]};
    if ((rank[0] == rank[1] && rank[1] == rank[2]) || !finished_.front(t)) continue;
    for (std::uint32_t i = 0; i < 3; ++i) {
      const std::uint32_t j = next_edge(i);
      if (rank[i] == rank[j]) continue;
      tell(rank[i], v[j]);
      tell(rank[j], v[i]);
    }
  }
}

}  // namespace pstripack
