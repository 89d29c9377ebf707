#pragma once

#include <cstdint>

#include "arrays.h"

namespace bindings {

/// pstripack_scvt: `start` generators, or as many as it has rows to start from. `density`: of an array (m,
/// 3), or None; `progress`: of (generators, evaluations, gradient, energy), or None; true ends the run.
/// Returns (code, message, generators, energy, gradient, evaluations, reason), of which all after the message
/// hold only for code 0. What the procedures raise comes out, and so does an interrupt from the keyboard.
py::tuple scvt(const py::object& start, const py::object& density, double tolerance, bool lloyd,
               std::int64_t most_evaluations, std::int64_t seed, const py::object& progress, int threads);

}  // namespace bindings
