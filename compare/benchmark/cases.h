#pragma once
// The benchmark's standard cases: one row per case, with measured and required ratios.

#include <optional>
#include <string>
#include <vector>

#include "original.h"

namespace benchmark {

struct CaseSettings {
  bool quick = false;
  std::vector<std::string> only;  ///< none: all of case_names() except distributions, queries, scvt and
                                  ///< warm-start; with `quick` only the quick cases
  std::vector<std::string> sets;  ///< point sets of the case distributions; none: all
  int repeats = 0;
};

std::vector<std::string> case_names();

/// Writes the table to stdout. `self`: path of this program.
void run_cases(const std::string& self, const CaseSettings& settings,
               const std::optional<legacy_stripack::Original>& original_library);

}  // namespace benchmark
