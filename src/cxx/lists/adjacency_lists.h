#pragma once
// STRIPACK's linked lists LIST, LPTR, LEND: written from a mesh, checked, and read back.
// Slots and nodes in the arrays count from 1, as Fortran callers see them.

#include <cstddef>
#include <cstdint>

#include "mesh/delaunay.h"
#include "mesh/triangulation.h"
#include "mesh/validate.h"

namespace pstripack {

/// The lists of one triangulation; read only. LNEW = 0 means "not known" (8-argument callers).
template <class Int>
struct ListsView {
  std::size_t n;
  const Int* list;
  const Int* lptr;
  const Int* lend;
  Int lnew;
};

/// Writes the canonical lists of a hull (docs/differences.md, Canonical lists): the neighbours of node k fill
/// consecutive slots, nodes in increasing order, counterclockwise; an interior node starts with its
/// smallest neighbour, a boundary node with its first boundary neighbour and ends with the negated last.
/// `list`, `lptr`: at least 6n-12 slots, of which 1..LNEW-1 are written; `lend`: n. Returns LNEW.
/// Every node must be in the hull (hull.coincident empty). Takes 32 bytes per node of the workspace that
/// `delaunay` used. On one thread.
std::int32_t write_lists(const Hull& hull, std::int32_t* list, std::int32_t* lptr, std::int32_t* lend,
                         Workspace& workspace);

/// Checks the structure only: slots in range, every slot 1..LNEW-1 in exactly one closed list, neighbours in
/// range and different, symmetric adjacency, a negative entry only for the last neighbour of a boundary node.
/// Reads no slot outside 1..6n-12, whatever the arrays hold. Throws std::bad_alloc, as the checks below do.
Verdict check_lists(const ListsView<std::int32_t>& lists);

/// check_lists, and that the triangles form one sphere or one disc. Ignores coordinates.
Verdict check_topology(const ListsView<std::int32_t>& lists);

/// True if the lists are canonical (docs/differences.md, Canonical lists). Needs check_lists to hold.
bool lists_are_canonical(const ListsView<std::int32_t>& lists);

/// The triangles of well-formed lists, smallest corner first, indices from 0.
Triangles triangles_of(const ListsView<std::int32_t>& lists);

/// check_lists, then is_valid of the triangles.
Verdict is_valid(const Point* p, const ListsView<std::int32_t>& lists, Lengths lengths = Lengths::automatic,
                 Ties ties = Ties::by_rule);

}  // namespace pstripack
