/* Calls routines of STRIPACK from C or C++ by the header of any library, also one that prints by the Fortran run-time
 * library. */
#include <math.h>
#include <stdio.h>
#include <stripack.h>

int main(void) {
  const stripack_integer n = 6, iflag = 1, lout = 6;
  const stripack_real x[] = {1, 0, 0, -1, 0, 0}, y[] = {0, 1, 0, 0, -1, 0}, z[] = {0, 0, 1, 0, 0, -1};
  const stripack_real a[] = {1, 0, 0}, b[] = {0, 1, 0}, c[] = {0, 0, 1};
  stripack_integer list[24], lptr[24], lend[6], lnew, near[6], next[6], ier;
  stripack_real dist[6];
  trmesh_(&n, x, y, z, list, lptr, lend, &lnew, near, next, dist, &ier);
  if (ier != 0 || lnew != 25) return 1;
  if (fabs(areas_(a, b, c) - 1.5707963) > 1e-6 || !left_(a, a + 1, a + 2, b, b + 1, b + 2, c, c + 1, c + 2)) return 2;
  trprnt_(&n, x, y, z, &iflag, list, lptr, lend, &lout);
  printf("legacy: %d triangles\n", (int)(lnew - 1) / 3);
  return 0;
}
