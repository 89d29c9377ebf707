/* The original behind the 8-argument TRMESH; the other routines as they are. */
#include <dlfcn.h>
#include <stdlib.h>

typedef void trmesh_12(const int*, const double*, const double*, const double*, int*, int*, int*, int*, int*,
                       int*, double*, int*);

typedef void trlist(const int*, const int*, const int*, const int*, const int*, int*, int*, int*);
typedef void crlist(const int*, const int*, const double*, const double*, const double*, const int*,
                    const int*, int*, int*, int*, int*, int*, double*, double*, double*, double*, int*);

static void* routine(const char* name) { return dlsym(dlopen(ORIGINAL_FILE, RTLD_NOW | RTLD_LOCAL), name); }

#pragma GCC visibility push(default)

void trmesh_(const int* n, const double* x, const double* y, const double* z, int* list, int* lptr, int* lend,
             int* ier) {
  trmesh_12* original = (trmesh_12*)routine("trmesh_");
  int lnew;
  int* work = malloc(2 * sizeof(int) * (size_t)*n);
  double* dist = malloc(sizeof(double) * (size_t)*n);
  original(n, x, y, z, list, lptr, lend, &lnew, work, work + *n, dist, ier);
  free(work), free(dist);
}

void trlist_(const int* n, const int* list, const int* lptr, const int* lend, const int* nrow, int* nt,
             int* ltri, int* ier) {
  ((trlist*)routine("trlist_"))(n, list, lptr, lend, nrow, nt, ltri, ier);
}

void crlist_(const int* n, const int* ncol, const double* x, const double* y, const double* z,
             const int* list, const int* lend, int* lptr, int* lnew, int* ltri, int* listc, int* nb,
             double* xc, double* yc, double* zc, double* rc, int* ier) {
  ((crlist*)routine("crlist_"))(n, ncol, x, y, z, list, lend, lptr, lnew, ltri, listc, nb, xc, yc, zc, rc,
                                ier);
}
