#include "parallel/patch_lists.h"

#include <algorithm>
#include <cassert>

#include "base/splitmix64.h"

namespace pstripack {
namespace {

template <class Int>
Listed<Int> listed(const PatchHull<Int>& hull, HullFace t) {
  const auto& vertex = hull.face(t).vertex;
  const std::uint32_t a = first_vertex(hull, t), b = next_edge(a);
  const auto number = [&](std::uint32_t i) { return static_cast<Int>(hull.number(vertex[i])); };
  return {number(a), number(b), number(next_edge(b))};
}

/// Finds entries by their triangles.
class Index {
 public:
  explicit Index(std::size_t most) {
    std::size_t places = 16;
    while (places < 2 * most) places *= 2;
    place_.assign(places, kEmpty);
  }
  template <class Int>
  std::size_t home(const Listed<Int>& t) const {
    const auto a = static_cast<std::uint64_t>(t[0]), b = static_cast<std::uint64_t>(t[1]),
               c = static_cast<std::uint64_t>(t[2]);
    return splitmix64(a ^ b << 22 ^ c << 43 ^ c >> 21) & (place_.size() - 1);
  }
  /// The place of an entry for which is(entry) is true, or an empty place.
  template <class Is>
  std::uint32_t& find(std::size_t home, const Is& is) {
    while (place_[home] != kEmpty && !is(place_[home])) home = (home + 1) & (place_.size() - 1);
    return place_[home];
  }
  static constexpr std::uint32_t kEmpty = UINT32_MAX;

 private:
  std::vector<std::uint32_t> place_;
};

}  // namespace

template <class Int>
void PatchLists<Int>::update(const PatchView<Int>& patch) {
  const PatchHull<Int>& hull = patch.hull;
  const std::size_t n = hull.growing().node_count(), first_new = owner_.size();
  if (first_new == n) return;
  owner_.resize(n, kNone);
  counts_.assign(static_cast<std::size_t>(patch.partition.patches()), 0);
  // A face that is new since the last time has a new node.
  entries_.erase(std::remove_if(entries_.begin(), entries_.end(),
                                [&](const Entry& e) {
                                  const auto& v = hull.face(e.face).vertex;
                                  return v[0] >= first_new || v[1] >= first_new || v[2] >= first_new;
                                }),
                 entries_.end());
  hull.for_each_face_at_border(first_new, [&](HullFace t) {
    if (!hull.is_front(t)) return;
    Entry entry{{}, t, {kNone, kNone}};
    const auto& vertex = hull.face(t).vertex;
    for (const HullNode v : {vertex[0], vertex[1], vertex[2]}) {
      if (hull.is_own(v)) continue;
      if (owner_[v] == kNone) owner_[v] = patch.owner(v);
      if (entry.other[0] == kNone)
        entry.other[0] = owner_[v];
      else if (entry.other[0] != owner_[v])
        entry.other[1] = owner_[v];
    }
    entry.triangle = listed(hull, t);
    entries_.push_back(entry);
  });
  assert(std::all_of(entries_.begin(), entries_.end(),
                     [&](const Entry& e) { return e.triangle == listed(hull, e.face); }));
  assert([&] {
    std::size_t faces = 0;
    hull.for_each_face_at_border(0, [&](HullFace t) { faces += hull.is_front(t); });
    return faces == entries_.size();
  }());
  for_each([&](PatchNumber q, const Listed<Int>&) { ++counts_[static_cast<std::size_t>(q)]; });
}

template <class Int>
std::vector<Question> PatchLists<Int>::lacking(const PatchView<Int>& patch,
                                               const std::vector<ListOfOther<Int>>& lists) const {
  Index index(entries_.size());
  const auto find = [&](const Listed<Int>& triangle) -> std::uint32_t& {
    return index.find(index.home(triangle),
                      [&](std::uint32_t e) { return entries_[e].triangle == triangle; });
  };
  for (std::uint32_t e = 0; e < entries_.size(); ++e) find(entries_[e].triangle) = e;
  std::vector<std::array<bool, 2>> has(entries_.size());  // the other patch has the triangle
  for (const ListOfOther<Int>& list : lists)
    for (const Listed<Int>* t = list.first; t < list.first + list.count; ++t)
      if (const std::uint32_t e = find(*t); e != Index::kEmpty)
        has[e][entries_[e].other[1] == list.from] = true;
  std::vector<Question> questions;
  for (std::uint32_t e = 0; e < entries_.size(); ++e)
    for (std::size_t k = 0; k < 2; ++k) {
      if (entries_[e].other[k] == kNone || has[e][k]) continue;
      questions.push_back(question_about(patch, entries_[e].face));
      questions.back().to = entries_[e].other[k];
    }
  return questions;
}

template class PatchLists<std::int32_t>;
template class PatchLists<std::int64_t>;

}  // namespace pstripack
