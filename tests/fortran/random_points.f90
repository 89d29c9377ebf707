!> Reproducible random points for the tests.
module random_points
  use, intrinsic :: iso_fortran_env, only: int64, real64
  implicit none
  integer(int64), private :: state = 1
contains
  subroutine seed(k)
    integer, intent(in) :: k
    state = 12345 + 99991*int(k, int64)
  end subroutine

  !> Uniform in [0,1), with 31 random bits (Lehmer, Park and Miller).
  real(real64) function uniform()
    state = mod(48271*state, 2147483647_int64)
    uniform = real(state, real64)/2147483647
  end function

  !> A random point of the unit sphere.
  function direction() result(p)
    real(real64) :: p(3), square
    do
      p = 2*[uniform(), uniform(), uniform()] - 1
      square = sum(p**2)
      if (square > 0.01 .and. square < 1) exit
    end do
    p = p/sqrt(square)
  end function

  !> Two orthogonal unit vectors perpendicular to the unit vector `axis`.
  subroutine basis(axis, u, v)
    real(real64), intent(in) :: axis(3)
    real(real64), intent(out) :: u(3), v(3)
    u = cshift(axis, 1)*[1, 1, -1]
    u = u - dot_product(u, axis)*axis
    u = u/sqrt(sum(u**2))
    v = cshift(axis, 1)*cshift(u, 2) - cshift(axis, 2)*cshift(u, 1)
  end subroutine
end module
