#pragma once
// STRIPACK's lists, read and written by the tests' own code.

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "geometry/point.h"

using Nodes = std::vector<pstripack::Point>;
using Faces = std::vector<std::array<std::int32_t, 3>>;  // nodes from 0, counterclockwise

struct Lists {
  std::vector<std::int32_t> list, lptr, lend;
  std::int32_t lnew = 0;

  std::size_t nodes() const { return lend.size(); }
};
inline bool operator==(const Lists& a, const Lists& b) {
  return a.list == b.list && a.lptr == b.lptr && a.lend == b.lend && a.lnew == b.lnew;
}

constexpr std::int32_t untouched = -987654321;  // value of all entries before a call

/// Arrays of exactly 6n-12 and n entries, not yet written.
inline Lists room_for(std::size_t n) {
  const std::vector<std::int32_t> slots(n < 3 ? 1 : 6 * n - 12, untouched);
  return {slots, slots, std::vector<std::int32_t>(n, untouched), untouched};
}

/// The neighbours of each node (from 0), counterclockwise; of an interior node from its smallest neighbour
/// on, of a boundary node from the first boundary neighbour to the last.
struct Rings {
  std::vector<std::vector<std::int32_t>> neighbours;
  std::vector<char> boundary;
};
inline bool operator==(const Rings& a, const Rings& b) {
  return a.neighbours == b.neighbours && a.boundary == b.boundary;
}

/// Empty unless each of the slots 1..lnew-1 is in exactly one closed list, with a neighbour in range,
/// different from the others and from the node, and negative only at LEND. Reads nothing else.
std::optional<Rings> rings_of(const Lists& lists);

/// The canonical lists (docs/differences.md) of these rings. lnew is one past the last slot; the arrays have
/// 6n-12 slots if that is enough, unused ones hold `filler`.
Lists canonical_lists(const Rings& rings, std::int32_t filler = 0);

/// Every triangle once, smallest corner first, sorted. Arcs that do not match are ignored.
Faces faces_of(const Rings& rings);

/// The rings of a set of triangles; empty if the star of some node is not one cycle or one fan.
std::optional<Rings> rings_of(std::size_t nodes, const Faces& faces);

/// Smallest corner first, sorted.
void sort_faces(Faces& faces);
