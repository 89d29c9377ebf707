#pragma once
// TRPRNT, TRLPRT, VORONOI_POLY_COUNT: tables for people to read. For Real = float, double and Int = int32_t,
// int64_t. They compose the records; the caller writes them. Words are ours; columns and page breaks are
// those of the original. Throw std::bad_alloc.

#include "lists/adjacency_lists.h"
#include "stripack/expressions.h"
#include "stripack/formatted_text.h"

namespace pstripack {

/// The two layouts in use. They differ at page breaks, where f90 has records of one blank, and in the totals,
/// which take three records in f90.
enum class ListingForm { f77, f90 };

/// The largest number of nodes, and of triangles, that a listing shows; a larger number is reported instead.
constexpr int most_listed = 9999;

/// TRPRNT: the neighbours of each node, from first to last, 0 after those of a boundary node; then the
/// numbers of boundary nodes, arcs and triangles. Before the neighbours: the coordinates if iflag = 0; x and
/// y if iflag > 0, taken for longitude and latitude; nothing if iflag < 0 (`nodes` is not read). Any number
/// of neighbours. Lists that are not closed are shown as far as they go, and end the table with a remark.
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
/// listc, lptr: 6n-12 slots. Reports lists that are not closed.
template <class Int>
void count_polygons(Int n, const Int* lend, const Int* lptr, const Int* listc, FormattedText& out);

}  // namespace pstripack
