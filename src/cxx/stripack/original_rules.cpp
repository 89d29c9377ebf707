#include "stripack/original_rules.h"

#include <cstdio>
#include <cstring>

#include "geometry/environment.h"

namespace pstripack {
namespace {

OriginalRules read_environment() {
  const char* const order = environment_variable("PSTRIPACK_ORDER");
  if (order == nullptr || *order == '\0' || std::strcmp(order, "canonical") == 0) return {};
  if (std::strcmp(order, "original") == 0) return {true};
  if (std::strcmp(order, "ngmath") == 0) return {true, 4, true, false};
  std::fprintf(
      stderr, "pstripack: PSTRIPACK_ORDER=%s: not canonical, original or ngmath; canonical is used\n", order);
  return {};
}

}  // namespace

const OriginalRules& original_rules() {
  static const OriginalRules rules = read_environment();
  return rules;
}

}  // namespace pstripack
