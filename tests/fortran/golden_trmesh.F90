! TRMESH with PSTRIPACK_ORDER=original or bitwise, on three small sets of nodes: the LIST, LPTR, LEND and LNEW that every
! variant of the original returns. REAL_KIND: 4 or 8, as in the library.
program golden_trmesh
  use expectations
  implicit none
  integer, parameter :: rk = REAL_KIND
  integer, parameter :: mark = -7777

  include 'seven_nodes.inc'

  call expect_lists("octahedron", [real(rk) :: 1, 0, 0, -1, 0, 0], [real(rk) :: 0, 1, 0, 0, -1, 0], &
    [real(rk) :: 0, 0, 1, 0, 0, -1], 25, &
    [2, 3, 3, 1, 1, 2, 4, 4, 3, 2, 5, 5, 5, 1, 3, 4, 6, 6, 6, 6, 1, 5, 4, 2], &
    [2, 11, 4, 20, 6, 7, 12, 3, 10, 19, 17, 5, 9, 15, 16, 18, 1, 14, 13, 8, 22, 23, 24, 21], &
    [11, 4, 7, 10, 16, 24])
  call expect_lists("six nodes", x(1:6), y(1:6), z(1:6), 21, &
    [5, 3, 3, 3, 1, -2, 4, 4, 1, -3, -5, 5, 2, 1, -6, 6, 6, 5, 1, -4], [integer ::], [7, 11, 6, 10, 15, 20])
  call expect_lists("seven nodes", x, y, z, 29, list(1:28), lptr(1:28), lend)

contains

  ! Without an expected LPTR it is not compared.
  subroutine expect_lists(what, px, py, pz, expected_lnew, expected_list, expected_lptr, expected_lend)
    character(len=*), intent(in) :: what
    real(rk), intent(in) :: px(:), py(:), pz(:)
    integer, intent(in) :: expected_lnew, expected_list(:), expected_lptr(:), expected_lend(:)
    integer :: nodes, last, got_lnew, ier
    integer :: got_list(6*size(px) - 12), got_lptr(6*size(px) - 12), got_lend(size(px))
    integer :: near(size(px)), next(size(px))
    real(rk) :: dist(size(px))
    external :: trmesh

    nodes = size(px)
    last = expected_lnew - 1
    got_list = mark
    got_lptr = mark
    call trmesh(nodes, px, py, pz, got_list, got_lptr, got_lend, got_lnew, near, next, dist, ier)
    call expect(ier == 0 .and. got_lnew == expected_lnew, what // ": IER and LNEW")
    call expect(all(got_list(1:last) == expected_list), what // ": LIST")
    if (size(expected_lptr) > 0) call expect(all(got_lptr(1:last) == expected_lptr), what // ": LPTR")
    call expect(all(got_lend == expected_lend), what // ": LEND")
    call expect(all(got_list(last + 1:) == mark) .and. all(got_lptr(last + 1:) == mark), what // ": slots from LNEW on")
  end subroutine

end program
