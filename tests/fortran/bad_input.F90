! Refused input: if IER is negative, nothing but IER is written; for a duplicate IER is its number.
! REAL_KIND: 4 or 8; STRIPACK_8_ARGUMENTS: the short argument list.
program bad_input
  use, intrinsic :: ieee_arithmetic, only: ieee_positive_inf, ieee_quiet_nan, ieee_value
  use expectations
  implicit none
  integer, parameter :: rk = REAL_KIND, n = 8, slots = 6*n - 12, mark = -7777
  real(rk) :: nodes(n, 3), bad(n, 3), al, b(3)
  integer :: list(slots), lptr(slots), lend(n), lnew, k, i(3)
#ifndef STRIPACK_8_ARGUMENTS
  integer :: near(n), next(n)
  real(rk) :: dist(n)
#endif
  integer, external :: nearnd
  external :: trmesh, trfind

  do k = 1, n
    nodes(k, 3) = 2*real(k, rk)/(n + 1) - 1
    nodes(k, 1) = sqrt(1 - nodes(k, 3)**2)*cos(2.4_rk*k)
    nodes(k, 2) = sqrt(1 - nodes(k, 3)**2)*sin(2.4_rk*k)
  end do

  do k = -1, 2
    call refuses(k, nodes, -1, "fewer than 3 nodes")
  end do
  call refuses(357913944, nodes, -4, "6N-11 beyond 32 bits")
  if (range(k) > 9) call refuses(ishft(1, bit_size(k) - 20), nodes, -4, "N beyond 32 bits")
  bad = nodes
  bad(1:3, :) = transpose(reshape([1._rk, 0._rk, 0._rk, 0._rk, 1._rk, 0._rk, -1._rk, 0._rk, 0._rk], [3, 3]))
  call refuses(n, bad, -2, "the first three on a great circle")
  bad = nodes
  bad(2, :) = bad(1, :)
  call refuses(n, bad, -2, "the first two equal")
  bad = nodes
  bad(2, 2) = ieee_value(1._rk, ieee_quiet_nan)
  call refuses(n, bad, -5, "NaN among the first three")
  bad = nodes
  bad(7, 1) = ieee_value(1._rk, ieee_quiet_nan)
  call refuses(n, bad, -5, "NaN later")
  bad(7, 1) = ieee_value(1._rk, ieee_positive_inf)
  call refuses(n, bad, -5, "infinity")
  bad(7, :) = 0
  call refuses(n, bad, -5, "zero vector")

  bad = nodes
  bad(7, :) = bad(4, :)
  bad(8, :) = bad(2, :)
  call mark_all
  call expect(triangulated(n, bad) == 4, "node 7 is a copy of node 4, and the first copy")
  call expect(all(lend(7:) == mark) .and. all(lend(:6) /= mark), "the lists are those of the nodes before the copy")
  call expect(all(abs(list(:lend(6))) <= 6) .and. all(lptr(:lend(6)) <= lend(6)), "and no others")
  call expect(all(list(lend(6) + 1:) == mark) .and. all(lptr(lend(6) + 1:) == mark), "no slot behind them is touched")

  bad = nodes
  bad(:, 3) = abs(bad(:, 3))
  call mark_all
  call expect(triangulated(n, bad) == 0 .and. lend(n) < slots, "nodes within a hemisphere")
  call expect(all(list(lend(n) + 1:) == mark) .and. all(lptr(lend(n) + 1:) == mark), "unused slots are not touched")

  call mark_all
  call expect(triangulated(n, nodes) == 0, "the nodes themselves are fine")
  b = 5
  call trfind(1, spread(ieee_value(1._rk, ieee_quiet_nan), 1, 3), n, nodes(:, 1), nodes(:, 2), nodes(:, 3), &
              list, lptr, lend, b(1), b(2), b(3), i(1), i(2), i(3))
  call expect(all(i == 0) .and. all(b == 5), "TRFIND of NaN")
  al = 5
  call expect(nearnd([0._rk, 0._rk, 0._rk], 1, n, nodes(:, 1), nodes(:, 2), nodes(:, 3), list, lptr, lend, al) == 0, &
              "NEARND of the zero vector")
  call expect(al == merge(0._rk, 5._rk, rk == 8), "NEARND's AL: 0 in REAL*8, untouched in REAL*4")

  call bad_arguments_of_queries

contains

  subroutine bad_arguments_of_queries
    real(rk) :: nan, huge_number, c(3), one(3), none(3)
    real(rk) :: xc(2*n), yc(2*n), zc(2*n), rc(2*n)
    integer :: ier, ltri(6, n), listc(slots), lptr_before(slots), lnew_before, nb, l, k
    logical, external :: inside
    external :: intrsc, circum, crlist, addnod
#ifdef STRIPACK_8_ARGUMENTS
    real(rk) :: area(3)
    external :: triareas
#endif
    nan = ieee_value(1._rk, ieee_quiet_nan)
    huge_number = ieee_value(1._rk, ieee_positive_inf)
    one = [1, 0, 0]
    none = [nan, 0._rk, 0._rk]

    call refuses_nodes(3, [3, 0], -10, "GETNP: node 0")
    call refuses_nodes(4, [3, 5, 3], -10, "GETNP: a node twice")
    call refuses_nodes(n + 1, [(l, l=1, n)], -15, "GETNP: L > N")
    nodes(3, 2) = nan
    call refuses_nodes(2, [3], -5, "GETNP: NaN")
    nodes(3, 2) = huge_number
    call refuses_nodes(2, [3], -5, "GETNP: infinity")

    do l = 0, n + 1
      call trfind(l, one, n, nodes(:, 1), nodes(:, 2), nodes(:, 3), list, lptr, lend, c(1), c(2), c(3), i(1), i(2), i(3))
      call expect(all(i >= 0) .and. all(i <= n), "TRFIND among nodes of which one is infinite")
    end do

    call expect(.not. inside(0*one, n, nodes(:, 1), nodes(:, 2), nodes(:, 3), 3, [1, 4, 8], ier) .and. ier == 4, &
                "INSIDE: the zero vector")
    call expect(.not. inside(none, n, nodes(:, 1), nodes(:, 2), nodes(:, 3), 3, [1, 4, 8], ier) .and. ier == -5, &
                "INSIDE: NaN")
    call expect(.not. inside(one, n, nodes(:, 1), nodes(:, 2), nodes(:, 3), 3, [1, 3, 8], ier) .and. ier == -5, &
                "INSIDE: an infinite vertex")

    c = 5
    call intrsc(none, one, one, c, ier)
    call expect(ier == -5 .and. all(c == 5), "INTRSC: NaN first")
    call intrsc(one, [0._rk, 1._rk, 0._rk], none, c, ier)
    call expect(ier == -5 .and. all(c == 5), "INTRSC: NaN in the normal")
    call circum(one, none, [0._rk, 1._rk, 0._rk], c, ier)
    call expect(ier == -5 .and. all(c == 5), "CIRCUM: NaN")

    lptr_before = lptr
    lnew_before = lnew
    call crlist(n, n, nodes(:, 1), nodes(:, 2), nodes(:, 3), list, lend, lptr, lnew, ltri, listc, nb, xc, yc, zc, rc, ier)
    call expect(ier == -5 .and. all(lptr == lptr_before) .and. lnew == lnew_before, "CRLIST: an infinite node")
    call crlist(2, n, nodes(:, 1), nodes(:, 2), nodes(:, 3), list, lend, lptr, lnew, ltri, listc, nb, xc, yc, zc, rc, ier)
    call expect(ier == 1 .and. all(lptr == lptr_before) .and. lnew == lnew_before, "CRLIST: two nodes")
    nodes(3, :) = nodes(2, :)
    call crlist(n, n, nodes(:, 1), nodes(:, 2), nodes(:, 3), list, lend, lptr, lnew, ltri, listc, nb, xc, yc, zc, rc, ier)
    call expect(ier == 3, "CRLIST: coincident nodes")
    nodes(3, :) = [0, 0, 1]
    lptr = lptr_before
    lnew = lnew_before
    do k = 1, lend(n)  ! no list has node 1 any more
      if (abs(list(k)) == 1) list(k) = sign(n, list(k))
    end do
    call crlist(n, n, nodes(:, 1), nodes(:, 2), nodes(:, 3), list, lend, lptr, lnew, ltri, listc, nb, xc, yc, zc, rc, ier)
    call expect(ier /= 0, "CRLIST: a node that its neighbours do not know")

    call addnod(1, (huge(k) - 1)/6 + 3, nodes(:, 1), nodes(:, 2), nodes(:, 3), list, lptr, lend, lnew, ier)
    call expect(ier == -4, "ADDNOD: 6K-12 does not fit")
    nodes(n, 1) = nan
    call addnod(1, n, nodes(:, 1), nodes(:, 2), nodes(:, 3), list, lptr, lend, lnew, ier)
    call expect(ier == -5, "ADDNOD: NaN")
#ifdef STRIPACK_8_ARGUMENTS
    area = 5
    call triareas(n, nodes(:, 1), nodes(:, 2), nodes(:, 3), 2, [1, 2, 4, 1, 2, n + 1], area)
    call expect(area(1) > 0 .and. area(2) /= area(2) .and. area(3) == 5, "TRIAREAS: a corner above N")
#endif
  end subroutine

  subroutine refuses_nodes(l, given, code, what)
    integer, intent(in) :: l, given(:), code
    character(len=*), intent(in) :: what
    integer :: npts(n + 1), ier
    real(rk) :: df
    external :: getnp
    npts = mark
    npts(:size(given)) = given
    df = 5
    call getnp(nodes(:, 1), nodes(:, 2), nodes(:, 3), list, lptr, lend, l, npts, df, ier)
    call expect(ier == code .and. df == 5, what)
    call expect(all(npts(:size(given)) == given) .and. all(npts(size(given) + 1:) == mark), what//": NPTS untouched")
  end subroutine

  subroutine mark_all
    list = mark
    lptr = mark
    lend = mark
    lnew = mark
  end subroutine

  subroutine refuses(count, p, code, what)
    integer, intent(in) :: count, code
    real(rk), intent(in) :: p(n, 3)
    character(len=*), intent(in) :: what
    call mark_all
    call expect(triangulated(count, p) == code, what)
    call expect(all(list == mark) .and. all(lptr == mark) .and. all(lend == mark) .and. lnew == mark, &
                what//": outputs untouched")
  end subroutine

  integer function triangulated(count, p) result(ier)
    integer, intent(in) :: count
    real(rk), intent(in) :: p(n, 3)
#ifdef STRIPACK_8_ARGUMENTS
    call trmesh(count, p(:, 1), p(:, 2), p(:, 3), list, lptr, lend, ier)
#else
    call trmesh(count, p(:, 1), p(:, 2), p(:, 3), list, lptr, lend, lnew, near, next, dist, ier)
#endif
  end function
end program
