/* A trmesh_ that hangs, crashes or stops the program where N > 3; for N = 3 it returns IER = 42. */
#include <signal.h>
#include <stdlib.h>

__attribute__((visibility("default"))) void trmesh_(const int* n, const double* x, const double* y,
                                                    const double* z, int* list, int* lptr, int* lend,
                                                    int* lnew, int* near, int* next, double* dist, int* ier) {
  (void)x, (void)y, (void)z, (void)list, (void)lptr, (void)lend, (void)near, (void)next, (void)dist;
  *ier = 42;
  *lnew = 1;
  if (*n == 3) return;
#if defined(ORIGINAL_hangs)
  for (volatile int turn = 0;;) turn = 1; /* computes for ever, as the original does */
#elif defined(ORIGINAL_crashes)
  raise(SIGSEGV);
#else
  exit(0); /* as the F90 text does on errors: STOP with status 0 */
#endif
}
