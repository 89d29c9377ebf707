#include "lists/adjacency_lists.h"

#include <algorithm>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "base/parallel_for.h"
#include "lists/list_pieces.h"
#include "lists/rings.h"
#include "mesh/ring_table.h"

namespace pstripack {
namespace {

/// The rings of nodes 0..count-1: that of node i is stored at rings + place[i].
struct StoredRings {
  const std::int32_t* rings;
  const std::uint32_t* place;

  Ring<std::int32_t> operator[](std::size_t i) const { return ring_at(rings + place[i]); }
  [[gnu::always_inline]] void prefetch(std::size_t i) const { __builtin_prefetch(rings + place[i]); }
};

}  // namespace

std::int32_t write_lists(const Hull& hull, std::int32_t* list, std::int32_t* lptr, std::int32_t* lend,
                         Workspace& workspace) {
  const std::size_t n = hull.node_count;
  workspace.next_phase();
  auto* const ring_of = workspace.for_phase<std::uint32_t>(n);  // where in `rings` the node's ring is stored
  auto* const rings = workspace.for_phase<std::int32_t>(7 * n + 2 * kBlock + 1);
  // In the order of the hull, where the faces of a star are close together in memory: store all rings.
  append_rings(
      hull, 0, n, [](std::size_t) { return true; }, Numbers<std::uint32_t, 1>{hull.order},
      [&](std::size_t v) { __builtin_prefetch(&ring_of[hull.order[v]], 1); }, rings,
      [&](std::size_t v, const std::int32_t* place, std::uint32_t) {
        ring_of[hull.order[v]] = static_cast<std::uint32_t>(place - rings);
      });
  workspace.keep_only_this_phase();
  // Then, in the order of the caller's nodes, so that the lists are written from front to back: copy the
  // rings.
  write_rings(StoredRings{rings, ring_of}, 0, n, 0, 0, list, lend);
  write_lptr(lend, n, 0, lptr, 1);
  return lend[n - 1] + 1;
}

namespace {

Verdict malformed(const std::string& what, std::size_t node) {
  Verdict v;
  v.defect = Defect::malformed;
  v.node[0] = static_cast<index_t>(node);
  v.message = "node " + std::to_string(node + 1) + ": " + what;
  return v;
}

std::size_t absolute(std::int32_t v) { return static_cast<std::size_t>(v < 0 ? -v : v); }

/// Reads the neighbours of all nodes in the order of the lists. A defect if the lists are not closed or do
/// not use exactly the slots 1..LNEW-1.
Verdict read_stars(const ListsView<std::int32_t>& lists, StarTable& stars) {
  const std::size_t n = lists.n;
  const std::size_t most = 6 * n - 12;
  if (lists.lnew != 0 && (lists.lnew < 1 || static_cast<std::size_t>(lists.lnew) > most + 1))
    return malformed("LNEW is out of range", 0);
  const std::size_t slots = lists.lnew != 0 ? static_cast<std::size_t>(lists.lnew) - 1 : most;
  const auto in_range = [](std::int32_t v, std::size_t last) {
    return v >= 1 && static_cast<std::size_t>(v) <= last;
  };

  std::vector<bool> visited(slots + 1, false);
  std::uint32_t end = 0;
  stars.begin[0] = 0;
  for (std::size_t k = 0; k < n; ++k) {
    const std::int32_t last = lists.lend[k];
    if (!in_range(last, slots)) return malformed("LEND is out of range", k);
    std::int32_t slot = last;
    do {
      slot = lists.lptr[slot - 1];
      if (!in_range(slot, slots)) return malformed("LPTR is out of range", k);
      if (visited[static_cast<std::size_t>(slot)])
        return malformed("a slot is in two lists, or a list is not closed", k);
      visited[static_cast<std::size_t>(slot)] = true;
      const std::int32_t b = lists.list[slot - 1];
      if (b < 0 && slot != last) return malformed("a negative neighbour that is not the last", k);
      if (b < -std::numeric_limits<std::int32_t>::max() || !in_range(b < 0 ? -b : b, n) ||
          absolute(b) == k + 1)
        return malformed("a neighbour is out of range", k);
      stars.to[end++] = b < 0 ? static_cast<index_t>(b) : static_cast<index_t>(b - 1);  // ~(|b|-1) == b
    } while (slot != last);
    stars.begin[k + 1] = end;
    if (end - stars.begin[k] < 2) return malformed("fewer than two neighbours", k);
  }
  // The slots in use must be exactly 1..LNEW-1; if LNEW is not known, they must have no gaps.
  if (lists.lnew != 0 && end != slots)
    return malformed("LNEW does not match the number of neighbours", n - 1);
  for (std::size_t s = 1; s <= end; ++s)
    if (!visited[s]) return malformed("slots in use are not 1..LNEW-1", n - 1);
  return {};
}

/// Compares the stars of neighbours with each other. Needs read_stars to hold.
Verdict compare_stars(const ListsView<std::int32_t>& lists) {
  constexpr std::int32_t kAhead = 8;
  Rings<std::int32_t> rings;
  rings.read(lists, threads_for(lists.n));
  for (std::int32_t a = 1; a <= rings.size(); ++a) {
    const auto k = static_cast<std::size_t>(a) - 1;
    const std::int32_t begin = rings.begin(a), end = rings.end(a), soon = std::min(a + kAhead, rings.size());
    for (std::int32_t arc = rings.begin(soon); arc < rings.end(soon); ++arc)
      rings.prefetch(rings.begin(rings.target(arc)));
    for (std::int32_t arc = begin; arc < end; ++arc)
      if (const std::int32_t first = rings.arc_back(rings.target(arc), a); first >= 0 && first != arc)
        return malformed("a neighbour twice", k);
    for (std::int32_t arc = begin; arc < end; ++arc) {
      const std::int32_t b = rings.target(arc), back = rings.arc_back(a, b);
      if (rings.entry(arc) < 0) {
        // The last neighbour b of boundary node a precedes a on the boundary, so a is the first of b's list.
        if (rings.entry(rings.end(b) - 1) >= 0 || back != rings.begin(b))
          return malformed("its last neighbour is not the boundary node before it", k);
        continue;
      }
      // c follows b in a's list, so a must follow c in b's list.
      const std::int32_t c = rings.target(rings.after(a, arc));
      if (back < 0 || rings.entry(rings.before(b, back)) != c)
        return malformed("neighbours " + std::to_string(b) + ", " + std::to_string(c) +
                             " make no triangle in the list of the first",
                         k);
    }
  }
  return {};
}

/// check_lists; stores the stars of valid lists in `stars`.
Verdict stars_of(const ListsView<std::int32_t>& lists, std::optional<StarTable>& stars) {
  if (lists.n < 3) return malformed("fewer than three nodes", 0);
  stars.emplace(lists.n, 6 * lists.n - 12);
  if (Verdict v = read_stars(lists, *stars); !v) return v;
  return compare_stars(lists);
}

}  // namespace

Verdict check_lists(const ListsView<std::int32_t>& lists) {
  std::optional<StarTable> stars;
  return stars_of(lists, stars);
}

Verdict check_topology(const ListsView<std::int32_t>& lists) {
  std::optional<StarTable> stars;
  if (Verdict v = stars_of(lists, stars); !v) return v;
  return check_surface(*stars);
}

bool lists_are_canonical(const ListsView<std::int32_t>& lists) {
  std::int32_t slot = 1;
  for (std::size_t k = 0; k < lists.n; ++k) {
    const std::int32_t first = slot, last = lists.lend[k];
    if (last < first) return false;
    for (; slot < last; ++slot)
      if (lists.lptr[slot - 1] != slot + 1) return false;
    if (lists.lptr[last - 1] != first) return false;
    if (lists.list[last - 1] > 0 &&
        *std::min_element(lists.list + first - 1, lists.list + last) != lists.list[first - 1])
      return false;
    ++slot;
  }
  return lists.lnew == 0 || lists.lnew == slot;
}

Triangles triangles_of(const ListsView<std::int32_t>& lists) {
  Triangles triangles;
  triangles.reserve(2 * lists.n);
  for (std::size_t k = 0; k < lists.n; ++k) {
    std::int32_t slot = lists.lend[k];
    do {
      const std::int32_t next = lists.lptr[slot - 1];
      const auto a = static_cast<index_t>(k), b = static_cast<index_t>(lists.list[slot - 1] - 1),
                 c = static_cast<index_t>(absolute(lists.list[next - 1]) - 1);
      if (a < b && a < c) triangles.push_back({a, b, c});  // b < 0: the last neighbour of a boundary node
      slot = next;
    } while (slot != lists.lend[k]);
  }
  return triangles;
}

Verdict is_valid(const Point* p, const ListsView<std::int32_t>& lists, Lengths lengths, Ties ties) {
  std::optional<StarTable> stars;
  if (Verdict v = stars_of(lists, stars); !v) return v;
  return is_valid(p, *stars, lengths, ties);
}

}  // namespace pstripack
