#pragma once

#include <cstdint>

namespace pstripack {

/// A bijection of 64 bits that leaves nothing of their order (Steele, Lea & Flood 2014: the last steps of
/// SplitMix64).
inline std::uint64_t scattered(std::uint64_t bits) {
  bits = (bits ^ (bits >> 30)) * 0xbf58476d1ce4e5b9u;
  bits = (bits ^ (bits >> 27)) * 0x94d049bb133111ebu;
  return bits ^ (bits >> 31);
}

}  // namespace pstripack
