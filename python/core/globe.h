#pragma once

#include <string>

#include "arrays.h"

namespace bindings {

/// The page of a globe whose cells have the colours of `values`, which readers see if `shows_values`.
/// `coasts`: a shapefile; "yes": Natural Earth's; empty: no coast lines. Throws std::runtime_error if the
/// file is missing.
py::str globe(const std::string& title, const Array<double>& lon, const Array<double>& lat,
              const Array<std::int32_t>& simplices, const Array<double>& values, const std::string& name,
              const std::string& unit, bool shows_values, const std::string& coasts);

}  // namespace bindings
