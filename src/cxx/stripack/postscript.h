#pragma once
// TRPLOT, VRPLOT: a triangulation or a Voronoi diagram as an Encapsulated PostScript picture, seen from far
// away. For Real = float, double and Int = int32_t, int64_t.

#include <string_view>

#include "capi/pstripack.h"
#include "lists/adjacency_lists.h"
#include "stripack/expressions.h"
#include "stripack/formatted_text.h"

namespace pstripack {

/// IER of TRPLOT and VRPLOT, except 3, output errors. The text is a picture only if the result is `done`.
enum class PlotStatus {
  done = 0,
  bad_size = 1,  ///< lun not in 0..99, plot_size not in 1..8.5, n < 3, VRPLOT: nt not 2n-4
  bad_view = 2,  ///< |latitude| > 90, |longitude| > 180, angle not in (0,90] or too small to draw
  bad_node = PSTRIPACK_BAD_COORDINATE,  ///< a point is not finite, or its length is not within 0.001..1000
  broken_lists =
      PSTRIPACK_BAD_LISTS,  ///< not the lists of a triangulation or Voronoi diagram, as far as they are read
};

/// The view and its size. Lengths on paper in inches, angles in degrees.
template <class Real, class Int>
struct PlotFrame {
  Int lun;                   ///< Fortran unit; used only to check its range
  Real plot_size;            ///< side of the bounding box
  Real latitude, longitude;  ///< the centre of the window, in the middle of the picture
  Real angle;                ///< from the centre of the window to its rim
  std::string_view title;    ///< a PostScript string, (...); 80 characters at most are shown
  bool numbers;              ///< show the numbers of the nodes
};

/// TRPLOT: the arcs with at least one end in the window, as straight lines, cut at the horizon and the rim.
template <class Real, class Int>
PlotStatus plot_triangulation(const PlotFrame<Real, Int>& frame, const ListsView<Int>& lists,
                              const Nodes<Real>& nodes, FormattedText& out);

/// VRPLOT: the edges of the Voronoi cells with at least one end in the window, likewise. listc, lptr, lend,
/// vertices: as CRLIST gives them, nt vertices.
template <class Real, class Int>
PlotStatus plot_voronoi(const PlotFrame<Real, Int>& frame, Int n, const Nodes<Real>& nodes, Int nt,
                        const Int* listc, const Int* lptr, const Int* lend, const Nodes<Real>& vertices,
                        FormattedText& out);

}  // namespace pstripack
