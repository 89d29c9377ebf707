#pragma once

#include <cstdint>

namespace pstripack {

/// The number of a node in the caller's lists, from 1; the same on every rank. Local indices, from 0, are
/// plain integers: which node of LocalNodes, of a patch, of a hull. Neither converts to the other by itself.
enum class GlobalNumber : std::int64_t {};

/// No node has it.
constexpr GlobalNumber kNoNumber{0};

constexpr std::int64_t value_of(GlobalNumber number) { return static_cast<std::int64_t>(number); }

/// The node that an entry of a ring names: the last neighbour of a boundary node is negated.
template <class Int>
constexpr GlobalNumber named_by(Int entry) {
  return GlobalNumber{entry < 0 ? -entry : entry};
}

}  // namespace pstripack
