#include "parallel/patch_agreement.h"

namespace pstripack {
namespace {

/// A node of another patch may be a hub if this patch has more than kManyTriangles triangles to ask its owner
/// about. It is one if the owner confirms most of the first kAFew.
constexpr std::size_t kManyTriangles = 64, kAFew = 8;

}  // namespace

template <class Int>
Doubts PatchAgreement<Int>::claim(PatchHull<Int>& hull, const PatchView<Int>& patch,
                                  const std::array<Record, 3>& corners, std::size_t most, Asked& asked) {
  Doubts doubts;
  const std::size_t n = hull.growing().node_count();
  doubts.has_grown = n != asked.nodes;
  ask_about_arcs(patch, corners, asked, doubts);
  asked.nodes = n;
  asked.around.clear();
  asked.is_around.assign(n, false);
  asked_about_.assign(n, {});
  if (!hubs_.empty())
    for (auto v = static_cast<HullNode>(is_hub_.size()); v < n; ++v)
      is_hub_.push_back(hubs_.count(hull.number(v)) > 0);

  struct Claim {
    HullFace face;
    HullNode node;
    PatchNumber owner;
  };
  std::vector<Claim> claims;
  std::vector<PatchNumber> owner_of_node(n, -1);
  std::vector<std::size_t> to_patch(static_cast<std::size_t>(patch.partition.patches()));
  hull.for_each_face_at_border(0, [&](HullFace t, int own) {
    if (own == 0) return;
    const auto& vertex = hull.face(t).vertex;
    const HullNode v[] = {vertex[0], vertex[1], vertex[2]};
    const bool has_one_hub = is_hub(v[0]) + is_hub(v[1]) + is_hub(v[2]) == 1;
    bool keeps = false;
    for (const HullNode w : v) {
      if (!hull.is_own(w))
        asked.meet(w);
      else
        keeps = keeps || !(has_one_hub && is_hub(w));
    }
    if (!keeps) return;
    PatchNumber last = patch.id;
    for (const HullNode w : v) {
      if (hull.is_own(w) || (has_one_hub && is_hub(w))) continue;
      PatchNumber& owner = owner_of_node[w];
      if (owner < 0) owner = patch.owner(w);
      if (owner == last) continue;
      last = owner;
      claims.push_back({t, w, owner});
      ++asked_about_[w].triangles;
      ++to_patch[static_cast<std::size_t>(owner)];
    }
  });
  std::vector<std::size_t> passed(to_patch.size());
  for (const Claim& claim : claims) {
    const auto q = static_cast<std::size_t>(claim.owner);
    AskedAbout& about = asked_about_[claim.node];
    const std::size_t step = (to_patch[q] - 1) / most + 1;  // of too many, every step-th is asked
    if (passed[q]++ % step != 0 || (about.triangles > kManyTriangles && about.asked == kAFew)) {
      doubts.left_out = true;
      continue;
    }
    ++about.asked;
    for (int i = 0; i < 3; ++i) hull.remember(hull.face(claim.face).vertex[i]);
    doubts.questions.push_back(question_about(patch, claim.face));
    doubts.questions.back().to = claim.owner;
  }
  return doubts;
}

template <class Int>
void PatchAgreement<Int>::see_refuted(const PatchView<Int>& patch, const Question& question) {
  if (asked_about_.empty()) return;
  for (const Record& r : question.corner) {
    const HullNode v = patch.hull.find(r.number);
    if (v != PatchHull<Int>::kNobody && patch.owner(v) == question.to) ++asked_about_[v].refuted;
  }
}

template <class Int>
std::vector<GlobalNumber> PatchAgreement<Int>::look_for_hubs(const PatchHull<Int>& hull) const {
  std::vector<GlobalNumber> numbers;
  for (HullNode v = 0; v < asked_about_.size(); ++v) {
    const AskedAbout& about = asked_about_[v];
    if (about.triangles > kManyTriangles && about.asked == kAFew && 2 * about.refuted < kAFew)
      numbers.push_back(hull.number(v));
  }
  return numbers;
}

template <class Int>
std::vector<GlobalNumber> PatchAgreement<Int>::kept_hubs(const PatchHull<Int>& hull) const {
  std::vector<GlobalNumber> kept;
  for (HullNode h = 0; h < is_hub_.size(); ++h) {
    if (!is_hub_[h]) continue;
    HullCorner corner = hull.corner(h);
    do {
      if (is_in_run(hull, h, face_of(corner), edge_of(corner))) {
        kept.push_back(hull.number(h));
        break;
      }
      corner = hull.counterclockwise(corner);
    } while (corner != hull.corner(h));
  }
  return kept;
}

template class PatchAgreement<std::int32_t>;
template class PatchAgreement<std::int64_t>;

}  // namespace pstripack
