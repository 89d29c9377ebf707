// A call that begins with the stars of the last one, in order:
//   1  every rank learns where the nodes are that its stars name and other ranks bring
//   2  every rank tests its own stars
//   3  arcs are flipped: by one rank alone where it brings all four nodes; else the ranks of its ends propose
//      the flip, all hear of it, and each changes the stars that it has
//
// After each exchange the stars of all ranks together are one mesh again. Why the tests suffice:
// docs/parallel.md, "Warm start".

#include "parallel/moving_stars.h"

#include <algorithm>
#include <atomic>
#include <cstdlib>
#include <numeric>
#include <unordered_set>
#include <utility>

#include "base/parallel_for.h"
#include "parallel/agreement.h"

namespace pstripack {
namespace {

/// A node outside the rank that asks, and which node it is of the rank that answers.
struct Found {
  OutsideNode outside;
  LocalNode node;
};

/// Room at first for this many nodes that become nodes outside later.
constexpr std::size_t kRoom = 1000;

}  // namespace

// ---- the stars of the last call ------------------------------------------------------------------------

template <class Int, class Begin>
std::unique_ptr<MovingStars> MovingStars::make(const LocalNodes& nodes, const Stars<Int>& stars,
                                               Communicator& ranks, const Begin& begin) {
  const auto size = static_cast<std::size_t>(ranks.size()), me = static_cast<RankNumber>(ranks.rank());
  std::int64_t sums[] = {static_cast<std::int64_t>(nodes.count),
                         static_cast<std::int64_t>(stars.of_node.arcs()),
                         static_cast<std::int64_t>(stars.outside.size())};
  ranks.all_sum(sums, 3);
  if (sums[1] != 6 * sums[0] - 12 || sums[2] > sums[0]) return nullptr;

  std::unique_ptr<MovingStars> moving;
  std::vector<GlobalNumber> numbers;
  Smallest first_with_nodes;
  if (nodes.count > 0) first_with_nodes.value = static_cast<std::int64_t>(me);
  in_agreement(
      ranks,
      [&] {
        moving.reset(new MovingStars(size, me));
        for (const Record& r : stars.outside) numbers.push_back(r.number);
      },
      first_with_nodes);
  moving->first_with_nodes_ = static_cast<RankNumber>(first_with_nodes.value);
  const Parcels wanted = ranks.all_gather(numbers.data(), numbers.size() * sizeof(GlobalNumber));
  const Parcels found = exchange_in_agreement(ranks, [&] { return begin(*moving, wanted); });
  in_agreement(ranks, [&] {
    moving->mesh_->for_each_arc_outside([&](std::size_t j) { ++moving->outside_[j].arcs; });
    moving->sort_outside();
    for (RankNumber r = 0; r < size; ++r)
      for (const Found& f : Items<Found>(found, r)) {
        moving->outside_[index_of(f.outside)].address = {static_cast<RankOfNode>(r), f.node};
        moving->receive_[r].push_back(f.outside);
      }
  });
  return moving;
}

template <class Int>
std::unique_ptr<MovingStars> MovingStars::make(const LocalNodes& nodes, const Stars<Int>& stars,
                                               Communicator& ranks) {
  return make(nodes, stars, ranks,
              [&](MovingStars& moving, const Parcels& wanted) { return moving.begin(nodes, stars, wanted); });
}

template <class Int>
std::unique_ptr<MovingStars> MovingStars::make(const LocalNodes& nodes, const Stars<Int>& stars,
                                               Communicator& ranks, std::unique_ptr<MovingStars> last,
                                               const Relocation& way) {
  constexpr std::size_t kFew = 8;  // one node in kFew may lie far from its neighbours in memory
  const bool is_of_use = last != nullptr && last->come_ + way.come() <= nodes.count / kFew;
  return make(nodes, stars, ranks, [&](MovingStars& moving, const Parcels& wanted) {
    return is_of_use ? moving.begin_with(*last, way, nodes, stars, wanted)
                     : moving.begin(nodes, stars, wanted);
  });
}

/// Finds which of the numbers that each rank wants are brought here. `local` has the numbers of the nodes
/// here.
Parcels MovingStars::find_wanted(const Parcels& wanted, const NumberTable<MeshNode>& local) {
  std::vector<std::vector<Found>> found(send_.size());
  for (RankNumber r = 0; r < found.size(); ++r) {
    std::uint32_t place = 0;
    for (const GlobalNumber number : Items<GlobalNumber>(wanted, r)) {
      if (const MeshNode* const i = local.find_value(number); i != nullptr) {
        found[r].push_back({OutsideNode{place}, *i});
        send_[r].push_back(*i);
      }
      ++place;
    }
  }
  return packed(found);
}

void MovingStars::enter_outside(const std::vector<Record>& outside, std::size_t n,
                                NumberTable<MeshNode>& local) {
  outside_.reserve(outside.size() + kRoom);
  for (const Record& r : outside) {
    local.insert(r.number, static_cast<MeshNode>(n + outside_.size()));
    outside_.push_back({{}, r.number, 0});
  }
}

/// Lays out the stars.
template <class Int>
Parcels MovingStars::begin(const LocalNodes& nodes, const Stars<Int>& stars, const Parcels& wanted) {
  constexpr std::size_t kAhead = 16;
  const std::size_t n = nodes.count, arcs = stars.of_node.arcs(), outside = stars.outside.size();
  const std::size_t room = outside + kRoom;
  stay_.emplace(MovingMesh::bytes(n, arcs, n + outside + room));
  NumberTable<MeshNode> local(n + outside);
  for (std::size_t i = 0; i < n; ++i) {
    if (i + kAhead < n) local.prefetch(nodes.number(i + kAhead));
    local.insert(nodes.number(i), static_cast<MeshNode>(i));
  }
  Parcels found = find_wanted(wanted, local);
  enter_outside(stars.outside, n, local);
  BlockArray<std::int32_t> list(arcs), lend(n);
  std::int32_t* at = list.data();
  for (std::size_t i = 0; i < n; ++i) {
    if (i + 2 * kAhead < n) stars.of_node.prefetch(i + 2 * kAhead);
    if (i + kAhead < n) {
      const Ring<Int> soon = stars.of_node[i + kAhead];
      for (std::uint32_t k = 0; k < soon.count; ++k) local.prefetch(GlobalNumber{soon.begin[k]});
    }
    const Ring<Int> ring = stars.of_node[i];
    for (std::uint32_t k = 0; k < ring.count; ++k)
      *at++ = static_cast<std::int32_t>(local.at(GlobalNumber{ring.begin[k]})) + 1;
    lend[i] = static_cast<std::int32_t>(at - list.data());
  }
  BlockArray<Point> points(n + outside);
  nodes.points.copy(0, n, points.data());
  std::fill(points.data() + n, points.data() + n + outside, Point{});
  mesh_.emplace(points.data(), n, list.data(), lend.data(), outside, room);
  return found;
}

/// The same from the stars of the last call. Only nodes that have come or gone, and their neighbours, are
/// searched by number.
template <class Int>
Parcels MovingStars::begin_with(MovingStars& last, const Relocation& way, const LocalNodes& nodes,
                                const Stars<Int>& stars, const Parcels& wanted) {
  const std::size_t n = nodes.count, arcs = stars.of_node.arcs(), outside = stars.outside.size();
  const std::size_t room = outside + kRoom;
  last.stay_.reset();
  stay_.emplace(MovingMesh::bytes(n, arcs, n + outside + room));
  std::vector<LocalNode> come;
  for (std::size_t i = 0; i < n; ++i)
    if (way.has_come(i)) come.push_back(static_cast<LocalNode>(i));
  MovingMesh::MoreStars more;
  const auto for_each_neighbour = [&](const auto& visit, const auto& end) {
    for (const LocalNode i : come) {
      const Ring<Int> ring = stars.of_node[i];
      std::for_each(ring.begin, ring.begin + ring.count, visit);
      end();
    }
  };
  std::size_t named = Items<GlobalNumber>(wanted).size();
  for_each_neighbour([&](Int) { ++named; }, [] {});
  NumberFilter filter(named);
  for (const GlobalNumber number : Items<GlobalNumber>(wanted)) filter.add(number);
  for_each_neighbour([&](Int number) { filter.add(GlobalNumber{number}); }, [] {});
  std::vector<LocalNode> here;
  for (std::size_t i = 0; i < n; ++i)
    if (way.has_come(i) || filter.may_have(nodes.number(i))) here.push_back(static_cast<LocalNode>(i));
  NumberTable<MeshNode> local(here.size() + outside);
  for (const LocalNode i : here) local.insert(nodes.number(i), i);
  Parcels found = find_wanted(wanted, local);
  enter_outside(stars.outside, n, local);

  const std::size_t had = way.had();
  BlockArray<MeshNode> to(had + last.outside_.size());
  for (std::size_t k = 0; k < had; ++k)
    to[k] = way.to(k) != Relocation::kGone ? way.to(k) : MovingMesh::kNobody;
  way.for_each_that_has_gone([&](std::size_t k, GlobalNumber number) { to[k] = local.at(number); });
  for (std::size_t j = 0; j < last.outside_.size(); ++j) {
    const MeshNode* const node = local.find_value(last.outside_[j].number);
    to[had + j] = node != nullptr ? *node : MovingMesh::kNobody;
  }
  more.node = come;
  for_each_neighbour([&](Int number) { more.ring.push_back(local.at(GlobalNumber{number})); },
                     [&] { more.end.push_back(static_cast<std::uint32_t>(more.ring.size())); });
  mesh_.emplace(*last.mesh_, n, arcs, outside, room, to.data(), more);
  last.mesh_.reset();
  come_ = last.come_ + come.size();
  return found;
}

void MovingStars::sort_outside() {
  std::vector<OutsideNode> sorted;
  for (std::uint32_t j = 0; j < outside_.size(); ++j)
    if (outside_[j].arcs > 0) sorted.push_back(OutsideNode{j});
  std::sort(sorted.begin(), sorted.end(), [&](OutsideNode a, OutsideNode b) {
    return outside_[index_of(a)].number < outside_[index_of(b)].number;
  });
  by_number_ = std::move(sorted);
}

// ---- 1, 2 and 3 ----------------------------------------------------------------------------------------

bool MovingStars::repair(const LocalNodes& nodes, Communicator& ranks, Confirm confirm) {
  constexpr int kMostRounds = 64;
  OnAll fits{move_nodes(nodes, ranks, confirm)};
  mesh_->begin(confirm);
  const std::optional<MovingMesh::Mark> mark = agree_on_mark(ranks);
  Parcels flips;
  flips_of_others_ = 0;
  OnAny any{true};
  for (rounds_ = 0; any.value && rounds_ < kMostRounds; ++rounds_) {
    std::vector<Flip> mine;
    in_agreement(
        ranks,
        [&] {
          if (rounds_ == 0)
            fits.value = fits.value && mark && mesh_->test(*mark);
          else
            fits.value = flip_all(flips);
          fits.value = fits.value && propose(nodes, mine) && !mesh_->differs();
          any.value = !mine.empty();
        },
        fits, any);
    if (!fits.value) return false;
    if (any.value) flips = ranks.all_gather(mine.data(), mine.size() * sizeof(Flip));
  }
  --rounds_;
  return !any.value;
}

/// Sets the positions of the nodes here and sends them to the ranks that know these nodes. True if all have
/// the length that `confirm` needs.
bool MovingStars::move_nodes(const LocalNodes& nodes, Communicator& ranks, Confirm confirm) {
  constexpr std::size_t kAhead = 16;
  const bool is_exact = confirm == Confirm::directions;
  const auto is_one = [&](const Point& p) {
    return is_exact ? length_is_one_up_to_rounding(p) : length_is_one(p);
  };
  MovingMesh& mesh = *mesh_;
  std::atomic<bool> all_have_length_one{true};
  const Parcels arrived = exchange_in_agreement(ranks, [&] {
    nodes.points.visit([&](const auto& node) {
      parallel_pieces(nodes.count, threads_for(nodes.count), [&](std::size_t first, std::size_t last, int) {
        bool have_length_one = true;
        for (std::size_t k = first; k < last; ++k) {
          if (k + kAhead < last) mesh.prefetch(k + kAhead);
          const Point p = node(k);
          have_length_one = have_length_one & is_one(p);
          mesh.node(k) = p;
        }
        if (!have_length_one) all_have_length_one = false;
      });
    });
    ParcelWriter writer(send_.size());
    for (RankNumber r = 0; r < send_.size(); ++r) writer.expect<Point>(r, send_[r].size());
    writer.make_room();
    for (RankNumber r = 0; r < send_.size(); ++r)
      for (const LocalNode k : send_[r]) writer.put(r, mesh.node(k));
    return writer.finish();
  });
  for (RankNumber r = 0; r < receive_.size(); ++r) {
    const Point* p = Items<Point>(arrived, r).begin();
    for (const OutsideNode j : receive_[r]) mesh.node(nodes.count + index_of(j)) = *p++;
  }
  return all_have_length_one;
}

/// The mark that the first rank with nodes chooses; none if it finds none.
std::optional<MovingMesh::Mark> MovingStars::agree_on_mark(Communicator& ranks) {
  MovingMesh::Mark mine;
  Mark mark;
  const bool have_one = me_ == first_with_nodes_ && mesh_->choose_mark(mine);
  if (have_one) {
    for (int i = 0; i < 3; ++i) mark.corner[i] = address_of(mine.corner[i]);
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
      return Corner{address_of(v), number, mesh_->node(v)};
    };
    flips.push_back({{corner(q.a), corner(q.b), corner(q.c), corner(q.d)}});
  }
  return true;
}

/// Goes through the proposals in their order, the same on every rank, and accepts those that share no node
/// with one accepted before. The arcs of the others will be tested again.
bool MovingStars::flip_all(const Parcels& flips) {
  std::unordered_set<std::uint64_t> taken;
  for (const Flip& flip : Items<Flip>(flips)) {
    const auto is_taken = [&](const Corner& c) { return taken.count(c.address.key()) > 0; };
    if (std::any_of(std::begin(flip.corner), std::end(flip.corner), is_taken)) {
      mesh_->suspect(find(flip.corner[0].address), find(flip.corner[1].address));
      continue;
    }
    for (const Corner& c : flip.corner) taken.insert(c.address.key());
    if (!flip_one(flip)) return false;
  }
  return true;
}

bool MovingStars::flip_one(const Flip& flip) {
  const auto& [a, b, c, d] = flip.corner;
  const auto is_here = [&](const Corner& corner) { return corner.address.rank == me_; };
  if (std::none_of(std::begin(flip.corner), std::end(flip.corner), is_here)) return true;
  if (!meet(c, d) || !meet(d, c)) return false;
  const MovingMesh::Quadrangle q{find(a.address), find(b.address), find(c.address), find(d.address)};
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
  if (one.address.rank != me_ || other.address.rank == me_) return true;
  std::vector<LocalNode>& send = send_[other.address.rank];
  if (std::find(send.begin(), send.end(), one.address.node) == send.end()) send.push_back(one.address.node);
  if (find(other.address) != MovingMesh::kNobody) return true;
  if (mesh_->add_outside(other.point) == MovingMesh::kNobody) return false;
  receive_[other.address.rank].push_back(OutsideNode{static_cast<std::uint32_t>(outside_.size())});
  outside_.push_back({other.address, other.number, 0});
  return true;
}

/// The node of the mesh here; kNobody if this rank does not know the address.
MeshNode MovingStars::find(const Address& address) const {
  if (address.rank == me_) return address.node;
  const auto found = std::find_if(outside_.begin(), outside_.end(),
                                  [&](const Outside& node) { return node.address == address; });
  if (found == outside_.end()) return MovingMesh::kNobody;
  return static_cast<MeshNode>(mesh_->size() + static_cast<std::size_t>(found - outside_.begin()));
}

// ---- what has changed ----------------------------------------------------------------------------------

template <class Int>
std::vector<LocalNode> MovingStars::update(const LocalNodes& nodes, Stars<Int>& stars) {
  const std::size_t n = nodes.count;
  const auto number_of = [&](std::int32_t node) {
    const auto k = static_cast<std::size_t>(node) - 1;
    return static_cast<Int>(k < n ? nodes.number(k) : outside_[k - n].number);
  };
  std::vector<LocalNode> changed, all;
  for (const auto& change : mesh_->changes()) changed.push_back(change.node);
  if (replaced_ > 8 * n) {  // then rings that are not used any more are freed
    all.resize(n);
    std::iota(all.begin(), all.end(), 0u);
    replaced_ = 0;
  }
  const std::vector<LocalNode>& rewritten = all.empty() ? changed : all;
  std::size_t entries = 0;
  for (const LocalNode k : rewritten) entries += 1 + mesh_->degree(k);
  Buffer<Int> rings(entries + kBlock);  // see copy_kept_ring
  stars.more_memory.reserve(stars.more_memory.size() + 1);
  std::vector<std::int32_t> ring;
  Int* at = rings.data();
  for (const LocalNode k : rewritten) {
    ring.resize(mesh_->degree(k));
    mesh_->write_ring(k, ring.data());
    Int* const place = at;
    *at++ = static_cast<Int>(ring.size());
    at = std::transform(ring.begin(), ring.end(), at, number_of);
    std::rotate(place + 1, std::min_element(place + 1, at), at);
    stars.of_node.replace(k, place);
  }
  if (!all.empty()) stars.more_memory.clear();
  stars.more_memory.push_back(std::move(rings));
  if (all.empty()) replaced_ += entries;
  mesh_->forget_changes();

  if (!by_number_) sort_outside();
  stars.outside.clear();
  for (const OutsideNode j : *by_number_)
    stars.outside.push_back({mesh_->node(n + index_of(j)), outside_[index_of(j)].number});
  stars.lengths = Lengths::as_given;
  return changed;
}

// ---- samples -------------------------------------------------------------------------------------------

SampleOfStars MovingStars::sample() const {
  SampleOfStars sample;
  std::vector<std::int32_t> ring;
  SampleOfStars::for_each_node(mesh_->size(), [&](std::size_t k) {
    ring.resize(mesh_->degree(k));
    mesh_->write_ring(k, ring.data());
    if (static_cast<std::size_t>(*std::max_element(ring.begin(), ring.end())) <= mesh_->size())
      sample.add(k, ring.data(), ring.size());
  });
  return sample;
}

/// The stars name few of all nodes. A filter, by some bits of the number, spares most other nodes the search.
template <class Int>
SampleOfStars sample_of(const LocalNodes& nodes, const Stars<Int>& stars) {
  const auto for_each_star = [&](const auto& visit) {
    SampleOfStars::for_each_node(nodes.count, [&](std::size_t k) { visit(k, stars.of_node[k]); });
  };
  std::size_t named = 0;
  for_each_star([&](std::size_t, const Ring<Int>& ring) { named += ring.count; });
  NumberFilter filter(named);
  for_each_star([&](std::size_t, const Ring<Int>& ring) {
    for (std::uint32_t i = 0; i < ring.count; ++i) filter.add(named_by(ring.begin[i]));
  });
  std::vector<std::pair<GlobalNumber, std::int32_t>> known;
  for (std::size_t i = 0; i < nodes.count; ++i)
    if (const GlobalNumber number = nodes.number(i); filter.may_have(number))
      known.emplace_back(number, static_cast<std::int32_t>(i) + 1);
  std::sort(known.begin(), known.end());
  SampleOfStars sample;
  std::vector<std::int32_t> local;
  for_each_star([&](std::size_t k, const Ring<Int>& ring) {
    local.clear();
    for (std::uint32_t i = 0; i < ring.count; ++i) {
      const std::pair<GlobalNumber, std::int32_t> least(GlobalNumber{ring.begin[i]}, 0);
      const auto found = std::lower_bound(known.begin(), known.end(), least);
      if (found != known.end() && found->first == GlobalNumber{ring.begin[i]}) local.push_back(found->second);
    }
    if (local.size() == ring.count) sample.add(k, local.data(), local.size());
  });
  return sample;
}

template SampleOfStars sample_of(const LocalNodes&, const Stars<std::int32_t>&);
template SampleOfStars sample_of(const LocalNodes&, const Stars<std::int64_t>&);
template std::unique_ptr<MovingStars> MovingStars::make(const LocalNodes&, const Stars<std::int32_t>&,
                                                        Communicator&);
template std::unique_ptr<MovingStars> MovingStars::make(const LocalNodes&, const Stars<std::int32_t>&,
                                                        Communicator&, std::unique_ptr<MovingStars>,
                                                        const Relocation&);
template std::unique_ptr<MovingStars> MovingStars::make(const LocalNodes&, const Stars<std::int64_t>&,
                                                        Communicator&);
template std::unique_ptr<MovingStars> MovingStars::make(const LocalNodes&, const Stars<std::int64_t>&,
                                                        Communicator&, std::unique_ptr<MovingStars>,
                                                        const Relocation&);
template std::vector<LocalNode> MovingStars::update(const LocalNodes&, Stars<std::int32_t>&);
template std::vector<LocalNode> MovingStars::update(const LocalNodes&, Stars<std::int64_t>&);

}  // namespace pstripack
