#include "trmesh/warm_start.h"

#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <optional>
#include <utility>
#include <vector>

#include "base/cached.h"
#include "base/parallel_for.h"
#include "lists/list_pieces.h"
#include "mesh/sample_of_stars.h"
#include "parallel/environment_options.h"

namespace pstripack {
namespace {

SampleOfStars sample_of(std::size_t n, const std::int32_t* list, const std::int32_t* lend) {
  SampleOfStars sample;
  SampleOfStars::for_each_node(n, [&](std::size_t k) {
    const std::int32_t begin = k == 0 ? 0 : lend[k - 1];
    sample.add(k, list + begin, static_cast<std::size_t>(lend[k] - begin));
  });
  return sample;
}

}  // namespace

/// LIST and LEND of a mesh. `mesh` is made by the first call that starts from it.
struct CachedMesh {
  CachedMesh(std::size_t n, std::size_t slots)
      : reservation((slots + n) * sizeof(std::int32_t) + MovingMesh::bytes(n, slots, n)),
        list(slots),
        lend(n) {}
  std::int32_t begin(std::size_t k) const { return k == 0 ? 0 : lend[k - 1]; }
  /// Throws std::bad_alloc.
  void find_changes();
  /// After find_changes(): writes the lists of the mesh: runs of the cached lists, and a new ring for each
  /// change. Parallel.
  void write(std::int32_t* to_list, std::int32_t* to_lptr, std::int32_t* to_lend) const;

  const CacheReservation reservation;
  BlockArray<std::int32_t> list, lend;
  std::optional<MovingMesh> mesh;
  std::vector<MovingMesh::Change> changes;  ///< of the mesh since `list` was written
  std::vector<std::int32_t> shift;          ///< [j]: shift, in slots, of the lists after the first j changes
};

struct LastMesh : CachedThing {
  LastMesh(std::size_t nodes, SampleOfStars some, const Patience& p)
      : n(nodes), sample(std::move(some)), patience(p) {}
  const std::size_t n;
  const pid_t process = getpid();
  SampleOfStars sample;
  Patience patience;
  std::unique_ptr<CachedMesh> cached;
  Confirm confirm = Confirm::nothing;  ///< of the call that left the mesh

  void lose_patience() {
    patience.fail();
    cached.reset();
  }
};

namespace {

/// Takes the mesh of an earlier call whose sample fits these nodes; null if there is none. If meshes with
/// as many nodes do not fit, raises `patience` to theirs.
std::unique_ptr<LastMesh> take_last_mesh(const NodeArrays& nodes, std::size_t n, Patience& patience) {
  for (int place = 0; place < kSharedPlaces; ++place) {
    std::unique_ptr<CachedThing> thing = take_out_of(place);
    auto* const last = static_cast<LastMesh*>(thing.get());
    if (last == nullptr || last->process != getpid()) continue;  // a forked child begins anew
    if (last->n == n) {
      if (last->sample.fits(nodes)) return thing.release(), std::unique_ptr<LastMesh>(last);
      patience = longest(patience, last->patience);
    }
    put_into(place, thing);
  }
  return nullptr;
}

void put_back(std::unique_ptr<CachedThing> last) {
  for (int place = 0; place < kSharedPlaces; ++place)
    if (put_into(place, last)) return;
  static std::atomic<unsigned> next_to_go{0};
  const auto place = static_cast<int>(next_to_go++ % unsigned{kSharedPlaces});
  take_out_of(place);
  put_into(place, last);
}

// ---- lists ------------------------------------------------------------------------------------------------

void copy(const std::int32_t* from, std::size_t count, std::int32_t* to) {
  parallel_pieces(count, threads_for(count / 8), [&](std::size_t first, std::size_t last, int) {
    std::copy(from + first, from + last, to + first);
  });
}

}  // namespace

void CachedMesh::find_changes() {
  changes = mesh->changes();
  shift.assign(changes.size() + 1, 0);
  for (std::size_t j = 0; j < changes.size(); ++j) {
    const auto [k, count] = changes[j];
    shift[j + 1] = shift[j] + static_cast<std::int32_t>(count) - (lend[k] - begin(k));
  }
}

void CachedMesh::write(std::int32_t* to_list, std::int32_t* to_lptr, std::int32_t* to_lend) const {
  const std::size_t n = mesh->size();
  const std::int32_t *const old_list = list.data(), *const old_end = lend.data();
  const int threads = threads_for(n);
  parallel_pieces(n, threads, [&](std::size_t first, std::size_t last, int) {
    auto j = static_cast<std::size_t>(
        std::lower_bound(changes.begin(), changes.end(), first,
                         [](const MovingMesh::Change& c, std::size_t k) { return c.node < k; }) -
        changes.begin());
    for (std::size_t k = first; k < last;) {
      const std::int32_t from = begin(k), here = shift[j];
      const std::size_t end = j < changes.size() ? std::min<std::size_t>(changes[j].node, last) : last;
      if (end > k) std::copy(old_list + from, old_list + old_end[end - 1], to_list + from + here);
      for (; k < end; ++k) to_lend[k] = old_end[k] + here;
      if (k == last) break;
      const std::int32_t place = begin(k) + here;
      mesh->write_ring(k, to_list + place);
      to_lend[k++] = place + static_cast<std::int32_t>(changes[j++].count);
    }
  });
  write_lptr(to_lend, n, 0, to_lptr, threads);
}

WarmStart::WarmStart(const NodeArrays& nodes, std::size_t n, Confirm confirm)
    : nodes_(nodes), n_(n), confirm_(confirm) {
  if (n >= kFewestForWarmStart && warm_start_is_allowed()) last_ = take_last_mesh(nodes, n, patience_);
}

WarmStart::~WarmStart() {
  if (last_ != nullptr) put_back(std::move(last_));
}

bool WarmStart::is_prepared() const { return last_ != nullptr && last_->cached != nullptr; }

/// Sets the positions of the mesh's nodes, after making the mesh if need be. What is made anew counts as
/// moved.
MovingMesh::Moved WarmStart::move_nodes(CachedMesh& cached) const {
  const bool is_new = !cached.mesh;
  if (is_new) {
    BlockArray<Point> points(n_);
    nodes_.copy(0, n_, points.data());
    const auto fits = [&](const Point& p) { return has_length_for(confirm_, p); };
    if (!std::all_of(points.begin(), points.end(), fits)) return {false, false};
    cached.mesh.emplace(points.data(), n_, cached.list.data(), cached.lend.data());
  }
  const auto [fit, any_has_moved] = cached.mesh->move(nodes_, confirm_);
  return {fit, any_has_moved || is_new};
}

bool WarmStart::find_mesh(ParallelCost* cost) noexcept {
  if (!is_prepared()) return false;
  CachedMesh& cached = *last_->cached;
  try {
    MovingMesh::Moved moved;
    {
      const PhaseTimer timer(cost, ParallelCost::divide);
      moved = move_nodes(cached);
    }
    bool fits = moved.fit && left(nodes_[0], nodes_[1], nodes_[2]) != 0;
    const PhaseTimer timer(cost, ParallelCost::triangulate);
    if (fits && (moved.any || last_->confirm != confirm_)) fits = cached.mesh->repair(confirm_);
    last_->confirm = confirm_;
    if (fits) {
      cached.find_changes();
      if (cost != nullptr) {
        cost->set_threads(thread_count(n_));
        cost->flips = moved.any ? static_cast<std::int64_t>(cached.mesh->flips()) : 0;
      }
      return true;
    }
  } catch (const std::bad_alloc&) {
  }
  last_->lose_patience();
  return false;
}

void WarmStart::write(const ListArrays& lists, ParallelCost* cost) noexcept {
  CachedMesh& cached = *last_->cached;
  const auto& [list, lptr, lend, lnew] = lists;
  {
    const PhaseTimer timer(cost, ParallelCost::lists);
    cached.write(list, lptr, lend);
    *lnew = lend[n_ - 1] + 1;
    if (cached.changes.size() > n_ / 16) {
      copy(list, cached.list.size(), cached.list.data());
      copy(lend, n_, cached.lend.data());
      cached.mesh->forget_changes();
    }
    cached.changes = {};
    last_->patience.succeed();
  }
  take_sample(list, lend);
}

/// Without memory for the sample, nothing is cached.
void WarmStart::take_sample(const std::int32_t* list, const std::int32_t* lend) noexcept {
  try {
    last_->sample = sample_of(n_, list, lend);
  } catch (const std::bad_alloc&) {
    last_.reset();
  }
}

void WarmStart::remember(const ListArrays& lists) noexcept {
  const auto& [list, lptr, lend, lnew] = lists;
  const auto slots = static_cast<std::size_t>(*lnew) - 1;
  if (n_ < kFewestForWarmStart || !warm_start_is_allowed() || slots != 6 * n_ - 12)
    return;  // no warm start for meshes with a boundary
  try {
    if (last_ == nullptr) {
      last_ = std::make_unique<LastMesh>(n_, sample_of(n_, list, lend), patience_);
      return;
    }
    if (last_->patience.is_enough()) {
      last_->cached = std::make_unique<CachedMesh>(n_, slots);
      copy(list, slots, last_->cached->list.data());
      copy(lend, n_, last_->cached->lend.data());
    }
  } catch (const std::bad_alloc&) {
    // No memory: the next call is cold, too.
  }
  if (last_ != nullptr) take_sample(list, lend);
}

}  // namespace pstripack
