! Centroidal tessellations by the module pstripack: the bits of the C API.
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

  subroutine bump_for_c(n, xyz, values, user) bind(c)
    integer(c_int32_t), value :: n
    real(c_double), intent(in) :: xyz(3, n)
    real(c_double), intent(inout) :: values(n)
    type(c_ptr), value :: user
    values = bump(xyz(1, :), xyz(2, :), xyz(3, :))
    if (c_associated(user)) error stop "no user data"
  end subroutine

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
  ! The C functions as in pstripack.h.
  type, bind(c) :: density_of_c
    type(c_funptr) :: at
    type(c_ptr) :: user = c_null_ptr
    integer(c_int32_t) :: any_thread = 0
  end type
  type, bind(c) :: options_of_c
    integer(c_int64_t) :: bytes
    integer(c_int32_t) :: start = 0, method = 0
    real(c_double) :: tolerance = 0
    integer(c_int64_t) :: most_evaluations = 0, seed = 0
    type(c_funptr) :: progress = c_null_funptr
    type(c_ptr) :: user = c_null_ptr
    integer(c_int32_t) :: widths = 0, well_centred = 0
  end type
  interface
    function c_scvt(n, x, y, z, density, options, result, message, length) result(ier) bind(c, name="pstripack_scvt")
      import
      integer(c_int32_t), value :: n, length
      real(c_double), intent(inout) :: x(*), y(*), z(*)
      type(density_of_c), intent(in), optional :: density
      type(options_of_c), intent(in), optional :: options
      type(pstripack_scvt_result), intent(inout) :: result
      type(c_ptr), value :: message
      integer(c_int32_t) :: ier
    end function
    function c_step(n, x, y, z, list, lptr, lend, density, xc, yc, zc, mass, energy, message, length) result(ier) &
        bind(c, name="pstripack_scvt_step")
      import
      integer(c_int32_t), value :: n, length
      real(c_double), intent(in) :: x(*), y(*), z(*)
      integer(c_int32_t), intent(in) :: list(*), lptr(*), lend(*)
      type(density_of_c), intent(in), optional :: density
      real(c_double), intent(inout) :: xc(*), yc(*), zc(*), mass(*), energy
      type(c_ptr), value :: message
      integer(c_int32_t) :: ier
    end function
  end interface

  integer, parameter :: n = 500
  real(c_double) :: x(n), y(n), z(n), x_of_c(n), y_of_c(n), z_of_c(n), p(3), energy, energy_of_c
  real(c_double), dimension(n) :: xc, yc, zc, mass, xc_of_c, yc_of_c, zc_of_c, mass_of_c
  integer(c_int32_t) :: list(6*n), lptr(6*n), lend(n), lnew, ier
  type(density_of_c) :: density
  type(options_of_c) :: c_options
  type(pstripack_scvt_options) :: options
  type(pstripack_scvt_result) :: found, expected
  character(len=120) :: message
  integer :: k

  density%at = c_funloc(bump_for_c)
  c_options%bytes = c_sizeof(c_options)

  ! Without options.
  ier = c_scvt(12, x_of_c, y_of_c, z_of_c, result=expected, message=c_null_ptr, length=0)
  call expect(ier == 0, "C, defaults")
  call pstripack_scvt(x(:12), y(:12), z(:12), found, ier, message=message)
  call expect(ier == pstripack_ok .and. message == "", "defaults")
  call expect(all(x(:12) == x_of_c(:12)) .and. same(found, expected), "defaults: same bits")
  call expect(found%reason == pstripack_scvt_converged .and. found%gradient <= 1e-5_c_double, "defaults: converged")

  ! A density, by one thread and by several.
  c_options%tolerance = 1e-2_c_double
  options%tolerance = 1e-2_c_double
  ier = c_scvt(n, x_of_c, y_of_c, z_of_c, density, c_options, expected, c_null_ptr, 0)
  call expect(ier == 0, "C, density")
  call pstripack_scvt(x, y, z, found, ier, bump_for_fortran, options)
  call expect(ier == 0 .and. same_generators() .and. same(found, expected), "density")
  call expect(calls > 20, "the density is called in batches")
  options%density_on_threads = .true.
  x = 0
  call pstripack_scvt(x, y, z, found, ier, bump_on_threads, options)
  call expect(ier == 0 .and. same_generators() .and. same(found, expected), "density on threads")

  ! From generators, by Lloyd's method, random ones; a progress procedure.
  do k = 1, n
    p = direction()
    x(k) = 2*p(1)
    y(k) = 2*p(2)
    z(k) = 2*p(3)
  end do
  x_of_c = x
  y_of_c = y
  z_of_c = z
  c_options = options_of_c(c_sizeof(c_options), pstripack_scvt_given, pstripack_scvt_lloyd, 0, 7_c_int64_t, 3_c_int64_t)
  options = pstripack_scvt_options(start=pstripack_scvt_given, method=pstripack_scvt_lloyd, most_evaluations=7, seed=3)
  ier = c_scvt(n, x_of_c, y_of_c, z_of_c, density, c_options, expected, c_null_ptr, 0)
  steps = 0
  call pstripack_scvt(x, y, z, found, ier, bump_for_fortran, options, progress)
  call expect(ier == 0 .and. same_generators() .and. same(found, expected), "from generators")
  call expect(found%reason == pstripack_scvt_evaluations .and. found%evaluations == 7, "from generators: 7 evaluations")
  call expect(steps == 6 .and. last%generators == n .and. last%evaluations == 7, "progress")
  call expect(last%energy == found%energy .and. last%gradient == found%gradient, "progress: the result's")
  options%start = pstripack_scvt_random
  steps = -2
  call pstripack_scvt(x, y, z, found, ier, options=options, progress=progress)
  call expect(ier == 0 .and. found%reason == pstripack_scvt_stopped .and. last%evaluations == 3, "stopped")

  ! Widths in place of a density.
  c_options = options_of_c(c_sizeof(c_options), tolerance=1e-2_c_double, widths=1, well_centred=1)
  ier = c_scvt(n, x_of_c, y_of_c, z_of_c, density, c_options, expected, c_null_ptr, 0)
  call expect(ier == 0, "C, widths")
  options = pstripack_scvt_options(tolerance=1e-2_c_double)
  call pstripack_scvt_widths(x, y, z, found, ier, bump_for_fortran, options, well_centred=.true., message=message)
  call expect(ier == 0 .and. message == "" .and. same_generators() .and. same(found, expected), "widths")
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

  ! One step.
  call pstripack_trmesh(x, y, z, list, lptr, lend, lnew, ier)
  call expect(ier == 0, "trmesh")
  ier = c_step(n, x, y, z, list, lptr, lend, density, xc_of_c, yc_of_c, zc_of_c, mass_of_c, energy_of_c, c_null_ptr, 0)
  call expect(ier == 0, "C, step")
  call pstripack_scvt_step(x, y, z, list, lptr, lend, xc, yc, zc, mass, energy, ier, bump_for_fortran, message=message)
  call expect(ier == 0 .and. message == "" .and. same_step(), "step")
  xc = 0
  call pstripack_scvt_step(x, y, z, list, lptr, lend, xc, yc, zc, mass, energy, ier, bump_on_threads, .true.)
  call expect(ier == 0 .and. same_step(), "step, density on threads")
  call pstripack_scvt_step(x, y, z, list, lptr, lend, xc, yc, zc, mass, energy, ier)
  call expect(ier == 0, "step, density 1")
  call expect(abs(sum(mass) - 16*atan(1._c_double)) < 1e-5_c_double, "the masses of density 1 are the sphere's area")

  ! Errors write nothing but the message.
  x_of_c = x
  expected = found
  options%start = 9
  call pstripack_scvt(x, y, z, found, ier, options=options, message=message)
  call expect(ier == pstripack_bad_option .and. index(message, "start") > 0, "a bad option")
  options%start = pstripack_scvt_by_number
  call pstripack_scvt(x, y, z, found, ier, negative, options, message=message)
  call expect(ier == pstripack_bad_density .and. index(message, "lon ") > 0, "a bad density: "//message)
  call pstripack_scvt(x(:3), y(:3), z(:3), found, ier, message=message)
  call expect(ier == pstripack_too_few_nodes .and. index(message, "at least 4") > 0, "three generators")
  call pstripack_scvt(x, y(2:), z, found, ier, message=message)
  call expect(ier == pstripack_bad_size .and. index(message, "sizes") > 0, "y too short")
  call expect(all(x == x_of_c) .and. same(found, expected), "errors write nothing")
  xc_of_c = xc
  energy_of_c = energy
  call pstripack_scvt_step(x, y, z, list, lptr, lend, xc, yc, zc, mass, energy, ier, negative, message=message)
  call expect(ier == pstripack_bad_density .and. index(message, "lon ") > 0, "step: a bad density")
  call pstripack_scvt_step(x, y, z, list, lptr, lend, xc(2:), yc, zc, mass, energy, ier, message=message)
  call expect(ier == pstripack_bad_size .and. index(message, "sizes") > 0, "step: xc too short")
  list(1) = 0
  call pstripack_scvt_step(x, y, z, list, lptr, lend, xc, yc, zc, mass, energy, ier, message=message)
  call expect(ier == pstripack_bad_lists .and. message /= "", "step: broken lists")
  call expect(all(xc == xc_of_c) .and. energy == energy_of_c, "step: errors write nothing")

contains

  logical function same(a, b)
    type(pstripack_scvt_result), intent(in) :: a, b
    same = a%energy == b%energy .and. a%gradient == b%gradient .and. a%evaluations == b%evaluations .and. &
           a%generators == b%generators .and. a%reason == b%reason
  end function

  logical function same_generators()
    same_generators = all(x == x_of_c .and. y == y_of_c .and. z == z_of_c)
  end function

  logical function same_step()
    same_step = all(xc == xc_of_c .and. yc == yc_of_c .and. zc == zc_of_c .and. mass == mass_of_c) .and. &
                energy == energy_of_c
  end function
end program
