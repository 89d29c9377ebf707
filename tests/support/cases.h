#pragma once
// Number of random cases of a test. PSTRIPACK_CASES multiplies it: more for a long run by hand, fewer if the
// tests run for every mutant (tests/mutation). Not set, it is the SHARE of add_cases (tests/CMakeLists.txt).

#include <cmath>
#include <cstdlib>

#ifndef SHARE_OF_CASES
#define SHARE_OF_CASES 1
#endif

static inline int cases(double usual) {
  const char* const factor = std::getenv("PSTRIPACK_CASES");
  return static_cast<int>(std::ceil(usual * (factor == nullptr ? SHARE_OF_CASES : std::atof(factor))));
}
