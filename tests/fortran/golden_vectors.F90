! TRLIST, CRLIST, BNODES, TRFIND, NEARND, LSTPTR, NBCNT and GETNP on two small triangulations, and INSIDE, INTRSC, JRAND
! and STORE, through implicit interfaces as in old codes: the results that every variant of the original gives.
! REAL_KIND: 4 or 8, as in the library.
program golden_vectors
  use expectations
  implicit none
  integer, parameter :: rk = REAL_KIND
  real(rk), parameter :: tolerance = 16*epsilon(1.0_rk)
  integer, parameter :: mark = -7777

  include 'seven_nodes.inc'

  call octahedron
  call seven_nodes

contains

  subroutine octahedron
    integer, parameter :: n = 6, slots = 24
    real(rk) :: x(n) = [1, 0, 0, -1, 0, 0], y(n) = [0, 1, 0, 0, -1, 0], z(n) = [0, 0, 1, 0, 0, -1]
    integer :: list(slots) = [2, 3, 3, 1, 1, 2, 4, 4, 3, 2, 5, 5, 5, 1, 3, 4, 6, 6, 6, 6, 1, 5, 4, 2]
    integer :: lptr(slots) = [2, 11, 4, 20, 6, 7, 12, 3, 10, 19, 17, 5, 9, 15, 16, 18, 1, 14, 13, 8, 22, 23, 24, 21]
    integer :: lend(n) = [11, 4, 7, 10, 16, 24]
    integer, parameter :: triangles(9, 8) = reshape([ &
      1, 6, 2, 5, 2, 4, 5, 1, 3,   1, 2, 3, 6, 3, 1, 6, 2, 1,   1, 3, 5, 7, 4, 2, 8, 4, 2, &
      1, 5, 6, 8, 1, 3, 10, 3, 4,  2, 6, 4, 8, 6, 1, 12, 7, 5,  2, 4, 3, 7, 2, 5, 9, 6, 7, &
      3, 4, 5, 8, 3, 6, 11, 8, 9,  4, 6, 5, 4, 7, 5, 10, 11, 12], [9, 8])
    integer, parameter :: cells(slots) = [3, 4, 3, 2, 3, 6, 7, 6, 6, 5, 1, 4, 7, 4, 7, 8, 2, 1, 8, 5, 1, 8, 5, 2]
    integer, parameter :: signs(3, 8) = reshape([1, -1, -1, 1, 1, -1, 1, 1, 1, 1, -1, 1, -1, 1, -1, -1, 1, 1, &
                                                 -1, -1, 1, -1, -1, -1], [3, 8])
    integer :: ltri(9, 8), ltri6(6, 8), nt, ier, listc(slots), lptr_before(slots), lnew, nb, na, nodes(n)
    integer :: no_columns(1, 1)
    real(rk) :: xc(8), yc(8), zc(8), rc(8)
    external :: trlist, crlist, bnodes

    call trlist(n, list, lptr, lend, 9, nt, ltri, ier)
    call expect(ier == 0 .and. nt == 8, "octahedron: TRLIST")
    call expect(all(ltri == triangles), "octahedron: LTRI, NROW = 9")
    call trlist(n, list, lptr, lend, 6, nt, ltri6, ier)
    call expect(ier == 0 .and. all(ltri6 == triangles(1:6, :)), "octahedron: LTRI, NROW = 6")
    ltri = mark
    call trlist(n, list, lptr, lend, 7, nt, ltri, ier)
    call expect(ier == 1 .and. nt == 0 .and. all(ltri == mark), "NROW = 7 is refused")
    call trlist(2, list, lptr, lend, 6, nt, ltri, ier)
    call expect(ier == 1 .and. nt == 0 .and. all(ltri == mark), "N = 2 is refused")

    nodes = mark
    call bnodes(n, list, lptr, lend, nodes, nb, na, nt)
    call expect(nb == 0 .and. na == 12 .and. nt == 8 .and. all(nodes == mark), "octahedron: BNODES")

    ! The sphere is covered: codes pass NCOL = 0 and an LTRI of one element.
    lptr_before = lptr
    lnew = 25
    no_columns = mark
    call crlist(n, 0, x, y, z, list, lend, lptr, lnew, no_columns, listc, nb, xc, yc, zc, rc, ier)
    call expect(ier == 0 .and. nb == 0 .and. lnew == 25, "octahedron: CRLIST")
    call expect(all(lptr == lptr_before) .and. no_columns(1, 1) == mark, "octahedron: LPTR and LTRI are left alone")
    call expect(all(listc == cells), "octahedron: LISTC")
    call expect(all(abs(xc - signs(1, :)/sqrt(3.0_rk)) < tolerance), "octahedron: XC")
    call expect(all(abs(yc - signs(2, :)/sqrt(3.0_rk)) < tolerance), "octahedron: YC")
    call expect(all(abs(zc - signs(3, :)/sqrt(3.0_rk)) < tolerance), "octahedron: ZC")
    call expect(all(abs(rc - 0.9553166181245092_rk) < tolerance), "octahedron: radii")
  end subroutine

  subroutine seven_nodes
    integer, parameter :: triangles(9, 8) = reshape([ &
      1, 6, 5, 0, 2, 4, 1, 2, 4,    1, 5, 3, 6, 3, 1, 7, 3, 2,   1, 3, 4, 7, 4, 2, 10, 5, 3, &
      1, 4, 6, 8, 1, 3, 13, 4, 5,   2, 7, 3, 7, 6, 0, 11, 9, 6,  2, 3, 5, 2, 0, 5, 7, 8, 9, &
      3, 7, 4, 8, 3, 5, 14, 10, 11, 4, 7, 6, 0, 4, 7, 12, 13, 14], [9, 8])
    integer, parameter :: cells(slots) = [8, 6, 8, 5, 5, 7, 3, 6, 6, 9, 1, 5, 8, 4, 1, 4, 3, 4, 3, 10, 2, &
                                           10, 9, 7, 10, 9, 7, 2, 2, 1]
    integer, parameter :: closed(slots) = [6, 7, 11, 14, 1, 23, 16, 5, 10, 22, 29, 2, 4, 15, 13, 12, 9, 19, 20, 21, &
                                           30, 17, 8, 3, 26, 27, 28, 25, 24, 18]
    integer, parameter :: pseudo(6, 2) = reshape([6, 2, 5, 0, 0, 2, 2, 6, 7, 0, 0, 1], [6, 2])
    real(8), parameter :: centres(4, 10) = reshape([ &
       0.17052726522621653d0,  0.21703470119700272d0, -0.9611536767295829d0,   1.9856592059582896d0, &
      -0.10055395189296748d0,  0.0335179839643225d0,  -0.9943668576082341d0,   2.1770657578215555d0, &
       0.4444444444444445d0,  -0.4444444444444445d0,   0.7777777777777778d0,   0.47588224966041665d0, &
       0.922834622346587d0,    0.2602866883541656d0,   0.28394911456818067d0,  0.674754939939827d0, &
       0.17142857142857132d0,  0.28571428571428575d0,  0.9428571428571428d0,   0.5410995259571458d0, &
       0.17609018126512466d0, -0.17609018126512466d0,  0.9684959969581862d0,   0.49398396078939316d0, &
      -0.9480982327478418d0,   0.3160327442492806d0,  -0.03511474936103117d0,  1.336912500475739d0, &
       0.08357745745261816d0,  0.3844563042820436d0,   0.9193520319788d0,      0.5371387058869839d0, &
      -0.3278510337753344d0,  -0.3832624761035597d0,   0.8634949762815143d0,   0.40078897330592966d0, &
       0.18418844413461452d0, -0.9500246065890643d0,  -0.2520473446052618d0,   1.193533799966544d0], [4, 10])
    integer :: ltri(9, 8), columns(6, n), nt, ier, listc(slots), lnew, nb, na, nodes(n)
    real(rk) :: c(10, 4)
    integer, external :: lstptr, nbcnt
    external :: trlist, crlist, bnodes

    call trlist(n, list, lptr, lend, 9, nt, ltri, ier)
    call expect(ier == 0 .and. nt == 8 .and. all(ltri == triangles), "seven nodes: TRLIST")

    nodes = mark
    call bnodes(n, list, lptr, lend, nodes, nb, na, nt)
    call expect(nb == 4 .and. na == 14 .and. nt == 8, "seven nodes: BNODES' counts")
    call expect(all(nodes == [2, 7, 6, 5, mark, mark, mark]), "seven nodes: BNODES' nodes, and no more of them")

    call expect(nbcnt(lend(1), lptr) == 4 .and. nbcnt(lend(7), lptr) == 4, "seven nodes: NBCNT")
    call expect(lstptr(lend(1), 6, list, lptr) == 16, "LSTPTR: a neighbour")
    call expect(lstptr(lend(2), 5, list, lptr) == 11, "LSTPTR: the last neighbour of a boundary node")
    call expect(lstptr(lend(2), 6, list, lptr) == 11, "LSTPTR: no neighbour")

    if (rk == 8) call searches
    call order_of_distance
    call polygons
    call random_numbers

    lnew = 29
    columns = mark
    c = 0
    call crlist(n, 1, x, y, z, list, lend, lptr, lnew, columns, listc, nb, c(:, 1), c(:, 2), c(:, 3), c(:, 4), ier)
    call expect(ier == 2 .and. nb == 4 .and. lnew == 29 .and. all(columns(:, 2:) == mark), "CRLIST: NCOL too small")
    columns = mark
    call crlist(n, n, x, y, z, list, lend, lptr, lnew, columns, listc, nb, c(:, 1), c(:, 2), c(:, 3), c(:, 4), ier)
    call expect(ier == 0 .and. nb == 4 .and. lnew == 31, "seven nodes: CRLIST")
    call expect(all(columns(:, 1:2) == pseudo) .and. all(columns(:, 3:) == mark), "seven nodes: CRLIST's LTRI")
    call expect(all(listc == cells), "seven nodes: LISTC")
    call expect(all(lptr == closed), "seven nodes: LPTR with the far side")
    call expect(all(abs(c - transpose(real(centres, rk))) < tolerance), "seven nodes: circumcentres and radii")
  end subroutine

  subroutine searches
    call search(1, [0.0_rk, 0.0_rk, 1.0_rk], [3, 4, 1], [0.36d0, 0d0, 0.168d0], 3, 0.283794109208328d0)
    call search(5, [0.0_rk, 0.0_rk, 1.0_rk], [3, 1, 5], [0.48d0, 0.2240000000000001d0, 0d0], 3, 0.283794109208328d0)
    call search(1, [0.0_rk, 0.0_rk, -1.0_rk], [6, 6, 0], [-7d0, -7d0, -0.6527999999999999d0], 6, 2.0714510391994847d0)
    call search(1, [1.0_rk, 0.0_rk, 0.0_rk], [2, 7, 0], [-7d0, -7d0, -0.5184d0], 6, 0.6435011087932843d0)
    call search(3, [-1.0_rk, 0.0_rk, 0.0_rk], [7, 2, 0], [-7d0, -7d0, -0.864d0], 7, 1.0701416143903084d0)
    call search(4, [0.0_rk, 1.0_rk, 0.0_rk], [7, 6, 0], [-7d0, -7d0, -0.288d0], 2, 0.6435011087932843d0)
    call search(1, [0.6_rk, 0.0_rk, 0.8_rk], [4, 6, 1], [2.7755575615628914d-17, 0d0, 0.384d0], 1, 0d0)
    call search(7, [-0.28_rk, 0.0_rk, 0.96_rk], [4, 3, 7], [0d0, 0.410176d0, 0d0], 3, 0d0)
  end subroutine

  subroutine order_of_distance
    integer :: npts(n), l, ier
    real(rk) :: df
    real(8), parameter :: cosines(2:n) = [0.768d0, 0.7104d0, 0.6d0, 0.576d0, 0.48d0, 0.2368d0]
    external :: getnp
    npts = mark
    npts(1) = 3
    do l = 2, n
      call getnp(x, y, z, list, lptr, lend, l, npts, df, ier)
      call expect(ier == 0 .and. abs(df + cosines(l)) < tolerance, "GETNP: DF")
    end do
    call expect(all(npts == [3, 4, 7, 1, 2, 5, 6]), "GETNP: nodes in order of distance")
  end subroutine

  subroutine polygons
    integer, parameter :: boundary(4) = [2, 7, 6, 5]
    real(rk) :: p(3)
    integer :: ier
    logical, external :: inside
    external :: intrsc
    call expect(inside([0.0_rk, 0.0_rk, 1.0_rk], n, x, y, z, 4, boundary, ier) .and. ier == 0, "INSIDE: within")
    call expect(.not. inside([1.0_rk, 0.0_rk, 0.0_rk], n, x, y, z, 4, boundary, ier) .and. ier == 0, "INSIDE: outside")
    call expect(inside([1.0_rk, 0.0_rk, 0.0_rk], n, x, y, z, 4, boundary(4:1:-1), ier) .and. ier == 0, &
                "INSIDE: a clockwise polygon is its complement")
    call intrsc([0.0_rk, 0.6_rk, 0.8_rk], [0.0_rk, -0.6_rk, 0.8_rk], [0.0_rk, 3.0_rk, 0.0_rk], p, ier)
    call expect(ier == 0 .and. all(p == [0, 0, 1]), "INTRSC")
  end subroutine

  subroutine random_numbers
    integer :: seeds(3), drawn(10), k
    integer, external :: jrand
    real(rk), external :: store
    seeds = [1, 2, 3]
    do k = 1, 10
      drawn(k) = jrand(1000, seeds(1), seeds(2), seeds(3))
    end do
    call expect(all(drawn == [34, 778, 53, 745, 491, 983, 810, 714, 802, 990]), "JRAND: numbers")
    call expect(all(seeds == [18240, 16436, 25613]), "JRAND: seeds")
    seeds = [1, 2, 3]
    do k = 1, 7997334
      drawn(1) = jrand(4, seeds(1), seeds(2), seeds(3))
    end do
    call expect(drawn(1) == merge(4, 5, rk == 8), "JRAND: N+1 in single precision")
    call expect(store(1/3.0_rk) == 1/3.0_rk, "STORE")
  end subroutine

  subroutine search(start, p, triangle, weights, nearest, angle)
    integer, intent(in) :: start, triangle(3), nearest
    real(rk), intent(in) :: p(3)
    real(8), intent(in) :: weights(3), angle
    integer :: i(3)
    real(rk) :: b(3), al
    integer, external :: nearnd
    external :: trfind
    b = -7
    call trfind(start, p, n, x, y, z, list, lptr, lend, b(1), b(2), b(3), i(1), i(2), i(3))
    call expect(all(i == triangle), "TRFIND: triangle")
    call expect(all(b == real(weights, rk)), "TRFIND: weights, to the last bit")
    call expect(nearnd(p, start, n, x, y, z, list, lptr, lend, al) == nearest, "NEARND: node")
    if (cos(al) < 1 - 2._rk**(-11)) then
      call expect(abs(al - real(angle, rk)) <= spacing(real(angle, rk)), "NEARND: angle")
    else  ! the original's is known from its cosine only
      call expect(abs(cos(al) - cos(real(angle, rk))) <= 2*epsilon(al), "NEARND: small angle")
    end if
  end subroutine
end program
