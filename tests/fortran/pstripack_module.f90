! Module pstripack, the binding for new codes.
program pstripack_module
  use, intrinsic :: iso_c_binding, only: c_double, c_float, c_int32_t, c_int64_t
  use pstripack
  use expectations
  use random_points
  implicit none
  integer, parameter :: n = 500, slots = 6*n - 12
  real(c_double) :: x(n), y(n), z(n), p(3)
  integer(c_int32_t) :: list(slots), lptr(slots), lend(n), lnew, ier
  integer(c_int64_t) :: print_of_all
  character(len=200) :: message
  integer :: k

  call expect(len(pstripack_version()) >= 5 .and. index(pstripack_version(), ".") > 1, "version")
  do k = pstripack_bad_size, 3
    call expect(len(pstripack_strerror(int(k, c_int32_t))) > 0, "every code has a text")
  end do
  do k = 1, n
    p = direction()
    x(k) = p(1)
    y(k) = p(2)
    z(k) = p(3)
  end do

  call pstripack_trmesh(x, y, z, list, lptr, lend, lnew, ier)
  call expect(ier == pstripack_ok .and. lnew == slots + 1, "trmesh, real64")
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
end program
