! ADDNOD, DELNOD, DELARC and EDGE on a small triangulation, through implicit interfaces as in old codes: the results
! that every variant of the original gives. REAL_KIND: 4 or 8, as in the library.
program golden_edits
  use expectations
  implicit none
  integer, parameter :: rk = REAL_KIND
  integer, parameter :: mark = -7777

  include 'seven_nodes.inc'
  integer :: a(slots), b(slots), c(n), nodes, lnew, lwk, iwk(2, n), ier
  real(rk) :: p(n, 3)
  external :: addnod, delnod, delarc, edge

  ! Node 7 is added to the triangulation of the others.
  a = mark
  b = mark
  c = mark
  a(:20) = [5, 3, 3, 3, 1, -2, 4, 4, 1, -3, -5, 5, 2, 1, -6, 6, 6, 5, 1, -4]
  b(:20) = [6, 7, 11, 14, 1, 8, 16, 5, 10, 17, 3, 2, 4, 15, 13, 12, 9, 19, 20, 18]
  c(:6) = [7, 11, 6, 10, 15, 20]
  lnew = 21
  call addnod(0, 7, x, y, z, a, b, c, lnew, ier)
  call expect(ier == 0 .and. lnew == 29, "ADDNOD")
  call expect(all(a == list) .and. all(b == lptr) .and. all(c == lend), "ADDNOD: LIST, LPTR, LEND")

  call seven
  nodes = 7
  lwk = 7
  call delnod(3, nodes, p(:, 1), p(:, 2), p(:, 3), a, b, c, lnew, lwk, iwk, ier)
  call expect(ier == 0 .and. nodes == 6 .and. lwk == 2 .and. lnew == 23, "DELNOD")
  call expect(all(iwk(:, 1) == [2, 1]) .and. all(iwk(:, 2) == [3, 2]) .and. all(iwk(:, 3:) == mark), "DELNOD: IWK")
  call expect(all(a(:22) == [6, 3, 3, -2, 2, 5, 3, 1, 1, 2, -4, 4, 2, 1, -5, 5, 5, 4, 1, 3, -6, 6]), "DELNOD: LIST")
  call expect(all(b(:22) == [2, 8, 4, 6, 22, 3, 16, 11, 5, 7, 1, 10, 14, 15, 13, 12, 9, 19, 20, 21, 18, 17]), &
              "DELNOD: LPTR")
  call expect(all(c(:6) == [7, 11, 9, 15, 21, 4]), "DELNOD: LEND")
  call expect(all(p(3:6, 1) == x(4:7)) .and. all(p(3:6, 2) == y(4:7)) .and. all(p(3:6, 3) == z(4:7)), "DELNOD: X, Y, Z")

  call seven
  call delarc(7, 2, 5, a, b, c, lnew, ier)
  call expect(ier == 0 .and. lnew == 27, "DELARC")
  call expect(all(a(:26) == [-5, 3, -3, 3, 1, 2, 4, 4, 1, 3, 3, 5, -2, 1, -6, 6, 6, 5, 1, 4, -7, 7, 7, 7, 6, 4]), &
              "DELARC: LIST")
  call expect(all(b(:26) == [6, 7, 24, 14, 1, 23, 16, 5, 10, 22, 13, 2, 25, 15, 4, 12, 9, 19, 20, 21, 18, 17, 8, 3, &
                             26, 11]), "DELARC: LPTR")
  call expect(all(c == [7, 3, 1, 10, 15, 21, 13]), "DELARC: LEND")

  call force(2, 4, [2, 1], [1, 2, 3, 2, 4, 2, 4, 4, 1, 3, -5, 5, 2, 1, -6, 6, 6, 5, 1, 4, -7, 7, 7, 7, 6, 4, 3, -2], &
             [11, 10, 5, 7, 1, 23, 16, 6, 2, 22, 24, 4, 14, 15, 13, 12, 9, 19, 20, 21, 18, 17, 8, 3, 26, 27, 28, 25], &
             [7, 11, 6, 10, 15, 21, 28])
  call force(5, 7, [5, 4], [5, 5, 3, 3, 4, 2, 4, 7, 1, 5, -5, 5, 2, 1, -6, 6, 6, 5, 1, 4, -7, 7, 7, 7, 6, 4, 3, -2], &
             [6, 22, 11, 8, 14, 23, 16, 5, 2, 27, 24, 7, 4, 15, 13, 12, 9, 19, 20, 21, 18, 17, 1, 3, 26, 10, 28, 25], &
             [7, 11, 6, 2, 15, 21, 28])
  call seven
  lwk = 7
  call edge(2, 7, x, y, z, lwk, iwk, a, b, c, ier)
  call expect(ier == 0 .and. lwk == 7 .and. all(iwk == mark), "EDGE of neighbours")
  call expect(all(a == list) .and. all(b == lptr) .and. all(c == lend), "EDGE of neighbours changes nothing")

contains

  subroutine seven
    a = list
    b = lptr
    c = lend
    lnew = 29
    p = reshape([x, y, z], [n, 3])
    iwk = mark
  end subroutine

  subroutine force(in1, in2, first_column, new_list, new_lptr, new_lend)
    integer, intent(in) :: in1, in2, first_column(2), new_list(28), new_lptr(28), new_lend(7)
    call seven
    lwk = 7
    call edge(in1, in2, x, y, z, lwk, iwk, a, b, c, ier)
    call expect(ier == 0 .and. lwk == 2, "EDGE")
    call expect(all(iwk(:, 1) == first_column) .and. all(iwk(:, 2) == 0) .and. all(iwk(:, 3:) == mark), "EDGE: IWK")
    call expect(all(a(:28) == new_list) .and. all(b(:28) == new_lptr) .and. all(c == new_lend), "EDGE: the lists")
  end subroutine
end program
