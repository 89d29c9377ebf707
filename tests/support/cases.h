#pragma once
// Number of random cases of a test. PSTRIPACK_CASES multiplies the default: more for a long run by hand,
// fewer if the tests run for every mutant (tests/mutation).

#include <cmath>
#include <cstdlib>

inline int cases(double usual) {
  const char* const factor = std::getenv("PSTRIPACK_CASES");
  return static_cast<int>(std::ceil(factor == nullptr ? usual : usual * std::atof(factor)));
}
