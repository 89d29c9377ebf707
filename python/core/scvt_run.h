#pragma once

#include <cstdint>

#include "arrays.h"

namespace bindings {

/// Runs pstripack_scvt. `start`: the number of generators, or an array of generators. `density`: a function
/// of an array (m, 3), or None. `progress`: a function of (generators, evaluations, gradient, energy), or
/// None; true ends the run. `widths`: `density` returns widths of cells. Returns (code, message, generators,
/// energy, gradient, evaluations, reason); the last five are valid only if code is 0. Exceptions of the
/// procedures and keyboard interrupts are passed on.
py::tuple scvt(const py::object& start, const py::object& density, double tolerance, bool lloyd,
               std::int64_t most_evaluations, std::int64_t seed, const py::object& progress, bool widths,
               bool well_centred, int threads);

/// Runs pstripack_scvt_cells for `width`, a function of an array (m, 3). Returns (code, message, cells).
py::tuple scvt_cells(const py::object& width, double radius);

}  // namespace bindings
