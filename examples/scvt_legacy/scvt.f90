! SCVT: generators of a spherical centroidal Voronoi tessellation by Lloyd's method.
!
! Each iteration triangulates the generators (TRMESH), takes the circumcentres of the triangles as the
! corners of the Voronoi cells, and moves every generator to the centroid of its cell. At the end TRLIST
! lists the triangles.
!
!   scvt [-n GENERATORS | -f FILE] [-i ITERATIONS] [-d uniform|bump] [-o PREFIX]
!
! Writes PREFIX_points.txt (x y z a line) and PREFIX_triangles.txt (three node numbers a line), and prints
! where the time went.

      program scvt
      implicit none
      integer, parameter :: dp = selected_real_kind(15), long = selected_int_kind(18)
      integer, parameter :: nrow = 9
      real(dp), parameter :: pi = 3.14159265358979323846_dp

! The parts of the program that are timed.
      integer, parameter :: in_trmesh = 1, in_lists = 2, in_centroids = 3, in_output = 4
      character(len=9), parameter :: part(4) = (/ 'trmesh   ', 'lists    ', 'centroids', 'output   ' /)

      integer :: n, iterations, iteration, k, nt, ier, lnew, lun, istat
      character(len=256) :: generator_file, density_name, prefix
      logical :: uniform
      real(dp) :: energy, move, seconds(4)
      integer(long) :: clock, clock_rate, clock_progress

      real(dp), allocatable :: x(:), y(:), z(:), xnew(:), ynew(:), znew(:)
      real(dp), allocatable :: dist(:)
      integer, allocatable :: list(:), lptr(:), lend(:), iwk(:), ltri(:,:)

      external trmesh, trlist

      call read_arguments
      if (generator_file /= ' ') then
        call read_generators
      else
        allocate (x(n), y(n), z(n))
        call make_generators
      end if
      if (n < 4) call fail('an SCVT needs at least 4 generators')

      allocate (xnew(n), ynew(n), znew(n), dist(n), iwk(2*n), lend(n))
      allocate (list(6*n-12), lptr(6*n-12), ltri(nrow,2*n-4), stat=istat)
      if (istat /= 0) call fail('out of memory')

      print '(a,i0,3a,i0)', 'SCVT: generators ', n, ', density ', trim(density_name), ', iterations ', iterations
      print '(a10,2a24)', 'iteration', 'energy', 'largest move'

      seconds = 0
      call system_clock(clock, clock_rate)
      clock_progress = clock
      do iteration = 1, iterations
        call triangulate
        call centroids(n, x, y, z, list, lptr, lend, xnew, ynew, znew, energy)
        move = 0
        do k = 1, n
          move = max(move, (xnew(k)-x(k))**2 + (ynew(k)-y(k))**2 + (znew(k)-z(k))**2)
        end do
        move = sqrt(move)
        x = xnew
        y = ynew
        z = znew
        call time_goes_to(in_centroids)
        print '(i10,2es24.15)', iteration, energy, move
        call progress
        call time_goes_to(in_output)
      end do

      call triangulate
      call trlist(n, list, lptr, lend, nrow, nt, ltri, ier)
      if (ier /= 0) call fail_with_code('trlist', ier)
      call time_goes_to(in_lists)
      call write_mesh
      call time_goes_to(in_output)
      do k = 1, 4
        print '(a,f12.6)', 'seconds in ' // part(k), seconds(k)
      end do
      print '(a,i0,5a)', 'wrote ', nt, ' triangles: ', trim(prefix), '_points.txt and ', trim(prefix), '_triangles.txt'

      contains

! TRMESH with the workspace of legacy codes: NEAR and NEXT are halves of one array.
      subroutine triangulate
      call trmesh(n, x, y, z, list, lptr, lend, lnew, iwk, iwk(n+1), dist, ier)
      if (ier == -2) call fail('the first three generators lie on one great circle; change their order')
      if (ier > 0) then
        write (0, '(a,i0,a)') 'scvt: generator ', ier, ' occurs twice'
        stop 1
      end if
      if (ier /= 0) call fail_with_code('trmesh', ier)
      call time_goes_to(in_trmesh)
      end subroutine triangulate

! Adds the time since the last call to the time of a part of the program.
      subroutine time_goes_to(i)
      integer, intent(in) :: i
      integer(long) :: now
      call system_clock(now)
      seconds(i) = seconds(i) + real(now - clock, dp) / real(clock_rate, dp)
      clock = now
      end subroutine time_goes_to

! The mass centroids of the Voronoi cells, back on the sphere, and the energy of all cells.
!
! The corners of the cell of generator g are the circumcentres of the triangles (g, neighbour e, next
! neighbour f). The cell is cut into triangles (g, corner a, next corner b), each integrated by the midpoints
! of its sides. e, f, a and b are relative to g; s is the moment of the cell about g. The walk starts at the
! neighbour with the smallest number, so that the sums do not depend on where the list of g starts. Each
! circumcentre is computed three times, once per generator; CRLIST takes longer.
      subroutine centroids(n, x, y, z, list, lptr, lend, xnew, ynew, znew, energy)
      integer, intent(in) :: n, list(*), lptr(*), lend(n)
      real(dp), intent(in) :: x(n), y(n), z(n)
      real(dp), intent(out) :: xnew(n), ynew(n), znew(n), energy
      real(dp), parameter :: sixth = 1.0_dp / 6
      integer :: i, j, k, lp, lp_first, corners
      real(dp) :: xg, yg, zg, xe, ye, ze, xf, yf, zf, xa, ya, za, xb, yb, zb, xs, ys, zs
      real(dp) :: mass, third, wa, wab, wb, r
      energy = 0
      do k = 1, n
        lp = lend(k)
        if (list(lp) < 0) call fail('the generators lie in one hemisphere; an SCVT needs the whole sphere')
        lp_first = lp
        corners = 1
        do
          lp = lptr(lp)
          if (lp == lend(k)) exit
          if (list(lp) < list(lp_first)) lp_first = lp
          corners = corners + 1
        end do

        xg = x(k)
        yg = y(k)
        zg = z(k)
        lp = lp_first
        j = list(lp)
        xf = x(j) - xg
        yf = y(j) - yg
        zf = z(j) - zg
        xb = 0
        yb = 0
        zb = 0
        wb = 0
        xs = 0
        ys = 0
        zs = 0
        mass = 0
! Step i = 0 only computes the first corner, b.
        do i = 0, corners
          xa = xb
          ya = yb
          za = zb
          wa = wb
          xe = xf
          ye = yf
          ze = zf
          lp = lptr(lp)
          j = list(lp)
          xf = x(j) - xg
          yf = y(j) - yg
          zf = z(j) - zg
          xb = ye*zf - ze*yf
          yb = ze*xf - xe*zf
          zb = xe*yf - ye*xf
          r = 1 / sqrt(xb**2 + yb**2 + zb**2)
          xb = xb*r - xg
          yb = yb*r - yg
          zb = zb*r - zg
          wb = density(xg + 0.5_dp*xb, yg + 0.5_dp*yb, zg + 0.5_dp*zb)
          if (i == 0) cycle
! A third of the triangle's area.
          third = sixth * sqrt((ya*zb - za*yb)**2 + (za*xb - xa*zb)**2 + (xa*yb - ya*xb)**2)
! The sums below, simplified for weights of 1.
          if (uniform) then
            mass = mass + 3*third
            xs = xs + 2*third * (xa+xb)
            ys = ys + 2*third * (ya+yb)
            zs = zs + 2*third * (za+zb)
            energy = energy + 0.5_dp * third * (xa**2 + ya**2 + za**2 + xb**2 + yb**2 + zb**2 &
                   + xa*xb + ya*yb + za*zb)
            cycle
          end if
          wab = density(xg + 0.5_dp*(xa+xb), yg + 0.5_dp*(ya+yb), zg + 0.5_dp*(za+zb))
          mass = mass + third * (wa + wab + wb)
          xs = xs + third * (wa*xa + wab*(xa+xb) + wb*xb)
          ys = ys + third * (wa*ya + wab*(ya+yb) + wb*yb)
          zs = zs + third * (wa*za + wab*(za+zb) + wb*zb)
          energy = energy + 0.25_dp * third * (wa * (xa**2 + ya**2 + za**2) + wb * (xb**2 + yb**2 + zb**2) &
                 + wab * ((xa+xb)**2 + (ya+yb)**2 + (za+zb)**2))
        end do
        xs = mass*xg + 0.5_dp*xs
        ys = mass*yg + 0.5_dp*ys
        zs = mass*zg + 0.5_dp*zs
        r = 1 / sqrt(xs**2 + ys**2 + zs**2)
        xnew(k) = xs*r
        ynew(k) = ys*r
        znew(k) = zs*r
      end do
      end subroutine centroids

! uniform: 1. bump: fine around longitude 0, latitude 30 degrees (mesh width 1/3 of that elsewhere).
      function density(x, y, z) result(rho)
      real(dp), intent(in) :: x, y, z
      real(dp), parameter :: cos_latitude = 0.86602540378443864676_dp, sin_latitude = 0.5_dp
      real(dp) :: rho, distance
      rho = 1
      if (uniform) return
      distance = acos(min(1.0_dp, (x*cos_latitude + z*sin_latitude) / sqrt(x**2 + y**2 + z**2)))
      rho = (1 + 2 * 0.5_dp * (1 + tanh((pi/6 - distance) / (pi/18))))**4
      end function density

! Random points, uniform on the sphere, the same on every machine.
      subroutine make_generators
      integer(long) :: seed
      integer :: k
      real(dp) :: longitude, r
      seed = 42
      do k = 1, n
        z(k) = 2 * random(seed) - 1
        longitude = 2 * pi * random(seed)
        r = sqrt((1 - z(k)) * (1 + z(k)))
        x(k) = r * cos(longitude)
        y(k) = r * sin(longitude)
      end do
      end subroutine make_generators

! Park and Miller: seed = 16807 seed mod 2**31-1.
      function random(seed) result(u)
      integer(long), intent(inout) :: seed
      real(dp) :: u
      seed = mod(16807_long * seed, 2147483647_long)
      u = real(seed, dp) / 2147483647.0_dp
      end function random

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

! Prints a line on stderr every ten seconds.
      subroutine progress
      integer(long) :: now
      call system_clock(now, clock_rate)
      if (now - clock_progress < 10 * clock_rate) return
      clock_progress = now
      write (0, '(a,i0,a,i0,a,f8.1,a)') 'scvt: ', iteration, ' of ', iterations, ' iterations done,', &
            seconds(in_trmesh), ' s in trmesh'
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
      uniform = density_name == 'uniform'
      if (.not. uniform .and. density_name /= 'bump') &
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
