#include "lists/list_pieces.h"

namespace pstripack {

void write_lptr(const std::int32_t* lend, std::size_t n, std::size_t first_slot, std::int32_t* lptr,
                int threads) {
  constexpr std::size_t kTogether = 512;  // so few nodes that their slots stay in the cache between the loops
  parallel_pieces(n, threads, [&](std::size_t first, std::size_t last, int) {
    for (std::size_t k = first; k < last; k += kTogether) {
      const std::size_t end = std::min(k + kTogether, last);
      const std::int32_t begin = k > 0 ? lend[k - 1] : static_cast<std::int32_t>(first_slot);
      for (std::int32_t slot = begin; slot < lend[end - 1]; ++slot) lptr[slot] = slot + 2;
      std::int32_t ring = begin;
      for (std::size_t i = k; i < end; ++i) {
        lptr[lend[i] - 1] = ring + 1;
        ring = lend[i];
      }
    }
  });
}

}  // namespace pstripack
