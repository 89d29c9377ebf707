! Triangulates 1000 nodes on the unit sphere and adds up the areas of the triangles: the module pstripack.
!
! $ gfortran mesh.f90 -o mesh $(pkg-config --cflags --libs pstripack_fortran)
! $ ./mesh
program mesh
  use, intrinsic :: iso_fortran_env, only: int32, real64, error_unit
  use pstripack, only: pstripack_trmesh, pstripack_strerror, pstripack_ok
  implicit none
  integer(int32), parameter :: n = 1000
  real(real64), parameter :: pi = acos(-1._real64)
  real(real64) :: x(n), y(n), z(n), longitude, area
  integer(int32) :: list(6*n - 12), lptr(6*n - 12), lend(n), lnew, ier
  integer :: k, slot, triangles

  ! A spiral from pole to pole, a golden angle from node to node.
  do k = 1, n
    longitude = k*pi*(3 - sqrt(5._real64))
    z(k) = 1 - (2*k - 1)/real(n, real64)
    x(k) = sqrt(1 - z(k)**2)*cos(longitude)
    y(k) = sqrt(1 - z(k)**2)*sin(longitude)
  end do

  call pstripack_trmesh(x, y, z, list, lptr, lend, lnew, ier)
  if (ier /= pstripack_ok) then
    write (error_unit, '(a)') pstripack_strerror(ier)
    error stop
  end if

  ! Node k and two consecutive neighbours form a triangle. Count it only at its smallest corner. (If the nodes lie in
  ! a hemisphere, the last neighbour of a boundary node is negative and forms no triangle with the first.)
  triangles = 0
  area = 0
  do k = 1, n
    slot = lend(k)
    do
      if (list(slot) > k .and. abs(list(lptr(slot))) > k) then
        triangles = triangles + 1
        area = area + spherical_area(node(k), node(list(slot)), node(abs(list(lptr(slot)))))
      end if
      slot = lptr(slot)
      if (slot == lend(k)) exit
    end do
  end do
  print '(i0, a, i0, a, f9.6)', n, ' nodes, ', triangles, ' triangles, area ', area

contains

  pure function node(i)
    integer(int32), intent(in) :: i
    real(real64) :: node(3)
    node = [x(i), y(i), z(i)]
  end function

  ! Area of the triangle of unit vectors (Van Oosterom and Strackee).
  pure real(real64) function spherical_area(a, b, c)
    real(real64), intent(in) :: a(3), b(3), c(3)
    real(real64) :: b_cross_c(3)
    b_cross_c = [b(2)*c(3) - b(3)*c(2), b(3)*c(1) - b(1)*c(3), b(1)*c(2) - b(2)*c(1)]
    spherical_area = 2*atan2(dot_product(a, b_cross_c), &
                             1 + dot_product(a, b) + dot_product(b, c) + dot_product(c, a))
  end function
end program
