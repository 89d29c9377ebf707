// The parallel triangulation, in order:
//   1  divide        a sample of the nodes, the same on every rank, and counts near the cuts cut the sphere
//                    into patches; every node goes to its patch and to those that have it in their halo
//   2  triangulate   every patch its own nodes, its halo and a few nodes from everywhere
//   3  merge         every patch asks the others about what it cannot know, until nothing is left to ask
//   4  lists         the stars of the nodes go back to the ranks that brought them
//
// Patches are divided among the ranks, one after another, and a rank's among its threads. There is no
// sequential merge: the predicates are exact and know nothing of numbers, so two patches never disagree on a
// triangle whose circumscribed cap both know.

#include "parallel/triangulate.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <numeric>
#include <optional>

#include "geometry/insertion_order.h"
#include "geometry/parallel_for.h"
#include "geometry/workspace.h"
#include "parallel/patch.h"
#include "parallel/sample.h"

namespace pstripack {
namespace {

/// Sorts by number and leaves out what is there twice.
void keep_one_of_each(std::vector<Record>& nodes) {
  std::sort(nodes.begin(), nodes.end(), [](const Record& a, const Record& b) { return a.number < b.number; });
  nodes.erase(std::unique(nodes.begin(), nodes.end(),
                          [](const Record& a, const Record& b) { return a.number == b.number; }),
              nodes.end());
}

/// Items for every rank, in the order of the ranks.
template <class Item>
Parcels parcels(const std::vector<std::vector<Item>>& items) {
  Parcels p;
  p.begin.push_back(0);
  for (const auto& v : items) p.begin.push_back(p.begin.back() + v.size() * sizeof(Item));
  p.bytes = Block(p.begin.back());
  for (std::size_t r = 0; r < items.size(); ++r)
    if (!items[r].empty())
      std::memcpy(p.bytes.data() + p.begin[r], items[r].data(), items[r].size() * sizeof(Item));
  return p;
}

/// So that the next parcel begins where numbers of 64 bits can.
constexpr std::size_t rounded_up(std::size_t bytes) { return (bytes + 7) / 8 * 8; }

/// All items of all ranks.
template <class Item>
std::vector<Item> items(const Parcels& p) {
  const auto* const first = reinterpret_cast<const Item*>(p.bytes.data());
  return {first, first + p.begin.back() / sizeof(Item)};
}

/// Reads items of a parcel one after another.
class Reader {
 public:
  explicit Reader(const unsigned char* at) : at_(at) {}
  template <class T>
  const T* array(std::size_t n) {
    const T* const items = reinterpret_cast<const T*>(at_);
    at_ += n * sizeof(T);
    return items;
  }

 private:
  const unsigned char* at_;
};

constexpr std::size_t kClosingNodes = 256;
// Whether patches can be kept is judged by so many nodes of a rank; so many more than its share do not
// matter.
constexpr std::size_t kLookedAt = 256, kCloselyEnough = 64;

template <class Int>
class Triangulator {
 public:
  Triangulator(const LocalNodes& nodes, const std::array<Record, 3>& corners, Communicator& ranks,
               const ParallelOptions& options, Lengths lengths, double deviation, ParallelCost& cost)
      : nodes_(nodes),
        corners_(corners),
        ranks_(ranks),
        options_(options),
        cost_(cost),
        places_(lengths, deviation),
        me_(static_cast<std::size_t>(ranks.rank())),
        size_(static_cast<std::size_t>(ranks.size())) {}

  /// Throws HiddenNode on every rank, or AgreedFailure on every rank.
  Stars<Int> run() {
    {
      const PhaseTimer timer(&cost_, ParallelCost::divide, &ranks_);
      ranks_.set_phase("divide");
      divide();
      if (!gave_up_) send_nodes();
    }
    if (gave_up_) {
      Stars<Int> none;
      none.gave_up = true;
      return none;
    }
    {
      const PhaseTimer timer(&cost_, ParallelCost::triangulate, &ranks_);
      ranks_.set_phase("triangulate");
      triangulate_patches();
    }
    Stars<Int> stars;
    stars.lengths = places_.lengths();
    {
      const PhaseTimer timer(&cost_, ParallelCost::merge, &ranks_);
      ranks_.set_phase("merge");
      stars.coincident = all_coincident();
      if (stars.coincident.empty()) in_agreement([&] { ask(); }, asked_, asked_about_arcs_, has_grown_);
      while (stars.coincident.empty() && !gave_up_ &&
             (asked_ < 0 || (asked_about_arcs_ < 0 && has_grown_ < 0))) {
        learn_and_ask();
        stars.coincident = all_coincident();
      }
      stars.gave_up = gave_up_;
    }
    if (stars.coincident.empty() && !gave_up_) {
      const PhaseTimer timer(&cost_, ParallelCost::lists, &ranks_);
      ranks_.set_phase("lists");
      return_rings(stars);
      if (options_.with_neighbours) find_outside(stars);
      stars.memory.push_back(std::move(position_memory_));
      stars.memory.push_back(std::move(table_memory_));
      stars.memory.push_back(std::move(options_.with_neighbours ? entries_memory_ : workspace_));
      *stars.homes = Homes(std::move(partition_), options_.partition, std::move(first_patch_), places_);
    }
    return stars;
  }

 private:
  // ---- what all phases share ----

  int patches_here() const { return first_patch_[me_ + 1] - first_patch_[me_]; }
  std::size_t rank_of(int patch) const {
    return static_cast<std::size_t>(std::upper_bound(first_patch_.begin(), first_patch_.end(), patch) -
                                    first_patch_.begin()) -
           1;
  }

  // Ranks agree on the outcome of what each of them does: the lowest code. Failures in here have lower codes
  // than a hidden node, which is no failure.
  static constexpr std::int32_t kHidden = -1;

  template <class Body>
  static std::int32_t outcome_of(const Body& body) {
    try {
      body();
    } catch (const HiddenNode&) {
      return kHidden;
    } catch (...) {
      return code_of(std::current_exception());
    }
    return 0;
  }
  static void accept(std::int64_t outcome) {
    if (outcome == kHidden) throw HiddenNode{};
    if (outcome != 0) throw AgreedFailure(static_cast<std::int32_t>(outcome));
  }

  /// Runs body() and agrees with the other ranks on its outcome. On the way `values`, as they are after
  /// body(), become the smallest of all ranks.
  template <class Body, class... Values>
  void in_agreement(const Body& body, Values&... values) {
    const std::int64_t outcome = outcome_of(body);
    std::int64_t all[] = {outcome, values...};
    ranks_.all_min(all, std::size(all));
    accept(all[0]);
    [[maybe_unused]] std::size_t k = 0;
    ((values = all[++k]), ...);
  }

  /// Exchanges what body() returns, and agrees on its outcome on the way.
  template <class Body>
  Parcels exchange_in_agreement(const Body& body) {
    Parcels outgoing;
    const std::int32_t outcome = outcome_of([&] { outgoing = body(); });
    try {
      return ranks_.exchange(outgoing, outcome);
    } catch (const AgreedFailure& failure) {
      accept(failure.code);
      throw;
    }
  }

  /// body(patch, k) for every patch of this rank, on its threads. Throws what a body threw.
  template <class Body>
  void for_patches(const Body& body) {
    std::vector<std::exception_ptr> errors(patches_.size());
    parallel_tasks(static_cast<int>(patches_.size()), options_.threads, [&](int k) {
      try {
        body(patches_[static_cast<std::size_t>(k)], static_cast<std::size_t>(k));
      } catch (...) {
        errors[static_cast<std::size_t>(k)] = std::current_exception();
      }
    });
    for (const auto& e : errors)
      if (e) std::rethrow_exception(e);
  }

  // ---- 1: divide ----

  void divide() {
    // A rank has less than 2^29 nodes and less than 2^30 patches.
    const std::int64_t* const headers =
        ranks_.all_gather_one(static_cast<std::int64_t>(nodes_.count) | std::int64_t{options_.patches} << 32 |
                              std::int64_t{most_are_at_home()} << 62);
    const auto nodes_of = [=](std::size_t r) { return static_cast<std::size_t>(headers[r] & 0xffffffff); };
    const auto patches_of = [=](std::size_t r) { return static_cast<int>(headers[r] >> 32 & 0x3fffffff); };
    bool keeps_patches = std::all_of(headers, headers + size_, [](std::int64_t h) { return h >> 62 != 0; });
    std::size_t nodes = 0;
    BlockArray<Record> sample;
    std::vector<std::size_t> begin;  // bytes that the ranks bring
    std::vector<std::int64_t> counter;
    in_agreement([&] {
      first_patch_.assign(1, 0);
      for (std::size_t r = 0; r < size_; ++r) {
        first_patch_.push_back(first_patch_.back() + patches_of(r));
        nodes += nodes_of(r);
      }
      const auto patches = static_cast<std::size_t>(first_patch_.back());
      const auto has_its_share = [&](std::size_t r) {
        const std::size_t share = nodes / patches * static_cast<std::size_t>(patches_of(r));
        return nodes_of(r) <= share + share / 8 + kCloselyEnough;
      };
      keeps_patches =
          keeps_patches && options_.last->are_for(options_.partition, first_patch_, places_.lengths());
      for (std::size_t r = 0; r < size_; ++r) keeps_patches = keeps_patches && has_its_share(r);
      const std::size_t wanted = keeps_patches ? std::min(nodes, kClosingNodes) : sample_size(nodes, patches);
      begin.assign(1, 0);
      for (std::size_t r = 0; r < size_; ++r)
        begin.push_back(begin.back() + share_of_sample(nodes_of(r), wanted, nodes) * sizeof(Record));
      sample = BlockArray<Record>(begin.back() / sizeof(Record));
      write_share(nodes_, share_of_sample(nodes_.count, wanted, nodes),
                  sample.data() + begin[me_] / sizeof(Record));
      counter.resize(Cuts::counters(first_patch_.back()));
    });
    ranks_.all_gather_in_place(sample.data(), begin);
    std::int32_t outcome = 0;
    if (keeps_patches)
      partition_ = options_.last->partition();
    else
      outcome = cut_anew(sample, nodes, counter);
    in_agreement([&] {
      if (outcome != 0) throw Failure(outcome);
      const int patches = first_patch_.back();
      if (may_give_up() && !patches_know_most(some_of(sample, 256 * static_cast<std::size_t>(patches)),
                                              *partition_, places_)) {
        gave_up_ = true;
        return;
      }
      choose_closing(sample);
      // Worth it where it spares a look at more triangles than it takes time for.
      constexpr std::size_t kManyInAPatch = 50000;
      if (nodes / static_cast<std::size_t>(patches) > kManyInAPatch)
        most_stretch_ = most_stretch(closing_, places_);
      for (int q = 0; q < patches_here(); ++q)
        patches_.emplace_back(first_patch_[me_] + q, *partition_, places_);
    });
  }

  /// Patches with equal numbers of nodes, as far as a sample and counts can tell. Returns the outcome here: a
  /// rank that fails counts nothing from there on.
  std::int32_t cut_anew(BlockArray<Record>& sample, std::size_t nodes, std::vector<std::int64_t>& counter) {
    const int patches = first_patch_.back();
    const bool is_bisection = options_.partition == PartitionKind::bisection;
    std::vector<Point> places;
    std::optional<Cuts> cuts;
    std::int32_t outcome = outcome_of([&] {
      places.reserve(sample.size());
      for (const Record& r : sample) places.push_back(places_(r.point));
      if (is_bisection)
        cuts.emplace(patches, places,
                     places_to_count(nodes_, nodes, static_cast<std::size_t>(patches), places_));
    });
    for (int level = 0; is_bisection && level < Cuts::levels(patches); ++level) {
      std::fill(counter.begin(), counter.end(), 0);
      if (outcome == 0) outcome = outcome_of([&] { cuts->cut(); });
      if (outcome == 0) cuts->count(counter.data());
      ranks_.all_sum(counter.data(), counter.size());
      if (outcome == 0) cuts->move(counter.data());
    }
    if (outcome != 0) return outcome;
    return outcome_of([&] {
      partition_ = cuts ? std::make_shared<Partition>(*cuts, std::move(places), nodes)
                        : std::make_shared<Partition>(options_.partition, patches, std::move(places), nodes);
    });
  }

  /// True if the last call's patches are known, and nearly all of some of this rank's nodes are at home.
  bool most_are_at_home() const {
    if (options_.last == nullptr) return false;
    const std::size_t step = nodes_.count / kLookedAt + 1;
    std::size_t looked_at = 0, away = 0;
    for (std::size_t i = 0; i < nodes_.count; i += step, ++looked_at)
      away += options_.last->rank(nodes_.points[i]) != static_cast<int>(me_);
    return 16 * away <= looked_at;
  }

  /// One process, whose caller has another way: questions to itself would only cost.
  bool may_give_up() const {
    return size_ == 1 && first_patch_.back() > 1 && options_.most_questions < nodes_.count;
  }

  static std::vector<Record> some_of(const BlockArray<Record>& sample, std::size_t most) {
    std::vector<Record> some;
    const std::size_t step = sample.size() / most + 1;
    for (std::size_t k = 0; k < sample.size(); k += step) some.push_back(sample[k]);
    keep_one_of_each(some);
    return some;
  }

  /// Some of the sample and the corners, each once, along a curve.
  void choose_closing(BlockArray<Record>& sample) {
    std::vector<Record> some(corners_.begin(), corners_.end());
    const std::size_t step = sample.size() / kClosingNodes + 1;
    for (std::size_t k = 0; k < sample.size(); k += step) some.push_back(sample[k]);
    keep_one_of_each(some);
    Workspace workspace(16 * some.size());
    std::vector<std::uint32_t> order(some.size());
    insertion_order(&some[0].point, some.size(), order.data(), workspace, sizeof(Record));
    for (const std::uint32_t k : order) closing_.push_back(some[k]);
  }

  /// Nodes on their way to one patch, own and halo, counted by each thread.
  struct Count {
    std::size_t own = 0, halo = 0;
  };

  /// Where the nodes of this rank belong; the latter two for each thread.
  struct Routes {
    struct HaloNode {
      std::uint32_t node, patch;
    };
    explicit Routes(std::size_t nodes) : memory(nodes * sizeof *owner) {}
    Workspace memory;
    std::uint32_t* owner = nullptr;  ///< of each node; null: there is one patch only
    std::vector<std::vector<HaloNode>> halo;
    std::vector<std::vector<Count>> count;  ///< to each patch
  };

  /// Records of other ranks' patches travel in parcels; those of patches here are written into place, between
  /// those that have arrived.
  void send_nodes() {
    std::optional<Routes> routes;
    arrived_ = exchange_in_agreement([&] {
      routes.emplace(nodes_.count);
      position_memory_ = std::make_unique<Workspace>(nodes_.count * sizeof *position_);
      position_ = position_memory_->keep<std::uint32_t>(nodes_.count);
      find_routes(*routes);
      if (may_give_up()) {
        std::size_t halo = 0;
        for (const Count& c : sent_) halo += c.halo;
        gave_up_ = halo > nodes_.count / 4 * (sent_.size() - 1);  // all in all, more work than one hull
        if (gave_up_) return Parcels{{}, std::vector<std::size_t>(size_ + 1, 0)};
      }
      for (std::size_t q = 0; q < sent_.size(); ++q)
        away_begin_[q + 1] = away_begin_[q] + (rank_of(static_cast<int>(q)) == me_ ? 0 : sent_[q].own);
      return parcels_for_others(*routes);
    });
    if (!gave_up_) placed_ = outcome_of([&] { place_nodes(*routes); });
  }

  void find_routes(Routes& routes) {
    const auto patches = static_cast<std::size_t>(first_patch_.back());
    const auto pieces = static_cast<std::size_t>(options_.threads);
    routes.halo.resize(pieces);
    routes.count.assign(pieces, std::vector<Count>(patches));
    sent_.assign(patches, {});
    away_begin_.assign(patches + 1, 0);
    if (patches == 1) {
      sent_[0].own = routes.count[0][0].own = nodes_.count;
      return;
    }
    routes.owner = routes.memory.template keep<std::uint32_t>(nodes_.count);
    std::vector<std::exception_ptr> errors(pieces);
    parallel_pieces(nodes_.count, options_.threads, [&](std::size_t first, std::size_t last, int piece) {
      const auto t = static_cast<std::size_t>(piece);
      auto& count = routes.count[t];
      try {
        // Several tallies: the next node's would wait for the one before to be written.
        constexpr std::size_t kTallies = 4;
        std::vector<std::size_t> own(kTallies * patches);
        // Nodes are often at home, most of them deep in the first patch here. That is sooner told than their
        // owner; only the others are looked at closely.
        bool most_are_deep = true;
        const auto home = static_cast<std::uint32_t>(first_patch_[me_]);
        constexpr std::size_t kTogether = 256;
        Point place[kTogether];
        std::uint32_t which[kTogether], its_owner[kTogether];
        double nearest_plane[kTogether];
        for (std::size_t block = first; block < last; block += kTogether) {
          const std::size_t all = std::min(last - block, kTogether);
          const Point* at = nodes_.points.points(block, all, place);
          if (places_.lengths() != Lengths::as_given) {
            for (std::size_t i = 0; i < all; ++i) place[i] = places_(at[i]);
            at = place;
          }
          std::uint32_t* const owner = routes.owner + block;
          const auto route = [&](std::size_t n, const auto& index) {
            partition_->owners(at, n, its_owner, nearest_plane);
            for (std::size_t i = 0; i < n; ++i) {
              ++own[i % kTallies * patches + its_owner[i]];
              owner[index(i)] = its_owner[i];
            }
            partition_->for_each_halo(at, n, its_owner, nearest_plane, [&](std::size_t i, int q) {
              ++count[static_cast<std::size_t>(q)].halo;
              routes.halo[t].push_back(
                  {static_cast<std::uint32_t>(block + index(i)), static_cast<std::uint32_t>(q)});
            });
          };
          if (most_are_deep) {
            std::fill(owner, owner + all, home);
            const std::size_t n = partition_->not_deep(static_cast<int>(home), at, all, which);
            own[home] += all - n;
            for (std::size_t i = 0; i < n; ++i) place[i] = at[which[i]];
            at = place;
            route(n, [&](std::size_t i) { return which[i]; });
            most_are_deep = 2 * n <= all;
          } else {
            route(all, [](std::size_t i) { return i; });
          }
        }
        for (std::size_t k = 0; k < own.size(); ++k) count[k % patches].own += own[k];
      } catch (...) {
        errors[t] = std::current_exception();
      }
    });
    for (const auto& e : errors)
      if (e) std::rethrow_exception(e);
    for (const auto& count : routes.count)
      for (std::size_t q = 0; q < patches; ++q) sent_[q].own += count[q].own, sent_[q].halo += count[q].halo;
  }

  /// Writes the items item(i) of the nodes i for patches of this rank, or of the others: those of patch q to
  /// base[q], from begin[q] on.
  template <class Item, class MakeItem>
  void write_items(const Routes& routes, bool here, const std::vector<Item*>& base,
                   const std::vector<Count>& begin, const MakeItem& item) {
    const std::size_t patches = sent_.size();
    std::vector<std::vector<Count>> next(routes.count.size(), begin);  // where each thread goes on
    for (std::size_t t = 1; t < next.size(); ++t)
      for (std::size_t q = 0; q < patches; ++q) {
        next[t][q].own = next[t - 1][q].own + routes.count[t - 1][q].own;
        next[t][q].halo = next[t - 1][q].halo + routes.count[t - 1][q].halo;
      }
    const std::size_t first_here = static_cast<std::size_t>(first_patch_[me_]),
                      count_here = static_cast<std::size_t>(patches_here());
    const auto is_wanted = [=](std::size_t q) { return (q - first_here < count_here) == here; };
    std::vector<std::size_t> table(patches);  // where the ring of a patch's item 0 would be in the table
    for (std::size_t q = 0; q < patches; ++q)
      if (is_wanted(q)) table[q] = here ? own_begin_[q - first_here] : away_begin_[q] - begin[q].own;
    parallel_pieces(nodes_.count, options_.threads, [&](std::size_t first, std::size_t last, int piece) {
      auto& place = next[static_cast<std::size_t>(piece)];
      for (std::size_t i = first; i < last; ++i) {
        const std::size_t q = routes.owner != nullptr ? routes.owner[i] : 0;
        if (!is_wanted(q)) continue;
        const std::size_t at = place[q].own++;
        base[q][at] = item(i);
        position_[i] = static_cast<std::uint32_t>(table[q] + at);
      }
      for (const auto& h : routes.halo[static_cast<std::size_t>(piece)])
        if (is_wanted(h.patch)) base[h.patch][place[h.patch].halo++] = item(h.node);
    });
  }

  /// As what a node travels to a rank that can read it.
  using Number = std::uint32_t;

  /// body(item), where item(i) is the record of node i of this rank.
  template <class Body>
  auto with_records(const Body& body) const {
    return nodes_.points.visit([&](const auto& node) {
      return body([&](std::size_t i) { return Record{node(i), nodes_.number(i)}; });
    });
  }

  Parcels parcels_for_others(const Routes& routes) {
    if (nodes_.of_all_ranks != nullptr)
      return parcels_of<Number>(routes,
                                [this](std::size_t i) { return static_cast<Number>(nodes_.number(i)); });
    return with_records([&](const auto& record) { return parcels_of<Record>(routes, record); });
  }

  /// A parcel: the counts of each patch of the rank, then for each patch its own nodes and its halo.
  template <class Item, class MakeItem>
  Parcels parcels_of(const Routes& routes, const MakeItem& item) {
    Parcels parcels;
    parcels.begin.assign(1, 0);
    const std::size_t patches = sent_.size();
    std::vector<Count> begin(patches);
    std::vector<Item*> base(patches);
    std::vector<std::size_t> header(size_);
    for (std::size_t r = 0; r < size_; ++r) {
      std::size_t items = 0;
      const auto first = static_cast<std::size_t>(first_patch_[r]),
                 last = static_cast<std::size_t>(first_patch_[r + 1]);
      for (std::size_t q = first; q < last; ++q) {
        begin[q] = {items, items + sent_[q].own};
        items += sent_[q].own + sent_[q].halo;
      }
      header[r] = (last - first) * sizeof(Count);
      const bool is_empty = r == me_ || items == 0;
      const std::size_t bytes = is_empty ? 0 : header[r] + items * sizeof(Item);
      parcels.begin.push_back(parcels.begin.back() + rounded_up(bytes));
    }
    if (parcels.begin.back() == 0) return parcels;
    parcels.bytes = Block(parcels.begin.back());
    for (std::size_t r = 0; r < size_; ++r) {
      if (parcels.begin[r] == parcels.begin[r + 1]) continue;
      unsigned char* const parcel = parcels.bytes.data() + parcels.begin[r];
      std::memcpy(parcel, &sent_[static_cast<std::size_t>(first_patch_[r])], header[r]);
      for (auto q = static_cast<std::size_t>(first_patch_[r]);
           q < static_cast<std::size_t>(first_patch_[r + 1]); ++q)
        base[q] = reinterpret_cast<Item*>(parcel + header[r]);
    }
    write_items(routes, false, base, begin, item);
    return parcels;
  }

  /// What has arrived of a patch from one rank: its own nodes, then its halo, as records or as numbers.
  class Segment {
   public:
    Segment() = default;
    Segment(Reader& reader, Count c, const NodeArrays* all) : count(c), all_(all) {
      const std::size_t items = c.own + c.halo;
      if (all != nullptr)
        numbers_ = reader.array<Number>(items);
      else
        records_ = reader.array<Record>(items);
    }
    /// Its items first..last-1.
    void copy(std::size_t first, std::size_t last, Record* to) const {
      if (numbers_ != nullptr)
        all_->visit([&](const auto& node) {
          for (std::size_t i = first; i < last; ++i) *to++ = {node(numbers_[i] - 1), numbers_[i]};
        });
      else if (records_ != nullptr)
        std::copy(records_ + first, records_ + last, to);
    }
    Count count;

   private:
    const NodeArrays* all_ = nullptr;
    const Record* records_ = nullptr;
    const Number* numbers_ = nullptr;
  };

  /// The records of each patch here: own nodes in the order of the ranks that brought them, then the halo.
  void place_nodes(const Routes& routes) {
    std::vector<std::vector<Segment>> segments(patches_.size(), std::vector<Segment>(size_));
    for (std::size_t r = 0; r < size_; ++r) {
      if (r == me_ || arrived_.begin[r + 1] == arrived_.begin[r]) continue;
      Reader reader(arrived_.bytes.data() + arrived_.begin[r]);
      const Count* const counts = reader.array<Count>(patches_.size());
      for (std::size_t k = 0; k < patches_.size(); ++k)
        segments[k][r] = Segment(reader, counts[k], nodes_.of_all_ranks);
    }
    std::size_t records = 0, rings = away_begin_.back();
    std::vector<Count> total(patches_.size());
    for (std::size_t k = 0; k < patches_.size(); ++k) {
      segments[k][me_].count = sent_[static_cast<std::size_t>(patches_[k].id())];
      std::vector<std::size_t>& from = own_from_.emplace_back(1, 0);
      for (const Segment& s : segments[k]) {
        from.push_back(from.back() + s.count.own);
        total[k].own += s.count.own, total[k].halo += s.count.halo;
      }
      own_begin_.push_back(rings);
      rings += total[k].own;
      records += total[k].own + total[k].halo;
      cost_.halo += static_cast<std::int64_t>(total[k].halo);
    }
    table_memory_ = std::make_unique<Workspace>(rings * (sizeof *place_ + sizeof *size_class_));
    place_ = table_memory_->keep<const Int*>(rings);
    size_class_ = table_memory_->keep<std::uint8_t>(rings);
    records_memory_ = std::make_unique<Workspace>(records * sizeof(Record));
    Record* at = records_memory_->keep<Record>(records);
    std::vector<Count> begin(sent_.size());
    std::vector<Record*> base(sent_.size());
    for (std::size_t k = 0; k < patches_.size(); ++k) {
      patches_[k].set_nodes(at, total[k].own, total[k].own + total[k].halo);
      const auto q = static_cast<std::size_t>(patches_[k].id());
      base[q] = at;
      Record *own = at, *halo = at + total[k].own;
      for (std::size_t r = 0; r < size_; ++r) {
        const Segment& s = segments[k][r];
        if (r == me_) begin[q] = {static_cast<std::size_t>(own - at), static_cast<std::size_t>(halo - at)};
        s.copy(0, s.count.own, own);
        s.copy(s.count.own, s.count.own + s.count.halo, halo);
        own += s.count.own, halo += s.count.halo;
      }
      at = halo;
    }
    arrived_ = {};
    with_records([&](const auto& record) { write_items(routes, true, base, begin, record); });
  }

  // ---- 2: triangulate ----

  void triangulate_patches() {
    in_agreement([&] {
      if (placed_ != 0) throw Failure(placed_);
      constexpr std::size_t kPage = 4096;
      std::vector<std::size_t> begin{0};
      for (const Patch<Int>& patch : patches_)
        begin.push_back(begin.back() + (patch.workspace_bytes(closing_.size()) + kPage - 1) / kPage * kPage);
      workspace_ = std::make_unique<Workspace>(begin.back());
      unsigned char* const memory = workspace_->keep<unsigned char>(begin.back());
      for_patches([&](Patch<Int>& patch, std::size_t k) {
        Workspace part(memory + begin[k], begin[k + 1] - begin[k]);
        patch.set_up(closing_, part);
      });
    });
    // What one patch has seen to be hidden, no other begins to triangulate for nothing.
    in_agreement(
        [&] {
          for_patches([](Patch<Int>& patch, std::size_t) { patch.triangulate(); });
          count_coincident();
        },
        least_coincident_);
  }

  // ---- 3: merge ----

  void count_coincident() {
    least_coincident_ = 0;
    for (const Patch<Int>& patch : patches_)
      least_coincident_ -= static_cast<std::int64_t>(patch.coincident().size());
  }

  /// Different nodes in the same direction that any patch came upon.
  std::vector<std::pair<std::int64_t, std::int64_t>> all_coincident() {
    if (least_coincident_ == 0) return {};
    std::vector<std::pair<std::int64_t, std::int64_t>> pairs;
    in_agreement([&] {
      for (const Patch<Int>& patch : patches_)
        pairs.insert(pairs.end(), patch.coincident().begin(), patch.coincident().end());
    });
    const Parcels all = ranks_.all_gather(pairs.data(), pairs.size() * sizeof(pairs[0]));
    in_agreement([&] { pairs = items<std::pair<std::int64_t, std::int64_t>>(all); });
    return pairs;
  }

  /// What the patches here want to know.
  void ask() {
    questions_.assign(size_, {});
    asked_ = asked_about_arcs_ = has_grown_ = 0;
    std::vector<Doubts> of_patch(patches_.size());
    for_patches([&](Patch<Int>& patch, std::size_t k) { of_patch[k] = patch.ask(corners_, most_stretch_); });
    for (const Doubts& doubts : of_patch) {
      for (const Question& q : doubts.questions) questions_[rank_of(q.to)].push_back(q);
      asked_ -= static_cast<std::int64_t>(doubts.questions.size() - doubts.arcs);
      asked_about_arcs_ -= static_cast<std::int64_t>(doubts.arcs);
      has_grown_ = doubts.has_grown ? -1 : has_grown_;
    }
    gave_up_ = size_ == 1 && static_cast<std::size_t>(-asked_ - asked_about_arcs_) > options_.most_questions;
  }

  /// One round: questions, answers, and what is asked next. Patches that came upon nodes which coincide have
  /// no more questions.
  void learn_and_ask() {
    ++cost_.rounds;
    const Parcels incoming = exchange_in_agreement([&] { return parcels(questions_); });
    const Parcels replies = exchange_in_agreement([&] { return answers(incoming); });
    in_agreement(
        [&] {
          learn(replies);
          count_coincident();
          asked_ = asked_about_arcs_ = has_grown_ = 0;
          if (least_coincident_ == 0) ask();
        },
        least_coincident_, asked_, asked_about_arcs_, has_grown_);
  }

  /// The answers to the questions of each rank, in their order: a count, then nodes.
  Parcels answers(const Parcels& incoming) {
    const auto* const question = reinterpret_cast<const Question*>(incoming.bytes.data());
    const std::size_t count = incoming.begin.back() / sizeof(Question);
    std::vector<std::vector<Record>> answer(count);
    for_patches([&](Patch<Int>& patch, std::size_t) {
      for (std::size_t k = 0; k < count; ++k)
        if (question[k].to == patch.id()) patch.answer(question[k], answer[k]);
    });
    Parcels outgoing;
    outgoing.begin.push_back(0);
    std::size_t total = 0;
    for (const auto& a : answer) total += sizeof(std::int64_t) + a.size() * sizeof(Record);
    outgoing.bytes = Block(total);
    std::size_t at = 0, k = 0;
    for (std::size_t r = 0; r < size_; ++r) {
      for (; k < incoming.begin[r + 1] / sizeof(Question); ++k) {
        const auto n = static_cast<std::int64_t>(answer[k].size());
        std::memcpy(outgoing.bytes.data() + at, &n, sizeof n);
        at += sizeof n;
        if (n > 0)
          std::memcpy(outgoing.bytes.data() + at, answer[k].data(), answer[k].size() * sizeof(Record));
        at += answer[k].size() * sizeof(Record);
      }
      outgoing.begin.push_back(at);
    }
    return outgoing;
  }

  void learn(const Parcels& replies) {
    struct Answer {
      const Record* nodes;
      std::size_t count;
    };
    std::vector<std::vector<Answer>> of_patch(patches_.size());
    for (std::size_t r = 0; r < size_; ++r) {
      Reader reader(replies.bytes.data() + replies.begin[r]);
      for (const Question& q : questions_[r]) {
        const auto n = static_cast<std::size_t>(*reader.array<std::int64_t>(1));
        of_patch[static_cast<std::size_t>(q.from - first_patch_[me_])].push_back(
            {reader.array<Record>(n), n});
      }
    }
    for_patches([&](Patch<Int>& patch, std::size_t k) {
      for (const Answer& a : of_patch[k]) patch.learn(a.nodes, a.count);
    });
  }

  // ---- 4: lists ----

  void return_rings(Stars<Int>& stars) {
    stars.received = exchange_in_agreement([&] {
      stars.homes = std::make_unique<Homes>();
      stars.memory.reserve(3);  // what run() moves there must not fail
      write_rings(stars);
      return rings_for_others();
    });
    for (std::size_t r = 0; r < size_; ++r) {
      if (r == me_) continue;
      auto* at = reinterpret_cast<const Int*>(stars.received.bytes.data() + stars.received.begin[r]);
      for (std::size_t k = away_begin_[static_cast<std::size_t>(first_patch_[r])];
           k < away_begin_[static_cast<std::size_t>(first_patch_[r + 1])]; ++k) {
        place_[k] = at;
        size_class_[k] = RingTable<Int>::size_class_of(static_cast<std::uint32_t>(*at));
        at += 1 + *at;
      }
    }
    stars.of_node = RingTable<Int>(nodes_.count, position_, place_, size_class_);
  }

  void write_rings(Stars<Int>& stars) {
    std::vector<std::size_t> begin(patches_.size() + 1, 0);
    for_patches([&](Patch<Int>& patch, std::size_t k) { begin[k + 1] = patch.finish() + 2 * kBlock; });
    std::partial_sum(begin.begin(), begin.end(), begin.begin());
    Int* own_room = nullptr;
    if (options_.with_neighbours) {  // the stars stay, the hulls go
      entries_memory_ = std::make_unique<Workspace>(begin.back() * sizeof(Int));
      own_room = entries_memory_->keep<Int>(begin.back());
    }
    stars.more_memory.resize(patches_.size());
    for_patches([&](Patch<Int>& patch, std::size_t k) {
      const std::size_t entries = begin[k + 1] - begin[k];
      Int* out = own_room != nullptr ? own_room + begin[k]
                                     : static_cast<Int*>(patch.room_for_rings(entries * sizeof(Int)));
      if (out == nullptr) {
        stars.more_memory[k] = Buffer<Int>(entries);
        out = stars.more_memory[k].data();
      }
      // By value, as in Patch::write_rings.
      const Int** const place = place_ + own_begin_[k];
      std::uint8_t* const size_class = size_class_ + own_begin_[k];
      patch.write_rings(
          out,
          [=](std::size_t i, const Int* ring, std::uint32_t n) {
            place[i] = ring;
            size_class[i] = RingTable<Int>::size_class_of(n);
          },
          [=](std::size_t i) { __builtin_prefetch(place + i, 1); });
    });
  }

  /// For each rank the rings of the nodes that it brought, patch by patch.
  Parcels rings_for_others() const {
    Parcels parcels;
    parcels.begin.push_back(0);
    const auto for_each_run_of = [&](std::size_t r, const auto& visit) {
      for (std::size_t k = 0; k < patches_.size() && r != me_; ++k)
        visit(own_begin_[k] + own_from_[k][r], own_begin_[k] + own_from_[k][r + 1]);
    };
    for (std::size_t r = 0; r < size_; ++r) {
      std::size_t entries = 0;
      for_each_run_of(r, [&](std::size_t first, std::size_t last) {
        for (std::size_t i = first; i < last; ++i)
          entries += 1 + RingTable<Int>::count_of(place_[i], size_class_[i]);
      });
      parcels.begin.push_back(parcels.begin.back() + rounded_up(entries * sizeof(Int)));
    }
    if (parcels.begin.back() == 0) return parcels;
    parcels.bytes = Block(parcels.begin.back() + kBlock * sizeof(Int));  // see copy_kept_ring
    for (std::size_t r = 0; r < size_; ++r) {
      auto* at = reinterpret_cast<Int*>(parcels.bytes.data() + parcels.begin[r]);
      for_each_run_of(r, [&](std::size_t first, std::size_t last) {
        constexpr std::size_t kAhead = 16;  // they lie in the order of the hulls
        for (std::size_t i = first; i < last; ++i) {
          if (i + kAhead < last) __builtin_prefetch(place_[i + kAhead]);
          at = copy_kept_ring(place_[i], at);
        }
      });
    }
    return parcels;
  }

  /// The neighbours of this rank's nodes that it did not bring itself.
  void find_outside(Stars<Int>& stars) {
    const Parcels incoming = exchange_in_agreement([&] {
      std::vector<std::vector<Record>> neighbours(size_);
      for (std::size_t k = 0; k < patches_.size(); ++k)
        patches_[k].for_each_missing_neighbour(
            me_, own_from_[k], [&](std::size_t r, const Record& node) { neighbours[r].push_back(node); });
      return parcels(neighbours);
    });
    in_agreement([&] {
      std::vector<Record> all = items<Record>(incoming);
      keep_one_of_each(all);
      // A patch does not know which nodes this rank brought for other patches; where there are none, it
      // knows all. Those that may be among `all` are marked in a table of some bits of the number first.
      std::vector<std::int64_t> own;
      if (away_begin_.back() > 0 || patches_here() > 1) {
        std::vector<bool> maybe(std::size_t{1} << 10);
        while (maybe.size() < 16 * all.size()) maybe.resize(2 * maybe.size());
        const auto slot = [&](std::int64_t number) {
          return static_cast<std::uint64_t>(number) * 0x9e3779b97f4a7c15u >> 40 & (maybe.size() - 1);
        };
        for (const Record& r : all) maybe[slot(r.number)] = true;
        for (std::size_t i = 0; i < nodes_.count; ++i)
          if (maybe[slot(nodes_.number(i))]) own.push_back(nodes_.number(i));
      }
      std::sort(own.begin(), own.end());
      for (const Record& r : all)
        if (!std::binary_search(own.begin(), own.end(), r.number)) stars.outside.push_back(r);
    });
  }

  const LocalNodes& nodes_;
  const std::array<Record, 3>& corners_;
  Communicator& ranks_;
  const ParallelOptions& options_;
  ParallelCost& cost_;
  const Places places_;
  const std::size_t me_, size_;

  std::vector<int> first_patch_;  ///< of each rank
  std::shared_ptr<const Partition> partition_;
  std::vector<Record> closing_;                                    ///< nodes from everywhere
  double most_stretch_ = std::numeric_limits<double>::infinity();  ///< of the closing nodes, if computed
  std::vector<Patch<Int>> patches_;                                ///< of this rank
  std::int64_t least_coincident_ = 0;             ///< 0: no patch has come upon any; agreed on
  std::vector<std::vector<Question>> questions_;  ///< to each rank
  // Less than 0, agreed on: some rank has questions about triangles, about arcs, nodes since it asked last.
  std::int64_t asked_ = 0, asked_about_arcs_ = 0, has_grown_ = 0;
  bool gave_up_ = false;

  std::vector<Count> sent_;  ///< to each patch
  // The table of rings: of this rank's nodes in the patches of other ranks, patch by patch, then of all own
  // nodes of each patch here. away_begin_ is for each patch of all, own_begin_ for each here.
  std::vector<std::size_t> away_begin_, own_begin_;
  const Int** place_ = nullptr;
  std::uint8_t* size_class_ = nullptr;
  std::uint32_t* position_ = nullptr;  ///< of each of this rank's nodes in the table
  std::unique_ptr<Workspace> position_memory_, table_memory_, entries_memory_, records_memory_, workspace_;
  Parcels arrived_;
  std::int32_t placed_ = 0;                         ///< the outcome here, not agreed on yet
  std::vector<std::vector<std::size_t>> own_from_;  ///< [patch][rank]: its own nodes that the rank brought
};

}  // namespace

void agree_on(Look& look, Communicator& ranks) {
  std::int64_t votes[] = {look.vote_for_lengths(), look.vote_for_deviation()};
  ranks.all_min(votes, std::size(votes));
  look.elect(votes[0], votes[1]);
}

template <class Int>
Stars<Int> triangulate(const LocalNodes& nodes, const Look& look, const Point (&corners)[3],
                       const std::int64_t (&numbers)[3], Communicator& ranks, const ParallelOptions& options,
                       ParallelCost* cost) {
  ParallelCost own_cost;
  ParallelCost& c = cost != nullptr ? *cost : own_cost;
  const std::array<Record, 3> corner_records{
      Record{corners[0], numbers[0]}, {corners[1], numbers[1]}, {corners[2], numbers[2]}};
  const auto run = [&](Lengths lengths) {
    return Triangulator<Int>(nodes, corner_records, ranks, options, lengths, look.deviation, c).run();
  };
  Stars<Int> stars;
  if (look.lengths_are_one) {  // the predicates must be the same everywhere
    try {
      stars = run(Lengths::as_given);
      c.bytes_sent = ranks.bytes_sent;
      return stars;
    } catch (const HiddenNode&) {
      // The lengths as given hide a node: only directions show all.
    }
  }
  stars = run(Lengths::directions);
  c.bytes_sent = ranks.bytes_sent;
  return stars;
}

template Stars<std::int32_t> triangulate(const LocalNodes&, const Look&, const Point (&)[3],
                                         const std::int64_t (&)[3], Communicator&, const ParallelOptions&,
                                         ParallelCost*);
template Stars<std::int64_t> triangulate(const LocalNodes&, const Look&, const Point (&)[3],
                                         const std::int64_t (&)[3], Communicator&, const ParallelOptions&,
                                         ParallelCost*);

}  // namespace pstripack
