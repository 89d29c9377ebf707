! SCVT: generators of a spherical centroidal Voronoi tessellation by Lloyd's method.
!
! Each iteration triangulates the generators (TRMESH), takes the circumcentres of the triangles as the
! corners of the Voronoi cells (CRLIST), and moves every generator to the centroid of its cell. At the end
! TRLIST lists the triangles.
!
!   scvt [-n GENERATORS | -f FILE] [-i ITERATIONS] [-d uniform|bump] [-o PREFIX]
!
! Writes PREFIX_points.txt (x y z a line) and PREFIX_triangles.txt (three node numbers a line).

      program scvt
      implicit none
      integer, parameter :: dp = selected_real_kind(15), long = selected_int_kind(18)
      integer, parameter :: nrow = 9

      integer :: n, iterations, iteration, k, nt, nb, ier, lnew, lun, istat
      integer :: ltri_of_crlist(6)
      character(len=256) :: generator_file, density_name, prefix
      real(dp) :: energy, move, seconds
      integer(long) :: clock_start, clock_end, clock_rate, clock_progress

      real(dp), allocatable :: x(:), y(:), z(:), xnew(:), ynew(:), znew(:)
      real(dp), allocatable :: xc(:), yc(:), zc(:), rc(:), dist(:)
      integer, allocatable :: list(:), lptr(:), lend(:), listc(:), iwk(:), ltri(:,:)

      external trmesh, trlist, crlist

      call read_arguments
      if (generator_file /= ' ') then
        call read_generators
      else
        allocate (x(n), y(n), z(n))
        call make_generators
      end if
      if (n < 4) call fail('an SCVT needs at least 4 generators')

      allocate (xnew(n), ynew(n), znew(n), dist(n), iwk(2*n), lend(n))
      allocate (list(6*n-12), lptr(6*n-12), listc(6*n-12))
      allocate (xc(2*n-4), yc(2*n-4), zc(2*n-4), rc(2*n-4), ltri(nrow,2*n-4), stat=istat)
      if (istat /= 0) call fail('out of memory')

      print '(a,i0,3a,i0)', 'SCVT: generators ', n, ', density ', trim(density_name), ', iterations ', iterations
      print '(a10,2a24)', 'iteration', 'energy', 'largest move'

      seconds = 0
      call system_clock(clock_progress, clock_rate)
      do iteration = 1, iterations
        call triangulate
        call crlist(n, 1, x, y, z, list, lend, lptr, lnew, ltri_of_crlist, listc, nb, xc, yc, zc, rc, ier)
        if (nb > 0) call fail('the generators lie in one hemisphere; an SCVT needs the whole sphere')
        if (ier /= 0) call fail_with_code('crlist', ier)

        energy = 0
        move = 0
        do k = 1, n
          call centroid_of_cell(k, xnew(k), ynew(k), znew(k), energy)
          move = max(move, sqrt((xnew(k)-x(k))**2 + (ynew(k)-y(k))**2 + (znew(k)-z(k))**2))
        end do
        x = xnew
        y = ynew
        z = znew
        print '(i10,2es24.15)', iteration, energy, move
        call progress
      end do

      call triangulate
      call trlist(n, list, lptr, lend, nrow, nt, ltri, ier)
      if (ier /= 0) call fail_with_code('trlist', ier)
      call write_mesh
      print '(a,f12.6)', 'seconds in trmesh', seconds
      print '(a,i0,5a)', 'wrote ', nt, ' triangles: ', trim(prefix), '_points.txt and ', trim(prefix), '_triangles.txt'

      contains

! TRMESH with its workspace as legacy codes pass it: NEAR and NEXT are halves of one array.
      subroutine triangulate
      call system_clock(clock_start, clock_rate)
      call trmesh(n, x, y, z, list, lptr, lend, lnew, iwk, iwk(n+1), dist, ier)
      call system_clock(clock_end)
      seconds = seconds + real(clock_end - clock_start, dp) / real(clock_rate, dp)
      if (ier == -2) call fail('the first three generators lie on one great circle; change their order')
      if (ier > 0) then
        write (0, '(a,i0,a)') 'scvt: generator ', ier, ' occurs twice'
        stop 1
      end if
      if (ier /= 0) call fail_with_code('trmesh', ier)
      end subroutine triangulate

! The mass centroid of the Voronoi cell of generator k, back on the sphere; adds the cell's energy.
! The cell is cut into triangles (generator, corner, next corner), each integrated by the midpoints of
! its sides. The walk starts at the neighbour with the smallest number, so that the sums do not depend
! on where the list of k happens to start.
      subroutine centroid_of_cell(k, cx, cy, cz, energy)
      integer, intent(in) :: k
      real(dp), intent(out) :: cx, cy, cz
      real(dp), intent(inout) :: energy
      integer :: lp, lp_first, this, next, side
      real(dp) :: g(3), a(3), b(3), c(3), p(3), s(3), mass, area, r
      lp = lend(k)
      lp_first = lp
      do
        lp = lptr(lp)
        if (list(lp) < list(lp_first)) lp_first = lp
        if (lp == lend(k)) exit
      end do

      g = (/ x(k), y(k), z(k) /)
      s = 0
      lp = lp_first
      do
        this = listc(lp)
        lp = lptr(lp)
        next = listc(lp)
        a = (/ xc(this), yc(this), zc(this) /)
        b = (/ xc(next), yc(next), zc(next) /)
        c = cross(a - g, b - g)
        area = 0.5_dp * sqrt(c(1)**2 + c(2)**2 + c(3)**2)
        do side = 1, 3
          if (side == 1) p = 0.5_dp * (g + a)
          if (side == 2) p = 0.5_dp * (a + b)
          if (side == 3) p = 0.5_dp * (b + g)
          mass = density(p) * area / 3
          s = s + mass * p
          energy = energy + mass * ((p(1)-g(1))**2 + (p(2)-g(2))**2 + (p(3)-g(3))**2)
        end do
        if (lp == lp_first) exit
      end do
      r = sqrt(s(1)**2 + s(2)**2 + s(3)**2)
      cx = s(1) / r
      cy = s(2) / r
      cz = s(3) / r
      end subroutine centroid_of_cell

      function cross(a, b) result(c)
      real(dp), intent(in) :: a(3), b(3)
      real(dp) :: c(3)
      c = (/ a(2)*b(3) - a(3)*b(2), a(3)*b(1) - a(1)*b(3), a(1)*b(2) - a(2)*b(1) /)
      end function cross

! uniform: 1. bump: fine around longitude 0, latitude 30 degrees (mesh width 1/3 of that elsewhere).
      function density(p) result(rho)
      real(dp), intent(in) :: p(3)
      real(dp) :: rho, distance, pi
      rho = 1
      if (density_name == 'uniform') return
      pi = acos(-1.0_dp)
      distance = acos(min(1.0_dp, (p(1)*cos(pi/6) + p(3)*sin(pi/6)) / sqrt(p(1)**2 + p(2)**2 + p(3)**2)))
      rho = (1 + 2 * 0.5_dp * (1 + tanh((pi/6 - distance) / (pi/18))))**4
      end function density

! Random points, uniform on the sphere, from a generator of our own: the same on every machine.
      subroutine make_generators
      integer(long) :: seed
      integer :: k
      real(dp) :: longitude, r
      seed = 42
      do k = 1, n
        z(k) = 2 * uniform(seed) - 1
        longitude = 2 * acos(-1.0_dp) * uniform(seed)
        r = sqrt((1 - z(k)) * (1 + z(k)))
        x(k) = r * cos(longitude)
        y(k) = r * sin(longitude)
      end do
      end subroutine make_generators

! Park and Miller: seed = 16807 seed mod 2**31-1.
      function uniform(seed) result(u)
      integer(long), intent(inout) :: seed
      real(dp) :: u
      seed = mod(16807_long * seed, 2147483647_long)
      u = real(seed, dp) / 2147483647.0_dp
      end function uniform

      subroutine read_generators
      character(len=512) :: line
      integer :: pass
      real(dp) :: r
      open (newunit=lun, file=generator_file, status='old', action='read', iostat=istat)
      if (istat /= 0) call fail('cannot read ' // trim(generator_file))
      do pass = 1, 2
        n = 0
        do
          read (lun, '(a)', iostat=istat) line
          if (istat /= 0) exit
          if (line == ' ') cycle
          n = n + 1
          if (pass == 1) cycle
          read (line, *, iostat=istat) x(n), y(n), z(n)
          r = 0
          if (istat == 0) r = sqrt(x(n)**2 + y(n)**2 + z(n)**2)
          if (.not. (r > 0 .and. r <= huge(r))) then
            write (0, '(3a,i0,a)') 'scvt: ', trim(generator_file), ': generator ', n, ': expected x y z, not all 0'
            stop 1
          end if
          x(n) = x(n) / r
          y(n) = y(n) / r
          z(n) = z(n) / r
        end do
        if (pass == 1) allocate (x(n), y(n), z(n))
        rewind (lun)
      end do
      close (lun)
      end subroutine read_generators

      subroutine write_mesh
      call create('_points.txt')
      do k = 1, n
        write (lun, '(3es25.16e3)') x(k), y(k), z(k)
      end do
      close (lun)
      call create('_triangles.txt')
      do k = 1, nt
        write (lun, '(3(1x,i0))') ltri(1:3,k)
      end do
      close (lun)
      end subroutine write_mesh

      subroutine create(suffix)
      character(len=*), intent(in) :: suffix
      open (newunit=lun, file=trim(prefix)//suffix, status='replace', action='write', iostat=istat)
      if (istat /= 0) call fail('cannot write ' // trim(prefix) // suffix)
      end subroutine create

! A line on stderr every ten seconds.
      subroutine progress
      integer(long) :: now
      call system_clock(now, clock_rate)
      if (now - clock_progress < 10 * clock_rate) return
      clock_progress = now
      write (0, '(a,i0,a,i0,a,f8.1,a)') 'scvt: ', iteration, ' of ', iterations, ' iterations done,', seconds, &
            ' s in trmesh'
      end subroutine progress

      subroutine read_arguments
      character(len=256) :: option, value
      integer :: i
      n = 10242
      iterations = 10
      density_name = 'uniform'
      prefix = 'scvt'
      generator_file = ' '
      if (mod(command_argument_count(), 2) /= 0) call usage
      do i = 1, command_argument_count(), 2
        call get_command_argument(i, option)
        call get_command_argument(i + 1, value)
        istat = 0
        select case (option)
        case ('-n')
          read (value, *, iostat=istat) n
        case ('-i')
          read (value, *, iostat=istat) iterations
        case ('-d')
          density_name = value
        case ('-o')
          prefix = value
        case ('-f')
          generator_file = value
        case default
          call usage
        end select
        if (istat /= 0) call fail('not a number: ' // trim(option) // ' ' // trim(value))
      end do
      if (n < 4) call fail('-n must be at least 4')
      if (iterations < 0) call fail('-i must not be negative')
      if (density_name /= 'uniform' .and. density_name /= 'bump') &
        call fail('unknown density ' // trim(density_name) // ': uniform or bump')
      end subroutine read_arguments

      subroutine usage
      call fail('usage: scvt [-n GENERATORS | -f FILE] [-i ITERATIONS] [-d uniform|bump] [-o PREFIX]')
      end subroutine usage

      subroutine fail_with_code(routine, code)
      character(len=*), intent(in) :: routine
      integer, intent(in) :: code
      write (0, '(3a,i0)') 'scvt: ', routine, ' returned IER = ', code
      stop 1
      end subroutine fail_with_code

      subroutine fail(message)
      character(len=*), intent(in) :: message
      write (0, '(2a)') 'scvt: ', message
      stop 1
      end subroutine fail

      end program scvt
