#pragma once
// One patch: the triangulation of its own nodes and of those around. In order: triangulate what it knows,
// compare lists with other patches, learn, read off the rings. docs/internals/parallel.md.

#include <algorithm>
#include <array>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "base/workspace.h"
#include "parallel/local_numbers.h"
#include "parallel/number_table.h"
#include "parallel/parcels.h"
#include "parallel/partition.h"
#include "parallel/patch_hull.h"
#include "parallel/places.h"
#include "parallel/sent_node.h"

namespace pstripack {

/// A triangle in a list: the numbers of its corners, counterclockwise, the smallest first.
template <class Int>
using Listed = std::array<Int, 3>;

/// A triangle in the list of a patch for another one.
template <class Int>
struct SentTriangle {
  Listed<Int> triangle;
  PatchNumber from, to;
};

/// "You lack this triangle. Does any of your nodes lie above it?"
struct Question {
  SentNode corner[3];
  PatchNumber from, to;
};

/// A patch answers for the front triangles of its hull that have a corner of its own. The list for another
/// patch has those that also have a corner of that patch.
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
  void set_up(const std::vector<SentNode>& closing, Workspace& workspace) {
    if (nodes_.own == 0) return;
    const auto is_own = [&](const SentNode& r) { return partition_->owner(hull_.places()(r.point)) == id_; };
    const SentNode *const margin = nodes_.first + nodes_.own, *const end = nodes_.first + nodes_.count();
    assert(std::all_of(nodes_.first, margin, is_own) && std::none_of(margin, end, is_own));
    // The margin is looked up by number: whether a node is in it depends on how distances were rounded.
    NumberTable<bool> is_in_margin(closing.size());
    for (const SentNode& r : closing) is_in_margin.insert(r.number, false);
    for (const SentNode* r = margin; r < end; ++r)
      if (bool* const found = is_in_margin.find(r->number)) *found = true;
    std::vector<SentNode> leading;
    for (const SentNode& r : closing) {
      const bool is_known = *is_in_margin.find(r.number) || is_own(r);
      assert(is_known ==
             std::any_of(nodes_.first, end, [&](const SentNode& known) { return known.number == r.number; }));
      if (!is_known) leading.push_back(r);
    }
    hull_.set_up(nodes_, leading, workspace);
  }
  /// Triangulates them. Throws HiddenNode, std::bad_alloc.
  void triangulate() {
    if (nodes_.own > 0) hull_.build();
  }

  /// Adds nodes of other patches to the triangulation, unless it has them. Many are added along a curve, so
  /// that the search for each begins near it. Throws HiddenNode, std::bad_alloc.
  void take_in(std::vector<SentNode> nodes) {
    if (nodes_.own == 0) return;
    // Each node once: no cell of the curve could tell equal ones apart. Triangles share corners, so many are
    // in.
    NumberTable<bool> met(nodes.size());
    nodes.erase(std::remove_if(nodes.begin(), nodes.end(),
                               [&](const SentNode& r) {
                                 return hull_.has_taken_in(r.number) || !met.insert(r.number, true).second;
                               }),
                nodes.end());
    constexpr std::size_t kMany = 1000;  // sorting fewer would take longer than the searches
    if (nodes.size() >= kMany) sort_along_curve(nodes);
    for (const SentNode& r : nodes) hull_.take_in(r);
  }

  /// The answer of this patch to another's question: some nodes that lie above the triangle, if it knows any.
  /// A patch that answers takes in the corners of the question. Throws HiddenNode, std::bad_alloc.
  std::vector<SentNode> answer(const Question& question) {
    assert(nodes_.own > 0);  // among them is a corner
    if (!hull_.coincident().empty()) return {};
    // The highest few: they change the asker's triangulation most, and the others may not matter then.
    constexpr std::size_t kFew = 64;
    HullNode v[3];
    for (int i = 0; i < 3; ++i) v[i] = hull_.take_in(question.corner[i]);
    std::vector<SentNode> nodes;
    for (const HullNode w : nodes_above(v, kFew)) nodes.push_back(hull_.node(w));
    return nodes;
  }

  /// Finds the triangles that other patches must have, too. Throws std::bad_alloc.
  void update_lists() {
    const std::size_t first_new = listed_;
    listed_ = known();
    if (first_new == listed_ || partition_->patches() == 1) return;
    // A face that is new since the last time has a new node.
    entries_.erase(std::remove_if(entries_.begin(), entries_.end(),
                                  [&](const Entry& e) {
                                    const auto& v = hull_.face(e.face).vertex;
                                    return v[0] >= first_new || v[1] >= first_new || v[2] >= first_new;
                                  }),
                   entries_.end());
    hull_.for_each_face_at_border(first_new, [&](HullFace t) {
      if (!hull_.is_front(t)) return;
      Entry entry{listed(t), t, {kNone, kNone}};
      for (const HullNode v : corners(t)) {
        if (hull_.is_own(v)) continue;
        const PatchNumber owner = partition_->owner(hull_.place(v));
        entry.other[entry.other[0] != kNone && entry.other[0] != owner] = owner;
      }
      entries_.push_back(entry);
    });
    assert(std::all_of(entries_.begin(), entries_.end(),
                       [&](const Entry& e) { return e.triangle == listed(e.face); }));
    assert([&] {
      std::size_t faces = 0;
      hull_.for_each_face_at_border(0, [&](HullFace t) { faces += hull_.is_front(t); });
      return faces == entries_.size();
    }());
  }
  /// Calls visit(triangle) for each triangle of the lists for other patches.
  template <class Visit>
  void for_each_listed(const Visit& visit) const {
    for (const Entry& e : entries_)
      for (const PatchNumber q : e.other)
        if (q != kNone) visit(SentTriangle<Int>{e.triangle, id_, q});
  }
  /// Compares the lists with those that have come from other patches. Returns the triangles that these lack,
  /// as questions to them. Throws std::bad_alloc.
  std::vector<Question> lacking(const Items<SentTriangle<Int>>& lists) const {
    Table<Listed<Int>, std::uint32_t> place(entries_.size());
    for (std::uint32_t e = 0; e < entries_.size(); ++e) place.insert(entries_[e].triangle, e);
    std::vector<std::array<bool, 2>> has(entries_.size());  // the other patch has the triangle
    for (const SentTriangle<Int>& t : lists) {
      if (t.to != id_) continue;
      if (const std::uint32_t* const e = place.find(t.triangle))
        has[*e][entries_[*e].other[1] == t.from] = true;
    }
    std::vector<Question> questions;
    for (std::size_t e = 0; e < entries_.size(); ++e)
      for (std::size_t k = 0; k < 2; ++k) {
        if (entries_[e].other[k] == kNone || has[e][k]) continue;
        const auto [a, b, c] = corners(entries_[e].face);
        questions.push_back({{hull_.node(a), hull_.node(b), hull_.node(c)}, id_, entries_[e].other[k]});
      }
    return questions;
  }

  /// After the last lists: the triangulation. Throws HiddenNode.
  void finish() {
    assert(known() == listed_ || partition_->patches() == 1);
    if (nodes_.own > 0) finished_ = hull_.growing().finish();
  }
  /// After finish(): room enough for the entries of all rings of its own nodes: the corners of all triangles,
  /// and for each node one more at the boundary and its count.
  std::size_t entries() const { return 3 * finished_.face_count + 2 * finished_.node_count; }

  /// After finish(): room for `bytes` in the workspace, in place of what is not needed any more; null if
  /// there is not enough.
  void* room_for_rings(std::size_t bytes) const { return hull_.room_for_rings(bytes); }

  /// Gives back the pages of what is not needed after finish(), or after the last ring.
  void give_back_planes() const { hull_.give_back_planes(); }
  void give_back_hull() const { hull_.give_back_hull(); }

  /// Writes the rings of its own nodes to `out`, which has room for all and 2*kBlock entries more; calls
  /// visit(i, place, count) for each: the ring of its node i lies at `place`; soon(i) some time before.
  template <class Visit, class Soon>
  void write_rings(Int* out, const Visit& visit, const Soon& soon) const {
    hull_.write_rings(finished_, out, visit, soon);
  }
  PatchNumber id() const { return id_; }
  std::size_t own() const { return nodes_.own; }
  std::size_t known() const { return nodes_.own > 0 ? hull_.growing().node_count() : 0; }
  /// The numbers of different nodes in the same direction, as far as it has found them.
  const CoincidentPairs& coincident() const { return hull_.coincident(); }

 private:
  static constexpr PatchNumber kNone = -1;
  struct Entry {
    Listed<Int> triangle;
    HullFace face;
    std::array<PatchNumber, 2> other;  ///< owners of its other corners, each once; then kNone
  };
  /// The vertices of face t, the one with the smallest number first, so that each triangle has one name.
  std::array<HullNode, 3> corners(HullFace t) const {
    const auto& v = hull_.face(t).vertex;
    std::uint32_t first = 0;
    for (const std::uint32_t i : {1, 2})
      if (hull_.number(v[i]) < hull_.number(v[first])) first = i;
    return {v[first], v[next_edge(first)], v[previous_edge(first)]};
  }
  Listed<Int> listed(HullFace t) const {
    const auto [a, b, c] = corners(t);
    return {static_cast<Int>(hull_.number(a)), static_cast<Int>(hull_.number(b)),
            static_cast<Int>(hull_.number(c))};
  }
  /// The `most` highest of the nodes above the triangle of three others; empty only if there are none.
  std::vector<HullNode> nodes_above(const HullNode (&v)[3], std::size_t most) const {
    std::vector<HullNode> above;
    const auto add_those_above = [&](HullNode node, std::size_t faces) {
      HullCorner corner = hull_.corner(node);
      do {
        const HullNode w = hull_.face(face_of(corner)).vertex[next_edge(edge_of(corner))];
        if (w != v[0] && w != v[1] && w != v[2] && hull_.growing().above(v[0], v[1], v[2], w))
          above.push_back(w);
        corner = hull_.counterclockwise(corner);
      } while (--faces > 0 && corner != hull_.corner(node));
    };
    // All nodes lie in the cone that the hull makes at a corner, so one of the neighbours of that corner lies
    // above if any node does. The corner with the fewest: its ring closes first.
    HullCorner at[3] = {hull_.corner(v[0]), hull_.corner(v[1]), hull_.corner(v[2])};
    std::uint32_t least = 0;
    do {
      least = least == 2 ? 0 : least + 1;
      at[least] = hull_.counterclockwise(at[least]);
    } while (at[least] != hull_.corner(v[least]));
    bool is_face = false;
    hull_.for_each_face_at(v[least], [&](HullFace t, std::uint32_t i) {
      const auto& corner = hull_.face(t).vertex;
      is_face |=
          corner[next_edge(i)] == v[next_edge(least)] && corner[previous_edge(i)] == v[previous_edge(least)];
    });
    if (is_face) return above;
    constexpr std::size_t kManyFaces = 512;  // not all at a node with very many neighbours
    add_those_above(v[least], SIZE_MAX);
    if (above.empty()) return above;
    for (std::uint32_t k = 0; k < 3; ++k)
      if (k != least) add_those_above(v[k], kManyFaces);
    std::sort(above.begin(), above.end());
    above.erase(std::unique(above.begin(), above.end()), above.end());
    if (above.size() > most) {
      const Point a = hull_.place(v[0]);
      const Point normal = cross(minus(hull_.place(v[1]), a), minus(hull_.place(v[2]), a));
      const auto height = [&](HullNode w) { return dot(normal, minus(hull_.place(w), a)); };
      std::nth_element(above.begin(), above.begin() + static_cast<std::ptrdiff_t>(most), above.end(),
                       [&](HullNode s, HullNode t) { return height(s) > height(t); });
      above.resize(most);
    }
    return above;
  }

  PatchNumber id_;
  const Partition* partition_;
  PatchNodes nodes_;
  PatchHull<Int> hull_;
  std::vector<Entry> entries_;
  std::size_t listed_ = 0;  ///< known() when the lists were made
  Hull finished_;
};

}  // namespace pstripack
