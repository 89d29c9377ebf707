#pragma once
// The ring of a node: its neighbours in the order of STRIPACK's lists, read off a hull.

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <limits>

#include "mesh/delaunay.h"

namespace pstripack {

/// Up to so many neighbours a ring is copied as one block, without a loop whose length no processor can
/// guess. What is copied too much is overwritten by the next ring. Six neighbours are the mean.
constexpr std::size_t kBlock = 8;

template <class Int>
void copy_block(const Int* from, Int* to) {
  std::memcpy(to, from, kBlock * sizeof(Int));
}

/// The corner at the same node in the next face clockwise.
inline std::uint32_t clockwise(const Hull& hull, std::uint32_t corner) {
  const std::uint32_t beyond = hull.faces[face_of(corner)].neighbour[previous_edge(edge_of(corner))];
  return 4 * face_of(beyond) + previous_edge(edge_of(beyond));
}

/// From any corner at a node to that in a front face, the first after the gap if there is one.
inline std::uint32_t first_corner(const Hull& hull, std::uint32_t corner) {
  while (!hull.front(face_of(corner))) corner = clockwise(hull, corner);
  const std::uint32_t start = corner;
  do {
    const std::uint32_t next = clockwise(hull, corner);
    if (!hull.front(face_of(next))) return corner;
    corner = next;
  } while (corner != start);
  return corner;
}

/// Appends the ring of one hull node as it will stand in LIST; returns the new end. `corner` is 4*t + i: the
/// node is vertex[i] of face t; number(v) is the number of hull node v, from 1. Writes up to 2*kBlock entries
/// beyond the end.
///
///            f.vertex[previous]           The face t = (v, next, previous). Its neighbour across the edge
///             /      |                    v - previous, which lies opposite `next`, follows
///      beyond       |  t                  counterclockwise.
///             \      |
///              v ------ f.vertex[next]
template <class Int, class Number>
Int* append_ring(const Hull& hull, std::uint32_t corner, const Number& number, Int* const begin) {
  if (!hull.surrounds_centre) corner = first_corner(hull, corner);
  Int* out = begin;
  Int smallest = std::numeric_limits<Int>::max();
  std::size_t smallest_at = 0;
  const std::uint32_t first = face_of(corner);
  do {
    const Face& f = hull.faces[face_of(corner)];
    const std::uint32_t next = next_edge(edge_of(corner));
    const Int neighbour = static_cast<Int>(number(f.vertex[next]));
    const bool smaller = neighbour < smallest;
    smallest = smaller ? neighbour : smallest;
    smallest_at = smaller ? static_cast<std::size_t>(out - begin) : smallest_at;
    *out++ = neighbour;
    const std::uint32_t beyond = f.neighbour[next];
    if (!hull.front(face_of(beyond))) {  // the boundary: its last node closes the list
      *out++ = -static_cast<Int>(number(f.vertex[previous_edge(edge_of(corner))]));
      return out;
    }
    corner = 4 * face_of(beyond) + next_edge(edge_of(beyond));
  } while (face_of(corner) != first);
  const auto count = static_cast<std::size_t>(out - begin);
  if (count > kBlock) {
    std::rotate(begin, begin + smallest_at, out);
    return out;
  }
  // Twice in a row, then the part that starts with the smallest.
  Int twice[2 * kBlock];
  copy_block(begin, twice);
  copy_block(begin, twice + count);
  copy_block(twice + smallest_at, begin);
  return out;
}

}  // namespace pstripack
