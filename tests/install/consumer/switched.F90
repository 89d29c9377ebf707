! Calls as in legacy codes, without a module. Ends with code 1 unless node 1 of an octahedron has its four neighbours.
program switched
  implicit none
#ifdef SINGLE_PRECISION
  integer, parameter :: rk = 4
#else
  integer, parameter :: rk = 8
#endif
  integer, parameter :: n = 6
  real(rk) :: x(n) = [1, 0, 0, -1, 0, 0], y(n) = [0, 1, 0, 0, -1, 0], z(n) = [0, 0, 1, 0, 0, -1]
  integer :: list(6*n - 12), lptr(6*n - 12), lend(n), ier, slot, neighbours(4), k
#ifdef EIGHT_ARGUMENTS
  call trmesh(n, x, y, z, list, lptr, lend, ier)
#else
  real(rk) :: dist(n)
  integer :: lnew, near(n), next(n)
  call trmesh(n, x, y, z, list, lptr, lend, lnew, near, next, dist, ier)
#endif
  if (ier /= 0) error stop 'TRMESH'
  slot = lend(1)
  do k = 1, 4
    slot = lptr(slot)
    neighbours(k) = list(slot)
  end do
  if (slot /= lend(1) .or. any(cshift(neighbours, findloc(neighbours, 2, 1) - 1) /= [2, 3, 5, 6])) error stop 'LIST'
  print '(a)', 'switched: right'
end program switched
