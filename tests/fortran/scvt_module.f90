! Centroidal tessellations by the module pstripack: every option, result and error passes through the interface.
module procedures
  use, intrinsic :: iso_c_binding
  use pstripack, only: pstripack_scvt_progress
  implicit none
  integer :: calls = 0, steps
  type(pstripack_scvt_progress) :: last

contains

  elemental real(c_double) function bump(x, y, z)
    real(c_double), intent(in) :: x, y, z
    bump = 1 + 80*exp(10*(0.6_c_double*y + 0.8_c_double*z - 1)) + 0*x
  end function

  ! A procedure with state, as in many old codes: it must be called by one thread only.
  subroutine bump_for_fortran(n, xyz, values)
    integer(c_int32_t), intent(in) :: n
    real(c_double), intent(in) :: xyz(3, n)
    real(c_double), intent(out) :: values(n)
    calls = calls + 1
    values = bump(xyz(1, :), xyz(2, :), xyz(3, :))
  end subroutine

  subroutine bump_on_threads(n, xyz, values)
    integer(c_int32_t), intent(in) :: n
    real(c_double), intent(in) :: xyz(3, n)
    real(c_double), intent(out) :: values(n)
    values = bump(xyz(1, :), xyz(2, :), xyz(3, :))
  end subroutine

  subroutine two(n, xyz, values)
    integer(c_int32_t), intent(in) :: n
    real(c_double), intent(in) :: xyz(3, n)
    real(c_double), intent(out) :: values(n)
    values = 2 + 0*xyz(1, :)
  end subroutine

  subroutine negative(n, xyz, values)
    integer(c_int32_t), intent(in) :: n
    real(c_double), intent(in) :: xyz(3, n)
    real(c_double), intent(out) :: values(n)
    values = xyz(1, :)
  end subroutine

  subroutine progress(where, stop)
    type(pstripack_scvt_progress), intent(in) :: where
    logical, intent(inout) :: stop
    last = where
    steps = steps + 1
    stop = steps == 0
  end subroutine
end module

program scvt_module
  use, intrinsic :: iso_c_binding
  use pstripack
  use procedures
  use expectations
  use random_points
  implicit none
  integer, parameter :: n = 500
  real(c_double) :: x(n), y(n), z(n), start(n, 3), before(n, 3), p(3), energy, energy_before
  real(c_double), dimension(n) :: xc, yc, zc, mass, xc_before, mass_before
  integer(c_int32_t) :: list(6*n), lptr(6*n), lend(n), lnew, ier
  type(pstripack_scvt_options) :: options
  type(pstripack_scvt_result) :: found, expected
  character(len=120) :: message
  integer :: k

  ! Without options.
  call pstripack_scvt(x(:12), y(:12), z(:12), found, ier, message=message)
  call expect(ier == pstripack_ok .and. message == "", "defaults")
  call expect(found%reason == pstripack_scvt_converged .and. found%gradient <= 1e-5_c_double, "defaults: converged")
  call expect(found%generators == 12, "defaults: generators")

  ! A density, by one thread and by several.
  options%tolerance = 1e-2_c_double
  call pstripack_scvt(x, y, z, expected, ier, bump_for_fortran, options)
  call expect(ier == 0 .and. expected%reason == pstripack_scvt_converged, "density")
  call expect(expected%gradient > 1e-4_c_double .and. expected%gradient <= 1e-2_c_double, "density: the tolerance")
  call expect(calls > 20, "the density is called in batches")
  call expect(count(0.6_c_double*y + 0.8_c_double*z > 0.9_c_double) > 62, "many generators are in the bump")
  before = reshape([x, y, z], [n, 3])
  options%density_on_threads = .true.
  x = 0
  call pstripack_scvt(x, y, z, found, ier, bump_on_threads, options)
  call expect(ier == 0 .and. same_generators() .and. same(found, expected), "density on threads")

  ! From generators, by Lloyd's method, random ones; a progress procedure.
  do k = 1, n
    p = direction()
    start(k, :) = 2*p
  end do
  call set_generators(start)
  options = pstripack_scvt_options(start=pstripack_scvt_given, most_evaluations=7)
  call pstripack_scvt(x, y, z, expected, ier, bump_for_fortran, options)
  call set_generators(start)
  options%method = pstripack_scvt_lloyd
  call pstripack_scvt(x, y, z, found, ier, bump_for_fortran, options, progress)
  call expect(ier == 0 .and. found%energy > expected%energy, "from generators: Lloyd's method is slower")
  call expect(maxval(abs(reshape([x, y, z], [n, 3]) - start/2)) < 0.6, "from generators: each stays near its place")
  call expect(found%reason == pstripack_scvt_evaluations .and. found%evaluations == 7, "from generators: 7 evaluations")
  call expect(steps == 6 .and. last%generators == n .and. last%evaluations == 7, "progress")
  call expect(last%energy == found%energy .and. last%gradient == found%gradient, "progress: the result's")
  options%start = pstripack_scvt_random
  options%seed = 3
  steps = -2
  call pstripack_scvt(x, y, z, found, ier, options=options, progress=progress)
  call expect(ier == 0 .and. found%reason == pstripack_scvt_stopped .and. last%evaluations == 3, "stopped")
  before = reshape([x, y, z], [n, 3])
  do k = 3, 4
    options%seed = k
    steps = -2
    call pstripack_scvt(x, y, z, found, ier, options=options, progress=progress)
    call expect(ier == 0 .and. (same_generators() .eqv. k == 3), "the seed")
  end do

  ! Widths in place of a density.
  options = pstripack_scvt_options(tolerance=1e-2_c_double)
  call pstripack_scvt_widths(x, y, z, found, ier, bump_for_fortran, options, well_centred=.true., message=message)
  call expect(ier == 0 .and. message == "" .and. found%reason == pstripack_scvt_not_well_centred, "widths")
  call expect(count(0.6_c_double*y + 0.8_c_double*z > 0.9_c_double) < 12, "few generators are where cells are wide")
  options%widths = .false.
  options%well_centred = .false.
  call pstripack_scvt_widths(x, y, z, found, ier, negative, options, message=message)
  call expect(ier == pstripack_bad_density .and. index(message, "the width is ") == 1, "a bad width: "//message)
  call pstripack_scvt_cells(two, 100._c_double, energy, ier, message)
  call expect(ier == 0 .and. message == "" .and. abs(energy/36275.987284684357_c_double - 1) < 1e-9_c_double, "cells")
  call pstripack_scvt_cells(negative, 100._c_double, energy, ier, message)
  call expect(ier == pstripack_bad_density .and. index(message, "the width is ") == 1, "cells: a bad width")
  call pstripack_scvt_cells(two, -1._c_double, energy, ier, message)
  call expect(ier == pstripack_bad_option .and. index(message, "radius") > 0, "cells: a bad radius")

  ! One step, with the density of one thread and with that of several, is one of Lloyd's method.
  call pstripack_trmesh(x, y, z, list, lptr, lend, lnew, ier)
  call expect(ier == 0, "trmesh")
  call pstripack_scvt_step(x, y, z, list, lptr, lend, xc, yc, zc, mass, energy, ier, bump_for_fortran, message=message)
  call expect(ier == 0 .and. message == "" .and. all(abs(xc**2 + yc**2 + zc**2 - 1) < 1e-14), "step")
  energy_before = energy
  xc_before = xc
  mass_before = mass
  call pstripack_scvt_step(x, y, z, list, lptr, lend, xc, yc, zc, mass, energy, ier, bump_on_threads, .true.)
  call expect(ier == 0 .and. all(xc == xc_before .and. mass == mass_before) .and. energy == energy_before, &
              "step, density on threads")
  start = reshape([x, y, z], [n, 3])
  options = pstripack_scvt_options(start=pstripack_scvt_given, method=pstripack_scvt_lloyd, most_evaluations=2)
  call pstripack_scvt(x, y, z, found, ier, bump_for_fortran, options)
  call expect(ier == 0 .and. all(x == xc .and. y == yc .and. z == zc), "step: that of Lloyd's method")
  call set_generators(start)
  call pstripack_scvt_step(x, y, z, list, lptr, lend, xc, yc, zc, mass, energy, ier)
  call expect(ier == 0, "step, density 1")
  call expect(abs(sum(mass) - 16*atan(1._c_double)) < 1e-5_c_double, "the masses of density 1 are the sphere's area")

  ! Errors write nothing but the message.
  before = start
  expected = found
  options = pstripack_scvt_options(start=9)
  call pstripack_scvt(x, y, z, found, ier, options=options, message=message)
  call expect(ier == pstripack_bad_option .and. index(message, "start") > 0, "a bad option")
  options%start = pstripack_scvt_by_number
  call pstripack_scvt(x, y, z, found, ier, negative, options, message=message)
  call expect(ier == pstripack_bad_density .and. index(message, "lon ") > 0, "a bad density: "//message)
  call pstripack_scvt(x(:3), y(:3), z(:3), found, ier, message=message)
  call expect(ier == pstripack_too_few_nodes .and. index(message, "at least 4") > 0, "three generators")
  call pstripack_scvt(x, y(2:), z, found, ier, message=message)
  call expect(ier == pstripack_bad_size .and. index(message, "sizes") > 0, "y too short")
  call expect(same_generators() .and. same(found, expected), "errors write nothing")
  xc_before = xc
  energy_before = energy
  call pstripack_scvt_step(x, y, z, list, lptr, lend, xc, yc, zc, mass, energy, ier, negative, message=message)
  call expect(ier == pstripack_bad_density .and. index(message, "lon ") > 0, "step: a bad density")
  call pstripack_scvt_step(x, y, z, list, lptr, lend, xc(2:), yc, zc, mass, energy, ier, message=message)
  call expect(ier == pstripack_bad_size .and. index(message, "sizes") > 0, "step: xc too short")
  list(1) = 0
  call pstripack_scvt_step(x, y, z, list, lptr, lend, xc, yc, zc, mass, energy, ier, message=message)
  call expect(ier == pstripack_bad_lists .and. message /= "", "step: broken lists")
  call expect(all(xc == xc_before) .and. energy == energy_before, "step: errors write nothing")

contains

  logical function same(a, b)
    type(pstripack_scvt_result), intent(in) :: a, b
    same = a%energy == b%energy .and. a%gradient == b%gradient .and. a%evaluations == b%evaluations .and. &
           a%generators == b%generators .and. a%reason == b%reason
  end function

  logical function same_generators()
    same_generators = all(reshape([x, y, z], [n, 3]) == before)
  end function

  subroutine set_generators(xyz)
    real(c_double), intent(in) :: xyz(n, 3)
    x = xyz(:, 1)
    y = xyz(:, 2)
    z = xyz(:, 3)
  end subroutine
end program
