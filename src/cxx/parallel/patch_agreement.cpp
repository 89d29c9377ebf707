#include "parallel/patch_agreement.h"

#include <algorithm>
#include <cstdint>

#include "base/scattered.h"
#include "parallel/number_table.h"

namespace pstripack {
namespace {

/// The node is a hub if its owner confirms most of the first kAFew triangles.
constexpr std::size_t kAFew = 8;

/// Never kNoNumber.
GlobalNumber hash_of(const KeptTriangle& t, PatchNumber patch) {
  std::uint64_t hash = static_cast<std::uint64_t>(patch);
  for (const GlobalNumber number : t) hash = scattered(hash ^ static_cast<std::uint64_t>(number));
  return GlobalNumber{static_cast<std::int64_t>(hash >> 2) + 1};
}

/// The triangle of face t.
template <class Int>
KeptTriangle kept_triangle(const PatchHull<Int>& hull, HullFace t) {
  const auto& vertex = hull.face(t).vertex;
  const std::uint32_t a = first_vertex(hull, t), b = next_edge(a);
  return {hull.number(vertex[a]), hull.number(vertex[b]), hull.number(vertex[next_edge(b)])};
}

}  // namespace

template <class Int>
Doubts PatchAgreement<Int>::claim(PatchHull<Int>& hull, const PatchView<Int>& patch,
                                  const std::array<Record, 3>& corners, Asked& asked) {
  Doubts doubts;
  const std::size_t n = hull.growing().node_count(), before = asked.nodes;
  doubts.has_grown = n != before;
  ask_about_arcs(patch, corners, asked, doubts);
  asked.nodes = n;
  if (!hubs_.empty())
    for (auto v = static_cast<HullNode>(is_hub_.size()); v < n; ++v) {
      is_hub_.push_back(hubs_.count(hull.number(v)) > 0);
      if (is_hub_.back()) hull.remember(v);
    }
  const bool is_first = to_patch_.empty();
  const bool is_anew = has_new_hubs_ || is_first;
  doubts.has_new_claims = doubts.has_grown || is_anew;
  has_new_hubs_ = false;
  if (!doubts.has_new_claims) return doubts;
  // A face that is new since the last time has a new node.
  const std::size_t first_new = is_anew ? 0 : before;
  const auto is_new = [&](HullFace t) {
    const auto& vertex = hull.face(t).vertex;
    return vertex[0] >= first_new || vertex[1] >= first_new || vertex[2] >= first_new;
  };
  claims_.erase(
      std::remove_if(claims_.begin(), claims_.end(), [&](const Claim& claim) { return is_new(claim.face); }),
      claims_.end());
  to_patch_.assign(static_cast<std::size_t>(patch.partition.patches()), 0);
  for (const Claim& claim : claims_) ++to_patch_[static_cast<std::size_t>(claim.owner)];
  if (is_anew) asked.around.clear(), asked.is_around.clear();
  asked.is_around.resize(n, false);
  std::vector<PatchNumber> owner_of_node(n, -1);
  hull.for_each_face_at_border(first_new, [&](HullFace t) {
    const auto& vertex = hull.face(t).vertex;
    const HullNode v[] = {vertex[0], vertex[1], vertex[2]};
    const bool has_one_hub = is_hub(v[0]) + is_hub(v[1]) + is_hub(v[2]) == 1;
    // Most triangles at a hub have two own nodes: nobody is asked about them.
    const auto says_nothing = [&](HullNode w) { return hull.is_own(w) || (is_hub(w) && asked.is_around[w]); };
    if (has_one_hub && says_nothing(v[0]) && says_nothing(v[1]) && says_nothing(v[2])) return;
    if (!hull.is_front(t)) return;
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
      claims_.push_back({t, w, owner, false});
      ++to_patch_[static_cast<std::size_t>(owner)];
    }
  });
  return doubts;
}

template <class Int>
std::vector<KeptTriangle> PatchAgreement<Int>::kept_with(const PatchView<Int>& patch,
                                                         PatchNumber other) const {
  std::vector<KeptTriangle> triangles;
  for (const Claim& claim : claims_)
    if (claim.owner == other) triangles.push_back(kept_triangle(patch.hull, claim.face));
  return triangles;
}

template <class Int>
void PatchAgreement<Int>::settle(const PatchView<Int>& patch, const std::vector<KeptByOther>& of_others) {
  std::size_t count = 0;
  std::vector<bool> has_told(to_patch_.size());
  for (const KeptByOther& kept : of_others) {
    count += kept.count;
    has_told[static_cast<std::size_t>(kept.other)] = true;
  }
  // By a hash of the triangle and the other patch. If two have the same, only one is found: the claim on the
  // other is not settled but becomes a question.
  NumberTable<const KeptTriangle*> table(count);
  for (const KeptByOther& kept : of_others)
    for (const KeptTriangle* t = kept.first; t < kept.first + kept.count; ++t)
      table.insert(hash_of(*t, kept.other), t);
  for (Claim& claim : claims_) {
    claim.is_settled = false;
    if (!has_told[static_cast<std::size_t>(claim.owner)]) continue;
    const KeptTriangle mine = kept_triangle(patch.hull, claim.face);
    const KeptTriangle* const* const theirs = table.find_value(hash_of(mine, claim.owner));
    claim.is_settled = theirs != nullptr && **theirs == mine;
  }
}

template <class Int>
void PatchAgreement<Int>::ask(PatchHull<Int>& hull, const PatchView<Int>& patch, std::size_t most,
                              Doubts& doubts) {
  asked_about_.assign(hull.growing().node_count(), {});
  std::vector<std::size_t> to_patch(to_patch_.size()), passed(to_patch_.size()), not_of_hub(to_patch_.size());
  doubts.questions.resize(doubts.arcs);
  doubts.left_out = doubts.has_many_claims = false;
  for (const Claim& claim : claims_) {
    doubts.has_many_claims = doubts.has_many_claims || claim.is_settled;
    if (claim.is_settled) continue;
    ++asked_about_[claim.node].triangles;
    ++to_patch[static_cast<std::size_t>(claim.owner)];
  }
  for (const Claim& claim : claims_) {
    if (claim.is_settled) continue;
    const auto q = static_cast<std::size_t>(claim.owner);
    AskedAbout& about = asked_about_[claim.node];
    if (about.triangles <= kManyTriangles && ++not_of_hub[q] > kAFew) doubts.has_many_claims = true;
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
std::vector<KeptHub> PatchAgreement<Int>::kept_hubs(const PatchHull<Int>& hull) const {
  std::vector<KeptHub> kept;
  for (HullNode h = 0; h < is_hub_.size(); ++h) {
    if (!is_hub_[h]) continue;
    std::size_t triangles = 0;
    HullCorner corner = hull.corner(h);
    do {
      triangles += is_in_run(hull, h, face_of(corner), edge_of(corner));
      corner = hull.counterclockwise(corner);
    } while (corner != hull.corner(h) && triangles < kManyTriangles);
    if (triangles > 0) kept.push_back({hull.number(h), triangles});
  }
  return kept;
}

template class PatchAgreement<std::int32_t>;
template class PatchAgreement<std::int64_t>;

}  // namespace pstripack
