! Triangulates 1000 nodes on the unit sphere and adds up the areas of the triangles. Each rank has a part of the
! nodes and receives their neighbours; no rank has all nodes.
!
! $ mpifort mesh.f90 -o mesh $(pkg-config --cflags --libs pstripack_mpi_fortran)
! $ mpirun -n 4 ./mesh
program mesh
  use, intrinsic :: iso_fortran_env, only: int32, int64, real64
  use mpi_f08
  use pstripack_mpi, only: pstripack_mesh
  implicit none
  integer(int64), parameter :: n = 1000
  real(real64), parameter :: pi = acos(-1._real64)
  type(pstripack_mesh) :: globe
  real(real64), allocatable :: xyz(:, :)    ! own nodes, then those of the halo
  integer(int64), allocatable :: number(:)  ! their numbers among all nodes
  integer(int64), allocatable :: begin(:)
  integer(int32), allocatable :: neighbour(:)
  integer(int64) :: own, arcs, triangles, halo, i, s, next
  integer(int32) :: ier
  integer :: rank, ranks
  real(real64) :: area, longitude, z

  call MPI_Init()
  call MPI_Comm_rank(MPI_COMM_WORLD, rank)
  call MPI_Comm_size(MPI_COMM_WORLD, ranks)

  ! This rank's part of a spiral from pole to pole, a golden angle from node to node.
  number = [(i, i=1 + n*rank/ranks, n*(rank + 1)/ranks)]
  own = size(number)
  allocate (xyz(3, own))
  do i = 1, own
    z = 1 - (2*number(i) - 1)/real(n, real64)
    longitude = number(i)*pi*(3 - sqrt(5._real64))
    xyz(:, i) = [sqrt(1 - z**2)*cos(longitude), sqrt(1 - z**2)*sin(longitude), z]
  end do

  call globe%create(MPI_COMM_WORLD, ier)
  if (ier == 0) call globe%triangulate(xyz, number, ier)
  if (ier /= 0) error stop 'triangulate'  ! ier is the same on every rank

  call globe%sizes(own, arcs, triangles, halo)
  allocate (begin(own + 1), neighbour(arcs))
  call globe%local_stars(begin, neighbour, ier)
  if (ier /= 0) error stop 'local_stars'
  call take_in_halo

  ! Count a triangle only on the rank that owns its smallest corner.
  area = 0
  do i = 1, own
    do s = begin(i), begin(i + 1) - 1
      next = merge(s + 1, begin(i), s + 1 < begin(i + 1))
      if (all(number(neighbour([s, next])) > number(i))) &
        area = area + spherical_area(xyz(:, i), xyz(:, neighbour(s)), xyz(:, neighbour(next)))
    end do
  end do
  call MPI_Allreduce(MPI_IN_PLACE, triangles, 1, MPI_INTEGER8, MPI_SUM, MPI_COMM_WORLD)
  call MPI_Allreduce(MPI_IN_PLACE, area, 1, MPI_REAL8, MPI_SUM, MPI_COMM_WORLD)
  if (rank == 0) print '(i0, a, i0, a, f9.6)', n, ' nodes, ', triangles, ' triangles, area ', area

  call globe%free()
  call MPI_Finalize()

contains

  subroutine take_in_halo
    integer(int64) :: halo_number(halo)
    real(real64) :: halo_xyz(3, halo)
    call globe%halo(halo_number, halo_xyz)
    number = [number, halo_number]
    xyz = reshape([xyz, halo_xyz], [3, size(number)])
  end subroutine

  ! Area of the triangle of unit vectors (Van Oosterom and Strackee).
  pure real(real64) function spherical_area(a, b, c)
    real(real64), intent(in) :: a(3), b(3), c(3)
    real(real64) :: b_cross_c(3)
    b_cross_c = [b(2)*c(3) - b(3)*c(2), b(3)*c(1) - b(1)*c(3), b(1)*c(2) - b(2)*c(1)]
    spherical_area = 2*atan2(dot_product(a, b_cross_c), &
                             1 + dot_product(a, b) + dot_product(b, c) + dot_product(c, a))
  end function
end program
