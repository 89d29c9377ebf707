#pragma once
// What ranks send to each other: a parcel for every rank, packed and unpacked by type.

#include <algorithm>
#include <cstddef>
#include <type_traits>
#include <utility>
#include <vector>

#include "base/workspace.h"
#include "parallel/local_numbers.h"

namespace pstripack {

/// Bytes for every rank, or from every rank: those of rank r are [begin[r], begin[r+1]).
struct Parcels {
  Block bytes;
  std::vector<std::size_t> begin;
};

/// Packs parcels in two passes: first sizes, then items. The begin of every parcel is aligned for all types
/// packed.
class ParcelWriter {
 public:
  explicit ParcelWriter(std::size_t ranks) { parcels_.begin.resize(ranks + 1); }

  /// First: n items more for this rank.
  template <class Item>
  void expect(RankNumber rank, std::size_t n = 1) {
    static_assert(std::is_trivially_copyable_v<Item>);
    alignment_ = std::max(alignment_, alignof(Item));
    parcels_.begin[rank + 1] += n * sizeof(Item);
  }
  /// Then: memory for all that is expected and for `beyond` bytes behind it that may be written. Throws
  /// std::bad_alloc.
  void make_room(std::size_t beyond = 0) {
    for (RankNumber r = 1; r < parcels_.begin.size(); ++r)
      parcels_.begin[r] =
          parcels_.begin[r - 1] + (parcels_.begin[r] + alignment_ - 1) / alignment_ * alignment_;
    end_ = parcels_.begin;
    if (!empty()) parcels_.bytes = Block(parcels_.begin.back() + beyond);
  }
  /// True if nothing is expected.
  bool empty() const { return parcels_.begin.back() == 0; }
  /// Then: room for the next n items for this rank.
  template <class Item>
  Item* room(RankNumber rank, std::size_t n) {
    auto* const items = reinterpret_cast<Item*>(parcels_.bytes.data() + end_[rank]);
    end_[rank] += n * sizeof(Item);
    return items;
  }
  template <class Item>
  void put(RankNumber rank, const Item& item) {
    *room<Item>(rank, 1) = item;
  }
  Parcels finish() { return std::move(parcels_); }

 private:
  Parcels parcels_;
  std::vector<std::size_t> end_;  ///< of what has been put
  std::size_t alignment_ = 1;
};

/// The next n items of a parcel, which are followed by what `at` is then, in the order in which they were
/// packed.
template <class Item>
const Item* next_items(const unsigned char*& at, std::size_t n) {
  const auto* const items = reinterpret_cast<const Item*>(at);
  at += n * sizeof(Item);
  return items;
}

/// Items in parcels that hold nothing else.
template <class Item>
class Items {
 public:
  explicit Items(const Parcels& parcels) : Items(parcels, 0, parcels.begin.size() - 1) {}
  Items(const Parcels& parcels, RankNumber rank) : Items(parcels, rank, rank + 1) {}
  const Item* begin() const { return first_; }
  const Item* end() const { return last_; }
  std::size_t size() const { return static_cast<std::size_t>(last_ - first_); }

 private:
  Items(const Parcels& parcels, RankNumber first_rank, RankNumber last_rank)
      : first_(reinterpret_cast<const Item*>(parcels.bytes.data() + parcels.begin[first_rank])),
        last_(first_ + (parcels.begin[last_rank] - parcels.begin[first_rank]) / sizeof(Item)) {}
  const Item *first_, *last_;
};

/// Parcels of these items, items[r] for rank r.
template <class Item>
Parcels packed(const std::vector<std::vector<Item>>& items) {
  ParcelWriter writer(items.size());
  for (RankNumber r = 0; r < items.size(); ++r) writer.expect<Item>(r, items[r].size());
  writer.make_room();
  for (RankNumber r = 0; r < items.size(); ++r)
    std::copy(items[r].begin(), items[r].end(), writer.room<Item>(r, items[r].size()));
  return writer.finish();
}

}  // namespace pstripack
