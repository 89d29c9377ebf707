/* The C API: an octahedron has eight triangles. */
#include <pstripack.h>
#include <stdio.h>

int main(void) {
  const double x[6] = {1, 0, 0, -1, 0, 0}, y[6] = {0, 1, 0, 0, -1, 0}, z[6] = {0, 0, 1, 0, 0, -1};
  int32_t list[24], lptr[24], lend[6], lnew = 0;
  char message[200];
  const int32_t ier = pstripack_trmesh(6, x, y, z, list, lptr, lend, &lnew);
  if (ier != PSTRIPACK_OK || lnew != 25 ||
      pstripack_validate(6, x, y, z, list, lptr, lend, lnew, message, sizeof message) != 0) {
    fprintf(stderr, "pstripack %s: %s\n", pstripack_version(), pstripack_strerror(ier));
    return 1;
  }
  printf("c_api: pstripack %s, %d slots\n", pstripack_version(), (int)lnew - 1);
  return 0;
}
