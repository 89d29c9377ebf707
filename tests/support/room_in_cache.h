#pragma once

#include <cstddef>
#include <new>

#include "base/cached.h"

namespace pstripack {

/// The number of bytes that the process may still keep between calls.
inline std::size_t room_in_cache() {
  std::size_t bytes = 0;
  for (std::size_t step = std::size_t{1} << 50; step > 0; step /= 2) try {
      CacheReservation(bytes + step);
      bytes += step;
    } catch (const std::bad_alloc&) {
    }
  return bytes;
}

}  // namespace pstripack
