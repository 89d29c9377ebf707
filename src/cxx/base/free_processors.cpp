#include "base/free_processors.h"

#include <dirent.h>
#include <limits.h>
#include <unistd.h>

#include <algorithm>
#include <cstdio>
#include <cstdlib>
#include <cstring>

#include "base/control_groups.h"
#include "base/environment.h"
#include "base/system.h"
#if defined(PSTRIPACK_LINUX)
#include <sched.h>
#endif

namespace pstripack {
namespace {

int positive_variable(const char* name) {
  const char* const value = environment_variable(name);
  return value == nullptr ? 0 : std::max(0, std::atoi(value));
}

#if defined(PSTRIPACK_LINUX)
/// The smaller quota; 0 is none.
int smaller(int a, int b) { return a == 0 || (b != 0 && b < a) ? b : a; }

/// "200000 100000": microseconds in each period. Without a limit "max" (version 2) or -1 (version 1).
int quota_in(const char* quota, const char* period) {
  const double allowed = std::atof(quota), of = std::atof(period);
  return allowed > 0 && of > 0 ? std::max(1, static_cast<int>(std::min(allowed / of, 1e6))) : 0;
}

/// Number of threads of this process that run or wait for a processor.
int own_running_threads(const char* root) {
  char path[PATH_MAX];
  std::snprintf(path, sizeof path, "%s/proc/self/task", root);
  DIR* const tasks = opendir(path);
  if (tasks == nullptr) return 1;
  int running = 0;
  while (const dirent* const task = readdir(tasks)) {
    if (task->d_name[0] == '.') continue;
    char name[sizeof task->d_name + 8];
    std::snprintf(name, sizeof name, "%s/stat", task->d_name);
    const FileText stat(root, "/proc/self/task", name);
    const char* const end_of_name = std::strrchr(stat.get(), ')');  // "17 (a name) R ..."
    running += end_of_name != nullptr && std::strncmp(end_of_name, ") R", 3) == 0;
  }
  closedir(tasks);
  return std::max(1, running);
}
#endif

}  // namespace

const char* name_of(ThreadLimit limit) {
  constexpr const char* kName[] = {"none", "size", "asked", "nested", "ranks", "quota", "busy", "system"};
  return kName[static_cast<int>(limit)];
}

ThreadCount free_processors(const Processors& machine) {
  ThreadCount result{std::max(1, machine.usable), ThreadLimit::none};
  const auto limit_to = [&](int most, ThreadLimit limit) {
    if (std::max(1, most) < result.threads) result = {std::max(1, most), limit};
  };
  int of_job = std::max(machine.of_job, machine.usable);
  if (machine.quota > 0) {
    limit_to(machine.quota, ThreadLimit::quota);
    of_job = std::min(of_job, machine.quota);
  }
  if (machine.local_ranks > 1) limit_to(of_job / machine.local_ranks, ThreadLimit::ranks);
  limit_to(machine.online - machine.others, ThreadLimit::busy);
  return result;
}

int local_ranks() {
  for (const char* const name :
       {"OMPI_COMM_WORLD_LOCAL_SIZE", "MPI_LOCALNRANKS", "PMI_LOCAL_SIZE", "MV2_COMM_WORLD_LOCAL_SIZE"})
    if (const int ranks = positive_variable(name); ranks > 0) return ranks;
  // srun sets these for what it starts; sbatch does not for the script, whose programs are no ranks.
  const int tasks = positive_variable("SLURM_STEP_NUM_TASKS");
  const int nodes = positive_variable("SLURM_STEP_NUM_NODES");
  return tasks > 0 && nodes > 0 ? (tasks + nodes - 1) / nodes : 1;
}

#if defined(PSTRIPACK_LINUX)
int quota_of_control_groups(const char* root) {
  int least = 0;
  for_each_control_group(root, "cpu", [&](const char* folder, bool is_version_2) {
    if (is_version_2) {
      const FileText both(root, folder, "cpu.max");
      const char* const space = std::strchr(both.get(), ' ');
      least = smaller(least, space == nullptr ? 0 : quota_in(both.get(), space));
    } else {
      const FileText quota(root, folder, "cpu.cfs_quota_us"), period(root, folder, "cpu.cfs_period_us");
      least = smaller(least, quota_in(quota.get(), period.get()));
    }
  });
  return least;
}

int threads_of_others(const char* root) {
  // In this order: an own thread that falls asleep in between is not taken for another's.
  const int own = own_running_threads(root);
  const FileText load(root, "/proc", "loadavg");  // "0.20 0.18 0.12 1/80 11206": of 80 threads 1 is running
  const char* at = load.get();
  for (int word = 0; word < 3 && at != nullptr; ++word) at = std::strchr(at + (word > 0), ' ');
  return at == nullptr ? 0 : std::max(0, std::atoi(at) - own);
}

int processors_of_parent() {
  cpu_set_t set;
  return sched_getaffinity(getppid(), sizeof set, &set) == 0 ? CPU_COUNT(&set) : 0;
}
#else
int quota_of_control_groups(const char*) { return 0; }
int threads_of_others(const char*) { return 0; }
int processors_of_parent() { return 0; }
#endif

}  // namespace pstripack
