#pragma once
// Time per node over N, for all contenders and orders of the nodes.

#include <optional>
#include <string>
#include <vector>

#include "original.h"

namespace benchmark {

struct CurveSettings {
  std::string points = "random";
  std::vector<std::string> orders{"given", "sorted", "rows"};
  std::vector<int> sizes{100, 1000, 10000, 100000, 1000000, 10000000};
  std::vector<std::string> contenders;  ///< none: all of contender_names()
  double time_limit = 60;               ///< limit of one measurement in seconds
  int repeats = 7;
};

const std::vector<std::string>& contender_names();

/// Writes one table per order to stdout. `self`: path of this program.
void run_curves(const std::string& self, const CurveSettings& settings,
                const std::optional<legacy_stripack::Original>& original_library);

}  // namespace benchmark
