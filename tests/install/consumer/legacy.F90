! Calls as in legacy codes, with and without `use stripack`. Ends with code 1 if the mesh of an octahedron is wrong.
program legacy
  use stripack
  implicit none
#ifdef SINGLE_PRECISION
  integer, parameter :: rk = 4
#else
  integer, parameter :: rk = 8
#endif
  integer, parameter :: n = 6
  real(rk) :: x(n) = [1, 0, 0, -1, 0, 0], y(n) = [0, 1, 0, 0, -1, 0], z(n) = [0, 0, 1, 0, 0, -1]
  integer :: list(6*n - 12), lptr(6*n - 12), lend(n), ltri(6, 2*n), ier, nt
#ifdef EIGHT_ARGUMENTS
  call trmesh(n, x, y, z, list, lptr, lend, ier)
#else
  real(rk) :: dist(n)
  integer :: lnew, near(n), next(n)
  call trmesh(n, x, y, z, list, lptr, lend, lnew, near, next, dist, ier)
  if (lnew /= 6*n - 11) error stop 'LNEW'
#endif
  if (ier /= 0) error stop 'TRMESH'
  call trlist(n, list, lptr, lend, 6, nt, ltri, ier)
  if (ier /= 0 .or. nt /= 8) error stop 'TRLIST'
  print '(a,i0,a)', 'legacy: ', nt, ' triangles'
end program legacy
