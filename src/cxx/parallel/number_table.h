#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "base/splitmix64.h"
#include "parallel/global_number.h"
#include "parallel/local_numbers.h"

namespace pstripack {

inline std::uint64_t hash_of(GlobalNumber number) { return splitmix64(static_cast<std::uint64_t>(number)); }
template <class Int>
std::uint64_t hash_of(const std::array<Int, 3>& numbers) {
  const auto a = static_cast<std::uint64_t>(numbers[0]), b = static_cast<std::uint64_t>(numbers[1]),
             c = static_cast<std::uint64_t>(numbers[2]);
  return splitmix64(a ^ b << 22 ^ c << 43 ^ c >> 21);
}

/// The rank that collects what all ranks say of a number. It depends on other bits of the number's hash than
/// the places in a Table there.
inline RankNumber meeting_rank(GlobalNumber number, std::size_t ranks) {
  return static_cast<RankNumber>((hash_of(number) >> 32) * ranks >> 32);
}

/// Finds values by keys, which have a hash_of(); Key{}, as kNoNumber, is none. Throws std::bad_alloc when
/// made for one or more, and in insert() if there are more than `most`.
template <class Key, class Value>
class Table {
 public:
  explicit Table(std::size_t most = 0) {
    if (most == 0) return;
    std::size_t places = kFewest;
    while (places < 2 * most) places *= 2;
    place_.resize(places);
  }

  /// The value of the key, and whether the key is new: a new one gets `value`.
  std::pair<Value, bool> insert(const Key& key, Value value) {
    if (place_.empty()) place_.resize(kFewest);
    if (Place& place = place_[find_place(key)]; place.key == key) return {place.value, false};
    if (2 * ++size_ > place_.size()) grow();
    place_[find_place(key)] = {key, value};
    return {value, true};
  }
  /// Null if the key is not in the table.
  Value* find(const Key& key) {
    if (place_.empty()) return nullptr;
    Place& place = place_[find_place(key)];
    return place.key == key ? &place.value : nullptr;
  }
  const Value* find(const Key& key) const { return const_cast<Table*>(this)->find(key); }

 private:
  static constexpr std::size_t kFewest = 16;
  struct Place {
    Key key{};
    Value value{};
  };
  std::size_t home(const Key& key) const { return hash_of(key) & (place_.size() - 1); }
  std::size_t find_place(const Key& key) const {
    std::size_t at = home(key);
    while (!(place_[at].key == key) && !(place_[at].key == Key{})) at = (at + 1) & (place_.size() - 1);
    return at;
  }
  void grow() {
    std::vector<Place> smaller(2 * place_.size());
    smaller.swap(place_);
    for (const Place& place : smaller)
      if (!(place.key == Key{})) place_[find_place(place.key)] = place;
  }
  std::vector<Place> place_;
  std::size_t size_ = 0;
};

/// By the number of a node.
template <class Value>
using NumberTable = Table<GlobalNumber, Value>;

}  // namespace pstripack
