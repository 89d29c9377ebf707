! A distributed mesh from Fortran: its gathered lists are those of pstripack_trmesh, its stars those of LIST.
program fortran_mesh
  use, intrinsic :: iso_fortran_env, only: int32, int64, real64
  use mpi
  use pstripack
  use pstripack_mpi
  implicit none
  integer, parameter :: n = 300
  real(real64) :: all(3, n)
  integer(int32) :: list(6*n - 12), lptr(6*n - 12), lend(n), lnew, ier
  integer :: rank, size_of_world, error, i

  call MPI_Init(error)
  call MPI_Comm_rank(MPI_COMM_WORLD, rank, error)
  call MPI_Comm_size(MPI_COMM_WORLD, size_of_world, error)
  do i = 1, n
    all(3, i) = (2*i - 1 - n)/real(n, real64)
    all(1, i) = sqrt(1 - all(3, i)**2)*cos(2.399963229728653_real64*i)
    all(2, i) = sqrt(1 - all(3, i)**2)*sin(2.399963229728653_real64*i)
  end do
  call pstripack_trmesh(all(1, :), all(2, :), all(3, :), list, lptr, lend, lnew, ier)
  if (ier /= pstripack_ok) error stop "pstripack_trmesh"
  call use_mesh
  call MPI_Finalize(error)

contains

  subroutine use_mesh
    type(pstripack_mesh) :: mesh  ! freed at the end
    integer(int64), allocatable :: number(:), begin(:), neighbour(:), corner(:, :), halo_number(:), local_begin(:)
    integer(int32), allocatable :: local(:)
    real(real64), allocatable :: halo_xyz(:, :)
    integer(int32) :: list2(6*n - 12), lptr2(6*n - 12), lend2(n), lnew2
    integer(int64) :: points, arcs, triangles, halo, k, first, second, total
    integer(int64) :: slot

    call mesh%create(MPI_COMM_WORLD, ier)
    if (ier /= 0) error stop "create"
    number = [(int(k, int64), k=rank + 1, n, size_of_world)]  ! round robin
    call mesh%triangulate(all(:, int(number)), number, ier)
    if (ier /= 0) error stop "triangulate"
    call mesh%sizes(points, arcs, triangles, halo)
    if (points /= size(number)) error stop "sizes"
    call MPI_Allreduce(triangles, total, 1, MPI_INTEGER8, MPI_SUM, MPI_COMM_WORLD, error)
    if (total /= 2*n - 4) error stop "not all triangles"

    allocate (begin(points + 1), neighbour(arcs), corner(3, triangles), halo_number(halo), halo_xyz(3, halo))
    call mesh%stars(begin, neighbour)
    do k = 1, points
      slot = merge(0, lend(max(number(k) - 1, 1_int64)), number(k) == 1)
      if (any(neighbour(begin(k):begin(k + 1) - 1) /= list(slot + 1:lend(number(k))))) error stop "stars"
    end do
    call mesh%triangles(corner)
    if (any(corner(1, :) > corner(2, :) .or. corner(1, :) > corner(3, :))) error stop "triangles"
    call mesh%halo(halo_number, halo_xyz)
    if (any(halo_xyz /= all(:, int(halo_number)))) error stop "halo"
    allocate (local_begin(points + 1), local(arcs))
    call mesh%local_stars(local_begin, local, ier)
    if (ier /= 0 .or. any(local_begin /= begin)) error stop "local_stars"
    number = [number, halo_number]
    if (any(number(local) /= neighbour)) error stop "local numbers"

    call mesh%gather(pstripack_every_rank, list2, lptr2, lend2, lnew2, ier)
    if (ier /= 0) error stop "gather"
    if (any(list2 /= list) .or. any(lptr2 /= lptr) .or. any(lend2 /= lend) .or. lnew2 /= lnew) &
      error stop "gathered lists"

    number = number(:points)
    if (rank == 0) number(1) = 2
    call mesh%triangulate(all(:, :points), number, ier)
    call mesh%error_points(first, second)
    if (ier /= pstripack_bad_number .or. first /= 2 .or. second /= 0) error stop "a number that occurs twice"
    call mesh%triangulate(all(:, :points), number(2:), ier)
    if (ier /= pstripack_too_many_nodes) error stop "arrays of different sizes"
    call mesh%free()
    call mesh%free()
    call mesh%triangulate(all(:, :0), number(:0), ier)
    if (ier /= pstripack_empty_mesh) error stop "a freed mesh"
  end subroutine
end program
