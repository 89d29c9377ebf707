#pragma once
// Exchange of values at neighbours that other ranks own.

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "parallel/agreement.h"
#include "parallel/communicator.h"
#include "parallel/number_table.h"
#include "scvt/spread.h"

namespace pstripack::scvt {

/// Each rank has the values at its own points and gets those at its halo: the neighbours of own points that
/// other ranks own. A single rank has no halo. All members except size() are collective and throw
/// AgreedFailure.
class Halo {
 public:
  explicit Halo(Communicator& ranks) : ranks_(ranks) {}

  /// Sets the halo to that of this neighbourhood. Adjacency must be symmetric: if a is a neighbour of b on
  /// one rank, b is a neighbour of a on the other. Each rank must have the same own points in every call.
  void connect(const Neighbourhood& here);
  /// Length of an array of values: own points, then the places of the halo.
  std::size_t size() const { return size_; }
  /// values: size() entries, of which those of own points are set. Sets those of the halo.
  template <class Value>
  void fill(std::vector<Value>& values) {
    if (ranks_.size() == 1) return;
    const Parcels parcels = exchange_in_agreement(ranks_, [&] {
      ParcelWriter writer(to_.size());
      for (std::size_t r = 0; r < to_.size(); ++r) writer.expect<Value>(r, to_[r].size());
      writer.make_room();
      for (std::size_t r = 0; r < to_.size(); ++r) {
        Value* room = writer.room<Value>(r, to_[r].size());
        for (const std::size_t i : to_[r]) *room++ = values[i];
      }
      return writer.finish();
    });
    const Value* value = Items<Value>(parcels).begin();
    for (const std::vector<std::size_t>& places : from_)
      for (const std::size_t place : places) values[place] = *value++;
  }

 private:
  void make_directory(const Neighbourhood& here);

  Communicator& ranks_;
  /// Owners of the numbers whose meeting_rank() is this rank.
  std::optional<NumberTable<std::int32_t>> directory_;
  std::size_t size_ = 0;
  /// For each rank, in the order of the numbers: own points that it needs; halo places that it fills.
  std::vector<std::vector<std::size_t>> to_, from_;
};

}  // namespace pstripack::scvt
