#include "parallel/environment_options.h"

#include <cstdio>
#include <cstring>

#include "base/environment.h"
#include "base/parallel_for.h"

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

bool warm_start_is_allowed() {
  return read_once([] {
    const char* const value = environment_variable("PSTRIPACK_WARM_START");
    if (value == nullptr || *value == '\0' || std::strcmp(value, "1") == 0) return true;
    if (std::strcmp(value, "0") == 0) return false;
    std::fprintf(stderr, "pstripack: PSTRIPACK_WARM_START=%s: not 0 or 1; 1 is used\n", value);
    return true;
  });
}

ParallelOptions options_from_environment(std::size_t local_nodes) {
  ParallelOptions options;
  options.partition = read_once([] { return partition_from_environment(); });
  // Two patches pay from 30,000 nodes on, with other work between the calls: 15,000 nodes are worth a thread,
  // where thread_count() takes 10,000 items. pstripack-benchmark --only threads shows it.
  const ThreadCount count = thread_count(2 * local_nodes / 3);
  options.threads = options.patches = count.threads;
  options.thread_limit = count.limit;
  return options;
}

}  // namespace pstripack
