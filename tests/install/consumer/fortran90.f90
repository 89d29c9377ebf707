! A program written against the Fortran 90 text of STRIPACK: it calls helpers of the same file.
program fortran90
  implicit none
  integer, parameter :: n = 6
  real(8) :: x(n) = [1, 0, 0, -2, 0, 0], y(n) = [0, 3, 0, 0, -1, 0], z(n) = [0, 0, 4, 0, 0, -1], dist(n)
  integer :: list(6*n - 12), lptr(6*n - 12), lend(n), lnew, near(n), next(n), ier, nt, corners(3, 2*n - 4)
  real(8), external :: arc_cosine, d_pi
  real, external :: r_pi
  call timestamp()
  call d3vec_normalize(n, x, y, z)
  if (any(abs(x**2 + y**2 + z**2 - 1) > 1d-15)) error stop 'D3VEC_NORMALIZE'
  if (abs(arc_cosine(-2d0) - d_pi()) > 1d-15 .or. abs(d_pi() - r_pi()) > 1d-6) error stop 'ARC_COSINE, D_PI, R_PI'
  call trmesh(n, x, y, z, list, lptr, lend, lnew, near, next, dist, ier)
  call trlist2(n, list, lptr, lend, nt, corners, ier)
  if (ier /= 0 .or. nt /= 8) error stop 'TRMESH or TRLIST2'
  call trprnt(n, x, y, z, 0, list, lptr, lend)
  print '(a)', 'fortran90: right'
end program
