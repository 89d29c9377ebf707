#pragma once
// Prints a comparison.

#include <vector>

#include "comparison.h"

namespace comparison {

/// Prints the table, the described differences and the verdict to stdout.
void print(const Result& result, const std::vector<pstripack::Point>& points, double timeout);

/// Prints the described differences and what counts against us.
void print_decisions(const Result& result, const std::vector<pstripack::Point>& points);

}  // namespace comparison
