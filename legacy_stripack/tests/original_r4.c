/* The original behind REAL*4 arguments. */
#include <dlfcn.h>
#include <stdlib.h>

typedef void trmesh_r8(const int*, const double*, const double*, const double*, int*, int*, int*, int*, int*,
                       int*, double*, int*);

typedef void crlist_r8(const int*, const int*, const double*, const double*, const double*, const int*,
                       const int*, int*, int*, int*, int*, int*, double*, double*, double*, double*, int*);

static void* routine(const char* name) { return dlsym(dlopen(ORIGINAL_FILE, RTLD_NOW | RTLD_LOCAL), name); }

static double* widened(const float* values, int n) {
  double* wide = malloc(sizeof(double) * (size_t)n);
  for (int i = 0; i < n; ++i) wide[i] = values[i];
  return wide;
}

#pragma GCC visibility push(default)

void trmesh_(const int* n, const float* x, const float* y, const float* z, int* list, int* lptr, int* lend,
             int* lnew, int* near, int* next, float* dist, int* ier) {
  trmesh_r8* original = (trmesh_r8*)routine("trmesh_");
  double *x8 = widened(x, *n), *y8 = widened(y, *n), *z8 = widened(z, *n), *dist8 = widened(dist, *n);
  original(n, x8, y8, z8, list, lptr, lend, lnew, near, next, dist8, ier);
  free(x8), free(y8), free(z8), free(dist8);
}

void crlist_(const int* n, const int* ncol, const float* x, const float* y, const float* z, const int* list,
             const int* lend, int* lptr, int* lnew, int* ltri, int* listc, int* nb, float* xc, float* yc,
             float* zc, float* rc, int* ier) {
  const int centres = 2 * *n - 4;
  double *x8 = widened(x, *n), *y8 = widened(y, *n), *z8 = widened(z, *n);
  double* c8 = malloc(4 * sizeof(double) * (size_t)centres);
  ((crlist_r8*)routine("crlist_"))(n, ncol, x8, y8, z8, list, lend, lptr, lnew, ltri, listc, nb, c8,
                                   c8 + centres, c8 + 2 * centres, c8 + 3 * centres, ier);
  for (int i = 0; i < centres; ++i) {
    xc[i] = (float)c8[i];
    yc[i] = (float)c8[centres + i];
    zc[i] = (float)c8[2 * centres + i];
    rc[i] = (float)c8[3 * centres + i];
  }
  free(x8), free(y8), free(z8), free(c8);
}
