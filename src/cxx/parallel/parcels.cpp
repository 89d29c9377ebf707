#include "parallel/parcels.h"

namespace pstripack {

void ParcelWriter::make_room(std::size_t beyond) {
  for (RankNumber r = 1; r < parcels_.begin.size(); ++r)
    parcels_.begin[r] =
        parcels_.begin[r - 1] + (parcels_.begin[r] + alignment_ - 1) / alignment_ * alignment_;
  end_ = parcels_.begin;
  if (!empty()) parcels_.bytes = Block(parcels_.begin.back() + beyond);
}

}  // namespace pstripack
