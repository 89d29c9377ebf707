#pragma once
// TRPRNT, TRLPRT, VORONOI_POLY_COUNT: printed tables. For Real = float, double and Int = int32_t, int64_t.
// The functions compose the records; the caller writes them. The wording is ours; columns and page breaks
// are those of the original. All throw std::bad_alloc.

#include <algorithm>
#include <array>
#include <vector>

#include "lists/adjacency_lists.h"
#include "lists/list_walk.h"
#include "stripack/expressions.h"
#include "stripack/formatted_text.h"

namespace pstripack {

/// The two layouts in use. They differ at page breaks, where f90 has records of one blank, and in the totals,
/// which take three records in f90.
enum class ListingForm { f77, f90 };

/// The largest number of nodes, and of triangles, that a listing shows. For more it is a message only.
constexpr int most_listed = 9999;

constexpr int page_length = 58;

struct Layout {
  std::string_view blank;  ///< a blank record between the parts of a table
  int page_break;          ///< number of blank records at a page break
  bool totals_in_rows;
};
constexpr Layout layout_of(ListingForm form) {
  return form == ListingForm::f77 ? Layout{"", 4, false} : Layout{" ", 3, true};
}

inline void blank(const Layout& layout, int count, FormattedText& out) {
  for (int i = 0; i < count; ++i) out.add(layout.blank).end();
}

template <class Int>
int shown_coordinates(Int iflag) {
  return iflag < 0 ? 0 : iflag > 0 ? 2 : 3;
}

template <class Real, class Int>
void coordinates(const Nodes<Real>& nodes, Int node, int shown, int width, FormattedText& out) {
  const Real* const of_axis[] = {nodes.x, nodes.y, nodes.z};
  for (int axis = 0; axis < shown; ++axis)
    out.exponential(static_cast<double>(of_axis[axis][node - 1]), width);
}

template <class Int>
void totals(const Layout& layout, Int boundary_nodes, Int arcs, Int triangles, FormattedText& out) {
  blank(layout, 1, out);
  if (layout.totals_in_rows) {
    out.add("NB = ").integer(boundary_nodes, 8).add(" boundary nodes").end();
    out.add("NA = ").integer(arcs, 8).add(" arcs").end();
    out.add("NT = ").integer(triangles, 8).add(" triangles").end();
  } else {
    out.add(" NB = ").integer(boundary_nodes, 4).add(" on the boundary");
    out.add("     NA = ").integer(arcs, 5).add(" arcs");
    out.add("     NT = ").integer(triangles, 5).add(" triangles").end();
  }
}

/// TRPRNT: the neighbours of each node, from first to last, followed by 0 for a boundary node; then the
/// numbers of boundary nodes, arcs and triangles. Before the neighbours: x, y, z if iflag = 0; x and y,
/// taken as longitude and latitude, if iflag > 0; nothing if iflag < 0 (`nodes` is not read). Any number of
/// neighbours. A list that is not closed is shown up to the defect, and ends the table with a remark.
template <class Real, class Int>
void list_neighbours(ListingForm form, Int iflag, const ListsView<Int>& lists, const Nodes<Real>& nodes,
                     FormattedText& out) {
  const Layout layout = layout_of(form);
  const Int n = static_cast<Int>(lists.n);
  const int shown = shown_coordinates(iflag);
  constexpr std::array<int, 4> neighbours_in_a_row{14, 0, 8, 5};  // by coordinates shown
  const int in_a_row = neighbours_in_a_row[static_cast<std::size_t>(shown)];
  const int margin = 9 + 15 * shown;  // columns before the neighbours

  out.empty(3).skip(15).add("PSTRIPACK: the neighbours of each node,  N = ").integer(n, 5).end().empty(2);
  if (n < 3 || n > most_listed) {
    out.skip(11).add("N must be 3 to ").integer(most_listed, 4).end();
    return;
  }
  out.add(" node");
  if (shown == 3) out.skip(9).add("x").skip(14).add("y").skip(14).add("z").skip(5);
  if (shown == 2) out.skip(5).add("longitude").skip(7).add("latitude").skip(1);
  out.skip(8).add("neighbours, counterclockwise").end().empty(2);

  ListWalk<Int> walk(n, lists.lptr);
  std::vector<Int> neighbours;
  Int boundary_nodes = 0;
  int line = 6;
  for (Int node = 1; node <= n; ++node) {
    neighbours.clear();
    const bool closed =
        walk(lists.lend[node - 1], [&](Int, Int slot) { neighbours.push_back(lists.list[slot - 1]); });
    if (closed && neighbours.back() < 0 && neighbours.back() >= -n) {
      ++boundary_nodes;
      neighbours.back() = -neighbours.back();
      neighbours.push_back(0);
    }
    const int entries = static_cast<int>(neighbours.size());
    const int records = (entries - 1) / in_a_row + 2;  // with the blank one after
    line += records;
    if (line > page_length) {
      blank(layout, layout.page_break, out);
      line = records;
    }
    out.integer(node, 5);
    coordinates(nodes, node, shown, 15, out);
    out.skip(4);
    for (int i = 0; i < entries; ++i) {
      if (i > 0 && i % in_a_row == 0) out.end().skip(margin);
      out.integer(neighbours[static_cast<std::size_t>(i)], 5);
    }
    out.end();
    // After exactly one full row the record is empty in both layouts: in the original Fortran's format
    // writes it.
    if (entries == in_a_row)
      out.end();
    else
      blank(layout, 1, out);
    if (!closed) {
      out.skip(11).add("LIST, LPTR, LEND are not closed lists at node ").integer(node, 4).end();
      return;
    }
  }
  const bool covered = boundary_nodes == 0;
  const Int triangles = covered ? 2 * n - 4 : 2 * n - boundary_nodes - 2;
  totals(layout, boundary_nodes, covered ? 3 * n - 6 : triangles + n - 1, triangles, out);
}

/// TRLPRT: the nodes, with coordinates as in list_neighbours (no nodes at all if iflag < 0), then the nt
/// columns of ltri(nrow, nt) as TRLIST gives them, then the totals.
template <class Real, class Int>
void list_triangles(ListingForm form, Int n, Int iflag, const Nodes<Real>& nodes, Int nrow, Int nt,
                    const Int* ltri, FormattedText& out) {
  const Layout layout = layout_of(form);
  out.empty(3).skip(18).add("PSTRIPACK: triangles as of TRLIST,  N = ").integer(n, 4).end();
  if (n < 3 || n > most_listed || (nrow != 6 && nrow != 9) || nt < 1 || nt > most_listed) {
    out.empty(2).skip(11).add("N must be 3 to ").integer(most_listed, 4);
    out.add(", NT 1 to ").integer(most_listed, 4).add(", NROW 6 or 9:  N =");
    out.integer(n, 5).add(", NROW =").integer(nrow, 5).add(", NT =").integer(nt, 5).end();
    return;
  }
  int line = 3;
  const auto begin_row = [&] {
    if (line >= page_length) {
      blank(layout, layout.page_break, out);
      line = 0;
    }
    ++line;
  };

  if (const int shown = shown_coordinates(iflag); shown > 0) {
    const int margin = shown == 3 ? 8 : 16;
    out.empty(2).skip(margin).add("node");
    if (shown == 3)
      out.skip(10).add("x").skip(16).add("y").skip(16).add("z").end();
    else
      out.skip(6).add("longitude").skip(9).add("latitude").end();
    out.empty(2);
    line = 6;
    for (Int node = 1; node <= n; ++node) {
      begin_row();
      out.skip(margin).integer(node, 4);
      coordinates(nodes, node, shown, 17, out);
      out.end();
    }
  }

  if (line > page_length / 2) {
    blank(layout, layout.page_break, out);
    line = 0;
  }
  out.empty(2).add("triangle").skip(9).add("corners").skip(13).add("neighbours");
  if (nrow == 9) out.skip(14).add("arcs");
  out.end().add("   no.  ");
  for (Int row = 0; row < nrow; ++row) out.integer(row % 3 + 1, 7);
  out.end().empty(1);
  line += 5;
  for (Int t = 1; t <= nt; ++t) {
    begin_row();
    const Int* const column = ltri + (t - 1) * nrow;
    out.skip(2).integer(t, 4).skip(2);
    for (Int row = 0; row < nrow; ++row) out.integer(column[row], 7);
    out.end();
  }

  const Int boundary_nodes = std::max<Int>(2 * n - nt - 2, 0);
  const bool covered = boundary_nodes < 3;
  totals(layout, covered ? Int{0} : boundary_nodes, covered ? 3 * n - 6 : nt + n - 1, nt, out);
}

/// VORONOI_POLY_COUNT: for the Voronoi diagram from CRLIST, the numbers of cells, vertices and edges, Euler's
/// sum F + V - E - 2, which is 0, and the non-zero numbers of cells with 1, 2, ..., 19, 20 or more sides.
/// listc, lptr: 6n-12 slots. If the lists are not closed, a message instead.
template <class Int>
void count_polygons(Int n, const Int* lend, const Int* lptr, const Int* listc, FormattedText& out) {
  constexpr std::size_t many = 20;
  std::array<Int, many + 1> cells{};  // by number of sides; `many` and more in the last
  Int vertices = 0, entries = 0;
  bool closed = n >= 3;
  ListWalk<Int> walk(n, lptr);
  for (Int node = 1; closed && node <= n; ++node) {
    std::size_t sides = 0;
    closed = walk(lend[node - 1], [&](Int, Int slot) {
      vertices = std::max(vertices, listc[slot - 1]);
      ++sides;
    });
    ++cells[std::min(sides, many)];
    entries += static_cast<Int>(sides);
  }
  closed = closed && vertices <= 2 * n - 4;

  out.end().add("PSTRIPACK: Voronoi diagram").end();
  if (!closed) {
    out.add("  N < 3, or LEND, LPTR, LISTC are not those that CRLIST gives").end();
    return;
  }
  const Int edges = entries / 2;
  out.add("  faces          F = ").integer(n, 8).end();
  out.add("  vertices       V = ").integer(vertices, 8).end();
  out.add("  edges          E = ").integer(edges, 8).end();
  out.add("  F + V - E - 2    = ").integer(n + vertices - edges - 2, 8).end();
  out.end().add("   sides   cells   (20: 20 or more)").end();
  for (std::size_t sides = 0; sides <= many; ++sides)
    if (cells[sides] != 0) out.integer(sides, 8).integer(cells[sides], 8).end();
}

}  // namespace pstripack
