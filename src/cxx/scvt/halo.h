#pragma once
// Values at neighbours that other ranks have.

#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "parallel/agreement.h"
#include "parallel/communicator.h"
#include "parallel/number_table.h"
#include "scvt/spread.h"

namespace pstripack::scvt {

/// Each rank has the values of its own points, and asks for those of its halo: the neighbours of own points
/// that other ranks own. A rank alone has none. All members but size() are collective, and throw
/// AgreedFailure.
class Halo {
 public:
  explicit Halo(Communicator& ranks) : ranks_(ranks) {}

  /// From now on the halo is that of this neighbourhood. Neighbours are so on both ranks, and each rank has
  /// the same own points in every call.
  void connect(const Neighbourhood& here);
  /// Own points and all places of the neighbourhood behind them.
  std::size_t size() const { return size_; }
  /// Fills the places of the halo behind those of the own points.
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
  std::optional<NumberTable<std::int32_t>>
      directory_;  ///< owners of the numbers whose meeting_rank() this is
  std::size_t size_ = 0;
  /// For each rank, in the order of the numbers: own points that it asks for, and halo places that it fills.
  std::vector<std::vector<std::size_t>> to_, from_;
};

}  // namespace pstripack::scvt
