! Messages of EDGE and DELNOD on standard output, printed when the original prints them: two blank records, the text, one
! blank record; numbers without padding. CMakeLists.txt has the expected output. The triangulations have null triangles
! and are linked as the original's TRMESH links them.
program edit_messages
  use expectations
  implicit none
  integer, parameter :: seven(3, 7) = reshape([1, 1, 1, 0, 1, 1, 0, -1, 0, -1, 1, 1, 0, 1, 0, 0, 0, 1, 0, -1, 1], [3, 7])
  integer, parameter :: six(3, 6) = reshape([-2, 1, 1, -2, 0, -1, -1, 0, 1, -1, -1, 0, 1, -2, 1, 0, -1, 1], [3, 6])
  integer, parameter :: eight(3, 8) = reshape([0, 1, 0, 0, 1, -1, -1, -1, -1, 1, 1, 0, 1, 0, 0, 0, -1, 0, -1, -1, 0, &
                                               1, -1, 1], [3, 8])
  integer :: list(48), lptr(48), lend(8), lnew, lwk, iwk(2, 8), ier, n
  real(8) :: x(8), y(8), z(8)
  external :: edge, delnod

  call place(seven)
  list(:24) = [2, -3, 3, 1, 1, -2, 4, 5, 2, 2, -5, 5, 4, -1, -6, 6, 2, -4, 7, 7, 7, 2, 3, 1]
  lptr(:24) = [21, 12, 19, 8, 20, 5, 15, 7, 11, 14, 16, 1, 10, 13, 3, 9, 18, 17, 4, 6, 2, 23, 24, 22]
  lend(:7) = [2, 15, 6, 11, 14, 18, 24]
  lwk = 8
  call edge(7, 4, x, y, z, lwk, iwk, list, lptr, lend, ier)
  call expect(ier == 3 .and. lwk == 8, "EDGE: IER 3")

  call place(six)
  list(:22) = [2, -3, 3, -1, 1, 2, 4, 4, 3, 2, -5, 5, 5, 3, 4, -2, 6, 6, 6, 3, 4, 5]
  lptr(:22) = [2, 1, 4, 13, 6, 7, 17, 3, 10, 12, 5, 18, 8, 19, 16, 14, 11, 9, 15, 21, 22, 20]
  lend(:6) = [2, 4, 11, 10, 16, 22]
  lwk = 8
  call edge(1, 5, x, y, z, lwk, iwk, list, lptr, lend, ier)
  call expect(ier == 4, "EDGE: IER 4")

  call place(eight)
  list(:36) = [2, 3, 3, 1, 1, 2, 2, 4, 4, 6, 2, 1, -5, 5, 4, 1, 6, 6, 3, 4, 7, 7, 7, 1, 3, 6, -8, 8, 8, 8, 8, 5, 1, 7, &
               6, -4]
  lptr(:36) = [2, 21, 4, 8, 6, 17, 20, 10, 1, 3, 12, 13, 31, 9, 16, 27, 22, 11, 7, 30, 28, 5, 19, 25, 26, 29, 15, 14, &
               24, 23, 18, 33, 34, 35, 36, 32]
  lend = [21, 4, 17, 13, 27, 20, 26, 36]
  lnew = 37
  n = 8
  lwk = 8
  call delnod(1, n, x, y, z, list, lptr, lend, lnew, lwk, iwk, ier)
  call expect(ier == 5 .and. n == 7, "DELNOD: IER 5")

contains

  subroutine place(directions)
    integer, intent(in) :: directions(:, :)
    integer :: k
    real(8) :: length
    do k = 1, size(directions, 2)
      length = sqrt(real(sum(directions(:, k)**2), 8))
      x(k) = directions(1, k)/length
      y(k) = directions(2, k)/length
      z(k) = directions(3, k)/length
    end do
  end subroutine
end program
