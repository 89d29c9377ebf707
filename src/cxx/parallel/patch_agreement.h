#pragma once
// What a patch does to agree with others on the stars of its nodes: docs/parallel.md, "Agreement".
//
// A patch keeps a triangle of its hull if it owns a corner. The patches that own its other corners must keep
// it, too: the patch asks each of them about it. A hub is a node with more neighbours than its owner should
// take in. Its owner need not keep triangles at it, unless these have two hubs.

#include <array>
#include <cstddef>
#include <cstdint>
#include <unordered_set>
#include <vector>

#include "parallel/patch_hull.h"
#include "parallel/patch_questions.h"
#include "parallel/record.h"

namespace pstripack {

/// A triangle that a patch keeps: the numbers of its corners, counterclockwise, the smallest first.
using KeptTriangle = std::array<GlobalNumber, 3>;

/// Triangles that another patch keeps, with a corner of this one.
struct KeptByOther {
  PatchNumber other;
  const KeptTriangle* first;
  std::size_t count;
};

/// A hub at which a patch keeps triangles.
struct KeptHub {
  GlobalNumber number;
  std::size_t triangles;  ///< at most kManyTriangles of them are counted
};
/// A node of another patch may be a hub if a patch has more than kManyTriangles to ask its owner about.
constexpr std::size_t kManyTriangles = 64;

/// The members do what those of Patch do.
template <class Int>
class PatchAgreement {
 public:
  Doubts claim(PatchHull<Int>& hull, const PatchView<Int>& patch, const std::array<Record, 3>& corners,
               Asked& asked);
  std::size_t claims_on(PatchNumber other) const {
    return to_patch_.empty() ? 0 : to_patch_[static_cast<std::size_t>(other)];
  }
  std::vector<KeptTriangle> kept_with(const PatchView<Int>& patch, PatchNumber other) const;
  void settle(const PatchView<Int>& patch, const std::vector<KeptByOther>& of_others);
  void ask(PatchHull<Int>& hull, const PatchView<Int>& patch, std::size_t most, Doubts& doubts);
  /// The answer to a question has refuted the triangle.
  void see_refuted(const PatchView<Int>& patch, const Question& question);
  std::vector<GlobalNumber> look_for_hubs(const PatchHull<Int>& hull) const;
  void set_hubs(const std::unordered_set<GlobalNumber>& numbers) {
    hubs_ = numbers;
    is_hub_.clear();
    has_new_hubs_ = true;
  }
  std::vector<KeptHub> kept_hubs(const PatchHull<Int>& hull) const;
  template <class Visit>
  void for_each_run(const PatchView<Int>& patch, const Visit& visit) const {
    const PatchHull<Int>& hull = patch.hull;
    std::vector<Record> run;
    for (HullNode h = 0; h < is_hub_.size(); ++h) {
      if (!is_hub_[h]) continue;
      const auto end_run = [&] {
        if (!run.empty()) visit(hull.node(h), patch.owner(h), run);
        run.clear();
      };
      hull.for_each_face_at(h, [&](HullFace t, std::uint32_t i) {
        if (!is_in_run(hull, h, t, i)) return;
        const auto& corner = hull.face(t).vertex;
        const HullNode x = corner[next_edge(i)], y = corner[previous_edge(i)];
        if (run.empty() || run.back().number != hull.number(x)) {
          end_run();
          run.push_back(hull.node(x));
        }
        run.push_back(hull.node(y));
      });
      end_run();
    }
  }
  /// True if v and w, neighbours in this hull, may be none in the mesh: one is a hub, the other neither a hub
  /// nor an own node. for_each_run() has the neighbours of hubs.
  bool is_in_doubt(const PatchHull<Int>& hull, HullNode v, HullNode w) const {
    return (is_hub(v) && !is_hub(w) && !hull.is_own(w)) || (is_hub(w) && !is_hub(v) && !hull.is_own(v));
  }

 private:
  bool is_hub(HullNode v) const { return v < is_hub_.size() && is_hub_[v]; }
  /// Corner i of triangle t is hub h. True if this patch, among all that keep t, has it in a run.
  bool is_in_run(const PatchHull<Int>& hull, HullNode h, HullFace t, std::uint32_t i) const {
    const HullNode x = hull.face(t).vertex[next_edge(i)];
    return hull.is_own(is_hub_[x] ? h : x) && hull.growing().front(t);
  }

  struct Claim {
    HullFace face;
    HullNode node;
    PatchNumber owner;  ///< of the node
    bool is_settled;    ///< the owner's patch keeps the triangle, too
  };
  std::vector<Claim> claims_;
  std::vector<std::size_t> to_patch_;  ///< number of claims, by PatchNumber
  struct AskedAbout {                  ///< of a node of another patch
    std::size_t triangles = 0, asked = 0, refuted = 0;
  };
  std::vector<AskedAbout> asked_about_;  ///< by hull node
  std::vector<bool> is_hub_;             ///< by hull node; empty: there are none
  std::unordered_set<GlobalNumber> hubs_;
  bool has_new_hubs_ = false;  ///< since the last claim
};

}  // namespace pstripack
