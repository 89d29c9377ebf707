#pragma once
// LIST, LPTR and LEND of the engine's TRMESH, of nodes in arrays of either precision.

#include <gtest/gtest.h>

#include <cstdint>
#include <numeric>
#include <vector>

#include "point_sets.h"
#include "trmesh/trmesh.h"

/// Canonical lists; or others: slots in random order, and each list begins with any neighbour, as after
/// edits.
enum class Slots { canonical, shuffled };

struct PlainLists {
  std::vector<std::int32_t> list, lptr, lend;  ///< 6n-12, 6n-12 and n entries
  std::size_t slots;                           ///< those in use: LNEW-1
};

template <class Real>
PlainLists plain_lists(std::size_t n, const Real* x, const Real* y, const Real* z,
                       Slots order = Slots::canonical) {
  std::vector<std::int32_t> list(6 * n - 12), lptr(list.size()), lend(n);
  std::int32_t end = 0;
  EXPECT_EQ(pstripack::trmesh(
                {static_cast<std::int32_t>(n), {x, y, z}, {list.data(), lptr.data(), lend.data(), &end}})
                .ier,
            0);
  const auto slots = static_cast<std::size_t>(end - 1);
  PlainLists other{list, lptr, lend, slots};
  if (order == Slots::canonical) return other;
  std::vector<std::size_t> place(slots);
  std::iota(place.begin(), place.end(), std::size_t{0});
  point_sets::shuffle(place, 1);
  const auto placed = [&](std::int32_t slot) {
    return static_cast<std::int32_t>(place[static_cast<std::size_t>(slot - 1)] + 1);
  };
  for (std::size_t s = 0; s < slots; ++s) {
    other.list[place[s]] = list[s];
    other.lptr[place[s]] = placed(lptr[s]);
  }
  for (std::size_t i = 0; i < n; ++i) {
    const auto last = static_cast<std::size_t>(lend[i] - 1);
    other.lend[i] = placed(list[last] < 0 || i % 2 == 0 ? lend[i] : lptr[last]);
  }
  return other;
}
