#pragma once
// The arrays of one TRMESH call in memory that the model and the ranks of its pool on its machine share.

#include <cstddef>
#include <cstdint>

namespace pstripack {

/// Where the arrays lie in an area: x | y | z | list | lptr | lend, each on a page of its own.
class AreaLayout {
 public:
  AreaLayout(std::int32_t n, std::int32_t real_bytes) {
    constexpr std::size_t kPage = 4096;
    const auto nodes = static_cast<std::size_t>(n), slots = 6 * nodes - 12;
    const auto real = static_cast<std::size_t>(real_bytes);
    const std::size_t bytes[6] = {nodes * real, nodes * real, nodes * real, slots * 4, slots * 4, nodes * 4};
    begin_[0] = 0;
    for (int i = 0; i < 6; ++i) begin_[i + 1] = begin_[i] + (bytes[i] + kPage - 1) / kPage * kPage;
  }
  std::size_t size() const { return begin_[6]; }
  template <class Real>
  Real* coordinate(void* area, int axis) const {
    return reinterpret_cast<Real*>(static_cast<unsigned char*>(area) + begin_[axis]);
  }
  std::int32_t* list(void* area) const { return coordinate<std::int32_t>(area, 3); }
  std::int32_t* lptr(void* area) const { return coordinate<std::int32_t>(area, 4); }
  std::int32_t* lend(void* area) const { return coordinate<std::int32_t>(area, 5); }

 private:
  std::size_t begin_[7];
};

}  // namespace pstripack
