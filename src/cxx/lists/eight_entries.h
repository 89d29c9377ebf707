#pragma once
// Tests of eight entries of LIST at once, without branches, because their outcome is unpredictable. The
// answers are bits, entry[0] in the lowest. |entry| is the neighbour; an entry is negative if there is no
// triangle left of the arc to it.

#include <array>
#include <cstddef>
#include <cstdint>

#if defined(__SSE2__)
#include <emmintrin.h>
#endif

namespace pstripack {

constexpr int eight = 8;

/// The answers to entry > a, and to |entry| > a.
struct Greater {
  unsigned entries, neighbours;
};

/// Bit i of the result is test(i). For integers of any size.
template <class Test>
unsigned bits_of_eight(const Test& test) {
  unsigned bits = 0;
  for (int i = 0; i < eight; ++i) bits |= static_cast<unsigned>(test(i)) << i;
  return bits;
}

template <class Int>
Int neighbour_in(Int entry) {
  return entry < 0 ? -entry : entry;
}

/// Tests |entry| == a.
template <class Int>
unsigned equal_of_eight(const Int* entry, Int a) {
  return bits_of_eight([=](int i) { return (entry[i] == a) | (entry[i] == -a); });
}

template <class Int>
Greater greater_of_eight(const Int* entry, Int a) {
  return {bits_of_eight([=](int i) { return entry[i] > a; }),
          bits_of_eight([=](int i) { return neighbour_in(entry[i]) > a; })};
}

/// For each byte: the number of its bits that are 1, and their positions in increasing order.
constexpr auto ones_of_bits = [] {
  std::array<unsigned char, 256> ones{};
  for (unsigned byte = 1; byte < 256; ++byte)
    ones[byte] = static_cast<unsigned char>(ones[byte / 2] + byte % 2);
  return ones;
}();
constexpr auto positions_of_bits = [] {
  std::array<std::array<unsigned char, eight>, 256> positions{};
  for (unsigned byte = 0; byte < 256; ++byte) {
    std::size_t count = 0;
    for (unsigned i = 0; i < eight; ++i)
      if ((byte >> i & 1) != 0) positions[byte][count++] = static_cast<unsigned char>(i);
  }
  return positions;
}();
/// The number of 1s among the lowest 16 bits.
template <class Int>
Int ones(unsigned bits) {
  return static_cast<Int>(ones_of_bits[bits & 255] + ones_of_bits[bits >> eight]);
}

using EightBytes = std::array<unsigned char, eight>;

/// to[i] = base + bytes[i]
template <class Int>
void put_sums(Int base, const EightBytes& bytes, Int* to) {
  for (std::size_t i = 0; i < eight; ++i) to[i] = base + bytes[i];
}

#if defined(__SSE2__)
namespace sse2 {
inline __m128i four(const std::int32_t* entry) {
  return _mm_loadu_si128(reinterpret_cast<const __m128i*>(entry));
}
inline __m128i absolute(__m128i e) {
  const __m128i sign = _mm_srai_epi32(e, 31);
  return _mm_sub_epi32(_mm_xor_si128(e, sign), sign);
}
/// 16 bits from 16 comparisons.
inline unsigned bits(__m128i a, __m128i b, __m128i c, __m128i d) {
  return static_cast<unsigned>(
      _mm_movemask_epi8(_mm_packs_epi16(_mm_packs_epi32(a, b), _mm_packs_epi32(c, d))));
}
}  // namespace sse2

inline void put_sums(std::int32_t base, const EightBytes& bytes, std::int32_t* to) {
  const __m128i from = _mm_set1_epi32(base), zero = _mm_setzero_si128();
  const __m128i words =
      _mm_unpacklo_epi8(_mm_loadl_epi64(reinterpret_cast<const __m128i*>(bytes.data())), zero);
  auto* const two = reinterpret_cast<__m128i*>(to);
  _mm_storeu_si128(two, _mm_add_epi32(from, _mm_unpacklo_epi16(words, zero)));
  _mm_storeu_si128(two + 1, _mm_add_epi32(from, _mm_unpackhi_epi16(words, zero)));
}

inline unsigned equal_of_eight(const std::int32_t* entry, std::int32_t a) {
  const __m128i plus = _mm_set1_epi32(a), minus = _mm_set1_epi32(-a);
  const auto equal = [&](__m128i e) {
    return _mm_or_si128(_mm_cmpeq_epi32(e, plus), _mm_cmpeq_epi32(e, minus));
  };
  const __m128i none = _mm_setzero_si128();
  return sse2::bits(equal(sse2::four(entry)), equal(sse2::four(entry + 4)), none, none);
}

inline Greater greater_of_eight(const std::int32_t* entry, std::int32_t a) {
  const __m128i node = _mm_set1_epi32(a), e = sse2::four(entry), f = sse2::four(entry + 4);
  const unsigned bits =
      sse2::bits(_mm_cmpgt_epi32(e, node), _mm_cmpgt_epi32(f, node), _mm_cmpgt_epi32(sse2::absolute(e), node),
                 _mm_cmpgt_epi32(sse2::absolute(f), node));
  return {bits & 255, bits >> 8};
}
#endif

}  // namespace pstripack
