! The same routines of the original (libngmath.a, names that begin with CS), called with the same lists:
! every integer, and every real that no arccos, arcsin or atan2 went into, must be equal to the last bit.
! The lists come from the original's TRMESH, so that they are linked in its irregular way.
program against_original
  use expectations
  use random_points
  implicit none
  integer, parameter :: rk = real64, most = 3000, mark = -7777
  real(rk), parameter :: real_mark = -77.0_rk
  external :: trlist, crlist, bnodes, trfind, circum, scoord, trans
  external :: cstrmesh, cstrlist, cscrlist, csbnodes, cstrfind, cscircum, csscoordd, cstransd
  integer, external :: nearnd, lstptr, nbcnt, csnearnd, cslstptr, csnbcnt
  logical, external :: left, csleft
  real(rk), external :: areas, csareas
  integer :: n, lnew, meshes = 0, with_boundary = 0
  real(rk) :: x(most), y(most), z(most)
  integer :: list(6*most), lptr(6*most), lend(most)
  ! Work space of the comparisons.
  integer :: ours(18*most), theirs(18*most), columns_ours(6*most), columns_theirs(6*most)
  integer :: lptr_ours(6*most), lptr_theirs(6*most)
  real(rk) :: xc(2*most), yc(2*most), zc(2*most), rc(2*most), latitude(2*most), longitude(2*most), rc_theirs(2*most)
  integer :: trial, k

  do trial = 1, 200  ! random nodes, of all sizes
    call seed(trial)
    n = 3 + mod(trial, 100)
    do k = 1, n
      call put(k, direction())
    end do
    call compare
  end do
  do trial = 1, 150  ! within a hemisphere or a cap
    call seed(1000 + trial)
    n = 3 + mod(trial, 90)
    do k = 1, n
      call put(k, direction())
      z(k) = abs(z(k)) + mod(trial, 3)
      call put(k, [x(k), y(k), z(k)]/sqrt(x(k)**2 + y(k)**2 + z(k)**2))
    end do
    call compare
  end do
  do trial = 1, 200  ! directions of a small lattice: ties and nodes in line everywhere
    call seed(2000 + trial)
    n = 4 + mod(trial, 17)
    call lattice
    call compare
  end do
  do trial = 1, 3  ! enough nodes for threads and long walks
    call seed(3000 + trial)
    n = most
    do k = 1, n
      call put(k, direction())
      if (trial == 2) z(k) = abs(z(k))
    end do
    call compare
  end do
  call expect(meshes > 450, "most of the sets can be compared")
  call expect(with_boundary > 150, "many of them have a boundary")
  call compare_small_functions
  print "(i0, a, i0, a)", meshes, " triangulations compared, ", with_boundary, " of them with boundary"

contains

  subroutine put(node, p)
    integer, intent(in) :: node
    real(rk), intent(in) :: p(3)
    x(node) = p(1)
    y(node) = p(2)
    z(node) = p(3)
  end subroutine

  !> n different directions of integer vectors with components -2..2.
  subroutine lattice
    integer :: v(3), other
    k = 0
    do while (k < n)
      v = int(5*[uniform(), uniform(), uniform()]) - 2
      if (all(v == 0)) cycle
      k = k + 1
      call put(k, v/sqrt(real(sum(v**2), rk)))
      do other = 1, k - 1
        if (x(other)*x(k) + y(other)*y(k) + z(other)*z(k) > 0.9999_rk) then
          k = k - 1
          exit
        end if
      end do
    end do
  end subroutine

  subroutine compare
    integer :: near(most), next(most), ier
    real(rk) :: dist(most)
    list = mark
    lptr = mark
    call cstrmesh(n, x, y, z, list, lptr, lend, lnew, near, next, dist, ier)
    if (ier /= 0) return
    meshes = meshes + 1
    call compare_lists
    call compare_searches
    call compare_voronoi
  end subroutine

  subroutine compare_lists
    integer :: nt(2), nb(2), na(2), ier(2), nrow, node, other
    do nrow = 6, 9, 3
      ours = mark
      theirs = mark
      call trlist(n, list, lptr, lend, nrow, nt(1), ours, ier(1))
      call cstrlist(n, list, lptr, lend, nrow, nt(2), theirs, ier(2))
      call expect(nt(1) == nt(2) .and. ier(1) == ier(2), "TRLIST: NT, IER")
      call expect(all(ours == theirs), "TRLIST: LTRI")
    end do
    ours = mark
    theirs = mark
    call bnodes(n, list, lptr, lend, ours, nb(1), na(1), nt(1))
    call csbnodes(n, list, lptr, lend, theirs, nb(2), na(2), nt(2))
    call expect(nb(1) == nb(2) .and. na(1) == na(2) .and. nt(1) == nt(2) .and. all(ours == theirs), "BNODES")
    if (nb(1) > 0) with_boundary = with_boundary + 1
    do node = 1, min(n, 30)
      call expect(nbcnt(lend(node), lptr) == csnbcnt(lend(node), lptr), "NBCNT")
      do other = 1, min(n, 30)
        call expect(lstptr(lend(node), other, list, lptr) == cslstptr(lend(node), other, list, lptr), "LSTPTR")
      end do
    end do
  end subroutine

  subroutine compare_searches
    real(rk) :: p(3), b(3, 2), al(2)
    integer :: i(3, 2), try, start
    do try = 1, 40
      p = direction()
      start = 1 + int(n*uniform())
      b = real_mark
      i = mark
      call trfind(start, p, n, x, y, z, list, lptr, lend, b(1, 1), b(2, 1), b(3, 1), i(1, 1), i(2, 1), i(3, 1))
      call cstrfind(start, p, n, x, y, z, list, lptr, lend, b(1, 2), b(2, 2), b(3, 2), i(1, 2), i(2, 2), i(3, 2))
      call expect(all(i(:, 1) == i(:, 2)), "TRFIND: I1, I2, I3")
      call expect(all(b(:, 1) == b(:, 2)), "TRFIND: B1, B2, B3")
      if (mod(try, 4) == 0) start = -start
      al = real_mark
      i(1, 1) = nearnd(p, start, n, x, y, z, list, lptr, lend, al(1))
      i(1, 2) = csnearnd(p, start, n, x, y, z, list, lptr, lend, al(2))
      call expect(i(1, 1) == i(1, 2), "NEARND: node")
      call expect(close(al(1), al(2)), "NEARND: AL")
    end do
  end subroutine

  subroutine compare_voronoi
    integer :: lnew_ours, lnew_theirs, nb(2), ier(2), ncol, t
    real(rk) :: c(3)
    do ncol = 0, n, n
      lptr_ours = lptr
      lptr_theirs = lptr
      lnew_ours = lnew
      lnew_theirs = lnew
      ours = mark
      theirs = mark
      columns_ours = mark
      columns_theirs = mark
      rc = real_mark
      rc_theirs = real_mark
      call crlist(n, ncol, x, y, z, list, lend, lptr_ours, lnew_ours, columns_ours, ours, nb(1), xc, yc, zc, rc, ier(1))
      call cscrlist(n, ncol, x, y, z, list, lend, lptr_theirs, lnew_theirs, columns_theirs, theirs, nb(2), latitude, &
                    longitude, rc_theirs, ier(2))
      call expect(nb(1) == nb(2) .and. ier(1) == ier(2) .and. lnew_ours == lnew_theirs, "CRLIST: NB, IER, LNEW")
      call expect(all(ours == theirs), "CRLIST: LISTC")
      call expect(all(lptr_ours == lptr_theirs), "CRLIST: LPTR")
      call expect(all(columns_ours == columns_theirs), "CRLIST: LTRI")
      if (ier(1) /= 0) cycle
      do t = 1, 2*n - 4
        call scoord(xc(t), yc(t), zc(t), c(1), c(2), c(3))
        call expect(close(rc(t), rc_theirs(t)), "CRLIST: RC")
        call expect(close(c(1), latitude(t)) .and. close(c(2), longitude(t)), "CRLIST: centres")
      end do
      call expect(all(rc(2*n - 3:) == real_mark), "CRLIST writes no more radii")
    end do
  end subroutine

  subroutine compare_small_functions
    real(rk) :: v(3, 3), c(3, 2), x1(3), x2(3), lat(3), lon(3)
    integer :: try, ier(2)
    do try = 1, 20000
      v(:, 1) = direction()
      v(:, 2) = direction()
      v(:, 3) = direction()
      select case (mod(try, 8))
        case (1); v = real(nint(2*v), rk)                    ! a lattice: exact zeros, zero vectors
        case (2); v(:, 3) = v(:, 1)
        case (3); v(:, 3) = 0.25_rk*v(:, 1) + 0.75_rk*v(:, 2)  ! in line
        case (4); v(:, 2) = v(:, 1) + 1e-9_rk*v(:, 2)
        case (5); v = 1e-170_rk*v
      end select
      call expect(left(v(1, 1), v(2, 1), v(3, 1), v(1, 2), v(2, 2), v(3, 2), v(1, 3), v(2, 3), v(3, 3)) .eqv. &
                  csleft(v(1, 1), v(2, 1), v(3, 1), v(1, 2), v(2, 2), v(3, 2), v(1, 3), v(2, 3), v(3, 3)), "LEFT")
      c = real_mark
      call circum(v(:, 1), v(:, 2), v(:, 3), c(:, 1), ier(1))
      call cscircum(v(:, 1), v(:, 2), v(:, 3), c(:, 2), ier(2))
      call expect(ier(1) == ier(2) .and. all(c(:, 1) == c(:, 2)), "CIRCUM")
      call expect(abs(areas(v(:, 1), v(:, 2), v(:, 3)) - csareas(v(:, 1), v(:, 2), v(:, 3))) <= 3*spacing(4.0_rk), "AREAS")
      call scoord(v(1, 1), v(2, 1), v(3, 1), c(1, 1), c(2, 1), c(3, 1))
      call csscoordd(v(1, 1), v(2, 1), v(3, 1), c(1, 2), c(2, 2), c(3, 2))
      call expect(all(close(c(:, 1), c(:, 2))), "SCOORD")
      lat = v(:, 1)
      lon = v(:, 2)
      call trans(3, lat, lon, lat, lon, x1)
      call cstransd(3, v(:, 1), v(:, 2), c(:, 1), c(:, 2), x2)
      call expect(all(close(lat, c(:, 1))) .and. all(close(lon, c(:, 2))) .and. all(close(x1, x2)), "TRANS, in place")
    end do
  end subroutine

  !> Equal, or one unit in the last place apart: results of functions of the mathematical library.
  elemental logical function close(a, b)
    real(rk), intent(in) :: a, b
    close = a == b .or. abs(a - b) <= spacing(max(abs(a), abs(b)))
  end function
end program
