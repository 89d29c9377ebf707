// The parallel triangulation, in order:
//   1  divide        a sample of the nodes, the same on every rank, cuts the sphere into patches; every node
//                    goes to its patch and to those that have it in their halo
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
#include <atomic>
#include <chrono>
#include <cmath>
#include <cstring>
#include <ctime>
#include <numeric>

#include "geometry/insertion_order.h"
#include "geometry/parallel_for.h"
#include "geometry/workspace.h"
#include "parallel/patch.h"

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
  p.bytes = Buffer<unsigned char>(p.begin.back());
  for (std::size_t r = 0; r < items.size(); ++r)
    if (!items[r].empty())
      std::memcpy(p.bytes.data() + p.begin[r], items[r].data(), items[r].size() * sizeof(Item));
  return p;
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
  void align(std::size_t size) { at_ += (size - reinterpret_cast<std::uintptr_t>(at_) % size) % size; }

 private:
  const unsigned char* at_;
};

/// Pseudo-random bits of k (Steele, Lea & Flood 2014, splitmix64).
std::uint64_t scrambled(std::uint64_t k) {
  k += 0x9e3779b97f4a7c15u;
  k = (k ^ (k >> 30)) * 0xbf58476d1ce4e5b9u;
  k = (k ^ (k >> 27)) * 0x94d049bb133111ebu;
  return k ^ (k >> 31);
}

/// The sample: so many nodes a patch, more where that costs little beside the work on all nodes.
std::size_t sample_size(std::size_t nodes, std::size_t patches) {
  return std::min(nodes, std::max(64 * patches, std::clamp<std::size_t>(nodes / 64, 256, 4096)));
}

constexpr std::size_t kClosingNodes = 256;

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
      send_nodes();
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
      if (stars.coincident.empty()) find_boundary();
      while (stars.coincident.empty() && !gave_up_ && ask_and_learn()) stars.coincident = all_coincident();
      stars.gave_up = gave_up_;
    }
    if (stars.coincident.empty() && !gave_up_) {
      const PhaseTimer timer(&cost_, ParallelCost::lists, &ranks_);
      ranks_.set_phase("lists");
      return_rings(stars);
      if (options_.with_neighbours) find_outside(stars);
      stars.of_node = RingTable<Int>(nodes_.count, rings_, position_);
      stars.memory.push_back(std::move(per_node_));
      stars.memory.push_back(std::move(workspace_));
      *stars.homes = Homes(std::move(partition_), std::move(first_patch_), places_);
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

  /// Runs body() and agrees with the other ranks on its outcome.
  template <class Body>
  void in_agreement(const Body& body) {
    std::int64_t code_and_hidden[2] = {0, 0};
    try {
      body();
    } catch (const HiddenNode&) {
      code_and_hidden[1] = -1;
    } catch (...) {
      code_and_hidden[0] = code_of(std::current_exception());
    }
    ranks_.all_min(code_and_hidden, 2);
    if (code_and_hidden[0] != 0) throw AgreedFailure(static_cast<std::int32_t>(code_and_hidden[0]));
    if (code_and_hidden[1] != 0) throw HiddenNode{};
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
    struct Header {
      std::int64_t nodes, patches;
    } mine{static_cast<std::int64_t>(nodes_.count), options_.patches};
    const Parcels headers = ranks_.all_gather(&mine, sizeof mine);
    std::size_t nodes = 0;
    std::vector<Record> sample;
    in_agreement([&] {
      first_patch_.assign(1, 0);
      for (std::size_t r = 0; r < size_; ++r) {
        Header h;
        std::memcpy(&h, headers.bytes.data() + headers.begin[r], sizeof h);
        first_patch_.push_back(first_patch_.back() + static_cast<int>(h.patches));
        nodes += static_cast<std::size_t>(h.nodes);
      }
      const std::size_t wanted = sample_size(nodes, static_cast<std::size_t>(first_patch_.back()));
      const std::size_t share = (wanted * nodes_.count + nodes - 1) / nodes;
      for (std::size_t k = 0; k < share; ++k) {  // one in each of `share` runs of nodes
        const std::size_t begin = nodes_.count * k / share, end = nodes_.count * (k + 1) / share;
        const std::size_t i = begin + scrambled(k) % (end - begin);
        sample.push_back({nodes_.points[i], nodes_.number(i)});
      }
    });
    const int patches = first_patch_.back();
    const Parcels samples = ranks_.all_gather(sample.data(), sample.size() * sizeof(Record));
    in_agreement([&] {
      sample.resize(samples.begin.back() / sizeof(Record));
      std::memcpy(static_cast<void*>(sample.data()), samples.bytes.data(), samples.begin.back());
      std::vector<Point> places;
      for (const Record& r : sample) places.push_back(places_(r.point));
      partition_ = std::make_unique<Partition>(options_.partition, patches, places, nodes);
      choose_closing(sample);
      for (int q = 0; q < patches_here(); ++q)
        patches_.emplace_back(first_patch_[me_] + q, *partition_, places_);
    });
  }

  /// Some of the sample and the corners, each once, along a curve.
  void choose_closing(const std::vector<Record>& sample) {
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

  void send_nodes() {
    const std::size_t patches = static_cast<std::size_t>(first_patch_.back());
    const int threads = options_.threads;
    Parcels outgoing;
    std::vector<std::size_t> own_begin;  // of each patch: the first of its records in their parcel

    in_agreement([&] {
      std::vector<std::size_t> halo_begin(patches), parcel_records(size_, 0);
      own_begin.resize(patches);
      const auto pieces = static_cast<std::size_t>(threads);
      struct HaloNode {
        std::uint32_t node, patch;
      };
      std::vector<std::vector<HaloNode>> halo(pieces);
      std::vector<std::vector<Count>> count(pieces, std::vector<Count>(patches));
      std::vector<std::exception_ptr> errors(pieces);
      per_node_ = std::make_unique<Workspace>(nodes_.count * (2 * sizeof(std::uint32_t) + sizeof(Ring<Int>)));
      position_ = per_node_->keep<std::uint32_t>(nodes_.count);
      rings_ = per_node_->keep<Ring<Int>>(nodes_.count);
      auto* const owner = per_node_->take<std::uint32_t>(nodes_.count);
      if (patches > 1) {
        parallel_pieces(nodes_.count, threads, [&](std::size_t first, std::size_t last, int piece) {
          const auto t = static_cast<std::size_t>(piece);
          try {
            std::vector<int> scratch;
            constexpr std::size_t kTogether = 256;
            Point place[kTogether];
            for (std::size_t block = first; block < last; block += kTogether) {
              const std::size_t end = std::min(last, block + kTogether);
              const Point* at = nodes_.points + block;
              if (places_.lengths() != Lengths::as_given) {
                for (std::size_t i = block; i < end; ++i) place[i - block] = places_(nodes_.points[i]);
                at = place;
              }
              partition_->owners(at, end - block, owner + block);
              for (std::size_t i = block; i < end; ++i) {
                ++count[t][owner[i]].own;
                partition_->for_each_halo(at[i - block], static_cast<int>(owner[i]), scratch, [&](int other) {
                  ++count[t][static_cast<std::size_t>(other)].halo;
                  halo[t].push_back({static_cast<std::uint32_t>(i), static_cast<std::uint32_t>(other)});
                });
              }
            }
          } catch (...) {
            errors[t] = std::current_exception();
          }
        });
        for (const auto& e : errors)
          if (e) std::rethrow_exception(e);
      } else {
        count[0][0].own = nodes_.count;
      }

      // A parcel: the counts of each patch of the rank, then for each patch its own nodes and its halo.
      outgoing.begin.assign(1, 0);
      sent_.assign(patches, {});
      own_position_.assign(patches + 1, 0);
      for (std::size_t r = 0; r < size_; ++r) {
        std::size_t at = 0;
        for (auto q = static_cast<std::size_t>(first_patch_[r]);
             q < static_cast<std::size_t>(first_patch_[r + 1]); ++q) {
          for (const auto& c : count) sent_[q].own += c[q].own, sent_[q].halo += c[q].halo;
          own_begin[q] = at;
          halo_begin[q] = at + sent_[q].own;
          at += sent_[q].own + sent_[q].halo;
          own_position_[q + 1] = own_position_[q] + sent_[q].own;
        }
        parcel_records[r] = at;
        const std::size_t header =
            static_cast<std::size_t>(first_patch_[r + 1] - first_patch_[r]) * sizeof(Count);
        outgoing.begin.push_back(outgoing.begin.back() +
                                 (r == me_ || at == 0 ? 0 : header + at * sizeof(Record)));
      }
      outgoing.bytes = Buffer<unsigned char>(outgoing.begin.back());
      local_memory_ = std::make_unique<Workspace>(parcel_records[me_] * sizeof(Record));
      local_ = local_memory_->keep<Record>(parcel_records[me_]);

      // Where each patch's records go: into the parcel of its rank, or stay.
      std::vector<Record*> records(patches);
      for (std::size_t r = 0; r < size_; ++r) {
        const auto first = static_cast<std::size_t>(first_patch_[r]),
                   last = static_cast<std::size_t>(first_patch_[r + 1]);
        Record* base = local_;
        if (r != me_) {
          if (parcel_records[r] == 0) continue;
          auto* const header = reinterpret_cast<Count*>(outgoing.bytes.data() + outgoing.begin[r]);
          std::copy(sent_.begin() + static_cast<std::ptrdiff_t>(first),
                    sent_.begin() + static_cast<std::ptrdiff_t>(last), header);
          base = reinterpret_cast<Record*>(header + (last - first));
        }
        for (std::size_t q = first; q < last; ++q) records[q] = base;
      }
      // Where each thread goes on.
      std::vector<std::vector<Count>> next(pieces, std::vector<Count>(patches));
      for (std::size_t q = 0; q < patches; ++q) {
        Count at{own_begin[q], halo_begin[q]};
        for (std::size_t t = 0; t < pieces; ++t) {
          next[t][q] = at;
          at.own += count[t][q].own, at.halo += count[t][q].halo;
        }
      }
      const auto record = [&](std::size_t i) { return Record{nodes_.points[i], nodes_.number(i)}; };
      parallel_pieces(nodes_.count, threads, [&](std::size_t first, std::size_t last, int piece) {
        auto& place = next[static_cast<std::size_t>(piece)];
        for (std::size_t i = first; i < last; ++i) {
          const std::size_t q = patches > 1 ? owner[i] : 0;
          const std::size_t at = place[q].own++;
          records[q][at] = record(i);
          position_[i] = static_cast<std::uint32_t>(own_position_[q] + (at - own_begin[q]));
        }
        for (const HaloNode& h : halo[static_cast<std::size_t>(piece)])
          records[h.patch][place[h.patch].halo++] = record(h.node);
      });
    });

    arrived_ = ranks_.exchange(outgoing);
    in_agreement([&] {
      outgoing = {};
      for (Patch<Int>& patch : patches_) gather_nodes(patch, own_begin);
    });
  }

  /// Hands a patch its nodes: those of this rank as they lie, or together with those that have arrived.
  void gather_nodes(Patch<Int>& patch, const std::vector<std::size_t>& own_begin) {
    const auto q = static_cast<std::size_t>(patch.id()), k = q - static_cast<std::size_t>(first_patch_[me_]);
    struct Segment {
      const Record* records;
      Count count;
    };
    std::vector<Segment> segments(size_);
    Count total;
    bool from_others = false;
    for (std::size_t r = 0; r < size_; ++r) {
      Segment& s = segments[r];
      if (r == me_) {
        s = {local_ + own_begin[q], sent_[q]};
      } else if (arrived_.begin[r + 1] > arrived_.begin[r]) {
        Reader reader(arrived_.bytes.data() + arrived_.begin[r]);
        const Count* const counts = reader.array<Count>(patches_.size());
        for (std::size_t j = 0; j < k; ++j) reader.array<Record>(counts[j].own + counts[j].halo);
        s = {reader.array<Record>(0), counts[k]};
        from_others = from_others || s.count.own + s.count.halo > 0;
      }
      total.own += s.count.own, total.halo += s.count.halo;
    }
    cost_.halo += static_cast<std::int64_t>(total.halo);
    std::vector<std::size_t>& from = own_from_.emplace_back(1, 0);
    for (const Segment& s : segments) from.push_back(from.back() + s.count.own);
    if (!from_others) {
      patch.set_nodes(segments[me_].records, total.own, total.own + total.halo);
      return;
    }
    Buffer<Record>& all = gathered_.emplace_back(total.own + total.halo);
    Record* at = all.data();
    for (const Segment& s : segments) at = std::copy(s.records, s.records + s.count.own, at);
    for (const Segment& s : segments)
      at = std::copy(s.records + s.count.own, s.records + s.count.own + s.count.halo, at);
    patch.set_nodes(all.data(), total.own, total.own + total.halo);
  }

  // ---- 2: triangulate ----

  void triangulate_patches() {
    in_agreement([&] {
      constexpr std::size_t kPage = 4096;
      std::vector<std::size_t> begin{0};
      for (const Patch<Int>& patch : patches_)
        begin.push_back(begin.back() + (patch.workspace_bytes(closing_.size()) + kPage - 1) / kPage * kPage);
      workspace_ = std::make_unique<Workspace>(begin.back());
      unsigned char* const memory = workspace_->keep<unsigned char>(begin.back());
      for_patches([&](Patch<Int>& patch, std::size_t k) {
        Workspace part(memory + begin[k], begin[k + 1] - begin[k]);
        patch.triangulate(closing_, part);
      });
    });
  }

  // ---- 3: merge ----

  /// Different nodes in the same direction that any patch came upon.
  std::vector<std::pair<std::int64_t, std::int64_t>> all_coincident() {
    std::int64_t count = 0;
    for (const Patch<Int>& patch : patches_) count -= static_cast<std::int64_t>(patch.coincident().size());
    ranks_.all_min(&count, 1);
    if (count == 0) return {};
    std::vector<std::pair<std::int64_t, std::int64_t>> pairs;
    in_agreement([&] {
      for (const Patch<Int>& patch : patches_)
        pairs.insert(pairs.end(), patch.coincident().begin(), patch.coincident().end());
    });
    const Parcels all = ranks_.all_gather(pairs.data(), pairs.size() * sizeof(pairs[0]));
    in_agreement([&] {
      pairs.resize(all.begin.back() / sizeof(pairs[0]));
      std::memcpy(static_cast<void*>(pairs.data()), all.bytes.data(), all.begin.back());
    });
    return pairs;
  }

  /// The boundary of all nodes, if any patch has own nodes on what it takes for it. A patch that surrounds
  /// the centre shows that there is none; if no patch does, all nodes lie inside what the patches see.
  void find_boundary() {
    std::vector<Record> nodes;
    std::int64_t values[2] = {0,
                              INT64_MAX};  // some patch has own nodes on it; the first patch that surrounds
    in_agreement([&] {
      for (const Patch<Int>& patch : patches_) {
        const auto outline = patch.outline();
        if (outline.has_own) values[0] = -1;
        if (outline.surrounds_centre) values[1] = std::min<std::int64_t>(values[1], patch.id());
        nodes.insert(nodes.end(), outline.nodes.begin(), outline.nodes.end());
      }
    });
    gave_up_ = size_ == 1 && nodes.size() > options_.most_questions;
    if (gave_up_) return;
    ranks_.all_min(values, 2);
    if (values[0] == 0) return;
    const bool there_is_none = values[1] != INT64_MAX;
    in_agreement([&] {
      if (!there_is_none) return;
      nodes.clear();
      for (const Patch<Int>& patch : patches_)
        if (patch.id() == values[1]) nodes = patch.nodes_around_centre();
    });
    const Parcels all = ranks_.all_gather(nodes.data(), nodes.size() * sizeof(Record));
    in_agreement([&] {
      nodes.resize(all.begin.back() / sizeof(Record));
      std::memcpy(static_cast<void*>(nodes.data()), all.bytes.data(), all.begin.back());
      nodes.insert(nodes.end(), corners_.begin(), corners_.end());
      keep_one_of_each(nodes);
      boundary_ =
          there_is_none ? Boundary::none(std::move(nodes)) : Boundary(std::move(nodes), places_.lengths());
    });
  }

  /// One round; false if nobody had a question.
  bool ask_and_learn() {
    std::vector<std::vector<Question>> questions;  // to each rank
    std::int64_t asked = 0;
    in_agreement([&] {
      questions.resize(size_);
      std::vector<std::vector<Question>> of_patch(patches_.size());
      for_patches([&](Patch<Int>& patch, std::size_t k) { patch.ask(boundary_, of_patch[k]); });
      for (const auto& list : of_patch)
        for (const Question& q : list) questions[rank_of(q.to)].push_back(q), --asked;
    });
    ranks_.all_min(&asked, 1);
    if (asked == 0) return false;
    gave_up_ = size_ == 1 && static_cast<std::size_t>(-asked) > options_.most_questions;
    if (gave_up_) return false;
    ++cost_.rounds;

    Parcels outgoing;
    in_agreement([&] { outgoing = parcels(questions); });
    const Parcels incoming = ranks_.exchange(outgoing);
    in_agreement([&] { outgoing = answers(incoming); });
    const Parcels replies = ranks_.exchange(outgoing);
    in_agreement([&] { learn(questions, replies); });
    return true;
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
    outgoing.bytes = Buffer<unsigned char>(total);
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

  void learn(const std::vector<std::vector<Question>>& questions, const Parcels& replies) {
    struct Answer {
      const Record* nodes;
      std::size_t count;
    };
    std::vector<std::vector<Answer>> of_patch(patches_.size());
    for (std::size_t r = 0; r < size_; ++r) {
      Reader reader(replies.bytes.data() + replies.begin[r]);
      for (const Question& q : questions[r]) {
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
    Parcels outgoing;
    in_agreement([&] {
      std::vector<std::vector<Ring<Int>>> others(patches_.size());  // rings of the nodes of other ranks
      stars.memory.reserve(2);
      stars.homes = std::make_unique<Homes>();
      stars.more_memory.resize(patches_.size());
      for_patches([&](Patch<Int>& patch, std::size_t k) {
        const std::size_t entries = patch.finish() + 2 * kBlock;
        auto* rings = static_cast<Int*>(patch.room_for_rings(entries * sizeof(Int)));
        if (rings == nullptr) {
          stars.more_memory[k] = Buffer<Int>(entries);
          rings = stars.more_memory[k].data();
        }
        const std::vector<std::size_t>& from = own_from_[k];
        Ring<Int>* const mine = rings_ + own_position_[static_cast<std::size_t>(patch.id())];
        const std::size_t first = from[me_], count = from[me_ + 1] - first;
        const auto soon = [&](std::size_t i) { __builtin_prefetch(mine + (i - first), 1); };
        if (count == patch.own()) {
          patch.write_rings(
              rings,
              [&](std::size_t i, const Int* begin, std::uint32_t n) {
                mine[i] = {begin, n};
              },
              soon);
          return;
        }
        others[k].resize(patch.own());
        patch.write_rings(
            rings,
            [&](std::size_t i, const Int* begin, std::uint32_t n) {
              (i - first < count ? mine[i - first] : others[k][i]) = {begin, n};
            },
            soon);
      });

      // For each rank and patch: the sizes of its nodes' rings, then the rings.
      outgoing.begin.push_back(0);
      for (std::size_t r = 0; r < size_; ++r) {
        std::size_t bytes = 0;
        for (std::size_t k = 0; k < patches_.size() && r != me_; ++k) {
          bytes += (own_from_[k][r + 1] - own_from_[k][r]) * sizeof(std::uint32_t);
          bytes = (bytes + sizeof(Int) - 1) / sizeof(Int) * sizeof(Int);
          for (std::size_t i = own_from_[k][r]; i < own_from_[k][r + 1]; ++i)
            bytes += others[k][i].count * sizeof(Int);
        }
        outgoing.begin.push_back(outgoing.begin.back() + (bytes + 7) / 8 * 8);
      }
      outgoing.bytes = Buffer<unsigned char>(outgoing.begin.back());
      for (std::size_t r = 0; r < size_; ++r) {
        if (r == me_) continue;
        unsigned char* at = outgoing.bytes.data() + outgoing.begin[r];
        const unsigned char* const begin = at;
        for (std::size_t k = 0; k < patches_.size(); ++k) {
          for (std::size_t i = own_from_[k][r]; i < own_from_[k][r + 1]; ++i, at += sizeof(std::uint32_t))
            std::memcpy(at, &others[k][i].count, sizeof(std::uint32_t));
          at += (sizeof(Int) - static_cast<std::size_t>(at - begin) % sizeof(Int)) % sizeof(Int);
          for (std::size_t i = own_from_[k][r]; i < own_from_[k][r + 1]; ++i) {
            const std::size_t size = others[k][i].count * sizeof(Int);
            std::memcpy(at, others[k][i].begin, size);
            at += size;
          }
        }
      }
    });
    stars.received = ranks_.exchange(outgoing);
    for (std::size_t r = 0; r < size_; ++r) {
      if (r == me_) continue;
      Reader reader(stars.received.bytes.data() + stars.received.begin[r]);
      for (auto q = static_cast<std::size_t>(first_patch_[r]);
           q < static_cast<std::size_t>(first_patch_[r + 1]); ++q) {
        const std::size_t n = sent_[q].own;
        const std::uint32_t* const counts = reader.array<std::uint32_t>(n);
        reader.align(sizeof(Int));
        Ring<Int>* const rings = rings_ + own_position_[q];
        for (std::size_t i = 0; i < n; ++i) rings[i] = {reader.array<Int>(counts[i]), counts[i]};
      }
    }
  }

  /// The neighbours of this rank's nodes that it did not bring itself.
  void find_outside(Stars<Int>& stars) {
    Parcels outgoing;
    in_agreement([&] {
      std::vector<std::vector<Record>> neighbours(size_);
      for (std::size_t k = 0; k < patches_.size(); ++k) {
        const std::vector<std::size_t>& from = own_from_[k];
        const std::size_t first = from[me_], count = from[me_ + 1] - first;
        const auto rank_of = [&](std::size_t i) {
          if (i - first < count) return me_;
          return static_cast<std::size_t>(std::upper_bound(from.begin(), from.end(), i) - from.begin()) - 1;
        };
        patches_[k].for_each_missing_neighbour(
            me_, rank_of, [&](std::size_t r, const Record& node) { neighbours[r].push_back(node); });
      }
      outgoing = parcels(neighbours);
    });
    const Parcels incoming = ranks_.exchange(outgoing);
    in_agreement([&] {
      std::vector<Record> all(incoming.begin.back() / sizeof(Record));
      std::memcpy(static_cast<void*>(all.data()), incoming.bytes.data(), incoming.begin.back());
      std::sort(all.begin(), all.end(), [](const Record& a, const Record& b) { return a.number < b.number; });
      // Without those that it brought: marked in a table of some bits of the number first.
      std::vector<bool> maybe(std::size_t{1} << 16);
      while (maybe.size() < 16 * all.size()) maybe.resize(2 * maybe.size());
      const auto slot = [&](std::int64_t number) {
        return scrambled(static_cast<std::uint64_t>(number)) & (maybe.size() - 1);
      };
      for (const Record& r : all) maybe[slot(r.number)] = true;
      std::vector<std::int64_t> own;
      for (std::size_t i = 0; i < nodes_.count; ++i)
        if (maybe[slot(nodes_.number(i))]) own.push_back(nodes_.number(i));
      std::sort(own.begin(), own.end());
      for (std::size_t k = 0; k < all.size(); ++k)
        if ((k == 0 || all[k].number != all[k - 1].number) &&
            !std::binary_search(own.begin(), own.end(), all[k].number))
          stars.outside.push_back({all[k].number, all[k].point});
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
  std::unique_ptr<Partition> partition_;
  std::vector<Record> closing_;      ///< nodes from everywhere
  std::vector<Patch<Int>> patches_;  ///< of this rank
  Boundary boundary_;
  bool gave_up_ = false;

  std::vector<Count> sent_;                ///< to each patch
  std::vector<std::size_t> own_position_;  ///< for each patch, where its nodes begin in rings_
  std::unique_ptr<Workspace> per_node_, local_memory_, workspace_;
  std::uint32_t* position_ = nullptr;  ///< of each local node among those sent to their patches
  Ring<Int>* rings_ = nullptr;         ///< of the nodes sent to their patches, in that order
  Record* local_ = nullptr;            ///< nodes of this rank for patches of this rank
  Parcels arrived_;
  std::vector<Buffer<Record>> gathered_;
  std::vector<std::vector<std::size_t>> own_from_;  ///< [patch][rank]: its own nodes that the rank brought
};

}  // namespace

template <class Int>
Stars<Int> triangulate(const LocalNodes& nodes, const Point (&corners)[3], const std::int64_t (&numbers)[3],
                       Communicator& ranks, const ParallelOptions& options, ParallelCost* cost) {
  ParallelCost own_cost;
  ParallelCost& c = cost != nullptr ? *cost : own_cost;
  // All lengths 1? The predicates must be the same everywhere.
  std::atomic<bool> unit{true};
  std::atomic<double> deviation{0};
  parallel_pieces(nodes.count, options.threads, [&](std::size_t first, std::size_t last, int) {
    double largest = 0;
    bool all = true;
    for (std::size_t i = first; i < last; ++i) {
      const Point& p = nodes.points[i];
      all = all & length_is_one(p);
      largest = std::max(largest, std::fabs(p.x * p.x + p.y * p.y + p.z * p.z - 1));
    }
    if (!all) unit = false;
    for (double seen = deviation; seen < largest && !deviation.compare_exchange_weak(seen, largest);) {
    }
  });
  std::int64_t agreed[2] = {unit ? 0 : -1, 0};
  double most = deviation;
  std::memcpy(&agreed[1], &most, sizeof most);
  agreed[1] = -agreed[1];  // the bits of positive numbers are in their order
  ranks.all_min(agreed, 2);
  agreed[1] = -agreed[1];
  std::memcpy(&most, &agreed[1], sizeof most);

  const std::array<Record, 3> corner_records{
      Record{corners[0], numbers[0]}, {corners[1], numbers[1]}, {corners[2], numbers[2]}};
  const auto run = [&](Lengths lengths) {
    return Triangulator<Int>(nodes, corner_records, ranks, options, lengths, most, c).run();
  };
  Stars<Int> stars;
  if (agreed[0] == 0) {
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

template Stars<std::int32_t> triangulate(const LocalNodes&, const Point (&)[3], const std::int64_t (&)[3],
                                         Communicator&, const ParallelOptions&, ParallelCost*);
template Stars<std::int64_t> triangulate(const LocalNodes&, const Point (&)[3], const std::int64_t (&)[3],
                                         Communicator&, const ParallelOptions&, ParallelCost*);

}  // namespace pstripack
