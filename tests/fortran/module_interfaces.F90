! Codes that `use` the module, with explicit interfaces. They pass INTENT(IN) arrays as output, which the original allows,
! arrays of another rank, sections and constants. MODULE_NAME: name of the module. REAL_TYPE: real type of the code.
module helper
  use MODULE_NAME
  implicit none
contains
  ! As in a grid generator: LTRI, which TRLIST writes, is INTENT(IN) here.
  subroutine triangles(n, list, lptr, lend, nrow, nt, ltri, ier)
    integer, intent(in) :: n, list(:), lptr(:), lend(:), nrow, nt, ltri(:, :), ier
    call trlist(n, list, lptr, lend, nrow, nt, ltri, ier)
  end subroutine

  ! A constant, rows of an array (which the compiler copies), and parts of work space.
  subroutine mesh(xyz, list, lptr, lend, ier)
    REAL_TYPE, intent(in) :: xyz(:, :)
    integer, intent(inout) :: list(:), lptr(:), lend(:)
    integer, intent(out) :: ier
#ifdef STRIPACK_8_ARGUMENTS
    call trmesh(40, xyz(1, :), xyz(2, :), xyz(3, :), list, lptr, lend, ier)
#else
    integer :: lnew, iwk(2*40)
    REAL_TYPE :: dist(40)
    call trmesh(40, xyz(1, :), xyz(2, :), xyz(3, :), list, lptr, lend, lnew, iwk, iwk(40 + 1), dist, ier)
#endif
  end subroutine
end module

program module_interfaces
  use helper
  use expectations
  implicit none
  integer, parameter :: n = 40, slots = 6*n - 12
  REAL_TYPE :: x(n), y(n), z(n), xc(2*n), yc(2*n), zc(2*n), rc(2*n), c(3), p(3), b(3), al, pi, total
  integer, target :: list(slots), lptr(slots), lend(n)
  integer :: lnew, ier, nt, ltri(6, 2*n), columns(6, n), nb, na, nodes(n), listc(slots), i(3), k, corners(3, 2*n)
  integer :: other_list(slots), other_lptr(slots), other_lend(n)
  REAL_TYPE :: xyz(3, n)
#ifndef STRIPACK_8_ARGUMENTS
  integer :: work(2*n)
  REAL_TYPE :: dist(n)
#endif

  pi = acos(-real(1, kind(pi)))
  do k = 1, n  ! within a hemisphere
    z(k) = real(k, kind(z))/n
    x(k) = sqrt(1 - z(k)**2)*cos(2.4*real(k, kind(z)))
    y(k) = sqrt(1 - z(k)**2)*sin(2.4*real(k, kind(z)))
  end do
#ifdef STRIPACK_8_ARGUMENTS
  call trmesh(n, x, y, z, list, lptr, lend, ier)
  call expect(ier == 0, "TRMESH with 8 arguments")
  call bnodes(n, list, lptr, lend, nodes, nb, na, nt)
  lnew = 2*na + 1
#else
  call trmesh(n, x, y, z, list, lptr, lend, lnew, work, work(n + 1), dist, ier)
  call expect(ier == 0, "TRMESH with 12 arguments")
  call bnodes(n, list, lptr, lend, nodes, nb, na, nt)
  call expect(lnew == 2*na + 1, "LNEW")
#endif
  call expect(nb >= 3 .and. na == nt + n - 1 .and. nt == 2*n - nb - 2, "BNODES")

  xyz(1, :) = x
  xyz(2, :) = y
  xyz(3, :) = z
  call mesh(xyz, other_list, other_lptr, other_lend, ier)
  call expect(ier == 0 .and. all(other_lend == lend), "TRMESH of sections")
  call expect(all(other_list(:lnew - 1) == list(:lnew - 1)), "the same lists")
  call trlist(40, list(1:slots), lptr(:), lend(1), 3 + 3, nt, ltri(1, 1), ier)
  call expect(ier == 0 .and. nt == 2*n - nb - 2, "TRLIST with constants, sections, elements")

  call triangles(n, list, lptr, lend, 6, nt, ltri, ier)
  call expect(ier == 0 .and. nt == 2*n - nb - 2, "TRLIST through INTENT(IN) dummies")
  call trlist2(n, list, lptr, lend, nt, corners, ier)
  call expect(ier == 0 .and. all(corners(:, :nt) == ltri(1:3, :nt)), "TRLIST2 gives the corners of TRLIST")
  k = ltri(1, 1)
  total = areas(point(k), point(ltri(2, 1)), point(ltri(3, 1)))
  call expect(left(x(k), y(k), z(k), x(ltri(2, 1)), y(ltri(2, 1)), z(ltri(2, 1)), x(ltri(3, 1)), y(ltri(3, 1)), &
                   z(ltri(3, 1))), "LEFT")
  call circum(point(k), point(ltri(2, 1)), point(ltri(3, 1)), c, ier)
  call expect(ier == 0 .and. abs(dot_product(c, c) - 1) < 1e-5, "CIRCUM")

  p = point(11) + point(12)
  call trfind(0, p, n, x, y, z, list, lptr, lend, b(1), b(2), b(3), i(1), i(2), i(3))
  call expect(all(i >= 1) .and. all(b >= 0), "TRFIND from a random node")
  call expect(nearnd(point(11), 0, n, x, y, z, list, lptr, lend, al) == 11, "NEARND")
  nodes(1) = 11
  call getnp(x, y, z, list, lptr, lend, 2, nodes, al, ier)
  call expect(ier == 0 .and. -al > 0.8, "GETNP")
  call expect(inside(point(ltri(1, 1)) + point(ltri(2, 1)) + point(ltri(3, 1)), n, x, y, z, 3, ltri(1:3, 1), ier), "INSIDE")
  call intrsc(point(1), point(2), point(3), c, ier)
  call expect(ier == 0 .and. abs(dot_product(c, point(3))) < 1e-5, "INTRSC")
  i = [1, 2, 3]
  call expect(jrand(1000, i(1), i(2), i(3)) == 34, "JRAND")
  call expect(store(al) == al, "STORE")
  call triareas(n, x, y, z, nt, corners, rc)
  call expect(abs(rc(1) - total) < 100*epsilon(total) .and. sum(rc(:nt)) > pi .and. sum(rc(:nt)) < 2*pi, &
              "TRIAREAS: nearly a hemisphere; AREAS")
  call expect(nbcnt(lend(11), lptr) >= 3, "NBCNT")
  call expect(lstptr(lend(11), list(lptr(lend(11))), list, lptr) == lptr(lend(11)), "LSTPTR")
  call scoord(x(1), y(1), z(1), b(1), b(2), b(3))
  call expect(abs(b(3) - 1) < 1e-5, "SCOORD")
  call trans(1, b(1), b(2), c(1), c(2), c(3))
  call expect(all(abs(c - point(1)) < 1e-5), "TRANS")

  call crlist(n, n, x, y, z, list, lend, lptr, lnew, columns, listc, nb, xc, yc, zc, rc, ier)
  call expect(ier == 0 .and. lnew == 6*n - 11, "CRLIST")
  call print_and_plot

contains
  ! TRPRNT and TRLPRT with LOUT, and without.
  subroutine print_and_plot
    integer :: lout
    REAL_TYPE :: size = 7.5, latitude = 40, longitude = -100, angle = 90
    lout = 20
    open (lout, status="scratch")
    call trprnt(n, x, y, z, 0, other_list, other_lptr, lend, lout)
    call trlprt(n, x, y, z, 1, 6, nt, ltri, lout)
    call trprnt(n, x, y, z, 0, other_list, other_lptr, lend)
    call trlprt(n, x, y, z, 1, 6, nt, ltri)
    call trplot(lout, size, latitude, longitude, angle, n, x, y, z, other_list, other_lptr, lend, '(Mesh)', .true., ier)
    call expect(ier == 0, "TRPLOT")
    call vrplot(lout, size, latitude, longitude, angle, n, x, y, z, 2*n - 4, listc, lptr, lend, xc, yc, zc, &
                '(Cells)', .false., ier)
    call expect(ier == 0, "VRPLOT")
    close (lout)
    call voronoi_poly_count(n, lend, lptr, listc)
  end subroutine
  function point(node)
    integer, intent(in) :: node
    REAL_TYPE :: point(3)
    point = [x(node), y(node), z(node)]
  end function
end program
