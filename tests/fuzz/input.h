#pragma once
// Typed values from the bytes of a fuzz input, and the check by which a target fails.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>
#include <vector>

#include "support/lists.h"

/// Yields the bytes of an input, then zeros.
class Input {
 public:
  Input(const std::uint8_t* data, std::size_t size) : data_(data), size_(size) {}

  bool empty() const { return at_ >= size_; }

  /// Any bits of this type.
  template <class T>
  T bits() {
    // No memcpy of the remaining bytes: GCC 12 omits the zero after a single byte.
    std::uint8_t bytes[sizeof(T)];
    for (std::uint8_t& byte : bytes) byte = empty() ? 0 : data_[at_++];
    T value;
    std::memcpy(&value, bytes, sizeof value);
    return value;
  }
  /// 0..n-1, n <= 256.
  int below(int n) { return bits<std::uint8_t>() % n; }
  /// least..most, and seldom any integer.
  std::int32_t integer(std::int32_t least, std::int32_t most) {
    const int choice = bits<std::uint8_t>();
    return choice == 255 ? bits<std::int32_t>() : least + choice % (most - least + 1);
  }
  std::string rest() {
    const std::string text(reinterpret_cast<const char*>(data_) + at_, size_ - at_);
    at_ = size_;
    return text;
  }

 private:
  const std::uint8_t* data_;
  std::size_t size_, at_ = 0;
};

/// A vector of one of several kinds: from a small lattice, as integers or scaled to length 1, or some ulps
/// beside these; with arbitrary exponents; with arbitrary bits; an earlier node or its opposite.
pstripack::Point any_vector(Input& input, const Nodes& earlier);

/// One of 65536 directions in general position.
pstripack::Point general_direction(Input& input);

/// Ends the program unless `holds`.
inline void require(bool holds, const std::string& what) {
  if (holds) return;
  std::fprintf(stderr, "%s\n", what.c_str());
  std::abort();
}
