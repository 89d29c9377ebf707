! Calls every routine of a library once through implicit interfaces: with LOUT defined as programs for Algorithm 772 do,
! which pass a unit to TRPRNT and TRLPRT, else as programs for the Fortran 90 text do, which pass none.
! REAL_KIND: 4 or 8, as in the library. STRIPACK_8_ARGUMENTS: TRMESH has 8.
#ifdef LOUT
#define AND_LOUT , lout
#else
#define AND_LOUT
#endif
program calling_conventions
  use expectations
  implicit none
  integer, parameter :: rk = REAL_KIND, n = 6
  real(rk) :: x(n) = [1, 0, 0, -1, 0, 0], y(n) = [0, 1, 0, 0, -1, 0], z(n) = [0, 0, 1, 0, 0, -1]
  integer :: list(24), lptr(24), lend(n), ier
#ifdef LOUT
  integer :: lout = 20
  open (lout, status="scratch")
#endif
  call mesh(n, x, y, z, list, lptr, lend, ier)
  call expect(ier == 0, "TRMESH")
  call trprnt(6, x, y, z, 0, list, lptr, lend AND_LOUT)
  call queries(n, x, y, z, list, lptr, lend)
  call lists(n, x, y, z, list, lptr, lend)
  call changes(x, y, z)
  call helpers(x, y, z)
#ifdef LOUT
  call expect_records(2)
#endif
  print "(a)", "every routine returned"

contains

  subroutine mesh(nodes, x, y, z, list, lptr, lend, ier)
    integer :: nodes, list(*), lptr(*), lend(*), ier
    real(rk) :: x(*), y(*), z(*)
#ifdef STRIPACK_8_ARGUMENTS
    call trmesh(nodes, x, y, z, list, lptr, lend, ier)
#else
    integer :: lnew, near(n), next(n)
    real(rk) :: dist(n)
    call trmesh(nodes, x, y, z, list, lptr, lend, lnew, near, next, dist, ier)
#endif
  end subroutine

  subroutine queries(n, x, y, z, list, lptr, lend)
    integer :: n, list(*), lptr(*), lend(*)
    real(rk) :: x(*), y(*), z(*), p(3) = [1, 1, 1], b(3), distance
    integer :: i(3), nb, na, nt, nodes(6) = 1, ier
    integer, external :: nearnd, nbcnt, lstptr
    call bnodes(n, list, lptr, lend, nodes, nb, na, nt)
    call expect(nb == 0 .and. na == 12 .and. nt == 8, "BNODES")
    call trfind(1, p, n, x, y, z, list, lptr, lend, b(1), b(2), b(3), i(1), i(2), i(3))
    call expect(sum(i) == 6 .and. all(b > 0), "TRFIND")
    call expect(nearnd([1.0_rk, 0.1_rk, 0.0_rk], 1, n, x, y, z, list, lptr, lend, distance) == 1, "NEARND")
    nodes(1) = 1
    call getnp(x, y, z, list, lptr, lend, 2, nodes, distance, ier)
    call expect(ier == 0 .and. abs(distance) < 1e-6, "GETNP")
    call expect(nbcnt(lend(1), lptr) == 4, "NBCNT")
    call expect(list(lstptr(lend(1), 2, list, lptr)) == 2, "LSTPTR")
  end subroutine

  subroutine lists(n, x, y, z, list, lptr, lend)
    integer :: n, list(*), lptr(*), lend(*)
    real(rk) :: x(*), y(*), z(*), xc(8), yc(8), zc(8), rc(8), area(8), size = 7, latitude = 40, longitude = -100, angle = 90
    integer :: nt, ltri(6, 8), corners(3, 8), columns(6, 6), listc(24), lnew, nb, ier
    call trlist(n, list, lptr, lend, 6, nt, ltri, ier)
    call expect(ier == 0 .and. nt == 8, "TRLIST")
    call trlprt(n, x, y, z, 0, 6, nt, ltri AND_LOUT)
    call trlist2(n, list, lptr, lend, nt, corners, ier)
    call expect(ier == 0 .and. all(corners == ltri(1:3, :)), "TRLIST2")
    call triareas(n, x, y, z, nt, corners, area)
    call expect(abs(sum(area) - 4*acos(-1.0_rk)) < 1e-4, "TRIAREAS")
    open (8, status="scratch")
    call trplot(8, size, latitude, longitude, angle, n, x, y, z, list, lptr, lend, "(Mesh)", .true., ier)
    call expect(ier == 0, "TRPLOT")
    lnew = 25
    call crlist(n, n, x, y, z, list, lend, lptr, lnew, columns, listc, nb, xc, yc, zc, rc, ier)
    call expect(ier == 0 .and. nb == 0, "CRLIST")
    call voronoi_poly_count(n, lend, lptr, listc)
    call vrplot(8, size, latitude, longitude, angle, n, x, y, z, 8, listc, lptr, lend, xc, yc, zc, "(Cells)", .true., ier)
    call expect(ier == 0, "VRPLOT")
    close (8)
  end subroutine

  ! A triangle, to which the routines that ADDNOD calls add nodes.
  subroutine changes(x, y, z)
    real(rk) :: x(*), y(*), z(*), xyz(n, 3)
    integer :: list(24), lptr(24), lend(n), lnew, ier, lph, lp, arcs(2, n), lwk, nit, nodes, i(3)
    real(rk) :: b(3)
    logical, external :: swptst
    call mesh(3, x, y, z, list, lptr, lend, ier)
    lnew = 7
    call trfind(1, [-1.0_rk, 1.0_rk, 1.0_rk], 3, x, y, z, list, lptr, lend, b(1), b(2), b(3), i(1), i(2), i(3))
    call bdyadd(4, i(1), i(2), list, lptr, lend, lnew)
    call expect(lnew == 11, "BDYADD")
    call covsph(5, 1, list, lptr, lend, lnew)
    call expect(lnew == 19, "COVSPH")
    call delnb(5, 1, 5, list, lptr, lend, lnew, lph)
    call expect(lph > 0 .and. lnew == 18, "DELNB")

    call mesh(3, x, y, z, list, lptr, lend, ier)
    lnew = 7
    call intadd(4, 1, 2, 3, list, lptr, lend, lnew)
    call expect(lnew == 13, "INTADD")
    lp = lend(4)
    call insert(5, lp, list, lptr, lnew)
    call expect(lnew == 14 .and. list(13) == 5 .and. lptr(lp) == 13, "INSERT")

    call mesh(5, x, y, z, list, lptr, lend, ier)
    lnew = 17
    call addnod(1, 6, x, y, z, list, lptr, lend, lnew, ier)
    call expect(ier == 0 .and. lnew == 25, "ADDNOD")
    call expect(.not. swptst(1, 2, 3, 5, x, y, z), "SWPTST")
    call swap(5, 2, 1, 3, list, lptr, lend, lp)
    call expect(lp > 0, "SWAP")
    arcs(:, 1) = [5, 2]
    nit = 4
    call optim(x, y, z, 1, list, lptr, lend, nit, arcs, ier)
    call expect(ier == 0, "OPTIM")
    lwk = n
    call edge(1, 4, x, y, z, lwk, arcs, list, lptr, lend, ier)
    call expect(ier == 0, "EDGE")

    call mesh(6, x, y, z, list, lptr, lend, ier)
    lnew = 25
    lwk = n
    nodes = n
    xyz = reshape([x(:n), y(:n), z(:n)], [n, 3])
    call delnod(6, nodes, xyz(:, 1), xyz(:, 2), xyz(:, 3), list, lptr, lend, lnew, lwk, arcs, ier)
    call expect(ier == 0 .and. nodes == 5, "DELNOD")
    call mesh(5, x, y, z, list, lptr, lend, ier)
    lnew = 17
    call delarc(5, 1, 2, list, lptr, lend, lnew, ier)
    call expect(ier == 0, "DELARC")
  end subroutine

  subroutine helpers(x, y, z)
    real(rk) :: x(*), y(*), z(*), c(3), latitude, longitude, length, v1(3) = [1, 0, 0], v2(3) = [0, 1, 0], v3(3) = [0, 0, 1]
    integer :: ier, i(3) = [1, 2, 3]
    real(rk), external :: areas, store
    integer, external :: jrand
    logical, external :: left, inside
    call expect(abs(areas(v1, v2, v3) - acos(-1.0_rk)/2) < 1e-4, "AREAS")
    call circum(v1, v2, v3, c, ier)
    call expect(ier == 0 .and. all(c > 0.5), "CIRCUM")
    call expect(left(x(1), y(1), z(1), x(2), y(2), z(2), x(3), y(3), z(3)), "LEFT")
    call expect(inside(c, 6, x, y, z, 3, i, ier) .and. ier == 0, "INSIDE")
    call intrsc(v1, v2, [1.0_rk, -1.0_rk, 0.0_rk], c, ier)
    call expect(ier == 0 .and. abs(c(3)) < 1e-6, "INTRSC")
    call scoord(x(3), y(3), z(3), latitude, longitude, length)
    call expect(length == 1, "SCOORD")
    call trans(1, latitude, longitude, c(1), c(2), c(3))
    call expect(abs(c(3) - 1) < 1e-6, "TRANS")
    call expect(jrand(1000, i(1), i(2), i(3)) == 34, "JRAND")
    call expect(store(length) == 1, "STORE")
  end subroutine

#ifdef LOUT
  ! Unit LOUT has both listings.
  subroutine expect_records(listings)
    integer, intent(in) :: listings
    integer :: found, status
    character(len=80) :: record
    found = 0
    rewind (lout)
    do
      read (lout, "(a)", iostat=status) record
      if (status /= 0) exit
      if (index(record, "PSTRIPACK: ") > 0) found = found + 1
    end do
    call expect(found == listings, "listings on unit LOUT")
  end subroutine
#endif
end program
