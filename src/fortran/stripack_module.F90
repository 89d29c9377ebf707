! Module stripack: explicit interfaces to the symbols of libstripack, libstripack_r4, libstripack_8arg.
!
! This file is installed, because module files belong to one compiler. Compile it yourself as you compile
! your code, with any -r8 or -fdefault-real-8 of yours; no object is needed, only the module file:
!
!   gfortran -c stripack_module.F90                              for libstripack
!   gfortran -c -DSTRIPACK_REAL_KIND=4 -DSTRIPACK_WITHOUT_F90_EXTRAS stripack_module.F90     for libstripack_r4
!   gfortran -c -DSTRIPACK_8_ARGUMENTS stripack_module.F90       for libstripack_8arg
!
!   STRIPACK_MODULE        name of the module                    default: stripack
!                          (CMake's own dependency scanner does not see through it; in a CMake project write
!                          a module of that name that contains `use stripack`)
!   STRIPACK_REAL_KIND     kind of all REAL arguments            default: double precision, which is the kind
!                          of the library and of a default REAL promoted by -r8 or -fdefault-real-8
!   STRIPACK_WITHOUT_F90_EXTRAS   no TRLIST2, which libstripack_r4 does not have
!   STRIPACK_8_ARGUMENTS   TRMESH without LNEW, NEAR, NEXT, DIST
!
! INTEGER and LOGICAL are the default kinds. No dummy has an INTENT: programs pass INTENT(IN) arrays of
! their own as output, as the original allows. Arrays are explicit-shape or assumed-size.
!
! All routines: none is collective (of an MPI program any number of ranks may call any number of times),
! none keeps state, any number of threads may call at once. Nodes and slots count from 1. LIST and LPTR
! have at least 6N-12 elements, LEND has N. Angles are in radians, lengths in units of the radius.

#ifndef STRIPACK_REAL_KIND
#define STRIPACK_REAL_KIND selected_real_kind(15, 307)
#endif

#ifdef STRIPACK_MODULE
module STRIPACK_MODULE
#else
module stripack
#endif
  implicit none

  interface

#ifdef STRIPACK_8_ARGUMENTS
    ! The Delaunay triangulation of nodes 1..N, N >= 3, as lists of neighbours, counterclockwise.
    ! IER  0; -1 N < 3; -2 the first three nodes lie on one great circle; L > 0 nodes L and M > L coincide,
    !      M the smallest, and the lists are those of nodes 1..M-1; -4 N too large; -5 a coordinate is not
    !      finite or a vector is zero; -6 out of memory. On a negative IER only IER is written.
    subroutine trmesh(n, x, y, z, list, lptr, lend, ier)
      integer :: n, list(*), lptr(*), lend(n), ier
      real(STRIPACK_REAL_KIND) :: x(n), y(n), z(n)
    end subroutine
#else
    ! The Delaunay triangulation of nodes 1..N, N >= 3, as lists of neighbours, counterclockwise.
    ! LNEW is one past the last slot used; NEAR, NEXT, DIST are not used and may overlap.
    ! IER  0; -1 N < 3; -2 the first three nodes lie on one great circle; L > 0 nodes L and M > L coincide,
    !      M the smallest, and the lists are those of nodes 1..M-1; -4 N too large; -5 a coordinate is not
    !      finite or a vector is zero; -6 out of memory. On a negative IER only IER is written.
    subroutine trmesh(n, x, y, z, list, lptr, lend, lnew, near, next, dist, ier)
      integer :: n, list(*), lptr(*), lend(n), lnew, near(*), next(*), ier
      real(STRIPACK_REAL_KIND) :: x(n), y(n), z(n), dist(*)
    end subroutine
#endif

    ! Cartesian coordinates X, Y, Z of N points at latitude RLAT and longitude RLON (radians).
    ! X and Y may be the arrays RLAT and RLON.
    subroutine trans(n, rlat, rlon, x, y, z)
      integer :: n
      real(STRIPACK_REAL_KIND) :: rlat(*), rlon(*), x(*), y(*), z(*)
    end subroutine

    ! Latitude PLAT and longitude PLON (radians, -pi..pi) and length PNRM of the vector (PX,PY,PZ).
    subroutine scoord(px, py, pz, plat, plon, pnrm)
      real(STRIPACK_REAL_KIND) :: px, py, pz, plat, plon, pnrm
    end subroutine

    ! True if (X0,Y0,Z0) lies left of, or on, the great circle from (X1,Y1,Z1) to (X2,Y2,Z2), as rounded.
    logical function left(x1, y1, z1, x2, y2, z2, x0, y0, z0)
      real(STRIPACK_REAL_KIND) :: x1, y1, z1, x2, y2, z2, x0, y0, z0
    end function

    ! Area (steradians) of the spherical triangle V1, V2, V3, in either order; vectors of any length.
    function areas(v1, v2, v3)
      real(STRIPACK_REAL_KIND) :: v1(3), v2(3), v3(3), areas
    end function

    ! Circumcentre C, a unit vector, of the counterclockwise triangle V1, V2, V3.
    ! IER  0; 1 two corners coincide, C is not written.
    subroutine circum(v1, v2, v3, c, ier)
      real(STRIPACK_REAL_KIND) :: v1(3), v2(3), v3(3), c(3)
      integer :: ier
    end subroutine

    ! The slot of neighbour NB in the list whose last slot is LPL = LEND(k); LPL if there is none.
    integer function lstptr(lpl, nb, list, lptr)
      integer :: lpl, nb, list(*), lptr(*)
    end function

    ! The number of neighbours in the list whose last slot is LPL.
    integer function nbcnt(lpl, lptr)
      integer :: lpl, lptr(*)
    end function

    ! The NB boundary nodes, counterclockwise; numbers NA of arcs and NT of triangles. NB = 0 and NODES
    ! not written if the triangles cover the sphere.
    subroutine bnodes(n, list, lptr, lend, nodes, nb, na, nt)
      integer :: n, list(*), lptr(*), lend(n), nodes(*), nb, na, nt
    end subroutine

    ! The NT triangles: rows 1-3 of LTRI corners, counterclockwise, smallest first; rows 4-6 the triangle
    ! opposite, or 0; with NROW = 9 rows 7-9 the arc opposite. LTRI has at least 2N-4 columns.
    ! IER  0; 1 N < 3 or NROW neither 6 nor 9; 2 not the lists of a triangulation; -6 out of memory, one
    !      line on stderr (the original has no such case). NT = 0 unless IER = 0.
    subroutine trlist(n, list, lptr, lend, nrow, nt, ltri, ier)
      integer :: n, list(*), lptr(*), lend(n), nrow, nt, ltri(nrow, *), ier
    end subroutine

#ifndef STRIPACK_WITHOUT_F90_EXTRAS
    ! The corners of the NT triangles alone; otherwise as TRLIST.
    subroutine trlist2(n, list, lptr, lend, nt, ltri, ier)
      integer :: n, list(*), lptr(*), lend(n), nt, ltri(3, *), ier
    end subroutine
#endif

    ! The Voronoi diagram: circumcentres XC, YC, ZC and radii RC (radians) of 2N-4 triangles; LISTC, by the
    ! slots of LIST, the triangle left of each arc, so that LISTC along LPTR from LEND(k) goes round the
    ! cell of node k, counterclockwise. NB > 0 boundary nodes: NB-2 triangles, whose columns are in LTRI,
    ! close the sphere, LPTR and LNEW are changed to hold them too, and NCOL >= NB-2 is needed. NB = 0:
    ! LTRI, LPTR, LNEW are not written, and NCOL may be 0.
    ! IER  0; 1 N < 3; 2 NCOL < NB-2; 3 two corners of a triangle coincide; and, which the original does
    !      not have, each with one line on stderr: -6 out of memory, -9 not the lists of a triangulation.
    subroutine crlist(n, ncol, x, y, z, list, lend, lptr, lnew, ltri, listc, nb, xc, yc, zc, rc, ier)
      integer :: n, ncol, list(*), lend(n), lptr(*), lnew, ltri(6, *), listc(*), nb, ier
      real(STRIPACK_REAL_KIND) :: x(n), y(n), z(n), xc(*), yc(*), zc(*), rc(*)
    end subroutine

    ! The triangle I1, I2, I3 that P lies in, and its weights B1, B2, B3 up to scale; the search starts at
    ! node NST, or a random one if that is not in 1..N. I3 = 0: P is outside, I1 and I2 are the rightmost
    ! and leftmost boundary nodes that it sees. I1 = 0: all nodes on one great circle, or P zero or NaN.
    subroutine trfind(nst, p, n, x, y, z, list, lptr, lend, b1, b2, b3, i1, i2, i3)
      integer :: nst, n, list(*), lptr(*), lend(n), i1, i2, i3
      real(STRIPACK_REAL_KIND) :: p(3), x(n), y(n), z(n), b1, b2, b3
    end subroutine

    ! The node nearest to the unit vector P and its distance AL (radians); the search starts at node IST.
    ! 0 if N < 3 or P is not found: AL is then 0, or in libstripack_r4 not written.
    integer function nearnd(p, ist, n, x, y, z, list, lptr, lend, al)
      integer :: ist, n, list(*), lptr(*), lend(n)
      real(STRIPACK_REAL_KIND) :: p(3), x(n), y(n), z(n), al
    end function

  end interface

end module
