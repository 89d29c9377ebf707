#include "parallel/options.h"

#include <algorithm>
#include <cstdio>
#include <cstring>

#include "geometry/environment.h"
#include "geometry/parallel_for.h"

namespace pstripack {
namespace {

PartitionKind partition_from_environment() {
  const char* const name = environment_variable("PSTRIPACK_PARTITION");
  if (name == nullptr || *name == '\0' || std::strcmp(name, "bisection") == 0)
    return PartitionKind::bisection;
  if (std::strcmp(name, "stripes") == 0) return PartitionKind::stripes;
  std::fprintf(stderr, "pstripack: PSTRIPACK_PARTITION=%s: not bisection or stripes; bisection is used\n",
               name);
  return PartitionKind::bisection;
}

}  // namespace

ParallelOptions options_from_environment(std::size_t local_nodes) {
  static const PartitionKind partition = partition_from_environment();
  ParallelOptions options;
  options.partition = partition;
  options.threads = threads_for(local_nodes);
  // Several patches a thread, so that none waits long for the slowest and a patch fits into the cache.
  constexpr std::size_t kPatch = 65536, kMost = 2;
  const auto threads = static_cast<std::size_t>(options.threads);
  const std::size_t a_thread = std::clamp<std::size_t>(local_nodes / threads / kPatch, 1, kMost);
  options.patches = options.threads > 1 ? static_cast<int>(threads * a_thread) : 1;
  return options;
}

}  // namespace pstripack
