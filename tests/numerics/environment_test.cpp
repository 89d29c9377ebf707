// Every routine of a library in every floating-point environment: the same bits, no signal, and the
// environment as it was; and nothing outside its arrays is touched.

#include "support/environment.h"

#include <gtest/gtest.h>

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

/// On a thread of its own: what the library keeps for a thread, OpenMP's team above all, begins with it.
std::uint64_t fingerprint(const NamedNodes& set, Edge edge, const CallRoutine& call_routine) {
  std::uint64_t result = 0;
  std::thread([&] { result = fingerprint_of_every_routine(set.nodes, edge, call_routine); }).join();
  return result;
}

void just_call(const char*, const std::function<void()>& call) { call(); }

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
    // The strange one first: the threads that it starts inherit its environment.
    const std::uint64_t inside = fingerprint(set, Edge::end, call_inside);
    EXPECT_EQ(inside, fingerprint(set, Edge::end, just_call)) << set.name;
  }
}

INSTANTIATE_TEST_SUITE_P(Numerics, InEnvironment, ::testing::ValuesIn(environments),
                         [](const auto& info) { return info.param.name; });

TEST(Memory, NoRoutineTouchesAnythingOutsideItsArrays) {
  for (const NamedNodes& set : spread_of_nodes())
    EXPECT_EQ(fingerprint(set, Edge::begin, just_call), fingerprint(set, Edge::end, just_call)) << set.name;
}

}  // namespace
