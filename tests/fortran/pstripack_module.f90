! Module pstripack, the binding for new codes.
program pstripack_module
  use, intrinsic :: iso_c_binding, only: c_double, c_f_pointer, c_float, c_int32_t, c_int64_t, c_loc
  use pstripack
  use expectations
  use random_points
  implicit none
  integer, parameter :: n = 500, slots = 6*n - 12
  integer(c_int64_t), parameter :: too_many = 2_c_int64_t**31 + 100
  real(c_double), target :: x(n)
  real(c_double) :: y(n), z(n), p(3)
  real(c_double), pointer, contiguous :: many(:)
  integer(c_int32_t), target :: list(slots)
  integer(c_int32_t), pointer, contiguous :: many_slots(:)
  integer(c_int32_t) :: lptr(slots), lend(n), lnew, ier
  integer(c_int64_t) :: print_of_all
  character(len=200) :: message
  integer :: k

  call expect(len(pstripack_version()) >= 5 .and. index(pstripack_version(), ".") > 1, "version")
  do k = pstripack_bad_size, 3
    call expect(len(pstripack_strerror(int(k, c_int32_t))) > 0, "every code has a text")
    call expect(index(pstripack_strerror(int(k, c_int32_t)), new_line("a")) == 0, "every text is one line")
  end do
  do k = 1, n
    p = direction()
    x(k) = p(1)
    y(k) = p(2)
    z(k) = p(3)
  end do

  call pstripack_trmesh(x, y, z, list, lptr, lend, lnew, ier)
  call expect(ier == pstripack_ok .and. lnew == slots + 1, "trmesh, real64")
  call pstripack_release_memory()
  call expect(pstripack_validate(x, y, z, list, lptr, lend, lnew, message) == 0 .and. message == "", "validate")
  call expect(pstripack_validate(x, y, z, list, lptr, lend, 0_c_int32_t) == 0, "validate without LNEW and message")
  print_of_all = pstripack_fingerprint(list, lptr, lend)
  x(9) = -x(9)
  call expect(pstripack_validate(x, y, z, list, lptr, lend, lnew, message) > 0 .and. message /= "", "a moved node is found")
  call pstripack_trmesh(x, y, z, list, lptr, lend, lnew, ier)
  call expect(pstripack_fingerprint(list, lptr, lend) /= print_of_all, "another mesh, another fingerprint")

  print_of_all = pstripack_fingerprint(list, lptr, lend)
  call pstripack_delaunay(x, y, z, list, lptr, lend, lnew, ier)
  call expect(ier == pstripack_ok .and. lnew == slots + 1, "delaunay")
  call expect(pstripack_fingerprint(list, lptr, lend) == print_of_all, "directions of unit vectors far apart: the same mesh")
  call pstripack_delaunay(x, y, z, list, lptr, lend(2:), lnew, ier)
  call expect(ier == pstripack_bad_size, "delaunay: lend too short")

  call pstripack_trmesh(real(x, c_float), real(y, c_float), real(z, c_float), list, lptr, lend, lnew, ier)
  call expect(ier == pstripack_ok .and. lnew == slots + 1, "trmesh, real32")

  call pstripack_trmesh(x, y, z, list(2:), lptr, lend, lnew, ier)
  call expect(ier == pstripack_bad_size, "list too short")
  call pstripack_trmesh(x, y(2:), z, list, lptr, lend, lnew, ier)
  call expect(ier == pstripack_bad_size, "y too short")
  call expect(pstripack_validate(x, y, z, list, lptr, lend(2:), lnew) == pstripack_bad_size, "lend too short")
  call pstripack_trmesh(x(:2), y(:2), z(:2), list, lptr, lend, lnew, ier)
  call expect(ier == pstripack_too_few_nodes, "two nodes")
  call expect(pstripack_fingerprint(list(2:), lptr, lend) == 0, "fingerprint: list too short")

  ! More nodes than 32 bits count: nothing of them is read.
  call c_f_pointer(c_loc(x), many, [too_many])
  call c_f_pointer(c_loc(list), many_slots, [6*too_many])
  call pstripack_trmesh(many, many, many, many_slots, many_slots, many_slots, lnew, ier)
  call expect(ier == pstripack_too_many_nodes, "2**31 nodes")
  call expect(pstripack_validate(many, many, many, many_slots, many_slots, many_slots, lnew) == &
              pstripack_too_many_nodes, "validate: 2**31 nodes")
  call expect(pstripack_fingerprint(many_slots, many_slots, many_slots) == 0, "fingerprint: 2**31 nodes")
  call threads_at_once

contains

  !> Each thread gets the texts of its own codes and its own density.
  recursive subroutine threads_at_once
    real(c_double), parameter :: whole = 4*acos(-1.0_c_double)
    character(len=200) :: texts(0:14)
    integer :: wrong, i
    do i = 0, 14
      texts(i) = pstripack_strerror(int(-i, c_int32_t))
    end do
    call pstripack_trmesh(x, y, z, list, lptr, lend, lnew, ier)
    wrong = 0
    !$omp parallel do num_threads(4) schedule(dynamic) reduction(+:wrong)
    do i = 1, 40000
      if (pstripack_strerror(int(-mod(i, 15), c_int32_t)) /= texts(mod(i, 15))) wrong = wrong + 1
      if (mod(i, 100) == 0) then
        if (abs(mass_of(i/100) - whole*merge(2, 1, mod(i/100, 2) == 0)) > 1e-6_c_double) wrong = wrong + 1
      end if
    end do
    call expect(wrong == 0, "threads share nothing")
  end subroutine

  recursive real(c_double) function mass_of(k)
    integer, intent(in) :: k
    real(c_double), allocatable :: c(:, :)
    real(c_double) :: energy
    integer(c_int32_t) :: code
    allocate (c(n, 4))
    if (mod(k, 2) == 0) then
      call pstripack_scvt_step(x, y, z, list, lptr, lend, c(:, 1), c(:, 2), c(:, 3), c(:, 4), energy, code, two)
    else
      call pstripack_scvt_step(x, y, z, list, lptr, lend, c(:, 1), c(:, 2), c(:, 3), c(:, 4), energy, code, one)
    end if
    mass_of = merge(sum(c(:, 4)), -1.0_c_double, code == 0)
  end function

  recursive subroutine one(m, xyz, values)
    integer(c_int32_t), intent(in) :: m
    real(c_double), intent(in) :: xyz(3, m)
    real(c_double), intent(out) :: values(m)
    values = 1 + 0*xyz(1, :)
  end subroutine

  recursive subroutine two(m, xyz, values)
    integer(c_int32_t), intent(in) :: m
    real(c_double), intent(in) :: xyz(3, m)
    real(c_double), intent(out) :: values(m)
    values = 2 + 0*xyz(1, :)
  end subroutine
end program
