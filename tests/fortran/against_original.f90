! Compares results with those of the original (libngmath.a, names that begin with CS) for the same lists, on meshes
! large enough for long walks. Integers, and reals computed without arccos, arcsin or atan2, must be equal
! to the last bit. The lists are those of the original's TRMESH, which links them irregularly. tests/differential
! compares all routines on many small sets.
program against_original
  use expectations
  use random_points
  implicit none
  integer, parameter :: rk = real64, n = 3000, mark = -7777
  real(rk), parameter :: real_mark = -77.0_rk
  external :: trlist, crlist, trfind, scoord
  external :: cstrmesh, cstrlist, cscrlist, cstrfind
  integer, external :: nearnd, csnearnd
  integer :: lnew
  real(rk) :: x(n), y(n), z(n)
  integer :: list(6*n), lptr(6*n), lend(n)
  ! Work space of the comparisons.
  integer :: ours(18*n), theirs(18*n), columns_ours(6*n), columns_theirs(6*n)
  integer :: lptr_ours(6*n), lptr_theirs(6*n)
  real(rk) :: xc(2*n), yc(2*n), zc(2*n), rc(2*n), latitude(2*n), longitude(2*n), rc_theirs(2*n)
  integer :: trial, k

  do trial = 1, 3
    call seed(3000 + trial)
    do k = 1, n
      call put(k, direction())
      if (trial == 2) z(k) = abs(z(k))
    end do
    call compare
  end do

contains

  subroutine put(node, p)
    integer, intent(in) :: node
    real(rk), intent(in) :: p(3)
    x(node) = p(1)
    y(node) = p(2)
    z(node) = p(3)
  end subroutine

  subroutine compare
    integer :: near(n), next(n), ier
    real(rk) :: dist(n)
    list = mark
    lptr = mark
    call cstrmesh(n, x, y, z, list, lptr, lend, lnew, near, next, dist, ier)
    call expect(ier == 0, "the original's TRMESH")
    call compare_lists
    call compare_searches
    call compare_voronoi
  end subroutine

  subroutine compare_lists
    integer :: nt(2), ier(2), nrow
    do nrow = 6, 9, 3
      ours = mark
      theirs = mark
      call trlist(n, list, lptr, lend, nrow, nt(1), ours, ier(1))
      call cstrlist(n, list, lptr, lend, nrow, nt(2), theirs, ier(2))
      call expect(nt(1) == nt(2) .and. ier(1) == ier(2), "TRLIST: NT, IER")
      call expect(all(ours == theirs), "TRLIST: LTRI")
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
      if (i(1, 1) /= i(1, 2) .and. minval(i(1, :)) > 0) then  ! ours may be nearer, but no farther
        call expect(dot_product(p, node(i(1, 1))) >= dot_product(p, node(i(1, 2))) - 2*epsilon(1d0), "NEARND: node")
        cycle
      end if
      call expect(i(1, 1) == i(1, 2), "NEARND: none")
      if (cos(al(1)) < 1 - 2d0**(-11)) then
        call expect(close(al(1), al(2)), "NEARND: AL")
      else  ! the original's is known from its cosine only
        call expect(abs(cos(al(1)) - cos(al(2))) <= 2*epsilon(1d0), "NEARND: a small AL")
      end if
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

  !> True if equal or one unit in the last place apart, for results of functions of the mathematical library.
  function node(k)
    integer, intent(in) :: k
    real(rk) :: node(3)
    node = [x(k), y(k), z(k)]
  end function

  elemental logical function close(a, b)
    real(rk), intent(in) :: a, b
    close = a == b .or. abs(a - b) <= spacing(max(abs(a), abs(b)))
  end function
end program
