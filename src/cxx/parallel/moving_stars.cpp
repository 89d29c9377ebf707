// A call that begins with the stars of the last one, in order:
//   1  every rank learns where the nodes are that its stars name and other ranks bring
//   2  every rank tests its own stars
//   3  arcs are flipped: by one rank alone where it brings all four nodes; else the ranks of its ends propose
//      the flip to those of the four nodes, which accept it or not, and each changes the stars that it has
//
// After each exchange the stars of all ranks together are one mesh again. Why the tests suffice:
// docs/internals/parallel.md, "Warm start".

#include "parallel/moving_stars.h"

#include <algorithm>
#include <numeric>
#include <unordered_map>
#include <utility>

#include "parallel/agreement.h"

namespace pstripack {
namespace {

/// Room at first for this many nodes that become nodes outside later.
constexpr std::size_t kRoom = 1000;

}  // namespace

// ---- the stars of the last call ------------------------------------------------------------------------

MovingStars::MovingStars(const NodeRanges& ranges, std::size_t size, RankNumber me, std::size_t outside)
    : ranges_(ranges),
      size_(size),
      me_(static_cast<RankOfNode>(me)),
      outside_by_counted_(outside + outside + kRoom) {}

template <class Int>
std::unique_ptr<MovingStars> MovingStars::make(const LocalNodes& nodes, const NodeRanges& ranges,
                                               const Stars<Int>& stars, Communicator& ranks,
                                               std::unique_ptr<MovingStars> last, const Relocation* way) {
  std::int64_t sums[] = {static_cast<std::int64_t>(stars.of_node.arcs()),
                         static_cast<std::int64_t>(stars.outside.size())};
  ranks.all_sum(sums, 2);
  if (sums[0] != 6 * ranges.nodes() - 12 || sums[1] > ranges.nodes()) return nullptr;

  std::unique_ptr<MovingStars> moving;
  std::vector<NodeAddress> outside;
  OnAll are_closed;  // a mesh has as many arcs if three nodes are its boundary
  in_agreement(
      ranks,
      [&] {
        const std::size_t count = stars.outside.size();
        moving.reset(new MovingStars(ranges, static_cast<std::size_t>(ranks.size()),
                                     static_cast<RankNumber>(ranks.rank()), count));
        moving->outside_.reserve(count + kRoom);
        for (const HaloNode& node : stars.outside) {
          moving->outside_by_counted_.insert(
              node.counted, static_cast<MeshNode>(stars.of_node.size() + moving->outside_.size()));
          moving->outside_.push_back({node.counted, node.number, 0});
        }
        outside = addresses_of(stars.outside, ranges);
        constexpr std::size_t kFew = 8;  // one node in kFew may lie far from its neighbours in memory
        if (way != nullptr && last != nullptr && last->come_ + way->come() <= nodes.count / kFew)
          moving->begin_with(*last, *way, stars);
        else
          are_closed.value = moving->begin(nodes, stars);
        if (!are_closed.value) return;
        moving->mesh_->for_each_arc_outside([&](std::size_t j) { ++moving->outside_[j].arcs; });
      },
      are_closed);
  if (!are_closed.value) return nullptr;
  moving->halo_ = Halo(outside, ranks);  // that of the stars may get nodes that are no neighbours any more
  return moving;
}

/// Lays out the stars. False if one is that of a boundary node.
template <class Int>
bool MovingStars::begin(const LocalNodes& nodes, const Stars<Int>& stars) {
  constexpr std::size_t kAhead = 16;
  const std::size_t n = nodes.count, arcs = stars.of_node.arcs(), outside = outside_.size();
  const std::size_t room = outside + kRoom;
  stay_.emplace(MovingMesh::bytes(n, arcs, n + outside + room));
  BlockArray<std::int32_t> list(arcs), lend(n);
  std::int32_t* at = list.data();
  for (std::size_t i = 0; i < n; ++i) {
    if (i + kAhead < n) stars.of_node.prefetch(i + kAhead);
    const Ring<Int> ring = stars.of_node[i];
    if (ring.begin[ring.count - 1] < 0) return false;
    for (std::uint32_t k = 0; k < ring.count; ++k)
      *at++ = static_cast<std::int32_t>(find(GlobalNumber{ring.begin[k]})) + 1;
    lend[i] = static_cast<std::int32_t>(at - list.data());
  }
  BlockArray<Point> points(n + outside);
  nodes.points.copy(0, n, points.data());
  std::fill(points.data() + n, points.data() + n + outside, Point{});
  mesh_.emplace(points.data(), n, list.data(), lend.data(), outside, room);
  return true;
}

/// The same from the stars of the last call.
template <class Int>
void MovingStars::begin_with(MovingStars& last, const Relocation& way, const Stars<Int>& stars) {
  const std::size_t n = stars.of_node.size(), arcs = stars.of_node.arcs(), outside = outside_.size();
  const std::size_t room = outside + kRoom, had = last.mesh_->size();
  last.stay_.reset();
  stay_.emplace(MovingMesh::bytes(n, arcs, n + outside + room));
  BlockArray<MeshNode> to(had + last.outside_.size());
  for (MeshNode v = 0; v < to.size(); ++v) to[v] = find(way.now(last.counted(v)));
  MovingMesh::MoreStars more;
  for (std::size_t i = 0; i < n; ++i) {
    if (!way.has_come(i)) continue;
    const Ring<Int> ring = stars.of_node[i];
    more.node.push_back(static_cast<MeshNode>(i));
    for (std::uint32_t k = 0; k < ring.count; ++k) more.ring.push_back(find(GlobalNumber{ring.begin[k]}));
    more.end.push_back(static_cast<std::uint32_t>(more.ring.size()));
  }
  mesh_.emplace(*last.mesh_, n, arcs, outside, room, to.data(), more);
  last.mesh_.reset();
  come_ = last.come_ + more.node.size();
}

// ---- 1, 2 and 3 ----------------------------------------------------------------------------------------

bool MovingStars::repair(const LocalNodes& nodes, Communicator& ranks, Confirm confirm) {
  constexpr int kMostRounds = 64;
  OnAll fits{move_nodes(nodes, ranks, confirm)};
  mesh_->begin(confirm);
  const std::optional<MovingMesh::Mark> mark = agree_on_mark(ranks);
  Proposals proposals;
  flips_of_others_ = 0;
  OnAny any{true};
  for (rounds_ = 0; rounds_ < kMostRounds; ++rounds_) {
    std::vector<Flip> mine;
    in_agreement(
        ranks,
        [&] {
          if (rounds_ == 0)
            fits.value = fits.value && mark && mesh_->test(*mark);
          else
            fits.value = flip_all(proposals);
          fits.value = fits.value && propose(nodes, mine) && !mesh_->differs();
          any.value = !mine.empty();
        },
        fits, any);
    if (!fits.value) return false;
    if (!any.value) break;
    proposals.flips = exchange_in_agreement(ranks, [&] { return sent_to_corners(mine); });
    proposals.verdicts = exchange_in_agreement(ranks, [&] { return verdicts_on(proposals); });
  }
  return !any.value;
}

/// Sets the positions of the nodes here and of those outside. True if all have the length that `confirm`
/// needs.
bool MovingStars::move_nodes(const LocalNodes& nodes, Communicator& ranks, Confirm confirm) {
  const bool fit = mesh_->move(nodes.points, confirm).fit;
  halo_.fetch<Point>(
      ranks, [&](LocalNode k) { return mesh_->node(k); },
      [&](OutsideNode j, const Point& p) { mesh_->node(nodes.count + index_of(j)) = p; });
  return fit;
}

/// The mark that the first rank with nodes chooses; none if it finds none.
std::optional<MovingMesh::Mark> MovingStars::agree_on_mark(Communicator& ranks) {
  MovingMesh::Mark mine;
  Mark mark;
  const bool have_one = me_ == ranges_.address(GlobalNumber{1}).rank && mesh_->choose_mark(mine);
  if (have_one) {
    for (int i = 0; i < 3; ++i) mark.corner[i] = counted(mine.corner[i]);
    mark.towards = mine.towards;
  }
  const Parcels all = ranks.all_gather(&mark, have_one ? sizeof mark : 0);
  const Items<Mark> marks(all);
  if (marks.size() == 0) return std::nullopt;
  for (int i = 0; i < 3; ++i) mine.corner[i] = find(marks.begin()->corner[i]);
  mine.towards = marks.begin()->towards;
  return mine;
}

/// Flips the arcs that this rank can flip alone, and proposes to flip the others. If two ranks propose the
/// same flip, the later proposal is not accepted.
bool MovingStars::propose(const LocalNodes& nodes, std::vector<Flip>& flips) {
  std::vector<MovingMesh::Quadrangle> across;
  if (!mesh_->flip_inside(across)) return false;
  for (const auto& q : across) {
    if (!mesh_->is_convex(q)) return false;
    const auto corner = [&](MeshNode v) {
      const GlobalNumber number = v < nodes.count ? nodes.number(v) : outside_[v - nodes.count].number;
      return Corner{mesh_->node(v), counted(v), number};
    };
    flips.push_back({{corner(q.a), corner(q.b), corner(q.c), corner(q.d)}});
  }
  return true;
}

/// The ranks of the corners, each once.
std::vector<RankNumber> MovingStars::ranks_of(const Flip& flip) const {
  std::vector<RankNumber> ranks;
  for (const Corner& c : flip.corner) ranks.push_back(ranges_.address(c.counted).rank);
  std::sort(ranks.begin(), ranks.end());
  ranks.erase(std::unique(ranks.begin(), ranks.end()), ranks.end());
  return ranks;
}

/// Proposals go to the ranks that have a star of theirs.
Parcels MovingStars::sent_to_corners(const std::vector<Flip>& flips) const {
  std::vector<std::vector<Flip>> to(size_);
  for (const Flip& flip : flips)
    for (const RankNumber r : ranks_of(flip)) to[r].push_back(flip);
  return packed(to);
}

/// All ranks see proposals in the order of the ranks that made them. A rank accepts one if it is the first at
/// each of its corners here, and tells the ranks of the other corners.
Parcels MovingStars::verdicts_on(Proposals& proposals) const {
  const Items<Flip> flips(proposals.flips);
  std::unordered_map<GlobalNumber, const Flip*> first;
  for (const Flip& flip : flips)
    for (const Corner& c : flip.corner)
      if (is_here(c.counted)) first.try_emplace(c.counted, &flip);
  proposals.accepted.clear();
  std::vector<std::vector<char>> to(size_);
  for (const Flip& flip : flips) {
    const bool accepts = std::all_of(std::begin(flip.corner), std::end(flip.corner), [&](const Corner& c) {
      return !is_here(c.counted) || first.at(c.counted) == &flip;
    });
    proposals.accepted.push_back(accepts);
    for (const RankNumber r : ranks_of(flip))
      if (r != me_) to[r].push_back(accepts);
  }
  return packed(to);
}

/// Flips what all ranks of its corners accept. The arcs of the others will be tested again.
bool MovingStars::flip_all(const Proposals& proposals) {
  std::vector<const char*> verdict;
  for (RankNumber r = 0; r < size_; ++r) verdict.push_back(Items<char>(proposals.verdicts, r).begin());
  std::size_t k = 0;
  for (const Flip& flip : Items<Flip>(proposals.flips)) {
    bool is_accepted = proposals.accepted[k++] != 0;
    for (const RankNumber r : ranks_of(flip))
      if (r != me_) is_accepted = *verdict[r]++ != 0 && is_accepted;
    if (!is_accepted)
      mesh_->suspect(find(flip.corner[0].counted), find(flip.corner[1].counted));
    else if (!flip_one(flip))
      return false;
  }
  return true;
}

bool MovingStars::flip_one(const Flip& flip) {
  const auto& [a, b, c, d] = flip.corner;
  const auto is_here = [&](const Corner& corner) { return this->is_here(corner.counted); };
  if (!meet(c, d) || !meet(d, c)) return false;
  const MovingMesh::Quadrangle q{find(a.counted), find(b.counted), find(c.counted), find(d.counted)};
  const auto count_arc = [&](const Corner& at, MeshNode other, std::uint32_t change) {
    if (is_here(at) && other >= mesh_->size()) {
      outside_[other - mesh_->size()].arcs += change;
      by_number_.reset();
    }
  };
  count_arc(a, q.b, -1u);
  count_arc(b, q.a, -1u);
  count_arc(c, q.d, 1);
  count_arc(d, q.c, 1);
  flips_of_others_ += !is_here(a);
  return mesh_->flip(q);
}

/// Two nodes become neighbours. If `one` is here and `other` is not, their ranks send each other the
/// positions from now on, unless they do so already, which both can see. False if there is no room.
bool MovingStars::meet(const Corner& one, const Corner& other) {
  if (!is_here(one.counted) || is_here(other.counted)) return true;
  const RankOfNode rank = ranges_.address(other.counted).rank;
  halo_.send(rank, ranges_.address(one.counted).node);
  if (find(other.counted) != MovingMesh::kNobody) return true;
  const MeshNode v = mesh_->add_outside(other.point);
  if (v == MovingMesh::kNobody) return false;
  outside_by_counted_.insert(other.counted, v);
  halo_.receive(rank, OutsideNode{static_cast<std::uint32_t>(outside_.size())});
  outside_.push_back({other.counted, other.number, 0});
  return true;
}

MeshNode MovingStars::find(GlobalNumber counted) const {
  if (is_here(counted)) return static_cast<MeshNode>(value_of(counted) - ranges_.first(me_));
  if (counted == kNoNumber) return MovingMesh::kNobody;
  const MeshNode* const found = outside_by_counted_.find(counted);
  return found != nullptr ? *found : MovingMesh::kNobody;
}

// ---- what has changed ----------------------------------------------------------------------------------

template <class Int>
void MovingStars::update(Stars<Int>& stars) {
  const std::size_t n = mesh_->size();
  std::vector<LocalNode> rewritten;
  const bool all = replaced_ > 8 * n;  // then rings that are not used any more are freed
  if (all) {
    rewritten.resize(n);
    std::iota(rewritten.begin(), rewritten.end(), 0u);
  } else {
    for (const MovingMesh::Change& change : mesh_->changes()) rewritten.push_back(change.node);
  }
  std::size_t entries = 0;
  for (const LocalNode k : rewritten) entries += 1 + mesh_->degree(k);
  stars.memory.reserve(stars.memory.size() + 1);
  Block rings((entries + kBlock) * sizeof(Int));  // see copy_ring
  std::vector<std::int32_t> ring;
  Int* at = reinterpret_cast<Int*>(rings.data());
  for (const LocalNode k : rewritten) {
    ring.resize(mesh_->degree(k));
    mesh_->write_ring(k, ring.data());
    stars.of_node.replace(k, at, static_cast<std::uint32_t>(ring.size()));
    *at++ = static_cast<Int>(ring.size());
    Int* const first = at;
    at = std::transform(ring.begin(), ring.end(), at, [&](std::int32_t v) {
      return static_cast<Int>(counted(static_cast<MeshNode>(v) - 1));
    });
    std::rotate(first, std::min_element(first, at), at);
  }
  if (all) stars.memory.clear();
  replaced_ = all ? 0 : replaced_ + entries;
  stars.memory.push_back(std::move(rings));
  mesh_->forget_changes();

  if (!by_number_) {
    std::vector<OutsideNode>& sorted = by_number_.emplace();
    for (std::uint32_t j = 0; j < outside_.size(); ++j)
      if (outside_[j].arcs > 0) sorted.push_back(OutsideNode{j});
    std::sort(sorted.begin(), sorted.end(), [&](OutsideNode a, OutsideNode b) {
      return outside_[index_of(a)].number < outside_[index_of(b)].number;
    });
    std::vector<OutsideNode> names(outside_.size(), Halo::kNobody);
    for (std::uint32_t k = 0; k < sorted.size(); ++k) names[index_of(sorted[k])] = OutsideNode{k};
    stars.halo = halo_.renamed(names);
  }
  stars.outside.clear();
  for (const OutsideNode j : *by_number_) {
    const Outside& node = outside_[index_of(j)];
    stars.outside.push_back({mesh_->node(n + index_of(j)), node.counted, node.number});
  }
}

// ---- samples -------------------------------------------------------------------------------------------

template <class Int>
SampleOfStars sample_of(const Stars<Int>& stars, const NodeRanges& ranges, RankNumber me) {
  SampleOfStars sample;
  std::vector<std::int32_t> local;
  SampleOfStars::for_each_node(stars.of_node.size(), [&](std::size_t k) {
    const Ring<Int> ring = stars.of_node[k];
    local.clear();
    for (std::uint32_t i = 0; i < ring.count; ++i)
      if (const GlobalNumber b{ring.begin[i]}; ranges.is_of(me, b))
        local.push_back(static_cast<std::int32_t>(ranges.address(b).node) + 1);
    if (local.size() == ring.count) sample.add(k, local.data(), local.size());
  });
  return sample;
}

template SampleOfStars sample_of(const Stars<std::int32_t>&, const NodeRanges&, RankNumber);
template std::unique_ptr<MovingStars> MovingStars::make(const LocalNodes&, const NodeRanges&,
                                                        const Stars<std::int32_t>&, Communicator&,
                                                        std::unique_ptr<MovingStars>, const Relocation*);
template void MovingStars::update(Stars<std::int32_t>&);
template SampleOfStars sample_of(const Stars<std::int64_t>&, const NodeRanges&, RankNumber);
template std::unique_ptr<MovingStars> MovingStars::make(const LocalNodes&, const NodeRanges&,
                                                        const Stars<std::int64_t>&, Communicator&,
                                                        std::unique_ptr<MovingStars>, const Relocation*);
template void MovingStars::update(Stars<std::int64_t>&);

}  // namespace pstripack
