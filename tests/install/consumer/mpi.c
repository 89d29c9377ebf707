/* Comm mode: every rank has the same nodes and gets the lists of an octahedron. */
#include <pstripack_mpi.h>
#include <stdio.h>

int main(int argc, char** argv) {
  const double x[6] = {1, 0, 0, -1, 0, 0}, y[6] = {0, 1, 0, 0, -1, 0}, z[6] = {0, 0, 1, 0, 0, -1};
  int32_t list[24], lptr[24], lend[6], lnew = 0;
  int rank, ranks;
  MPI_Init(&argc, &argv);
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  MPI_Comm_size(MPI_COMM_WORLD, &ranks);
  if (pstripack_set_comm(MPI_COMM_WORLD) != PSTRIPACK_OK ||
      pstripack_trmesh(6, x, y, z, list, lptr, lend, &lnew) != PSTRIPACK_OK || lnew != 25)
    MPI_Abort(MPI_COMM_WORLD, 1);
  if (rank == 0) printf("mpi: %d ranks, %d slots\n", ranks, (int)lnew - 1);
  MPI_Finalize();
  return 0;
}
