#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "base/splitmix64.h"
#include "base/workspace.h"
#include "parallel/global_number.h"
#include "parallel/local_numbers.h"

namespace pstripack {

/// The rank that collects what all ranks say of a number. It depends on other bits of the number's hash than
/// the places in a NumberTable there.
inline RankNumber meeting_rank(GlobalNumber number, std::size_t ranks) {
  return static_cast<RankNumber>((splitmix64(static_cast<std::uint64_t>(number)) >> 32) * ranks >> 32);
}

/// Finds values by number. Throws std::bad_alloc when made, never later.
template <class Value>
class NumberTable {
 public:
  explicit NumberTable(std::size_t most) {
    std::size_t places = 16;
    while (places < 2 * most) places *= 2;
    place_ = BlockArray<Place>(places);
    std::fill(place_.begin(), place_.end(), Place{});
  }

  /// The value of the number, and whether the number is new: a new one gets `value`.
  std::pair<Value, bool> insert(GlobalNumber number, Value value) {
    Place& place = place_[find(number)];
    if (place.number == number) return {place.value, false};
    place = {number, value};
    return {value, true};
  }
  /// Changes the value of the number if it is in the table.
  void set(GlobalNumber number, Value value) {
    if (Place& place = place_[find(number)]; place.number == number) place.value = value;
  }
  /// The number must be in the table.
  Value at(GlobalNumber number) const { return place_[find(number)].value; }
  /// Null if the number is not in the table.
  const Value* find_value(GlobalNumber number) const {
    const Place& place = place_[find(number)];
    return place.number == number ? &place.value : nullptr;
  }
  /// A hint that the number will be asked for soon.
  [[gnu::always_inline]] void prefetch(GlobalNumber number) const {
    __builtin_prefetch(&place_[home(number)], 1);
  }

 private:
  struct Place {
    GlobalNumber number;  // kNoNumber: empty
    Value value;
  };
  std::size_t home(GlobalNumber number) const {
    return splitmix64(static_cast<std::uint64_t>(number)) & (place_.size() - 1);
  }
  std::size_t find(GlobalNumber number) const {
    std::size_t at = home(number);
    while (place_[at].number != number && place_[at].number != kNoNumber) at = (at + 1) & (place_.size() - 1);
    return at;
  }
  BlockArray<Place> place_;
};

}  // namespace pstripack
