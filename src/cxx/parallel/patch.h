#pragma once
// One patch: the triangulation of its own nodes and of those around, and which of its triangles are final.

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <unordered_map>
#include <unordered_set>
#include <utility>
#include <vector>

#include "base/buffer.h"
#include "base/workspace.h"
#include "mesh/delaunay.h"
#include "mesh/ring_table.h"
#include "parallel/partition.h"
#include "parallel/places.h"
#include "parallel/record.h"

namespace pstripack {

/// "Does any of your nodes lie above this triangle?" Or, of an arc a -> b of the boundary, where the third
/// corner is the centre: "Is it an arc of your boundary?"
struct Question {
  Record corner[3];
  std::int32_t from, to;  ///< patches

  bool is_about_arc() const { return corner[2].point == Point{0, 0, 0}; }
};

/// What is not certain yet.
struct Doubts {
  std::vector<Question> questions;
  std::size_t arcs = 0;    ///< of the boundary: so many of the questions are about them
  bool has_grown = false;  ///< the patch has taken in nodes since it asked last
  bool left_out = false;   ///< it has more questions than it asks
};

/// How many times as far from the centre as a triangle of a hull a place in its direction can be, for all
/// hulls of these nodes and any others: they lie around the hull of these. Infinite if these do not surround
/// the centre. Throws std::bad_alloc.
double most_stretch(const std::vector<Record>& nodes, const Places& places);

/// Throws HiddenNode if lengths hide one of some nodes, and so in every set that has them. Looks closely only
/// if neighbours in their order, which should follow a curve, are close. Not all on one great circle. Throws
/// std::bad_alloc.
void look_for_hidden_nodes(const std::vector<Record>& nodes, const Places& places);

/// Int: what node numbers fit into.
template <class Int>
class Patch {
 public:
  Patch(int id, const Partition& partition, const Places& places)
      : id_(id), partition_(&partition), places_(places) {}

  /// The nodes: `own` of them first, then the halo. They must outlive set_up().
  void set_nodes(const Record* nodes, std::size_t own, std::size_t count);

  /// Memory for set_up(). `closing`: nodes of the global sample.
  std::size_t workspace_bytes(std::size_t closing) const;

  /// Sorts the patch's nodes and those of the `closing` that it does not know: some from everywhere, three of
  /// them not on one great circle, so that the far side is closed. The workspace must outlive the patch and
  /// its rings. Throws HiddenNode where it is easy to see that one is hidden, std::bad_alloc.
  void set_up(const std::vector<Record>& closing, Workspace& workspace);
  /// Triangulates them. Throws HiddenNode, std::bad_alloc.
  void triangulate();

  /// What is not certain yet of the stars of its own nodes, as questions to the patches that may know better.
  /// Every star is the star in the triangulation of all nodes when no patch has a question about triangles
  /// and, if any has one about arcs, none has grown. `corners`: three nodes that every patch knows, not on
  /// one great circle. `stretch`: most_stretch of nodes that it has taken in, or infinity. With more than
  /// `most` questions it stops: nobody will answer them. Throws HiddenNode, std::bad_alloc.
  Doubts ask(const std::array<Record, 3>& corners, double stretch, std::size_t most);

  /// The answer of this patch to another's question: nodes that lie above, or that show that the arc is none
  /// of the boundary; none if there are none. A patch that answers takes in the corners of the question.
  /// Throws HiddenNode, std::bad_alloc.
  void answer(const Question& question, std::vector<Record>& nodes);

  /// Takes in the answer to a question of its own. Throws HiddenNode, std::bad_alloc.
  void learn(const Question& question, const Record* nodes, std::size_t count);

  // Certification by agreement, where there would be too many questions: docs/parallel.md, "Agreement".

  /// Asks about triangles as ask() does, but only the owners of their corners, who must have them, too: at
  /// most `most` questions to each patch, and few about nodes that may be hubs. All arcs as ask() does.
  /// Throws HiddenNode, std::bad_alloc.
  Doubts claim(const std::array<Record, 3>& corners, std::size_t most);
  /// Takes in the corners of another's question. Throws HiddenNode, std::bad_alloc.
  void take_in_corners(const Question& question);
  /// After the answers: the numbers of nodes whose owners should not have to take in all their neighbours.
  std::vector<std::int64_t> look_for_hubs() const;
  /// All of them, the same for all patches. Throws std::bad_alloc.
  void set_hubs(const std::unordered_set<std::int64_t>& numbers);
  /// The hubs at which it keeps triangles. Throws std::bad_alloc.
  std::vector<std::int64_t> kept_hubs() const;
  /// Calls visit(hub, owner of hub, run): successive neighbours of the hub, counterclockwise; each but the
  /// last is followed by the next in triangles that this patch keeps. All patches together have each
  /// neighbour once as one that is not the last. Throws std::bad_alloc.
  template <class Visit>
  void for_each_run_at_hubs(const Visit& visit) const {
    const auto node = [&](std::uint32_t v) { return Record{arrays_.nodes[v], number_[v]}; };
    std::vector<Record> run;
    for (std::uint32_t h = 0; h < is_hub_.size(); ++h) {
      if (!is_hub_[h]) continue;
      const auto end_run = [&] {
        if (!run.empty()) visit(node(h), owner_of(h), run);
        run.clear();
      };
      for_each_face_at(h, [&](std::uint32_t t, std::uint32_t i) {
        if (!is_in_run(h, t, i)) return;
        const auto& corner = arrays_.faces[t].vertex;
        const std::uint32_t x = corner[next_edge(i)], y = corner[previous_edge(i)];
        if (run.empty() || run.back().number != number_[x]) {
          end_run();
          run.push_back(node(x));
        }
        run.push_back(node(y));
      });
      end_run();
    }
  }
  /// Of an own hub: which of set_nodes it is.
  std::size_t index_of_hub(std::int64_t number) const { return order_[taken_in_.at(number)]; }
  /// Of an own hub: where its ring begins if it is on the boundary; 0 inside.
  std::int64_t first_boundary_neighbour(std::int64_t number) const;

  /// After the last answer: the triangulation. Returns room enough for the entries of all rings of its own
  /// nodes. Throws HiddenNode.
  std::size_t finish();

  /// After finish(): room for `bytes` in the workspace, in place of what is not needed any more; null if
  /// there is not enough.
  void* room_for_rings(std::size_t bytes) const;

  /// Writes the rings of its own nodes to `out`, which has room for all and 2*kBlock entries more; calls
  /// visit(i, place, count) for each: the ring of node i of set_nodes is kept at `place`; soon(i) some time
  /// before.
  template <class Visit, class Soon>
  void write_rings(Int* out, const Visit& visit, const Soon& soon) const {
    // By value: where visit() writes bytes, they could change anything that is reached through `this`.
    append_rings(
        hull_, 0, built_, [order = order_, own = own_](std::size_t v) { return order[v] < own; },
        Numbers<Int, 0>{number_}, [order = order_, soon](std::size_t v) { soon(order[v]); }, out,
        [order = order_, visit](std::size_t v, const Int* place, std::uint32_t count) {
          visit(order[v], place, count);
        });
  }

  /// After finish(): who misses which neighbours. Rank r brought the own nodes [own_from[r], own_from[r+1]),
  /// `mine` is the rank that brought most. Calls visit(r, node) for each node that is a neighbour of one that
  /// r has brought and that r has not, perhaps more than once.
  template <class Visit>
  void for_each_missing_neighbour(std::size_t mine, const std::vector<std::size_t>& own_from,
                                  const Visit& visit) const {
    if (own_ == 0) return;
    const std::size_t first = own_from[mine], count = own_from[mine + 1] - first;
    // Of each own node, by whom it was brought; where one rank brought all, nobody asks.
    std::vector<std::uint32_t> bringer(count < own_ ? own_ : 0);
    for (std::size_t r = 0; r + 1 < own_from.size() && count < own_; ++r)
      std::fill(bringer.begin() + static_cast<std::ptrdiff_t>(own_from[r]),
                bringer.begin() + static_cast<std::ptrdiff_t>(own_from[r + 1]),
                static_cast<std::uint32_t>(r));
    const auto brought_by = [&](std::uint32_t v) {
      if (!is_own(v)) return kNobody;
      return count < own_ ? bringer[order_[v]] : static_cast<std::uint32_t>(mine);
    };
    const auto node = [&](std::uint32_t v) { return Record{arrays_.nodes[v], number_[v]}; };
    // Of each hull node, who was told of it last: most are missed by one rank, at several of its nodes.
    std::vector<std::uint32_t> told(count < own_ ? growing_->node_count() : 0, kNobody);
    const auto look_around = [&](std::uint32_t v) {
      const std::uint32_t r = brought_by(v);
      bool is_missing = false;
      const auto meet = [&](std::uint32_t w) {
        if (is_in_doubt(v, w)) return;
        const std::uint32_t other = brought_by(w);
        is_missing = is_missing || other == mine;
        if (r == kNobody || other == r || told[w] == r) return;
        told[w] = r;
        visit(std::size_t{r}, node(w));
      };
      for_each_face_at(v, [&](std::uint32_t t, std::uint32_t i) {
        if (!hull_.front(t)) return;
        const Face& f = hull_.faces[t];
        meet(f.vertex[next_edge(i)]);
        // The last neighbour of a boundary node; of others the next face tells.
        if (!hull_.front(face_of(f.neighbour[next_edge(i)]))) meet(f.vertex[previous_edge(i)]);
      });
      if (is_missing) visit(mine, node(v));
    };
    // Of two neighbours one is looked at: all but the own nodes of `mine`.
    for (const std::uint32_t v : around_) look_around(v);
    if (count == own_) return;
    for (std::uint32_t v = 0; v < built_; ++v)
      if (order_[v] < own_ && order_[v] - first >= count) look_around(v);
  }

  int id() const { return id_; }
  std::size_t own() const { return own_; }
  std::size_t halo() const { return count_ - own_; }
  /// Different nodes in the same direction that it came upon: their numbers.
  const std::vector<std::pair<std::int64_t, std::int64_t>>& coincident() const { return coincident_; }

 private:
  static constexpr std::uint32_t kNobody = UINT32_MAX;

  bool is_hub(std::uint32_t v) const { return v < is_hub_.size() && is_hub_[v]; }
  /// After an agreement: whether they may not be neighbours, one being an own hub, the other not certified
  /// here. Those of hubs are in for_each_run_at_hubs().
  bool is_in_doubt(std::uint32_t v, std::uint32_t w) const {
    return (is_hub(v) && !is_hub(w) && !is_own(w)) || (is_hub(w) && !is_hub(v) && !is_own(v));
  }
  /// Of a triangle t, whose corner i is hub h: true if this of all patches that keep it tells of it.
  bool is_in_run(std::uint32_t h, std::uint32_t t, std::uint32_t i) const {
    const std::uint32_t x = arrays_.faces[t].vertex[next_edge(i)];
    return is_own(is_hub_[x] ? h : x) && growing_->front(t);
  }
  bool is_own(std::uint32_t v) const { return v < built_ && order_[v] < own_; }
  Point place(std::uint32_t v) const { return places_(arrays_.nodes[v]); }

  /// A ball that holds all places above the triangle.
  Ball ball_above(std::uint32_t a, std::uint32_t b, std::uint32_t c) const;

  /// Meets node v of another patch at the border.
  void meet(std::uint32_t v) {
    if (is_own(v) || is_around_[v]) return;
    is_around_[v] = true;
    around_.push_back(v);
  }
  Question question_about(std::uint32_t t) const;
  void ask_about_triangle(std::uint32_t t, std::vector<Question>& questions);
  void ask_about_arcs(const std::array<Record, 3>& corners, Doubts& doubts);
  void answer_about_arc(std::uint32_t a, std::uint32_t b, std::vector<Record>& nodes);
  std::uint32_t take_in(const Record& node);
  void make_room();
  int owner_of(std::uint32_t v) const { return is_own(v) ? id_ : partition_->owner(place(v)); }

  /// The corner at the same node in the next face counterclockwise.
  std::uint32_t counterclockwise(std::uint32_t corner) const {
    const std::uint32_t beyond = arrays_.faces[face_of(corner)].neighbour[next_edge(edge_of(corner))];
    return 4 * face_of(beyond) + next_edge(edge_of(beyond));
  }

  /// Calls visit(t, i) for every face t of the hull around node v, which is its vertex i.
  template <class Visit>
  void for_each_face_at(std::uint32_t v, const Visit& visit) const {
    const std::uint32_t first = arrays_.corner[v];
    std::uint32_t corner = first;
    do {
      visit(face_of(corner), edge_of(corner));
      corner = counterclockwise(corner);
    } while (corner != first);
  }

  /// An arc a -> b of its boundary, with the front faces on the left.
  struct Arc {
    std::uint32_t a, b;
  };
  std::vector<Arc> boundary_arcs() const;
  /// Of the boundary next to v; kNobody where v is not on it.
  Arc beside_on_boundary(std::uint32_t v) const;
  /// Of a node strictly right of a -> b: itself, or one farther right that is strictly right, too.
  std::uint32_t farthest_right(std::uint32_t a, std::uint32_t b, std::uint32_t v) const;

  /// Calls visit(t, own) for every front face t that has a corner which is not the patch's own and among the
  /// hull nodes from `first` on; `own` of its corners are.
  template <class Visit>
  void for_each_face_at_border(std::size_t first, const Visit& visit) const {
    const auto n = static_cast<std::uint32_t>(growing_->node_count());
    const bool all_are_front = growing_->surrounds_centre();
    for (auto v = static_cast<std::uint32_t>(first); v < n; ++v) {
      if (is_own(v)) continue;
      for_each_face_at(v, [&](std::uint32_t t, std::uint32_t) {
        const auto& corner = arrays_.faces[t].vertex;
        int own = 0;
        for (int i = 0; i < 3; ++i) {
          if (corner[i] < v && corner[i] >= first && !is_own(corner[i])) return;  // met there
          own += is_own(corner[i]);
        }
        if (all_are_front || growing_->front(t)) visit(t, own);
      });
    }
  }

  int id_;
  const Partition* partition_;
  Places places_;
  const Record* nodes_ = nullptr;
  std::size_t own_ = 0, count_ = 0, leading_ = 0, built_ = 0;
  HullArrays arrays_;
  std::uint32_t* order_ = nullptr;  ///< of the hull nodes < built_: which of nodes_, count_ or more: closing
  Int* number_ = nullptr;           ///< of each hull node
  std::unique_ptr<GrowingHull> growing_;
  Hull hull_;
  Plane* first_planes_ = nullptr;  ///< those in the workspace, for built_ nodes at least
  std::size_t asked_with_ = 0;     ///< hull nodes
  std::vector<Arc> asked_arcs_;    ///< of the boundary, when it asked last
  std::vector<std::uint32_t>
      around_;  ///< hull nodes of others that were neighbours of own ones when it asked
  std::vector<bool> is_around_;
  std::vector<std::pair<std::int64_t, std::int64_t>> coincident_;
  std::unordered_map<std::int64_t, std::uint32_t> taken_in_;  ///< after the start: hull nodes by number
  std::vector<int> strangers_;
  // Agreement, by hull node:
  struct AskedAbout {  ///< of a node of another patch
    std::size_t triangles = 0, asked = 0, refuted = 0;
  };
  std::vector<AskedAbout> asked_about_;
  std::vector<bool> is_hub_;  ///< empty: there are none
  std::unordered_set<std::int64_t> hubs_;
  struct {  // where the workspace was too small for what was learnt
    Buffer<Point> nodes;
    Buffer<Int> number;
    Buffer<Face> faces;
    Buffer<Plane> planes;
    Buffer<std::uint32_t> corner;
  } memory_;
};

}  // namespace pstripack
