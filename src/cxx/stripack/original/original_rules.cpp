#include "stripack/original/original_rules.h"

#include <atomic>
#include <cerrno>
#include <cstdio>
#include <cstring>

#include "base/environment.h"

namespace pstripack {
namespace {

constexpr struct {
  const char* name;
  OriginalRules rules;
} kOrders[] = {{"canonical", {}},
               {"original", {true, 100, false, true}},
               {"bitwise", {true, 100, false, true, true}},
               {"ngmath", {true, 4, true, false}},
               {"bitwise-ngmath", {true, 4, true, false, true}}};

OriginalRules read_environment() {
  const char* const value = environment_variable("PSTRIPACK_ORDER");
  if (value == nullptr || *value == '\0') return {};
  for (const auto& order : kOrders)
    if (std::strcmp(value, order.name) == 0) return order.rules;
  std::fprintf(
      stderr,
      "pstripack: PSTRIPACK_ORDER=%s: no such order, so canonical is used; set it to canonical, original, "
      "bitwise, ngmath or bitwise-ngmath\n",
      value);
  return {};
}

}  // namespace

const OriginalRules& original_rules() {
  static std::atomic<const OriginalRules*> known{nullptr};
  if (const OriginalRules* const rules = known.load(std::memory_order_acquire)) return *rules;
  // Waiting here for another thread may change errno: restore it.
  const int error = errno;
  static const OriginalRules rules = read_environment();
  known.store(&rules, std::memory_order_release);
  errno = error;
  return rules;
}

}  // namespace pstripack
