! An MPI program that ends in any way: ending_program MODE END WHO
!
!   MODE   without: no call of PSTRIPACK; comm: TRMESH in comm mode; distributed: a mesh; never: comm mode, no call
!   END    finalize, finalize3, stop, stop3, error_stop, exit5, abort, mpi_abort
!   WHO    all, or the number of the rank that ends so while the others begin another call
program ending_program
  use mpi
  use pstripack_mpi
  implicit none
  integer, parameter :: n = 2000
  external :: trmesh, end_by
  character(len=20) :: mode, how, who
  type(pstripack_mesh) :: mesh
  double precision :: xyz(3, n)
  integer(8) :: number(n)
  integer :: rank, ranks, only, ier, status

  call get_command_argument(1, mode)
  call get_command_argument(2, how)
  call get_command_argument(3, who)
  read (who, *, iostat=status) only
  call MPI_Init(ier)
  call MPI_Comm_rank(MPI_COMM_WORLD, rank, ier)
  call MPI_Comm_size(MPI_COMM_WORLD, ranks, ier)
  call make_nodes
  if (mode == 'comm' .or. mode == 'never') call pstripack_set_comm(MPI_COMM_WORLD)
  if (mode == 'distributed') call mesh%create(MPI_COMM_WORLD, ier)
  call work
  if (status /= 0 .or. rank == only) call end_now
  ! Without another call these ranks would be in MPI_Finalize when one rank calls MPI_Abort. In this case Open MPI 4.1's
  ! mpiexec crashes or hangs in some 5 of 100 runs, also for programs that do nothing else.
  if (mode == 'without' .or. (mode == 'never' .and. how == 'mpi_abort')) call MPI_Barrier(MPI_COMM_WORLD, ier)
  call work
  call MPI_Finalize(ier)

contains

  subroutine make_nodes
    integer :: k
    double precision :: longitude
    do k = 1, n
      longitude = 2.399963229728653d0*k
      xyz(3, k) = 1 - (2*k - 1d0)/n
      xyz(1, k) = sqrt(1 - xyz(3, k)**2)*cos(longitude)
      xyz(2, k) = sqrt(1 - xyz(3, k)**2)*sin(longitude)
      number(k) = k
    end do
  end subroutine

  subroutine work
    integer :: list(6*n - 12), lptr(6*n - 12), lend(n), lnew, near(n), next(n)
    double precision :: dist(n)
    integer :: first, last
    if (mode == 'comm') then
      call trmesh(n, xyz(1, :), xyz(2, :), xyz(3, :), list, lptr, lend, lnew, near, next, dist, ier)
      if (ier /= 0) call MPI_Abort(MPI_COMM_WORLD, 99, ier)
    else if (mode == 'distributed') then
      first = n*rank/ranks + 1
      last = n*(rank + 1)/ranks
      call mesh%triangulate(xyz(:, first:last), number(first:last), ier)
      if (ier /= 0) call MPI_Abort(MPI_COMM_WORLD, 98, ier)
    end if
  end subroutine

  subroutine end_now
    if (how == 'finalize' .or. how == 'finalize3') call MPI_Finalize(ier)
    if (how == 'finalize') stop
    if (how == 'finalize3') stop 3
    if (how == 'mpi_abort') call MPI_Abort(MPI_COMM_WORLD, 7, ier)
    call end_by(how)
  end subroutine

end program ending_program
