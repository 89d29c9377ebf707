/* Calls routines of STRIPACK from C, also one that prints by the Fortran run-time library. */
#include <stdio.h>

void trmesh_(const int* n, const double* x, const double* y, const double* z, int* list, int* lptr, int* lend, int* lnew,
             int* near, int* next, double* dist, int* ier);
void trprnt_(const int* n, const double* x, const double* y, const double* z, const int* iflag, const int* list,
             const int* lptr, const int* lend, const int* lout);

int main(void) {
  const int n = 6, iflag = 1, lout = 6;
  const double x[] = {1, 0, 0, -1, 0, 0}, y[] = {0, 1, 0, 0, -1, 0}, z[] = {0, 0, 1, 0, 0, -1};
  int list[24], lptr[24], lend[6], lnew, near[6], next[6], ier;
  double dist[6];
  trmesh_(&n, x, y, z, list, lptr, lend, &lnew, near, next, dist, &ier);
  if (ier != 0 || lnew != 25) return 1;
  trprnt_(&n, x, y, z, &iflag, list, lptr, lend, &lout);
  printf("legacy: %d triangles\n", (lnew - 1) / 3);
  return 0;
}
