#pragma once

#include <cstdint>

namespace pstripack {

/// Hash of 64 bits, a bijection (the output function of SplitMix64: Steele, Lea & Flood 2014).
inline std::uint64_t splitmix64(std::uint64_t bits) {
  bits = (bits ^ (bits >> 30)) * 0xbf58476d1ce4e5b9u;
  bits = (bits ^ (bits >> 27)) * 0x94d049bb133111ebu;
  return bits ^ (bits >> 31);
}

}  // namespace pstripack
