#pragma once
// The benchmark's standard cases: one table, one row per case, ratios beside the required ones.

#include <optional>
#include <string>
#include <vector>

#include "original.h"

namespace benchmark {

struct CaseSettings {
  bool quick = false;
  std::vector<std::string> only;  ///< none: all of case_names() except distributions, queries, scvt and
                                  ///< warm-start, or the quick ones
  std::vector<std::string> sets;  ///< of distributions; none: all
  int repeats = 0;
};

std::vector<std::string> case_names();

/// Writes to stdout. `self`: this program.
void run_cases(const std::string& self, const CaseSettings& settings,
               const std::optional<legacy_stripack::Original>& original_library);

}  // namespace benchmark
