! A program with its own SWAP, INSERT, LEFT, STORE and LSTPTR, as user codes have: the library must neither clash with
! them nor call them. Linked with the shared and with the static library.
subroutine swap(a, b)
  real(8) :: a, b, c
  c = a
  a = b
  b = c
end subroutine
subroutine insert
  error stop "the library called the program's INSERT"
end subroutine
subroutine store
  error stop "the library called the program's STORE"
end subroutine
integer function lstptr()
  error stop "the library called the program's LSTPTR"
  lstptr = 0
end function
logical function left()
  error stop "the library called the program's LEFT"
  left = .false.
end function

program own_routines
  use expectations
  implicit none
  integer, parameter :: n = 100, slots = 6*n - 12
  real(8) :: x(n), y(n), z(n), dist(n), xc(2*n), yc(2*n), zc(2*n), rc(2*n), b(3), al, u(2) = [1, 2]
  integer :: list(slots), lptr(slots), lend(n), lnew, near(n), next(n), ier, nt, ltri(6, 2*n), columns(6, n), nb, i(3)
  integer :: cells(slots), k
  integer, external :: nearnd
  external :: trmesh, trlist, crlist, trfind, swap
  do k = 1, n
    z(k) = 2*real(k, 8)/(n + 1) - 1
    x(k) = sqrt(1 - z(k)**2)*cos(2.4d0*k)
    y(k) = sqrt(1 - z(k)**2)*sin(2.4d0*k)
  end do
  call swap(u(1), u(2))
  call expect(u(1) == 2, "the program calls its own SWAP")
  call trmesh(n, x, y, z, list, lptr, lend, lnew, near, next, dist, ier)
  call expect(ier == 0 .and. lnew == slots + 1, "TRMESH")
  call trlist(n, list, lptr, lend, 6, nt, ltri, ier)
  call expect(ier == 0 .and. nt == 2*n - 4, "TRLIST")
  call crlist(n, n, x, y, z, list, lend, lptr, lnew, columns, cells, nb, xc, yc, zc, rc, ier)
  call expect(ier == 0 .and. nb == 0, "CRLIST")
  call trfind(1, [x(7), y(7), z(7)], n, x, y, z, list, lptr, lend, b(1), b(2), b(3), i(1), i(2), i(3))
  call expect(any(i == 7), "TRFIND")
  call expect(nearnd([x(7), y(7), z(7)], 1, n, x, y, z, list, lptr, lend, al) == 7, "NEARND")
end program
