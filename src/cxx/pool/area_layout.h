#pragma once
// The arrays of one call of TRMESH in memory shared by the model and the ranks of its pool on the same
// machine.

#include <cstddef>
#include <cstdint>

#include "trmesh/call.h"

namespace pstripack {

/// The positions of the arrays in an area: x | y | z | list | lptr | lend, each starting on a page.
class AreaLayout {
 public:
  AreaLayout(std::int32_t n, std::int32_t real_bytes)
      : n_(n), real_bytes_(static_cast<std::size_t>(real_bytes)) {
    constexpr std::size_t kPage = 4096;
    const auto nodes = static_cast<std::size_t>(n), slots = 6 * nodes - 12;
    const std::size_t real = real_bytes_;
    const std::size_t bytes[6] = {nodes * real, nodes * real, nodes * real, slots * 4, slots * 4, nodes * 4};
    begin_[0] = 0;
    for (int i = 0; i < 6; ++i) begin_[i + 1] = begin_[i] + (bytes[i] + kPage - 1) / kPage * kPage;
  }
  std::size_t size() const { return begin_[6]; }
  void* coordinate(void* area, int axis) const { return static_cast<unsigned char*>(area) + begin_[axis]; }
  /// The call whose arrays are in the area.
  TrmeshCall call(void* area, std::int32_t* lnew) const {
    const auto integers = [&](int k) { return static_cast<std::int32_t*>(coordinate(area, k)); };
    return {n_,
            NodeArrays(real_bytes_, coordinate(area, 0), coordinate(area, 1), coordinate(area, 2)),
            {integers(3), integers(4), integers(5), lnew}};
  }

 private:
  std::int32_t n_;
  std::size_t real_bytes_;
  std::size_t begin_[7];
};

}  // namespace pstripack
