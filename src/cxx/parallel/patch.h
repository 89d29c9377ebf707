#pragma once
// One patch: the triangulation of its own nodes and of those around. In order: triangulate what it knows,
// compare lists with other patches, learn, read off the rings.

#include <algorithm>
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

  /// Sorts the patch's nodes and those of `closing` that it does not know: nodes from everywhere, three of
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
    if (nodes_.own == 0 || !hull_.coincident().empty()) return {};
    return pstripack::answer(hull_, question);
  }

  /// Finds the triangles that other patches must have, too. Throws std::bad_alloc.
  void update_lists() {
    if (nodes_.own > 0 && partition_->patches() > 1) lists_.update(view(), around_);
  }
  const PatchLists<Int>& lists() const { return lists_; }
  /// See PatchLists. Throws std::bad_alloc.
  std::vector<Question> lacking(const std::vector<ListOfOther<Int>>& lists) const {
    if (nodes_.own == 0) return {};
    return lists_.lacking(view(), lists);
  }

  /// After the last answer: the triangulation. Returns room enough for the entries of all rings of its own
  /// nodes. Throws HiddenNode.
  std::size_t finish();

  /// After finish(): room for `bytes` in the workspace, in place of what is not needed any more; null if
  /// there is not enough.
  void* room_for_rings(std::size_t bytes) const { return hull_.room_for_rings(bytes); }

  /// Writes the rings of its own nodes to `out`, which has room for all and 2*kBlock entries more; calls
  /// visit(i, place, count) for each: the ring of its node i is kept at `place`; soon(i) some time before.
  template <class Visit, class Soon>
  void write_rings(Int* out, const Visit& visit, const Soon& soon) const {
    hull_.write_rings(finished_, out, visit, soon);
  }

  /// After finish(): calls visit(r, node) for each node that rank r did not bring and that is a neighbour of
  /// a node that r brought, perhaps more than once. Rank r brought the own nodes [own_from[r],
  /// own_from[r+1]); `mine` is the rank that brought most of them.
  template <class Visit>
  void for_each_missing_neighbour(RankNumber mine, const std::vector<std::size_t>& own_from,
                                  const Visit& visit) const;

  PatchNumber id() const { return id_; }
  std::size_t own() const { return nodes_.own; }
  std::size_t halo() const { return nodes_.halo; }
  /// The numbers of different nodes in the same direction, as far as it has found them.
  const CoincidentPairs& coincident() const { return hull_.coincident(); }

 private:
  PatchView<Int> view() const { return {id_, *partition_, hull_}; }

  PatchNumber id_;
  const Partition* partition_;
  PatchNodes nodes_;
  PatchHull<Int> hull_;
  PatchLists<Int> lists_;
  Around around_;
  Hull finished_;
};

template <class Int>
template <class Visit>
void Patch<Int>::for_each_missing_neighbour(RankNumber mine, const std::vector<std::size_t>& own_from,
                                            const Visit& visit) const {
  constexpr RankOfNode kNoRank = UINT32_MAX;
  const std::size_t own = nodes_.own;
  if (own == 0) return;
  const std::size_t first = own_from[mine], count = own_from[mine + 1] - first;
  // The rank that brought each own node; empty if `mine` brought all.
  std::vector<RankOfNode> bringer(count < own ? own : 0);
  for (RankNumber r = 0; r + 1 < own_from.size() && count < own; ++r)
    std::fill(bringer.begin() + static_cast<std::ptrdiff_t>(own_from[r]),
              bringer.begin() + static_cast<std::ptrdiff_t>(own_from[r + 1]), static_cast<RankOfNode>(r));
  const auto brought_by = [&](HullNode v) {
    if (!hull_.is_own(v)) return kNoRank;
    return count < own ? bringer[hull_.index(v)] : static_cast<RankOfNode>(mine);
  };
  // The rank that was told last of each hull node: most are missed by one rank, at several of its nodes.
  std::vector<RankOfNode> told(count < own ? finished_.node_count : 0, kNoRank);
  const auto look_around = [&](HullNode v) {
    const RankOfNode r = brought_by(v);
    bool is_missing = false;
    const auto meet = [&](HullNode w) {
      const RankOfNode other = brought_by(w);
      is_missing = is_missing || other == mine;
      if (r == kNoRank || other == r || told[w] == r) return;
      told[w] = r;
      visit(RankNumber{r}, hull_.node(w));
    };
    hull_.for_each_face_at(v, [&](HullFace t, std::uint32_t i) {
      if (!finished_.front(t)) return;
      const Face& f = hull_.face(t);
      meet(f.vertex[next_edge(i)]);
      // The last neighbour of a boundary node; any other is met in the next face.
      if (!finished_.front(face_of(f.neighbour[next_edge(i)]))) meet(f.vertex[previous_edge(i)]);
    });
    if (is_missing) visit(mine, hull_.node(v));
  };
  // Looks around at all nodes but the own ones that `mine` brought: at one of any two neighbours that concern
  // two ranks.
  for (const HullNode v : around_.nodes) look_around(v);
  if (count == own) return;
  for (HullNode v = 0; v < hull_.built(); ++v)
    if (hull_.is_own(v) && hull_.index(v) - first >= count) look_around(v);
}

}  // namespace pstripack
