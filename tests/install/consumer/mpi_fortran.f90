! Comm mode: every rank has the same nodes and gets the lists of an octahedron.
program mpi_fortran
  use mpi
  use stripack
  use pstripack_mpi, only: pstripack_set_comm
  implicit none
  integer, parameter :: n = 6
  real(8) :: x(n) = [1, 0, 0, -1, 0, 0], y(n) = [0, 1, 0, 0, -1, 0], z(n) = [0, 0, 1, 0, 0, -1], dist(n)
  integer :: list(6*n - 12), lptr(6*n - 12), lend(n), lnew, near(n), next(n), rank, ranks, ier
  call MPI_Init(ier)
  call MPI_Comm_rank(MPI_COMM_WORLD, rank, ier)
  call MPI_Comm_size(MPI_COMM_WORLD, ranks, ier)
  call pstripack_set_comm(MPI_COMM_WORLD)
  call trmesh(n, x, y, z, list, lptr, lend, lnew, near, next, dist, ier)
  if (ier /= 0 .or. lnew /= 25) error stop 'TRMESH'
  if (rank == 0) print '(a,i0,a,i0,a)', 'mpi: ', ranks, ' ranks, ', lnew - 1, ' slots'
  call MPI_Finalize(ier)
end program mpi_fortran
