! Triangulates 1000 nodes on the unit sphere and adds up the areas of the triangles: Fortran 90 with STRIPACK's
! calls, whose arguments the module checks.
!
! $ gfortran mesh.f90 -o mesh $(pkg-config --cflags --libs stripack)
! $ ./mesh
program mesh
  use stripack
  implicit none
  integer, parameter :: dp = kind(1d0), n = 1000, nrow = 6
  real(dp) :: lat(n), lon(n), x(n), y(n), z(n), dist(n), area
  integer :: list(6*n - 12), lptr(6*n - 12), lend(n), lnew, near(n), next(n), ltri(nrow, 2*n - 4), nt, ier, k

  ! A spiral from pole to pole, a golden angle from node to node.
  lat = [(asin(1 - (2*k - 1)/real(n, dp)), k=1, n)]
  lon = [(k*acos(-1d0)*(3 - sqrt(5d0)), k=1, n)]
  call trans(n, lat, lon, x, y, z)

  call trmesh(n, x, y, z, list, lptr, lend, lnew, near, next, dist, ier)
  if (ier /= 0) stop 'trmesh'
  call trlist(n, list, lptr, lend, nrow, nt, ltri, ier)
  if (ier /= 0) stop 'trlist'

  area = 0
  do k = 1, nt
    area = area + areas(node(ltri(1, k)), node(ltri(2, k)), node(ltri(3, k)))
  end do
  print '(i0, a, i0, a, f9.6)', n, ' nodes, ', nt, ' triangles, area ', area

contains

  function node(i)
    integer, intent(in) :: i
    real(dp) :: node(3)
    node = [x(i), y(i), z(i)]
  end function
end program
