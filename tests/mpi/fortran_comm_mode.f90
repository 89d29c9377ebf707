! Comm mode from Fortran, with the handles of module mpi_f08 and of module mpi: the same lists as before.
program fortran_comm_mode
  use, intrinsic :: iso_fortran_env, only: int32
  use mpi_f08
  use pstripack_mpi
  implicit none
  external :: trmesh
  integer, parameter :: n = 500
  double precision :: x(n), y(n), z(n), dist(n)
  integer :: expected(12*n - 24 + n), ier, rank, integer_handle
  integer(int32) :: code
  type(MPI_Comm) :: half

  call MPI_Init()
  call MPI_Comm_rank(MPI_COMM_WORLD, rank)
  call spiral(n, x, y, z)
  call lists(expected)

  call pstripack_set_comm(MPI_COMM_WORLD, code)
  if (code /= 0) error stop "set_comm with type(MPI_Comm)"
  call compare("mpi_f08")
  integer_handle = MPI_COMM_WORLD%MPI_VAL
  call pstripack_set_comm(integer_handle, code)
  if (code /= 0) error stop "set_comm with an integer"
  call compare("integer")

  call MPI_Comm_split(MPI_COMM_WORLD, mod(rank, 2), 0, half)
  call pstripack_set_comm(half)
  call compare("half")
  call MPI_Comm_free(half)
  call compare("half, freed by the program")

  ! Data that differ.
  call pstripack_set_comm(MPI_COMM_WORLD)
  block
    integer :: size, list(6*n - 12), lptr(6*n - 12), lend(n), lnew, near(n), next(n)
    call MPI_Comm_size(MPI_COMM_WORLD, size)
    list = -77
    lptr = -77
    lend = -77
    lnew = -77
    if (rank == 0) x(7) = -x(7)
    call trmesh(n, x, y, z, list, lptr, lend, lnew, near, next, dist, ier)
    if (rank == 0) x(7) = -x(7)
    if (size > 1 .and. ier /= pstripack_ranks_disagree) error stop "ranks that disagree"
    if (size > 1 .and. (any(list /= -77) .or. any(lptr /= -77) .or. any(lend /= -77) .or. lnew /= -77)) &
      error stop "outputs written"
  end block

  call pstripack_set_comm(MPI_COMM_NULL, code)
  if (code /= 0) error stop "set_comm(MPI_COMM_NULL)"
  if (rank == 0) call compare("rank 0 alone")
  call pstripack_set_comm(MPI_COMM_WORLD)
  call MPI_Finalize()
  call compare("after MPI_Finalize")

contains

  subroutine lists(bytes)
    integer, intent(out) :: bytes(:)
    integer :: list(6*n - 12), lptr(6*n - 12), lend(n), lnew, near(n), next(n)
    call trmesh(n, x, y, z, list, lptr, lend, lnew, near, next, dist, ier)
    if (ier /= 0 .or. lnew /= 6*n - 11) error stop "trmesh"
    bytes = [list, lptr, lend]
  end subroutine

  subroutine compare(what)
    character(len=*), intent(in) :: what
    integer :: found(size(expected))
    call lists(found)
    if (any(found /= expected)) then
      print *, what, ": other lists"
      error stop 1
    end if
  end subroutine

  subroutine spiral(n, x, y, z)
    integer, intent(in) :: n
    double precision, intent(out) :: x(n), y(n), z(n)
    integer :: i
    do i = 1, n
      z(i) = (2*i - 1 - n)/dble(n)
      x(i) = sqrt(1 - z(i)**2)*cos(2.399963229728653d0*i)
      y(i) = sqrt(1 - z(i)**2)*sin(2.399963229728653d0*i)
    end do
  end subroutine
end program
