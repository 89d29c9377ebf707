#pragma once
// How many threads a call takes where neither OMP_NUM_THREADS nor the program says it: as many as there are
// processors that nobody else uses. Two threads on one processor are slower than one, by a time slice each
// time that they wait for each other.

namespace pstripack {

/// Why a call takes no more threads.
enum class ThreadLimit : int {
  none,    ///< it takes all processors of the affinity mask
  size,    ///< more threads would not pay for so few nodes
  asked,   ///< OMP_NUM_THREADS, omp_set_num_threads, or an option of ours
  nested,  ///< called inside a parallel region
  ranks,   ///< this rank's share of the processors
  quota,   ///< of the control group, as a container has it
  busy,    ///< other programs run, or other calls of this one
  system,  ///< a forked child, or no more threads can be started
};
const char* name_of(ThreadLimit limit);

struct ThreadCount {
  int threads;
  ThreadLimit limit;
};

/// What the system tells.
struct Processors {
  int usable;           ///< number in the affinity mask of this process
  int online;           ///< number of the machine
  int of_job;           ///< number in the affinity mask of the parent process: it has started all ranks here
  int local_ranks = 1;  ///< number of ranks that the launcher has started on this machine
  int quota = 0;        ///< processors' time that the control groups allow, in processors; 0: no limit
  int others = 0;       ///< number of threads that run or wait for a processor, besides this one
};

/// At least 1.
ThreadCount free_processors(const Processors& machine);

/// From the variables that Open MPI, MPICH, Intel MPI, MVAPICH and Slurm set for the ranks they start; 1
/// without them.
int local_ranks();
/// The least quota of the control groups, versions 1 and 2, that this process belongs to, rounded down but at
/// least 1; 0 if there is none. `root`: the folder with `proc` and `sys`, "" but in tests.
int quota_of_control_groups(const char* root);
/// Number of threads of all processes that run or wait for a processor, less those of this process. OpenMP's
/// threads spin for some ms after their work: they do not count. 0 if the system does not tell.
int threads_of_others(const char* root);
/// Number of processors in the affinity mask of the parent process; 0 if the system does not tell.
int processors_of_parent();

}  // namespace pstripack
