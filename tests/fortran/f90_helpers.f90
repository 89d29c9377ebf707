! The helpers of libstripack_f90.a.
program f90_helpers
  use, intrinsic :: ieee_arithmetic
  use expectations
  implicit none
  real(8), parameter :: pi = 3.14159265358979324d0
  real(8) :: x(3) = [3, 0, 1], y(3) = [4, 0, 1], z(3) = [12, 0, 1], u(3), v(3), w(3)
  real(8), external :: arc_cosine, d_pi
  real, external :: r_pi
  external :: d3vec_normalize, r83vec_normalize

  call expect(d_pi() == pi, "D_PI")
  call expect(r_pi() == real(pi), "R_PI")
  call expect(arc_cosine(1 + 1d-12) == 0 .and. arc_cosine(2d0) == 0, "ARC_COSINE above 1")
  call expect(arc_cosine(-1 - 1d-12) == pi .and. arc_cosine(-2d0) == pi, "ARC_COSINE below -1")
  call expect(abs(arc_cosine(0.5d0) - pi/3) < 1d-15, "ARC_COSINE")
  call expect(ieee_is_nan(arc_cosine(ieee_value(pi, ieee_quiet_nan))), "ARC_COSINE of NaN")

  u = x
  v = y
  w = z
  call d3vec_normalize(2, u, v, w)
  call expect(all(abs([u(1) - 3/13d0, v(1) - 4/13d0, w(1) - 12/13d0]) < 1d-15), "D3VEC_NORMALIZE")
  call expect(u(2) == 0 .and. v(2) == 0 .and. w(2) == 0, "D3VEC_NORMALIZE: a zero vector stays")
  call expect(u(3) == 1 .and. v(3) == 1 .and. w(3) == 1, "D3VEC_NORMALIZE: N vectors, no more")
  call r83vec_normalize(2, x, y, z)
  call expect(all(x == u) .and. all(y == v) .and. all(z == w), "R83VEC_NORMALIZE is the same")
end program
