/* sched_yield for tests, by LD_PRELOAD: Open MPI's waiting ranks call it without pause and take turns with the ranks
 * that they wait for. Every eighth call of a thread sleeps instead. */
#define _GNU_SOURCE
#include <sched.h>
#include <sys/syscall.h>
#include <time.h>
#include <unistd.h>

int sched_yield(void) {
  static __thread unsigned calls;
  const struct timespec nap = {0, 20000};
  return ++calls % 8 == 0 ? nanosleep(&nap, NULL) : (int)syscall(SYS_sched_yield);
}
