! SCVT on MPI ranks: the iteration of scvt_legacy on distributed generators.
!
! Each rank has generators that lie close together, with their global numbers. An iteration triangulates the
! generators of all ranks (mesh%triangulate), moves each one to the centroid of its Voronoi cell, which needs only
! its neighbours (mesh%local_stars, mesh%halo), and sends generators that have crossed a border to their new rank
! (mesh%home). At the end rank 0 gathers the mesh and writes it.
!
!   mpirun -n RANKS scvt_mpi [-n GENERATORS | -f FILE] [-i ITERATIONS] [-d uniform|bump] [-o PREFIX]
!
! Writes PREFIX_points.txt (x y z per line) and PREFIX_triangles.txt (three node numbers per line): the mesh of
! scvt_legacy, with the same digits for any number of ranks. Prints the times of the slowest rank.
program scvt_mpi
  use, intrinsic :: iso_fortran_env, only: dp => real64, int32, int64
  use mpi_f08
  use pstripack_mpi, only: pstripack_mesh, pstripack_coincident
  use stripack, only: trlist2
  implicit none

  integer, parameter :: most_generators = 357913943  ! the lists that rank 0 gathers have 32-bit integers

  type(MPI_Comm) :: comm
  integer :: rank, ranks, n, iterations, iteration
  character(len=256) :: generator_file, density_name, prefix
  character(len=512) :: problem = ' '  ! the error that rank 0 found
  logical :: uniform  ! the density
  real(dp) :: energy, move, last_progress
  integer(int64) :: migrated

  ! The parts of the program that are timed. Waiting for another rank counts in the part that waits.
  integer, parameter :: in_triangulate = 1, in_lists = 2, in_centroids = 3, in_migration = 4, in_output = 5
  character(len=*), parameter :: part(5) = [character(len=11) :: 'triangulate', 'lists', 'centroids', 'migration', &
                                            'output']
  real(dp) :: seconds(5) = 0, clock

  ! This rank's generators: global numbers and places.
  integer(int64), allocatable :: number(:)
  real(dp), allocatable :: xyz(:, :)
  ! The same, followed by the halo: their neighbours on other ranks. Local numbers are indices into these arrays.
  integer(int64), allocatable :: local_number(:)
  real(dp), allocatable :: local_xyz(:, :)
  type(pstripack_mesh) :: mesh
  type(MPI_Datatype) :: point  ! three coordinates as one item: counts are those of generators

  call MPI_Init()
  comm = MPI_COMM_WORLD
  call MPI_Comm_rank(comm, rank)
  call MPI_Comm_size(comm, ranks)
  call MPI_Type_contiguous(3, MPI_DOUBLE_PRECISION, point)
  call MPI_Type_commit(point)

  call read_arguments
  if (generator_file /= ' ') then
    call read_generators
  else
    call make_generators
  end if
  if (rank == 0) then
    print '(a,i0,3a,i0,a,i0)', 'SCVT: generators ', n, ', density ', trim(density_name), ', iterations ', &
      iterations, ', ranks ', ranks
    print '(a10,3a24)', 'iteration', 'energy', 'largest move', 'changed rank'
  end if

  call create_mesh
  clock = MPI_Wtime()
  last_progress = clock
  call triangulate
  call migrate(migrated)  ! from blocks of consecutive numbers to blocks of neighbours
  do iteration = 1, iterations
    call triangulate
    call move_to_centroids(energy, move)
    call migrate(migrated)
    ! Print fewer digits: MPI may add the ranks' energies in any order.
    if (rank == 0) print '(i10,es24.11,es24.15,i24)', iteration, energy, move, migrated
    call progress
    call time_goes_to(in_output)
  end do
  call triangulate
  call write_mesh

  call mesh%free()
  call MPI_Type_free(point)
  call MPI_Finalize()

contains

  subroutine create_mesh
    integer(int32) :: ier
    call mesh%create(comm, ier)
    if (ier /= 0) call fail_with_code('create', ier)
  end subroutine create_mesh

  ! An error is the same on all ranks.
  subroutine triangulate
    integer(int32) :: ier
    integer(int64) :: first, second
    character(len=80) :: message
    call mesh%triangulate(xyz, number, ier)
    call time_goes_to(in_triangulate)
    if (ier == -2) call fail('the generators lie on one great circle')
    if (ier == pstripack_coincident) then
      call mesh%error_points(first, second)
      write (message, '(a,i0,a)') 'generator ', first, ' occurs twice'
      call fail(message)
    end if
    if (ier /= 0) call fail_with_code('triangulate', ier)
  end subroutine triangulate

  ! Adds the time since the last call to the time of a part of the program.
  subroutine time_goes_to(i)
    integer, intent(in) :: i
    real(dp) :: now
    now = MPI_Wtime()
    seconds(i) = seconds(i) + now - clock
    clock = now
  end subroutine time_goes_to

  ! Moves each generator of this rank to the mass centroid of its cell.
  subroutine move_to_centroids(energy, move)
    real(dp), intent(out) :: energy, move
    integer(int64) :: points, arcs, triangles, halo, k
    integer(int64), allocatable :: begin(:)
    integer(int32), allocatable :: neighbour(:)
    integer(int32) :: ier
    real(dp) :: centroid(3)

    call mesh%sizes(points, arcs, triangles, halo)
    if (allocated(local_number)) deallocate (local_number, local_xyz)
    allocate (begin(points + 1), neighbour(arcs), local_number(points + halo), local_xyz(3, points + halo))
    local_number(:points) = number
    local_xyz(:, :points) = xyz
    call mesh%halo(local_number(points + 1:), local_xyz(:, points + 1:))
    call mesh%local_stars(begin, neighbour, ier)
    call check(ier == 0, 'out of memory')
    ! A negative neighbour is the last one of a boundary node.
    call check(all(neighbour > 0), 'the generators lie in one hemisphere; an SCVT needs the whole sphere')
    call time_goes_to(in_lists)

    energy = 0
    move = 0
    do k = 1, points
      call centroid_of_cell(int(k, int32), neighbour(begin(k):begin(k + 1) - 1), centroid, energy)
      move = max(move, sqrt((centroid(1) - xyz(1, k))**2 + (centroid(2) - xyz(2, k))**2 + &
                            (centroid(3) - xyz(3, k))**2))
      xyz(:, k) = centroid
    end do
    call MPI_Allreduce(MPI_IN_PLACE, energy, 1, MPI_DOUBLE_PRECISION, MPI_SUM, comm)
    call MPI_Allreduce(MPI_IN_PLACE, move, 1, MPI_DOUBLE_PRECISION, MPI_MAX, comm)
    call time_goes_to(in_centroids)
  end subroutine move_to_centroids

  ! The mass centroid of the Voronoi cell of generator k (a local number), back on the sphere; adds the cell's
  ! energy. `ring` are the neighbours, counterclockwise. The corners of the cell are the circumcentres of the
  ! triangles (k, neighbour, next neighbour). The cell is cut into triangles (k, corner a, next corner b), each
  ! integrated by the midpoints of its sides; e, f, a, b and the moment s are relative to k. The walk starts at the
  ! neighbour with the smallest global number, so that the rounding of the sums does not depend on the number of
  ! ranks.
  subroutine centroid_of_cell(k, ring, centroid, energy)
    integer(int32), intent(in) :: k, ring(0:)
    real(dp), intent(out) :: centroid(3)
    real(dp), intent(inout) :: energy
    real(dp), parameter :: sixth = 1.0_dp/6
    integer :: first, step, degree
    real(dp) :: g(3), e(3), f(3), a(3), b(3), s(3), mass, third, wa, wab, wb
    degree = size(ring)
    first = minloc(local_number(ring), dim=1) - 1

    g = local_xyz(:, k)
    e = local_xyz(:, ring(first)) - g
    f = local_xyz(:, ring(modulo(first + 1, degree))) - g
    b = circumcentre(e, f) - g
    wb = density(g + 0.5_dp*b)
    mass = 0
    s = 0
    do step = first + 1, first + degree
      a = b
      wa = wb
      e = f
      f = local_xyz(:, ring(modulo(step + 1, degree))) - g
      b = circumcentre(e, f) - g
      wb = density(g + 0.5_dp*b)
      wab = density(g + 0.5_dp*(a + b))
      third = sixth*sqrt(square(cross(a, b)))  ! a third of the triangle's area
      mass = mass + third*(wa + wab + wb)
      s = s + third*(wa*a + wab*(a + b) + wb*b)
      energy = energy + 0.25_dp*third*(wa*square(a) + wab*square(a + b) + wb*square(b))
    end do
    s = mass*g + 0.5_dp*s
    centroid = s*(1/sqrt(square(s)))
  end subroutine centroid_of_cell

  ! The circumcentre of the counterclockwise triangle (g, g + e, g + f).
  pure function circumcentre(e, f) result(centre)
    real(dp), intent(in) :: e(3), f(3)
    real(dp) :: centre(3)
    centre = cross(e, f)
    centre = centre*(1/sqrt(square(centre)))
  end function circumcentre

  pure real(dp) function square(a)
    real(dp), intent(in) :: a(3)
    square = a(1)**2 + a(2)**2 + a(3)**2
  end function square

  pure function cross(a, b) result(c)
    real(dp), intent(in) :: a(3), b(3)
    real(dp) :: c(3)
    c = [a(2)*b(3) - a(3)*b(2), a(3)*b(1) - a(1)*b(3), a(1)*b(2) - a(2)*b(1)]
  end function cross

  ! uniform: 1. bump: fine around longitude 0, latitude 30 degrees (mesh width 1/3 of that elsewhere).
  pure function density(p) result(rho)
    real(dp), intent(in) :: p(3)
    real(dp), parameter :: pi = 3.14159265358979323846_dp, centre(3) = [0.86602540378443864676_dp, 0.0_dp, 0.5_dp]
    real(dp) :: rho, distance
    rho = 1
    if (uniform) return
    distance = acos(min(1.0_dp, (p(1)*centre(1) + p(3)*centre(3))/sqrt(p(1)**2 + p(2)**2 + p(3)**2)))
    rho = (1 + 2*0.5_dp*(1 + tanh((pi/6 - distance)/(pi/18))))**4
  end function density

  ! Sends generators to their new ranks.
  subroutine migrate(migrated)
    integer(int64), intent(out) :: migrated  ! on all ranks together
    integer(int32), allocatable :: home(:)
    integer(int64), allocatable :: number_out(:), number_in(:)
    real(dp), allocatable :: xyz_out(:, :), xyz_in(:, :)
    integer :: send_count(0:ranks - 1), send_start(0:ranks - 1), count(0:ranks - 1), start(0:ranks - 1)
    integer :: next(0:ranks - 1), k, stay
    integer(int32) :: ier

    allocate (home(size(number)))
    call mesh%home(xyz, home, ier)
    if (ier /= 0) call stop_at_once('a generator has no home rank')

    send_count = 0
    do k = 1, size(number)
      if (home(k) /= rank) send_count(home(k)) = send_count(home(k)) + 1
    end do
    migrated = sum(send_count)
    call MPI_Allreduce(MPI_IN_PLACE, migrated, 1, MPI_INTEGER8, MPI_SUM, comm)
    if (migrated == 0) then
      call time_goes_to(in_migration)
      return
    end if
    call MPI_Alltoall(send_count, 1, MPI_INTEGER, count, 1, MPI_INTEGER, comm)
    send_start = starts(send_count)
    start = starts(count)

    ! Generators that stay move up; the others are sorted by their new rank.
    allocate (number_out(sum(send_count)), xyz_out(3, sum(send_count)))
    next = send_start
    stay = 0
    do k = 1, size(number)
      if (home(k) == rank) then
        stay = stay + 1
        number(stay) = number(k)
        xyz(:, stay) = xyz(:, k)
      else
        next(home(k)) = next(home(k)) + 1
        number_out(next(home(k))) = number(k)
        xyz_out(:, next(home(k))) = xyz(:, k)
      end if
    end do

    allocate (number_in(stay + sum(count)), xyz_in(3, stay + sum(count)))
    number_in(:stay) = number(:stay)
    xyz_in(:, :stay) = xyz(:, :stay)
    call MPI_Alltoallv(number_out, send_count, send_start, MPI_INTEGER8, &
                       number_in, count, start + stay, MPI_INTEGER8, comm)
    call MPI_Alltoallv(xyz_out, send_count, send_start, point, xyz_in, count, start + stay, point, comm)
    call move_alloc(number_in, number)
    call move_alloc(xyz_in, xyz)
    call time_goes_to(in_migration)
  end subroutine migrate

  ! The offset of each rank's items, from 0, in the items of all ranks.
  pure function starts(count) result(start)
    integer, intent(in) :: count(0:)
    integer :: start(0:size(count) - 1), r
    start(0) = 0
    do r = 1, size(count) - 1
      start(r) = start(r - 1) + count(r - 1)
    end do
  end function starts

  ! The first number of rank r's block before the first migration; n + 1 for r = ranks.
  pure integer function first_of_block(r)
    integer, intent(in) :: r
    first_of_block = int(int(n, int64)*r/ranks) + 1
  end function first_of_block

  subroutine allocate_block
    integer :: k, status
    allocate (number(first_of_block(rank + 1) - first_of_block(rank)), stat=status)
    if (status == 0) allocate (xyz(3, size(number)), stat=status)
    call check(status == 0, 'out of memory')
    number = [(int(k, int64), k=first_of_block(rank), first_of_block(rank + 1) - 1)]
  end subroutine allocate_block

  ! Random points, uniform on the sphere, the same on every machine and for any number of ranks: every rank draws
  ! all points and keeps those of its block.
  subroutine make_generators
    integer(int64) :: seed
    integer :: k, own
    real(dp) :: longitude, z, r
    call allocate_block
    seed = 42
    do k = 1, first_of_block(rank + 1) - 1
      z = 2*random(seed) - 1
      longitude = 2*acos(-1.0_dp)*random(seed)
      own = k - first_of_block(rank) + 1
      if (own < 1) cycle
      r = sqrt((1 - z)*(1 + z))
      xyz(:, own) = [r*cos(longitude), r*sin(longitude), z]
    end do
  end subroutine make_generators

  ! Park and Miller: seed = 16807 seed mod 2**31-1. Not pure: every call is a draw.
  function random(seed) result(u)
    integer(int64), intent(inout) :: seed
    real(dp) :: u
    seed = mod(16807_int64*seed, 2147483647_int64)
    u = real(seed, dp)/2147483647.0_dp
  end function random

  ! Rank 0 reads the file twice: to check and count the generators, then to send each rank its block.
  subroutine read_generators
    integer :: file, status, r, k
    real(dp), allocatable :: block(:, :)
    real(dp) :: p(3)
    if (rank == 0) then
      open (newunit=file, file=generator_file, status='old', action='read', iostat=status)
      if (status /= 0) problem = 'cannot read '//trim(generator_file)
      n = 0
      do while (problem == ' ' .and. n <= most_generators)
        if (.not. read_generator(file, p)) exit
        n = n + 1
      end do
    end if
    call fail_if_problem
    call MPI_Bcast(n, 1, MPI_INTEGER, 0, comm)
    if (n < 4) call fail('an SCVT needs at least 4 generators')
    if (n > most_generators) call fail('too many generators for the lists of one rank')

    call allocate_block
    if (rank /= 0) then
      call MPI_Recv(xyz, size(number), point, 0, 0, comm, MPI_STATUS_IGNORE)
      return
    end if
    rewind (file)
    do r = 0, ranks - 1
      allocate (block(3, first_of_block(r + 1) - first_of_block(r)))
      do k = 1, size(block, 2)
        if (.not. read_generator(file, block(:, k))) call stop_at_once(trim(generator_file)//' has changed')
      end do
      if (r == 0) xyz = block
      if (r > 0) call MPI_Send(block, size(block, 2), point, r, 0, comm)
      deallocate (block)
    end do
    close (file)
  end subroutine read_generators

  ! Reads the next generator and scales it to length 1. False at the end of the file, or if `problem` has been set.
  logical function read_generator(file, p)
    integer, intent(in) :: file
    real(dp), intent(out) :: p(3)
    character(len=512) :: line
    integer :: status
    real(dp) :: r
    integer, save :: count = 0  ! generators read so far, for the message
    read_generator = .false.
    line = ' '
    do while (line == ' ')
      read (file, '(a)', iostat=status) line
      if (status /= 0) return
    end do
    count = count + 1
    read (line, *, iostat=status) p
    r = 0
    if (status == 0) r = sqrt(p(1)**2 + p(2)**2 + p(3)**2)
    if (.not. (r > 0 .and. r <= huge(r))) then
      write (problem, '(2a,i0,a)') trim(generator_file), ': generator ', count, ': expected x y z, not all 0'
      return
    end if
    p = p/r
    read_generator = .true.
  end function read_generator

  ! Rank 0 gathers the mesh and writes it.
  subroutine write_mesh
    integer, allocatable :: list(:), lptr(:), lend(:), ltri(:, :)
    real(dp), allocatable :: all_xyz(:, :)
    integer :: lnew, nt, ier, status, file, k, room
    real(dp) :: longest(size(seconds))

    room = merge(n, 0, rank == 0)
    allocate (list(6*room), lptr(6*room), lend(room), ltri(3, 2*room), all_xyz(3, room), stat=status)
    call check(status == 0, 'out of memory')
    call gather_points(all_xyz)
    call mesh%gather(0, list, lptr, lend, lnew, ier)
    if (ier /= 0) call fail_with_code('gather', ier)
    call time_goes_to(in_lists)
    if (rank == 0) then
      call trlist2(n, list, lptr, lend, nt, ltri, ier)
      if (ier /= 0) write (problem, '(a,i0)') 'trlist2 returned IER = ', ier
      call time_goes_to(in_lists)
      if (problem == ' ') call create('_points.txt', file)
      if (problem == ' ') then
        do k = 1, n
          write (file, '(3es25.16e3)') all_xyz(:, k)
        end do
        close (file)
        call create('_triangles.txt', file)
      end if
      if (problem == ' ') then
        do k = 1, nt
          write (file, '(3(1x,i0))') ltri(:, k)
        end do
        close (file)
      end if
    end if
    call fail_if_problem
    call time_goes_to(in_output)
    call MPI_Reduce(seconds, longest, size(seconds), MPI_DOUBLE_PRECISION, MPI_MAX, 0, comm)
    if (rank == 0) then
      do k = 1, size(part)
        print '(a,f12.6)', 'seconds in '//part(k), longest(k)
      end do
      print '(a,i0,5a)', 'wrote ', nt, ' triangles: ', trim(prefix), '_points.txt and ', trim(prefix), &
        '_triangles.txt'
    end if
  end subroutine write_mesh

  ! Gathers all generators on rank 0, in the order of their numbers.
  subroutine gather_points(all_xyz)
    real(dp), intent(inout) :: all_xyz(:, :)
    integer(int64), allocatable :: all_number(:)
    real(dp), allocatable :: in_order_of_ranks(:, :)
    integer :: count(ranks)
    call MPI_Gather(size(number), 1, MPI_INTEGER, count, 1, MPI_INTEGER, 0, comm)
    if (rank /= 0) count = 0
    allocate (all_number(sum(count)), in_order_of_ranks(3, sum(count)))
    call MPI_Gatherv(number, size(number), MPI_INTEGER8, all_number, count, starts(count), MPI_INTEGER8, 0, comm)
    call MPI_Gatherv(xyz, size(number), point, in_order_of_ranks, count, starts(count), point, 0, comm)
    all_xyz(:, all_number) = in_order_of_ranks
  end subroutine gather_points

  subroutine create(suffix, file)
    character(len=*), intent(in) :: suffix
    integer, intent(out) :: file
    integer :: status
    open (newunit=file, file=trim(prefix)//suffix, status='replace', action='write', iostat=status)
    if (status /= 0) problem = 'cannot write '//trim(prefix)//suffix
  end subroutine create

  ! Prints a line on stderr every ten seconds.
  subroutine progress
    real(dp) :: now
    now = MPI_Wtime()
    if (rank /= 0 .or. now - last_progress < 10) return
    last_progress = now
    write (0, '(a,i0,a,i0,a,f8.1,a)') 'scvt_mpi: ', iteration, ' of ', iterations, ' iterations done,', &
      seconds(in_triangulate), ' s in triangulate'
  end subroutine progress

  ! Every rank sees the same arguments.
  subroutine read_arguments
    character(len=256) :: option, value
    integer :: i, status
    n = 10242
    iterations = 10
    density_name = 'uniform'
    prefix = 'scvt'
    generator_file = ' '
    if (mod(command_argument_count(), 2) /= 0) call usage
    do i = 1, command_argument_count(), 2
      call get_command_argument(i, option)
      call get_command_argument(i + 1, value)
      status = 0
      select case (option)
      case ('-n')
        read (value, *, iostat=status) n
      case ('-i')
        read (value, *, iostat=status) iterations
      case ('-d')
        density_name = value
      case ('-o')
        prefix = value
      case ('-f')
        generator_file = value
      case default
        call usage
      end select
      if (status /= 0) call fail('not a number: '//trim(option)//' '//trim(value))
    end do
    if (n < 4) call fail('-n must be at least 4')
    if (n > most_generators) call fail('too many generators for the lists of one rank')
    if (iterations < 0) call fail('-i must not be negative')
    uniform = density_name == 'uniform'
    if (.not. uniform .and. density_name /= 'bump') &
      call fail('unknown density '//trim(density_name)//': uniform or bump')
  end subroutine read_arguments

  subroutine usage
    call fail('usage: scvt_mpi [-n GENERATORS | -f FILE] [-i ITERATIONS] [-d uniform|bump] [-o PREFIX]')
  end subroutine usage

  ! Collective error exits: all ranks must call the same one of these four, so that none waits for a rank that has ended.

  subroutine fail_if_problem
    call MPI_Bcast(problem, len(problem), MPI_CHARACTER, 0, comm)
    if (problem /= ' ') call fail(problem)
  end subroutine fail_if_problem

  subroutine check(fine_here, message)
    logical, intent(in) :: fine_here
    character(len=*), intent(in) :: message
    logical :: fine
    call MPI_Allreduce(fine_here, fine, 1, MPI_LOGICAL, MPI_LAND, comm)
    if (.not. fine) call fail(message)
  end subroutine check

  subroutine fail_with_code(routine, code)
    character(len=*), intent(in) :: routine
    integer(int32), intent(in) :: code
    character(len=80) :: message
    write (message, '(2a,i0)') routine, ' returned ier = ', code
    call fail(message)
  end subroutine fail_with_code

  subroutine fail(message)
    character(len=*), intent(in) :: message
    if (rank == 0) write (0, '(2a)') 'scvt_mpi: ', trim(message)
    call MPI_Type_free(point)  ! MPICH reports types that are not freed
    call MPI_Finalize()
    stop 1, quiet=.true.
  end subroutine fail

  ! For errors that should not happen: one rank alone ends the program on all ranks.
  subroutine stop_at_once(message)
    character(len=*), intent(in) :: message
    write (0, '(2a)') 'scvt_mpi: ', trim(message)
    call MPI_Abort(comm, 1)
  end subroutine stop_at_once

end program scvt_mpi
