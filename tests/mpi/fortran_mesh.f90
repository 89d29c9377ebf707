! A distributed mesh from Fortran: its gathered lists are those of pstripack_trmesh, its stars those of LIST, its
! centroidal tessellation that of pstripack_scvt.
module procedures
  use, intrinsic :: iso_fortran_env, only: int32, real64
  use pstripack, only: pstripack_scvt_progress
  implicit none
  integer :: steps = 0, last_step = huge(1)

contains

  ! Without exp: GFortran's vectors of exp have other last bits than its scalar exp.
  subroutine bump(n, xyz, values)
    integer(int32), intent(in) :: n
    real(real64), intent(in) :: xyz(3, n)
    real(real64), intent(out) :: values(n)
    values = 1 + 5*(1 + 0.6_real64*xyz(2, :) + 0.8_real64*xyz(3, :))**4
  end subroutine

  subroutine negative(n, xyz, values)
    integer(int32), intent(in) :: n
    real(real64), intent(in) :: xyz(3, n)
    real(real64), intent(out) :: values(n)
    values = xyz(1, :)
  end subroutine

  subroutine progress(where, stop)
    type(pstripack_scvt_progress), intent(in) :: where
    logical, intent(inout) :: stop
    if (where%generators /= 300) error stop "progress: generators"
    steps = steps + 1
    stop = steps == last_step
  end subroutine
end module

program fortran_mesh
  use, intrinsic :: iso_fortran_env, only: int32, int64, real64
  use mpi
  use pstripack
  use pstripack_mpi
  use procedures
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
  call use_scvt
  call MPI_Finalize(error)

contains

  subroutine use_mesh
    type(pstripack_mesh) :: mesh  ! freed at the end
    integer(int64), allocatable :: number(:), begin(:), neighbour(:), corner(:, :), halo_number(:), local_begin(:)
    integer(int32), allocatable :: local(:), owner(:), place(:), near(:)
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
    allocate (owner(halo), place(halo))
    call mesh%halo_owners(owner, place)
    if (any((place - 1)*size_of_world + owner + 1 /= halo_number)) error stop "halo_owners"
    allocate (local_begin(points + 1), local(arcs))
    call mesh%local_stars(local_begin, local, ier)
    if (ier /= 0 .or. any(local_begin /= begin)) error stop "local_stars"
    number = [number, halo_number]
    if (any(number(local) /= neighbour)) error stop "local numbers"

    call exchange_values(mesh, number(:points), halo_number)
    call mesh%check(k, ier)
    if (ier /= 0 .or. k /= pstripack_fingerprint(list, lptr, lend)) error stop "check"

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
    if (ier /= pstripack_bad_size) error stop "arrays of different sizes"
    ! The commonest slip, on the last rank alone.
    halo_xyz = all(:, :points)
    if (rank == size_of_world - 1) halo_xyz = transpose(halo_xyz)
    call mesh%triangulate(halo_xyz, number, ier)
    if (ier /= pstripack_bad_size) error stop "xyz(n, 3)"
    number = [(int(k, int64), k=rank + 1, n, size_of_world)]
    call mesh%triangulate(all(:, int(number)), number, ier)
    if (ier /= 0) error stop "triangulate again"
    allocate (near(points))
    call mesh%home(all(:, :points), near, ier)
    if (ier /= 0) error stop "home"
    call mesh%home(transpose(all(:, :points)), near, ier)
    if (ier /= pstripack_bad_size) error stop "home of xyz(n, 3)"
    call mesh%home(all(:, :points), near(2:), ier)
    if (ier /= pstripack_bad_size) error stop "home: rank too short"
    call mesh%free()
    call mesh%free()
    call mesh%triangulate(all(:, :0), number(:0), ier)
    if (ier /= pstripack_empty_mesh) error stop "a freed mesh"
    call mesh%exchange(halo_number(:0), halo_number(:0), ier)
    if (ier /= pstripack_empty_mesh) error stop "exchange of a freed mesh"
    call mesh%check(k, ier)
    if (ier /= pstripack_empty_mesh) error stop "check of a freed mesh"
  end subroutine

  ! Values that follow from the numbers of the points, alone and three a point; two exchanges under way.
  subroutine exchange_values(mesh, number, halo_number)
    type(pstripack_mesh), intent(inout) :: mesh
    integer(int64), intent(in) :: number(:), halo_number(:)
    integer(int64) :: one(size(halo_number)), three(3, size(halo_number))
    real(real64) :: x(size(halo_number)), xyz(3, size(halo_number))
    integer(int64) :: j
    integer(int64), parameter :: factor(3) = [1_int64, -7_int64, 2_int64**40]
    call mesh%exchange(number, one, ier)
    if (ier /= 0 .or. any(one /= halo_number)) error stop "exchange of integers"
    call mesh%exchange(all(1, int(number)), x, ier)
    if (ier /= 0 .or. any(x /= all(1, int(halo_number)))) error stop "exchange of reals"
    call mesh%exchange_begin(all(:, int(number)), ier)
    if (ier /= 0) error stop "exchange_begin"
    call mesh%exchange_begin(reshape([(factor*number(j), j=1, size(number))], [3, size(number)]), ier)
    if (ier /= 0) error stop "exchange_begin of integers"
    call mesh%exchange(all(:, int(number)), xyz(:, size(x):1:-1), ier)
    if (ier /= 0 .or. any(xyz(:, size(x):1:-1) /= all(:, int(halo_number)))) error stop "exchange in the other order"
    call mesh%exchange_end(x, ier)
    if (ier /= pstripack_bad_size) error stop "exchange_end of another width"
    call mesh%exchange_end(xyz, ier)
    if (ier /= 0 .or. any(xyz /= all(:, int(halo_number)))) error stop "exchange_end"
    call mesh%exchange_end(three, ier)
    if (ier /= 0) error stop "exchange_end of integers"
    if (any([(any(three(:, j) /= factor*halo_number(j)), j=1, size(halo_number))])) error stop "integers"
    call mesh%exchange_end(xyz, ier)
    if (ier /= pstripack_empty_mesh) error stop "no exchange under way"
    call mesh%exchange(all(:0, int(number)), xyz(:0, :), ier)
    if (ier /= pstripack_bad_size) error stop "no values"
  end subroutine

  subroutine use_scvt
    type(pstripack_mesh) :: mesh
    type(pstripack_scvt_options) :: options
    type(pstripack_scvt_result) :: found, expected
    integer(int64), allocatable :: number(:)
    real(real64), allocatable :: xyz(:, :)
    real(real64) :: x(n), y(n), z(n)
    character(len=100) :: message, expected_message
    integer :: k

    options%start = pstripack_scvt_given
    options%tolerance = 1e-9_real64
    options%most_evaluations = 20
    options%widths = .true.
    x = all(1, :)
    y = all(2, :)
    z = all(3, :)
    call pstripack_scvt(x, y, z, expected, ier, bump, options)
    if (ier /= 0 .or. expected%reason /= pstripack_scvt_evaluations) error stop "pstripack_scvt"

    call mesh%scvt(all, [(int(k, int64), k=1, n)], found, ier)
    if (ier /= pstripack_empty_mesh) error stop "a mesh that was not created"
    call mesh%create(MPI_COMM_WORLD, ier)
    number = [(int(k, int64), k=rank + 1, n, size_of_world)]
    xyz = all(:, int(number))
    call mesh%scvt(xyz, number, found, ier, bump, options, progress, message)
    if (ier /= 0 .or. message /= "") error stop "scvt"
    if (any(xyz(1, :) /= x(number)) .or. any(xyz(2, :) /= y(number)) .or. any(xyz(3, :) /= z(number))) &
      error stop "other generators"
    if (found%energy /= expected%energy .or. found%gradient /= expected%gradient) error stop "another energy"
    if (found%generators /= size(number) .or. found%reason /= expected%reason) error stop "another result"
    if ((steps > 0) .neqv. (rank == 0)) error stop "progress is told to rank 0"

    options%widths = .false.
    steps = 0
    last_step = 2
    call mesh%scvt(xyz, number, found, ier, options=options, progress=progress)
    if (ier /= 0 .or. found%reason /= pstripack_scvt_stopped) error stop "stopped"
    call mesh%scvt(xyz, number, found, ier, negative, options, message=message)
    if (ier /= pstripack_bad_density .or. index(message, "the density is -") /= 1) error stop "a bad density"
    xyz = transpose(xyz)
    call mesh%scvt(xyz, number, found, ier, message=message)
    write (expected_message, "(a,i0,a)") "rank 0: xyz is (", (n + size_of_world - 1)/size_of_world, &
      ",3): must be (3,n), n the size of number"
    if (ier /= pstripack_bad_size .or. message /= expected_message) error stop "scvt of xyz(n, 3)"
  end subroutine
end program
