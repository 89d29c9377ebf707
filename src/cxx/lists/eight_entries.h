#pragma once
// Questions about eight entries of LIST at once, without branches: which of them have the answer yes is as
// good as random, and a branch would be predicted wrong. The answers are bits, entry[0] first. An entry is
// negative where nothing is on the left of the arc; |entry| is the neighbour.

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

/// Bit i is test(i). For integers of any size.
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

/// |entry| == a
template <class Int>
unsigned equal_of_eight(const Int* entry, Int a) {
  return bits_of_eight([=](int i) { return (entry[i] == a) | (entry[i] == -a); });
}

template <class Int>
Greater greater_of_eight(const Int* entry, Int a) {
  return {bits_of_eight([=](int i) { return entry[i] > a; }),
          bits_of_eight([=](int i) { return neighbour_in(entry[i]) > a; })};
}

/// |entry[i]| < |entry[i-1]|; bit 0 is 0.
template <class Int>
unsigned descents_of_eight(const Int* entry) {
  return bits_of_eight([=](int i) { return i > 0 && neighbour_in(entry[i]) < neighbour_in(entry[i - 1]); });
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

inline unsigned descents_of_eight(const std::int32_t* entry) {
  const __m128i none = _mm_setzero_si128();
  const __m128i e = sse2::absolute(sse2::four(entry)), f = sse2::absolute(sse2::four(entry + 4));
  const __m128i before_f = sse2::absolute(sse2::four(entry + 3));
  return sse2::bits(_mm_cmplt_epi32(e, _mm_slli_si128(e, 4)), _mm_cmplt_epi32(f, before_f), none, none) & ~1u;
}
#endif

}  // namespace pstripack
