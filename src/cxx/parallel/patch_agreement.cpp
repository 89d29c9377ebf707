// What a patch does to agree with others on the stars of its nodes: docs/parallel.md, "Agreement".
//
// A patch keeps a triangle of its hull if it owns a corner. Others keep it that own its other corners: the
// patch asks each of them about it. A hub is a node with more neighbours than its owner should take in. Its
// owner need not keep triangles at it, unless these have two hubs.

#include "parallel/patch.h"

namespace pstripack {
namespace {

/// A node of another patch that has more triangles than this with nodes here may be a hub. It is one where
/// its owner confirms most of so many of them.
constexpr std::size_t kManyTriangles = 64, kAFew = 8;

}  // namespace

template <class Int>
Doubts Patch<Int>::claim(const std::array<Record, 3>& corners, std::size_t most) {
  Doubts doubts;
  if (own_ == 0 || partition_->patches() == 1) return doubts;
  const std::size_t n = growing_->node_count();
  doubts.has_grown = n != asked_with_;
  ask_about_arcs(corners, doubts);
  asked_with_ = n;
  around_.clear();
  is_around_.assign(n, false);
  asked_about_.assign(n, {});
  if (!hubs_.empty())
    for (std::size_t v = is_hub_.size(); v < n; ++v) is_hub_.push_back(hubs_.count(number_[v]) > 0);

  struct Claim {
    std::uint32_t face, corner;
    int owner;
  };
  std::vector<Claim> claims;
  std::vector<int> owner_of_node(n, -1);
  std::vector<std::size_t> to_patch(static_cast<std::size_t>(partition_->patches()));
  for_each_face_at_border(0, [&](std::uint32_t t, int own) {
    if (own == 0) return;
    const auto& vertex = arrays_.faces[t].vertex;
    const std::uint32_t v[] = {vertex[0], vertex[1], vertex[2]};
    const bool has_one_hub = is_hub(v[0]) + is_hub(v[1]) + is_hub(v[2]) == 1;
    bool keeps = false;
    for (const std::uint32_t w : v) {
      meet(w);
      keeps = keeps || (is_own(w) && !(has_one_hub && is_hub(w)));
    }
    if (!keeps) return;
    int asked = id_;
    for (const std::uint32_t w : v) {
      if (is_own(w) || (has_one_hub && is_hub(w))) continue;
      int& owner = owner_of_node[w];
      if (owner < 0) owner = owner_of(w);
      if (owner == asked) continue;
      asked = owner;
      claims.push_back({t, w, owner});
      ++asked_about_[w].triangles;
      ++to_patch[static_cast<std::size_t>(owner)];
    }
  });
  std::vector<std::size_t> passed(to_patch.size());
  for (const Claim& claim : claims) {
    const auto q = static_cast<std::size_t>(claim.owner);
    AskedAbout& about = asked_about_[claim.corner];
    const std::size_t step = (to_patch[q] - 1) / most + 1;  // of too many, each so and so many-th
    if (passed[q]++ % step != 0 || (about.triangles > kManyTriangles && about.asked == kAFew)) {
      doubts.left_out = true;
      continue;
    }
    ++about.asked;
    for (int i = 0; i < 3; ++i) {
      const std::uint32_t w = arrays_.faces[claim.face].vertex[i];
      taken_in_.try_emplace(number_[w], w);
    }
    doubts.questions.push_back(question_about(claim.face));
    doubts.questions.back().to = claim.owner;
  }
  return doubts;
}

template <class Int>
void Patch<Int>::take_in_corners(const Question& question) {
  for (const Record& r : question.corner)
    if (own_ > 0 && r.number != 0) take_in(r);  // an arc has two corners
}

template <class Int>
std::vector<std::int64_t> Patch<Int>::look_for_hubs() const {
  std::vector<std::int64_t> numbers;
  for (std::size_t v = 0; v < asked_about_.size(); ++v) {
    const AskedAbout& about = asked_about_[v];
    if (about.triangles > kManyTriangles && about.asked == kAFew && 2 * about.refuted < kAFew)
      numbers.push_back(number_[v]);
  }
  return numbers;
}

template <class Int>
void Patch<Int>::set_hubs(const std::unordered_set<std::int64_t>& numbers) {
  hubs_ = numbers;
  is_hub_.clear();
}

template <class Int>
std::vector<std::int64_t> Patch<Int>::kept_hubs() const {
  std::vector<std::int64_t> kept;
  for (std::uint32_t h = 0; h < is_hub_.size(); ++h) {
    if (!is_hub_[h]) continue;
    std::uint32_t corner = arrays_.corner[h];
    do {
      if (is_in_run(h, face_of(corner), edge_of(corner))) {
        kept.push_back(number_[h]);
        break;
      }
      corner = counterclockwise(corner);
    } while (corner != arrays_.corner[h]);
  }
  return kept;
}

template <class Int>
std::int64_t Patch<Int>::first_boundary_neighbour(std::int64_t number) const {
  const Arc beside = beside_on_boundary(taken_in_.at(number));
  return beside.b != kNobody ? number_[beside.b] : 0;
}

template Doubts Patch<std::int32_t>::claim(const std::array<Record, 3>&, std::size_t);
template void Patch<std::int32_t>::take_in_corners(const Question&);
template std::vector<std::int64_t> Patch<std::int32_t>::look_for_hubs() const;
template std::vector<std::int64_t> Patch<std::int32_t>::kept_hubs() const;
template void Patch<std::int32_t>::set_hubs(const std::unordered_set<std::int64_t>&);
template std::int64_t Patch<std::int32_t>::first_boundary_neighbour(std::int64_t) const;
template Doubts Patch<std::int64_t>::claim(const std::array<Record, 3>&, std::size_t);
template void Patch<std::int64_t>::take_in_corners(const Question&);
template std::vector<std::int64_t> Patch<std::int64_t>::look_for_hubs() const;
template std::vector<std::int64_t> Patch<std::int64_t>::kept_hubs() const;
template void Patch<std::int64_t>::set_hubs(const std::unordered_set<std::int64_t>&);
template std::int64_t Patch<std::int64_t>::first_boundary_neighbour(std::int64_t) const;

}  // namespace pstripack
