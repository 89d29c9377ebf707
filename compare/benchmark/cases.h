#pragma once
// The cases that the project measures itself by: one table, a row a case, ratios beside those asked for.

#include <optional>
#include <string>
#include <vector>

#include "original.h"

namespace benchmark {

struct CaseSettings {
  bool quick = false;
  std::vector<std::string>
      only;  ///< none: all of case_names() but distributions, queries and warm-start, or those that are quick
  std::vector<std::string> sets;  ///< of distributions; none: all
  int repeats = 0;
};

std::vector<std::string> case_names();

/// Writes to stdout. `self`: this program.
void run_cases(const std::string& self, const CaseSettings& settings,
               const std::optional<legacy_stripack::Original>& original_library);

}  // namespace benchmark
