! SCVT_DENSITY: a centroidal mesh that is finer along a storm's track, by pstripack_scvt with a density procedure.
!
!   scvt_density [GENERATORS [TOLERANCE]]
!
! Writes scvt_density_points.txt (x y z a line) and prints how the run went and how wide the cells are.
!
! $ gfortran scvt_density.f90 -o scvt_density $(pkg-config --cflags --libs pstripack_fortran)
module storm
  use, intrinsic :: iso_c_binding, only: c_double, c_int32_t, c_int64_t
  use pstripack, only: pstripack_scvt_progress
  implicit none
  private
  public :: density, progress

  real(c_double), parameter :: degree = acos(-1._c_double)/180
  ! Longitude and latitude of the track.
  real(c_double), parameter :: track(2, 6) = reshape([-75.0_c_double, 23.0_c_double, -79.0_c_double, 25.5_c_double, &
    -84.0_c_double, 25.0_c_double, -88.0_c_double, 26.5_c_double, -89.5_c_double, 29.0_c_double, &
    -88.5_c_double, 33.0_c_double], [2, 6])
  real(c_double), parameter :: radius = 8*degree, transition = 12*degree, finer = 4

contains

  ! The density at many places. Cells are about density**(-1/4) wide: `finer` times narrower within the radius of the
  ! track. Called in the thread that calls pstripack_scvt, unless pstripack_scvt_options sets density_on_threads.
  subroutine density(n, xyz, values)
    integer(c_int32_t), intent(in) :: n
    real(c_double), intent(in) :: xyz(3, n)
    real(c_double), intent(out) :: values(n)
    real(c_double) :: nearest, step
    integer :: i, k
    do i = 1, n
      nearest = -1
      do k = 1, size(track, 2)
        nearest = max(nearest, dot_product(xyz(:, i), place(track(:, k))))
      end do
      step = (acos(min(1._c_double, nearest)) - radius)/transition
      step = max(0._c_double, min(1._c_double, step))
      step = step*step*(3 - 2*step)  ! smooth, from 0 near the track to 1 far from it
      values(i) = (finer + (1 - finer)*step)**4
    end do
  end subroutine

  pure function place(lon_lat)
    real(c_double), intent(in) :: lon_lat(2)
    real(c_double) :: place(3)
    place = [cos(degree*lon_lat(2))*cos(degree*lon_lat(1)), cos(degree*lon_lat(2))*sin(degree*lon_lat(1)), &
             sin(degree*lon_lat(2))]
  end function

  ! Called after each step. stop = .true. would end the run.
  subroutine progress(where, stop)
    type(pstripack_scvt_progress), intent(in) :: where
    logical, intent(inout) :: stop
    if (mod(where%evaluations, 20_c_int64_t) == 0) &
      print '(i10, a, i5, a, es9.2)', where%generators, ' generators, evaluation', where%evaluations, &
      ', gradient', where%gradient
    stop = .false.
  end subroutine
end module

program scvt_density
  use, intrinsic :: iso_c_binding, only: c_double, c_int32_t
  use, intrinsic :: iso_fortran_env, only: error_unit
  use pstripack
  use storm
  implicit none
  integer(c_int32_t) :: n = 2562, ier, lnew
  real(c_double), allocatable :: x(:), y(:), z(:), xc(:), yc(:), zc(:), mass(:)
  integer(c_int32_t), allocatable :: list(:), lptr(:), lend(:)
  type(pstripack_scvt_options) :: options
  type(pstripack_scvt_result) :: run
  real(c_double) :: energy
  character(len=200) :: message
  integer :: k, file

  options%tolerance = 1e-4_c_double
  if (command_argument_count() > 0) then
    call get_command_argument(1, message)
    read (message, *) n
  end if
  if (command_argument_count() > 1) then
    call get_command_argument(2, message)
    read (message, *) options%tolerance
  end if

  allocate (x(n), y(n), z(n))
  call pstripack_scvt(x, y, z, run, ier, density, options, progress, message)
  call check
  print '(a, i0, a, f0.1, a, es9.2, a, es22.15)', 'ended for reason ', run%reason, ' after ', run%evaluations, &
    ' evaluations: gradient', run%gradient, ', energy', run%energy

  ! The areas of the cells are their masses with density 1.
  allocate (list(6*n - 12), lptr(6*n - 12), lend(n), xc(n), yc(n), zc(n), mass(n))
  call pstripack_trmesh(x, y, z, list, lptr, lend, lnew, ier)
  message = pstripack_strerror(ier)
  call check
  call pstripack_scvt_step(x, y, z, list, lptr, lend, xc, yc, zc, mass, energy, ier, message=message)
  call check
  print '(i0, a, f7.1, a, f7.1, a)', n, ' cells, from', 6371*sqrt(minval(mass)), ' to', 6371*sqrt(maxval(mass)), &
    ' km wide'

  open (newunit=file, file='scvt_density_points.txt', action='write')
  do k = 1, n
    write (file, '(3es25.16e3)') x(k), y(k), z(k)
  end do
  close (file)

contains

  subroutine check
    if (ier == pstripack_ok) return
    write (error_unit, '(2a)') 'scvt_density: ', trim(message)
    stop 1, quiet=.true.
  end subroutine
end program
