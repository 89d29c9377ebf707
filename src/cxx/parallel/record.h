#pragma once

#include <cstdint>

#include "geometry/point.h"

namespace pstripack {

/// A node on its way between patches or ranks.
struct Record {
  Point point;
  std::int64_t number;  ///< global, from 1
};

}  // namespace pstripack
