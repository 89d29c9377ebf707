#pragma once
// The benchmark's standard cases: one row per case, with the ratios of the others' times to ours.

#include <optional>
#include <string>
#include <vector>

#include "original.h"

namespace benchmark {

struct CaseSettings {
  std::vector<std::string> only;  ///< none: all cases with a row in the standard table
  std::vector<std::string> sets;  ///< point sets of the case distributions; none: all
  int repeats = 7;
};

std::vector<std::string> case_names();

/// Writes the tables to stdout. `self`: path of this program.
void run_cases(const std::string& self, const CaseSettings& settings,
               const std::optional<legacy_stripack::Original>& original_library);

}  // namespace benchmark
