// In every floating-point environment every routine of a library gives the same bits, raises no signal,
// leaves the environment as it was, and accesses nothing outside its arrays.

#include "support/environment.h"

#include <gtest/gtest.h>

#include <map>
#include <ostream>
#include <thread>

#include "numerics/every_routine.h"

namespace {

struct Strange {
  const char* name;
  void (*enter)();
};
void PrintTo(const Strange& strange, std::ostream* out) { *out << strange.name; }

constexpr Strange environments[] = {{"Upward", [] { fesetround(FE_UPWARD); }},
                                    {"Downward", [] { fesetround(FE_DOWNWARD); }},
                                    {"TowardZero", [] { fesetround(FE_TOWARDZERO); }},
                                    {"FlushToZero", [] { flush_denormals(true, false); }},
                                    {"DenormalsAreZero", [] { flush_denormals(false, true); }},
                                    {"FlagsRaised", [] { feraiseexcept(FE_ALL_EXCEPT); }},
                                    {"FlagsClear", [] { feclearexcept(FE_ALL_EXCEPT); }},
                                    {"AllTraps", trap_all},
                                    {"AllAtOnce", enter_strange_environment}};

/// Runs on a new thread, since the library keeps state per thread, above all OpenMP's team.
std::uint64_t fingerprint(const NamedNodes& set, Edge edge, const CallRoutine& call_routine) {
  std::uint64_t result = 0;
  std::thread([&] { result = fingerprint_of_every_routine(set.nodes, edge, call_routine); }).join();
  return result;
}

void just_call(const char*, const std::function<void()>& call) { call(); }

/// In the usual environment, with arrays before inaccessible pages.
std::uint64_t usual_fingerprint(const NamedNodes& set) {
  static std::map<std::string, std::uint64_t> known;
  const auto [place, is_new] = known.try_emplace(set.name);
  if (is_new) place->second = fingerprint(set, Edge::end, just_call);
  return place->second;
}

class InEnvironment : public ::testing::TestWithParam<Strange> {};

TEST_P(InEnvironment, EveryRoutineGivesTheSameBitsAndLeavesItAsItWas) {
  for (const NamedNodes& set : spread_of_nodes()) {
    const auto call_inside = [&](const char* routine, const std::function<void()>& call) {
      fenv_t usual;
      fegetenv(&usual);
      GetParam().enter();
      const Environment before;
      call();
      const Environment after;
      fesetenv(&usual);
      EXPECT_TRUE(after == before) << routine << " of " << set.name << " changes the environment";
    };
    // The unusual environment first: threads inherit the environment in which they start.
    const std::uint64_t inside = fingerprint(set, Edge::end, call_inside);
    EXPECT_EQ(inside, usual_fingerprint(set)) << set.name;
  }
}

INSTANTIATE_TEST_SUITE_P(Numerics, InEnvironment, ::testing::ValuesIn(environments),
                         [](const auto& info) { return info.param.name; });

TEST(Memory, NoRoutineTouchesAnythingOutsideItsArrays) {
  for (const NamedNodes& set : spread_of_nodes())
    EXPECT_EQ(fingerprint(set, Edge::begin, just_call), usual_fingerprint(set)) << set.name;
}

}  // namespace
