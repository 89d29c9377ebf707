#pragma once
// TRPRNT, TRLPRT, VORONOI_POLY_COUNT: printed tables. For Real = float, double and Int = int32_t, int64_t.
// The functions compose the records; the caller writes them. The wording is ours; columns and page breaks
// are those of the original. All throw std::bad_alloc.

#include "lists/adjacency_lists.h"
#include "stripack/expressions.h"
#include "stripack/formatted_text.h"

namespace pstripack {

/// The two layouts in use. They differ at page breaks, where f90 has records of one blank, and in the totals,
/// which take three records in f90.
enum class ListingForm { f77, f90 };

/// The largest number of nodes, and of triangles, that a listing shows. For more it is a message only.
constexpr int most_listed = 9999;

/// TRPRNT: the neighbours of each node, from first to last, followed by 0 for a boundary node; then the
/// numbers of boundary nodes, arcs and triangles. Before the neighbours: x, y, z if iflag = 0; x and y,
/// taken as longitude and latitude, if iflag > 0; nothing if iflag < 0 (`nodes` is not read). Any number of
/// neighbours. A list that is not closed is shown up to the defect, and ends the table with a remark.
template <class Real, class Int>
void list_neighbours(ListingForm form, Int iflag, const ListsView<Int>& lists, const Nodes<Real>& nodes,
                     FormattedText& out);

/// TRLPRT: the nodes, with coordinates as in list_neighbours (no nodes at all if iflag < 0), then the nt
/// columns of ltri(nrow, nt) as TRLIST gives them, then the totals.
template <class Real, class Int>
void list_triangles(ListingForm form, Int n, Int iflag, const Nodes<Real>& nodes, Int nrow, Int nt,
                    const Int* ltri, FormattedText& out);

/// VORONOI_POLY_COUNT: for the Voronoi diagram from CRLIST, the numbers of cells, vertices and edges, Euler's
/// sum F + V - E - 2, which is 0, and the non-zero numbers of cells with 1, 2, ..., 19, 20 or more sides.
/// listc, lptr: 6n-12 slots. If the lists are not closed, a message instead.
template <class Int>
void count_polygons(Int n, const Int* lend, const Int* lptr, const Int* listc, FormattedText& out);

}  // namespace pstripack
