#pragma once
// A comparison for people.

#include <vector>

#include "comparison.h"

namespace comparison {

/// The table, the differences that the result describes, and the verdict; to stdout.
void print(const Result& result, const std::vector<pstripack::Point>& points, double timeout);

/// The part that describes each difference, and what counts against us.
void print_decisions(const Result& result, const std::vector<pstripack::Point>& points);

}  // namespace comparison
