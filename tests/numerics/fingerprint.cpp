// Prints one line per set of nodes: a hash of all results of libstripack's routines, called in the
// floating-point environment in which this program was started, which -ffast-math changes. Two builds of
// PSTRIPACK must print the same. stderr names the environment.

#include <cinttypes>
#include <cstdio>

#include "numerics/every_routine.h"
#include "support/environment.h"

int main() {
  fenv_t at_start;
  fegetenv(&at_start);
#if defined(__SSE2__)
  std::fprintf(stderr, "started with MXCSR = %x\n", _mm_getcsr() & ~0x3fu);
#endif
  fesetenv(FE_DFL_ENV);
  const CallRoutine call_as_started = [&](const char*, const std::function<void()>& call) {
    fesetenv(&at_start);
    call();
    fesetenv(FE_DFL_ENV);
  };
  for (const NamedNodes& set : spread_of_nodes())
    std::printf("%016" PRIx64 " %s\n", fingerprint_of_every_routine(set.nodes, Edge::end, call_as_started),
                set.name.c_str());
}
