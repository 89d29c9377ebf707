#pragma once
// Pools of points for small sets of nodes: lattices of few coordinates, and all degeneracies.

#include <cstddef>
#include <cstdint>

#include "support/lists.h"

constexpr int kPoolSize = 16;

constexpr int kPoolFamilies = 14;
const char* pool_family(std::uint64_t number);

/// Pool `number`: kPoolSize points, some of which may coincide. The number modulo kPoolFamilies is its
/// family.
Nodes make_pool(std::uint64_t number);
