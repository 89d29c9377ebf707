/* Triangulates 1000 nodes on the unit sphere and adds up the areas of the triangles.
 *
 * $ cc mesh.c -o mesh $(pkg-config --cflags --libs pstripack) -lm
 * $ ./mesh
 */
#include <math.h>
#include <pstripack.h>
#include <stdio.h>
#include <stdlib.h>

enum { N = 1000 };
static double x[N], y[N], z[N];
static int32_t list[6 * N - 12], lptr[6 * N - 12], lend[N], lnew;

/* Area of the triangle of nodes i, j, k, numbered from 1 (Van Oosterom and Strackee). */
static double area_of(int32_t i, int32_t j, int32_t k) {
  const double a[] = {x[i - 1], y[i - 1], z[i - 1]};
  const double b[] = {x[j - 1], y[j - 1], z[j - 1]};
  const double c[] = {x[k - 1], y[k - 1], z[k - 1]};
  const double det = a[0] * (b[1] * c[2] - b[2] * c[1]) + a[1] * (b[2] * c[0] - b[0] * c[2]) +
                     a[2] * (b[0] * c[1] - b[1] * c[0]);
  double sum = 1;
  for (int d = 0; d < 3; ++d) sum += a[d] * b[d] + b[d] * c[d] + c[d] * a[d];
  return 2 * atan2(det, sum);
}

int main(void) {
  /* A spiral from pole to pole, a golden angle from node to node. */
  for (int k = 0; k < N; ++k) {
    const double longitude = k * acos(-1) * (3 - sqrt(5));
    z[k] = 1 - (2 * k + 1.0) / N;
    x[k] = sqrt(1 - z[k] * z[k]) * cos(longitude);
    y[k] = sqrt(1 - z[k] * z[k]) * sin(longitude);
  }

  const int32_t ier = pstripack_trmesh(N, x, y, z, list, lptr, lend, &lnew);
  if (ier != PSTRIPACK_OK) {
    fprintf(stderr, "%s\n", pstripack_strerror(ier));
    return EXIT_FAILURE;
  }

  /* Node k and two consecutive neighbours form a triangle. Count it only at its smallest corner. (If the
   * nodes lie in a hemisphere, the last neighbour of a boundary node is negative and forms no triangle with
   * the first.) */
  int triangles = 0;
  double area = 0;
  for (int32_t k = 1; k <= N; ++k) {
    int32_t slot = lend[k - 1];
    do {
      const int32_t neighbour = list[slot - 1];
      slot = lptr[slot - 1];
      const int32_t next = abs(list[slot - 1]);
      if (neighbour > k && next > k) {
        ++triangles;
        area += area_of(k, neighbour, next);
      }
    } while (slot != lend[k - 1]);
  }
  printf("%d nodes, %d triangles, area %.6f\n", N, triangles, area);
  return EXIT_SUCCESS;
}
