#pragma once

#include <cstdint>

namespace pstripack {

/// The number of a node in the caller's lists, from 1; the same on every rank. Numbers that mean something on
/// one rank only, from 0, are in local_numbers.h and mesh/hull_numbers.h. Neither converts to the other by
/// itself.
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
