#pragma once
// The ring of a node: its neighbours in the order of STRIPACK's lists, read off a hull.

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <numeric>
#include <utility>

#include "base/workspace.h"
#include "mesh/delaunay.h"

namespace pstripack {

/// Rings of up to this many neighbours are copied as one block of fixed length, because the end of a loop
/// would be mispredicted. The next ring overwrites the excess. A node has six neighbours on average.
constexpr std::size_t kBlock = 8;

template <class Int>
void copy_block(const Int* from, Int* to) {
  std::memcpy(to, from, kBlock * sizeof(Int));
}

/// The number of hull node v is table[v] + kOffset.
template <class Int, std::int64_t kOffset>
struct Numbers {
  const Int* table;
  std::int64_t operator()(HullNode v) const { return table[v] + kOffset; }
  [[gnu::always_inline]] void prefetch(HullNode v) const { __builtin_prefetch(table + v); }
};

/// Writes the ring of one hull node to `begin` as it will stand in LIST; returns its end. `corner` is 4*t +
/// i: the node is vertex[i] of face t. number(v) is the caller's number of hull node v, from 1.
///
///            f.vertex[previous]           The face t = (v, next, previous). Its neighbour across the edge
///             /      |                    v - previous, which lies opposite `next`, follows
///      beyond       |  t                  counterclockwise. `code` is 4*t + i of `next`.
///             \      |
///              v ------ f.vertex[next]
template <class Int, class Number>
Int* append_ring(const Hull& hull, HullCorner corner, const Number& number, Int* const begin) {
  Int* out = begin;
  const HullCorner first = next_code(corner);
  HullCorner code = first;
  do {
    *out++ = static_cast<Int>(number(*hull.word(code)));
    const HullCorner beyond = hull.word(code)[4];
    if (!hull.front(face_of(beyond))) {  // the boundary: its last node closes the list
      *out++ = -static_cast<Int>(number(*hull.word(next_code(code))));
      return out;
    }
    code = previous_code(beyond);
  } while (code != first);
  std::rotate(begin, std::min_element(begin, out), out);
  return out;
}

/// The same for an inner node with up to kBlock neighbours; writes kBlock entries. Null if it has more
/// neighbours.
template <class Int, class Number>
Int* append_short_ring(const Hull& hull, HullCorner corner, const Number& number, Int* begin) {
  const HullCorner first = next_code(corner);
  HullCorner code = first;
  std::uint32_t count = 0, at = 0;
  Int ring[kBlock], twice[2 * kBlock], smallest = std::numeric_limits<Int>::max();
  do {
    const std::uint32_t* const word = hull.word(code);
    const Int neighbour = static_cast<Int>(number(word[0]));
    at = neighbour < smallest ? count : at;
    smallest = neighbour < smallest ? neighbour : smallest;
    if (count == kBlock) return nullptr;
    ring[count++] = neighbour;
    code = previous_code(word[4]);
  } while (code != first);
  copy_block(ring, twice);
  copy_block(ring, twice + count);
  copy_block(twice + at, begin);
  return begin + count;
}

/// A stored ring: its number of entries, then the entries.
template <class Int>
struct Ring {
  const Int* begin;
  std::uint32_t count;
};
template <class Int>
Ring<Int> ring_at(const Int* place) {
  return {place + 1, static_cast<std::uint32_t>(*place)};
}

/// Copies a stored ring; returns the end. Reads and writes up to kBlock entries beyond it.
template <class Int>
Int* copy_ring(const Int* place, Int* to) {
  const std::size_t entries = 1 + static_cast<std::size_t>(*place);
  copy_block(place, to);
  if (entries > kBlock) std::copy(place + kBlock, place + entries, to + kBlock);
  return to + entries;
}

/// The rings of nodes 0..size-1, wherever they are stored.
template <class Int>
class RingTable {
 public:
  /// Where a ring is stored; and its size, in one byte, so that arcs() need not read the rings.
  struct Entries {
    const Int** place;
    std::uint8_t* size_class;
    void set(std::size_t k, const Int* ring) const { set(k, ring, static_cast<std::uint32_t>(*ring)); }
    void set(std::size_t k, const Int* ring, std::uint32_t count) const {
      place[k] = ring;
      size_class[k] = static_cast<std::uint8_t>(std::min<std::uint32_t>(count, kMany));
    }
    /// Number of entries of ring k, usually without reading it there.
    std::size_t count(std::size_t k) const {
      return size_class[k] < kMany ? size_class[k] : ring_at(place[k]).count;
    }
  };

  RingTable() = default;
  /// The ring of node i is entry position[i] of `rings` ones, which are to be set. Throws std::bad_alloc.
  RingTable(BlockArray<std::uint32_t> position, std::size_t rings)
      : position_(std::move(position)), place_(rings), size_class_(rings) {}
  /// Ring i is that of node i.
  explicit RingTable(std::size_t size) : RingTable(BlockArray<std::uint32_t>(size), size) {
    std::iota(position_.begin(), position_.end(), 0);
  }

  std::size_t size() const { return position_.size(); }
  Entries entries() { return {place_.data(), size_class_.data()}; }
  Ring<Int> operator[](std::size_t i) const { return ring_at(place_[position_[i]]); }
  void replace(std::size_t i, const Int* ring, std::uint32_t count) {
    entries().set(position_[i], ring, count);
  }
  [[gnu::always_inline]] void prefetch(std::size_t i) const {
    const Int* const place = place_[position_[i]];
    __builtin_prefetch(place);
    __builtin_prefetch(place + 6);  // most rings have six entries, which may lie in two lines
  }
  std::size_t arcs(std::size_t first, std::size_t last) const {
    const Entries all = const_cast<RingTable*>(this)->entries();
    std::size_t sum = 0;
    for (std::size_t i = first; i < last; ++i) sum += all.count(position_[i]);
    return sum;
  }
  std::size_t arcs() const { return arcs(0, size()); }

 private:
  static constexpr std::uint8_t kMany = 255;
  BlockArray<std::uint32_t> position_;
  BlockArray<const Int*> place_;
  BlockArray<std::uint8_t> size_class_;
};

/// Writes to `out` the stored rings (see Ring) of the hull nodes v in first..last-1 with wanted(v); returns
/// their end. Calls visit(v, place, count) for each, and ahead(w) some nodes earlier, to prefetch. Writes up
/// to 2*kBlock entries beyond the end.
template <class Int, class Wanted, class Number, class Ahead, class Visit>
Int* append_rings(const Hull& hull, std::size_t first, std::size_t last, const Wanted& wanted,
                  const Number& number, const Ahead& ahead, Int* out, const Visit& visit) {
  constexpr std::size_t kAhead = 10;
  for (std::size_t v = first; v < last; ++v) {
    if (v + 2 * kAhead < last) {
      ahead(v + 2 * kAhead);
      __builtin_prefetch(&hull.faces[face_of(hull.corner[v + 2 * kAhead])]);
      const Face& soon = hull.faces[face_of(hull.corner[v + kAhead])];
      for (int i = 0; i < 3; ++i) __builtin_prefetch(&hull.faces[face_of(soon.neighbour[i])]);
      for (int i = 0; i < 3; ++i) number.prefetch(soon.vertex[i]);
    }
    if (!wanted(v)) continue;
    Int* const place = out;
    out = hull.inner(v) ? append_short_ring(hull, hull.corner[v], number, place + 1) : nullptr;
    if (out == nullptr) out = append_ring(hull, hull.corner[v], number, place + 1);
    const auto count = static_cast<std::uint32_t>(out - place - 1);
    *place = static_cast<Int>(count);
    visit(v, place, count);
  }
  return out;
}

}  // namespace pstripack
