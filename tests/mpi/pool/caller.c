/* A serial program that uses processes, threads and libraries around its calls.
 *
 *   caller calls N COUNT      COUNT calls, "call I" on stdout before each; seconds of the fastest on stderr
 *   caller pause N SECONDS    one call, "pid PID", sleeps, one call, "done"
 *   caller fork               a child calls, then the parent, then a child again
 *   caller threads            calls from threads at once, and from inside a parallel region
 *   caller codes N1 N2        IER of a call with N1 nodes, then with N2
 *   caller save               "waiting"; from SIGTERM, SIGINT, SIGHUP, SIGQUIT on two seconds, "saved", exit code 5
 *   caller dlopen LIBRARY     loads libpstripack, calls, unloads
 *   caller mpi                MPI_Init, call, MPI_Finalize, call (USE_MPI)
 *   caller kill SIGNAL        one call, then the signal
 *
 * Every result is validated, but only the first of many calls. At the end it prints "pool" if any call of this
 * process went to the pool, else "no pool", and "MPI" if MPI's library is loaded. */
#include <dlfcn.h>
#include <math.h>
#include <omp.h>
#include <pthread.h>
#include <signal.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/wait.h>
#include <time.h>
#include <unistd.h>
#ifdef USE_MPI
#include <mpi.h>
#endif

#include "pstripack.h"

int pool_was_used(void);

typedef int32_t trmesh_function(int32_t, const double*, const double*, const double*, int32_t*, int32_t*,
                                int32_t*, int32_t*);
static trmesh_function* trmesh = pstripack_trmesh;

static double seconds(void) {
  struct timespec t;
  clock_gettime(CLOCK_MONOTONIC, &t);
  return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

/* The code of one call with n nodes on a spiral; 99 if the lists are wrong. *time: of the call. */
static int call_and(int check, int n, double* time) {
  double* const xyz = malloc(3 * sizeof(double) * (size_t)n);
  const size_t slots = 6 * (size_t)n - 12;
  int32_t* const lists = malloc(4 * (2 * slots + (size_t)n));
  int32_t lnew = 0;
  int ier, k;
  char why[200];
  if (xyz == NULL || lists == NULL) exit(98);
  for (k = 0; k < n; ++k) {
    const double h = 1 - (2.0 * k + 1) / n, r = sqrt(1 - h * h);
    xyz[k] = r * cos(2.399963229728653 * k), xyz[n + k] = r * sin(2.399963229728653 * k), xyz[2 * n + k] = h;
  }
  const double start = seconds();
  ier = trmesh(n, xyz, xyz + n, xyz + 2 * n, lists, lists + slots, lists + 2 * slots, &lnew);
  if (time != NULL) *time = seconds() - start;
  if (check && ier == 0 &&
      pstripack_validate(n, xyz, xyz + n, xyz + 2 * n, lists, lists + slots, lists + 2 * slots, lnew, why,
                         200) != 0)
    ier = 99;
  free(xyz);
  free(lists);
  return ier;
}

static int call(int n, double* time) { return call_and(1, n, time); }

static void expect(int ok, const char* what) {
  if (ok) return;
  printf("caller: wrong: %s\n", what);
  fflush(stdout);
  exit(97);
}

static void* call_in_thread(void* n) {
  expect(call(*(int*)n, NULL) == 0, "a call in a thread");
  return NULL;
}

static void call_in_child(int n) {
  int status = -1;
  fflush(stdout);
  const pid_t child = fork();
  if (child == 0) _exit(call(n, NULL) == 0 ? 0 : 1);
  waitpid(child, &status, 0);
  expect(status == 0, "a call in a forked child");
}

static volatile sig_atomic_t signals = 0;
static void note(int signal) {
  (void)signal;
  ++signals;
}

static int mpi_is_loaded(void) {
  char line[4096];
  int loaded = 0;
  FILE* const maps = fopen("/proc/self/maps", "r");
  while (maps != NULL && fgets(line, sizeof line, maps) != NULL) loaded |= strstr(line, "/libmpi.so") != NULL || strstr(line, "/libmpich.so") != NULL;
  if (maps != NULL) fclose(maps);
  return loaded;
}

int main(int argc, char** argv) {
  const char* const action = argc > 1 ? argv[1] : "";
  const int first = argc > 2 ? atoi(argv[2]) : 0, second = argc > 3 ? atoi(argv[3]) : 0;
  int i, n = 5000;
  if (strcmp(action, "calls") == 0) {
    double best = 1e9, time = 0;
    for (i = 1; i <= second; ++i) {
      printf("call %d\n", i);
      fflush(stdout);
      expect(call_and(i == 1, first, &time) == 0, "a call");
      if (time < best) best = time;
    }
    fprintf(stderr, "seconds %.6f\n", best);
  } else if (strcmp(action, "pause") == 0) {
    expect(call(first, NULL) == 0, "the first call");
    printf("pid %d\n", (int)getpid());
    fflush(stdout);
    usleep((useconds_t)(1000000 * second));
    expect(call(first, NULL) == 0, "the second call");
    printf("done\n");
  } else if (strcmp(action, "fork") == 0) {
    call_in_child(n);
    expect(call(n, NULL) == 0, "a call");
    call_in_child(n);
    expect(call(n, NULL) == 0, "a call after the child's");
  } else if (strcmp(action, "threads") == 0) {
    pthread_t threads[8];
    for (i = 0; i < 8; ++i) pthread_create(&threads[i], NULL, call_in_thread, &n);
    for (i = 0; i < 8; ++i) pthread_join(threads[i], NULL);
#pragma omp parallel for num_threads(4)
    for (i = 0; i < 8; ++i) call_in_thread(&n);
    expect(call(n, NULL) == 0, "a call of the main thread");
  } else if (strcmp(action, "codes") == 0) {
    printf("codes %d", call(first, NULL));
    printf(" %d\n", call(second, NULL));
  } else if (strcmp(action, "save") == 0) {
    const int ends[] = {SIGTERM, SIGINT, SIGHUP, SIGQUIT};
    for (i = 0; i < 4; ++i) signal(ends[i], note);
    expect(call(n, NULL) == 0, "a call");
    printf("waiting\n");
    fflush(stdout);
    while (signals == 0) usleep(10000);
    for (i = 0; i < 200; ++i) usleep(10000);
    expect(call(n, NULL) == 0, "a call");
    printf("saved, %d signal%s\n", (int)signals, signals == 1 ? "" : "s");
    return 5;
  } else if (strcmp(action, "dlopen") == 0) {
    for (i = 0; i < 3; ++i) {
      void* const library = dlopen(argv[2], RTLD_NOW | RTLD_LOCAL);
      expect(library != NULL, "dlopen");
      *(void**)&trmesh = dlsym(library, "pstripack_trmesh");
      expect(call(n, NULL) == 0, "a call");
      trmesh = pstripack_trmesh;
      expect(dlclose(library) == 0, "dlclose");
    }
#ifdef USE_MPI
  } else if (strcmp(action, "mpi") == 0) {
    int size = 0;
    MPI_Init(&argc, &argv);
    MPI_Comm_size(MPI_COMM_WORLD, &size);
    expect(call(n, NULL) == 0, "a call with MPI");
    MPI_Finalize();
    expect(call(n, NULL) == 0, "a call after MPI_Finalize");
    printf("size %d\n", size);
#endif
  } else if (strcmp(action, "kill") == 0) {
    expect(call(n, NULL) == 0, "a call");
    raise(first);
  }
  printf("%s%s\n", pool_was_used() ? "pool" : "no pool", mpi_is_loaded() ? " MPI" : "");
  return 0;
}
