#pragma once
// One patch: the triangulation of its own nodes and of those around, and which of its triangles are final.
// In order: triangulate what it knows, ask about what it cannot know, learn, read off the rings.

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <unordered_set>
#include <utility>
#include <vector>

#include "base/workspace.h"
#include "parallel/local_numbers.h"
#include "parallel/partition.h"
#include "parallel/patch_agreement.h"
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

  /// What is not certain yet of the stars of its own nodes, as questions to the patches that may know better.
  /// Every star is the star in the triangulation of all nodes when no patch has a question about triangles
  /// and, if any has one about arcs, none has grown. `corners`: three nodes that every patch knows, not on
  /// one great circle. `stretch`: most_stretch of nodes that it has taken in, or infinity. With more than
  /// `most` questions it stops: nobody will answer them. Throws HiddenNode, std::bad_alloc.
  Doubts ask(const std::array<Record, 3>& corners, double stretch, std::size_t most) {
    if (nodes_.own == 0 || partition_->patches() == 1) return {};
    Doubts doubts = pstripack::ask(view(), corners, stretch, most, asked_);
    questions_ += static_cast<std::int64_t>(doubts.questions.size() - doubts.arcs);
    return doubts;
  }

  /// Adds nodes of other patches to the triangulation, unless it has them. Many are added along a curve, so
  /// that the search for each begins near it. Throws HiddenNode, std::bad_alloc.
  void take_in(std::vector<Record> nodes);

  /// The answer of this patch to another's question: nodes that lie above the triangle, or that show that the
  /// arc is not on the boundary. Empty if it knows no such nodes. A patch that answers takes in the corners
  /// of the question. Throws HiddenNode, std::bad_alloc.
  std::vector<Record> answer(const Question& question) {
    if (nodes_.own == 0 || !hull_.coincident().empty()) return {};
    return pstripack::answer(hull_, question);
  }

  // Certification by lists.

  /// Finds the triangles that other patches must have, too. Throws std::bad_alloc.
  void update_lists() {
    if (nodes_.own > 0 && partition_->patches() > 1) lists_.update(view(), asked_);
  }
  const PatchLists<Int>& lists() const { return lists_; }
  /// See PatchLists. Throws std::bad_alloc.
  std::vector<Question> lacking(const std::vector<ListOfOther<Int>>& lists) const {
    if (nodes_.own == 0) return {};
    return lists_.lacking(view(), lists);
  }

  // Certification by agreement, where there would be too many questions: docs/parallel.md, "Agreement".

  /// Finds what other patches must agree on: the triangles with own corners and theirs, each a claim on the
  /// owners of these. Asks about all arcs as ask() does. Throws HiddenNode, std::bad_alloc.
  Doubts claim(const std::array<Record, 3>& corners) {
    if (nodes_.own == 0 || partition_->patches() == 1) return {};
    return agreed_.claim(hull_, view(), corners, asked_);
  }
  /// The number of its claims on that patch.
  std::size_t claims_on(PatchNumber other) const { return agreed_.claims_on(other); }
  /// The triangles of its claims on that patch. Throws std::bad_alloc.
  std::vector<KeptTriangle> kept_with(PatchNumber other) const { return agreed_.kept_with(view(), other); }
  /// Settles the claims on triangles that their owners keep, too, and no others. Throws std::bad_alloc.
  void settle(const std::vector<KeptByOther>& of_others) { agreed_.settle(view(), of_others); }
  /// Puts questions about the claims that are not settled in place of those about triangles: at most `most`
  /// to each patch, and few about nodes that may be hubs. Throws std::bad_alloc.
  void ask_about_claims(std::size_t most, Doubts& doubts) {
    if (nodes_.own > 0) agreed_.ask(hull_, view(), most, doubts);
  }
  /// Other patches have answered its question with nodes above the triangle.
  void see_refuted(const Question& question) { agreed_.see_refuted(view(), question); }
  /// After the answers: nodes whose owners should not have to take in all their neighbours.
  std::vector<GlobalNumber> look_for_hubs() const { return agreed_.look_for_hubs(hull_); }
  /// Sets all hubs, the same for all patches. Throws std::bad_alloc.
  void set_hubs(const std::unordered_set<GlobalNumber>& numbers) { agreed_.set_hubs(numbers); }
  /// The hubs at which it keeps triangles. Throws std::bad_alloc.
  std::vector<KeptHub> kept_hubs() const { return agreed_.kept_hubs(hull_); }
  /// Calls visit(hub, owner of hub, run): successive neighbours of the hub, counterclockwise; each but the
  /// last is followed by the next in triangles that this patch keeps. All patches together have each
  /// neighbour once as one that is not the last. Throws std::bad_alloc.
  template <class Visit>
  void for_each_run_at_hubs(const Visit& visit) const {
    agreed_.for_each_run(view(), visit);
  }
  /// The PatchNode of an own hub.
  std::size_t index_of_hub(GlobalNumber number) const { return hull_.index(hull_.find(number)); }
  /// The neighbour with which the ring of an own hub begins if the hub is on the boundary; kNoNumber if it is
  /// inside.
  GlobalNumber first_boundary_neighbour(GlobalNumber number) const {
    const HullNode first = hull_.beside_on_boundary(hull_.find(number)).b;
    return first != PatchHull<Int>::kNobody ? hull_.number(first) : kNoNumber;
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
  /// About how many nanoseconds triangulate() took, by the decisions of the predicates. The same in every
  /// run, which no clock tells.
  std::int64_t work() const { return work_; }
  /// Number of questions about triangles in all calls of ask(), and of nodes taken in because of questions.
  std::int64_t questions() const {
    return nodes_.own == 0
               ? 0
               : questions_ + static_cast<std::int64_t>(hull_.growing().node_count() - hull_.built());
  }
  /// The numbers of different nodes in the same direction, as far as it has found them.
  const CoincidentPairs& coincident() const { return hull_.coincident(); }

 private:
  PatchView<Int> view() const { return {id_, *partition_, hull_}; }

  PatchNumber id_;
  const Partition* partition_;
  PatchNodes nodes_;
  PatchHull<Int> hull_;
  Asked asked_;
  PatchAgreement<Int> agreed_;
  PatchLists<Int> lists_;
  Hull finished_;
  std::int64_t work_ = 0, questions_ = 0;
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
      if (agreed_.is_in_doubt(hull_, v, w)) return;
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
  for (const HullNode v : asked_.around) look_around(v);
  if (count == own) return;
  for (HullNode v = 0; v < hull_.built(); ++v)
    if (hull_.is_own(v) && hull_.index(v) - first >= count) look_around(v);
}

}  // namespace pstripack
