! Module stripack: explicit interfaces to the symbols of libstripack, libstripack_r4, libstripack_8arg and
! libstripack_i8. Made by docs/api/make-api.py from stripack_module.F90.in and docs/api/routines: edit those.
!
! This file is installed because a module file is valid for one compiler only. Compile it with your code's options,
! such as -r8, -i8, -fdefault-real-8 or -fdefault-integer-8. Only the module file is needed, not the object file.
! Options that gfortran needs, by library:
!
!   libstripack        nothing
!   libstripack_r4     -DSTRIPACK_REAL_KIND=4
!   libstripack_8arg   -DSTRIPACK_8_ARGUMENTS
!   libstripack_i8     -fdefault-integer-8
!
! For a module of another name write one that uses this one, as
!
!   module trmesh_module; use stripack, only: trmesh; end module
!
! or define STRIPACK_MODULE. Two modules made in the second way are ambiguous where both are used, and CMake's
! dependency scanner does not expand their name. Macros:
!
!   STRIPACK_MODULE        name of the module                    default: stripack
!   STRIPACK_REAL_KIND     kind of all REAL arguments            default: double precision, which is the kind
!                          of the library and of a default REAL promoted by -r8 or -fdefault-real-8
!   STRIPACK_8_ARGUMENTS   TRMESH without LNEW, NEAR, NEXT, DIST
!
! INTEGER and LOGICAL are the default kinds. No dummy has an INTENT: programs pass INTENT(IN) arrays of
! their own as output, as the original allows. Arrays are explicit-shape or assumed-size.
!
! No routine is collective, except TRMESH after `call pstripack_set_comm`. Any number of threads may call at
! once with their own arrays. Nodes and slots count from 1. LIST and LPTR have at least 6N-12 elements, LEND
! has N. Angles are in radians except in TRPLOT and VRPLOT; lengths are in units of the radius. All
! arguments: man 3 trmesh etc., or docs/api.

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

    ! Builds the Delaunay triangulation of nodes on the unit sphere.
    ! The triangulation covers the sphere and has 3N-6 arcs and 2N-4 triangles. If all nodes lie in a
    ! hemisphere, it covers their convex hull and has NB >= 3 boundary nodes, 3N-NB-3 arcs and 2N-NB-2
    ! triangles.
    ! LIST holds the neighbours of node k counterclockwise: the last in slot LEND(k), the first in slot
    ! LPTR(LEND(k)), the successor of slot s in slot LPTR(s). The last neighbour of a boundary node is
    ! negated.
    ! The lists are canonical: nodes in increasing order, the neighbours of each in consecutive slots; an
    ! interior node starts with its neighbour of lowest number, a boundary node with its first boundary
    ! neighbour. Threads and ranks do not change the bytes. `PSTRIPACK_ORDER=original` returns the original's
    ! lists wherever its triangulation is correct; `PSTRIPACK_ORDER=bitwise` also returns them where the
    ! triangulation is not exactly Delaunay, with the original's IER.
    ! IER  0 done; -1 N < 3; -2 nodes 1, 2, 3 lie on one great circle, by exact sign: number others first;
    !      L > 0 node L coincides with node M, the first that repeats an earlier one; -4 N > 357,913,943:
    !      6N-11 does not fit 32 bits; in libstripack_i8 too (new); -5 a coordinate is not finite, or a node
    !      is (0,0,0) (new); -6 out of memory (new); -7 collective calls only: the ranks disagree in N or the
    !      coordinates (new).
#ifdef STRIPACK_8_ARGUMENTS
    subroutine trmesh(n, x, y, z, list, lptr, lend, ier)
      integer :: n, list(*), lptr(*), lend(n), ier
      real(STRIPACK_REAL_KIND) :: x(n), y(n), z(n)
    end subroutine
#else
    subroutine trmesh(n, x, y, z, list, lptr, lend, lnew, near, next, dist, ier)
      integer :: n, list(*), lptr(*), lend(n), lnew, near(*), next(*), ier
      real(STRIPACK_REAL_KIND) :: x(n), y(n), z(n), dist(*)
    end subroutine
#endif

    ! Lists the triangles with their neighbours and, on request, their arcs.
    ! Column t of LTRI is triangle t. Rows 1-3: its corners, counterclockwise, the smallest first. Rows 4-6:
    ! the triangle opposite each corner, 0 at the boundary. Rows 7-9 (NROW = 9): the arc opposite each corner.
    ! Triangles are numbered by their smallest corner, then in the order of its list; arcs from 1 to NA, in
    ! the order of their last triangle. CRLIST numbers triangles differently.
    ! IER  0 done; 1 N < 3, or NROW is neither 6 nor 9; 2 not the lists of a triangulation; -6 out of memory
    !      (new).
    subroutine trlist(n, list, lptr, lend, nrow, nt, ltri, ier)
      integer :: n, list(*), lptr(*), lend(n), nrow, nt, ltri(nrow, *), ier
    end subroutine

    ! Lists the corners of the triangles.
    ! Returns rows 1-3 of TRLIST's LTRI, with the same numbers.
    ! IER  0 done; 1 N < 3; 2 not the lists of a triangulation; -6 out of memory (new).
    subroutine trlist2(n, list, lptr, lend, nt, ltri, ier)
      integer :: n, list(*), lptr(*), lend(n), nt, ltri(3, *), ier
    end subroutine

    ! Lists the boundary nodes and counts arcs and triangles.
    ! NODES lists them counterclockwise from the smallest. If the triangles cover the sphere, NB = 0 and NODES
    ! is not written.
    subroutine bnodes(n, list, lptr, lend, nodes, nb, na, nt)
      integer :: n, list(*), lptr(*), lend(n), nodes(*), nb, na, nt
    end subroutine

    ! Finds the triangle that contains a point.
    ! I3 /= 0: (I1,I2,I3) is the counterclockwise triangle that contains P. B1, B2, B3 >= 0 are weights up to
    ! a common factor: P points at (B1*node I1 + B2*node I2 + B3*node I3)/(B1+B2+B3). B3 = 0 if P lies on the
    ! arc I1-I2.
    ! I3 = 0: P is outside. I1 and I2 are the rightmost and the leftmost boundary node visible from P (looking
    ! at the triangles); I1 = I2 if all boundary nodes are visible. I1 = I2 = I3 = 0: not found, because all
    ! nodes lie on one great circle, or P is zero or NaN. B1, B2, B3 are then undefined.
    subroutine trfind(nst, p, n, x, y, z, list, lptr, lend, b1, b2, b3, i1, i2, i3)
      integer :: nst, n, list(*), lptr(*), lend(n), i1, i2, i3
      real(STRIPACK_REAL_KIND) :: p(3), x(n), y(n), z(n), b1, b2, b3
    end subroutine

    ! Finds the node nearest to a point.
    ! Returns the nearest node, and its distance in AL. The triangulation must be Delaunay; after EDGE or
    ! DELARC it may not be, and the result may be wrong. If several nodes are equally near, the result is any
    ! of them.
    ! Result  the nearest node; 0 if N < 3 or P is not found, see TRFIND.
    integer function nearnd(p, ist, n, x, y, z, list, lptr, lend, al)
      integer :: ist, n, list(*), lptr(*), lend(n)
      real(STRIPACK_REAL_KIND) :: p(3), x(n), y(n), z(n), al
    end function

    ! Finds the next nearest node to a node.
    ! NPTS(1) is a node, NPTS(2..L-1) the nodes nearest to it, in order, from earlier calls; the call sets
    ! NPTS(L). Calls with L = 2, 3, ... give all nodes by their distance from NPTS(1).
    ! IER  0 done; 1 L < 2; -5 a distance is not finite (new); -6 out of memory (new); -13 a list runs into a
    !      loop (new); -10 NPTS holds a number below 1, or the same one twice (new); -15 no node is left: L >
    !      N (new).
    subroutine getnp(x, y, z, list, lptr, lend, l, npts, df, ier)
      integer :: list(*), lptr(*), lend(*), l, npts(*), ier
      real(STRIPACK_REAL_KIND) :: x(*), y(*), z(*), df
    end subroutine

    ! Counts the neighbours of a node.
    ! Result  number of neighbours of node k.
    integer function nbcnt(lpl, lptr)
      integer :: lpl, lptr(*)
    end function

    ! Finds the slot of a neighbour.
    ! Returns the slot s with LIST(s) = NB, or LPL if NB is the last neighbour, or is no neighbour:
    ! abs(LIST(LPL)) = NB only in the first case.
    ! Result  slot of NB in the list of node k, or LPL.
    integer function lstptr(lpl, nb, list, lptr)
      integer :: lpl, nb, list(*), lptr(*)
    end function

    ! Adds a node to a triangulation.
    ! Inserts node K into the triangulation of nodes 1..K-1 and swaps arcs until all are locally Delaunay.
    ! Uses slots from LNEW on.
    ! IER  0 done; -1 K < 4; -2 node K and all others lie on one great circle, or node K is (0,0,0);
    !      L > 0 node K coincides with node L; -4 6K-12 does not fit the integer kind (new); -5 a coordinate
    !      of node K is not finite (new); -13 not the lists of a triangulation (new).
    subroutine addnod(nst, k, x, y, z, list, lptr, lend, lnew, ier)
      integer :: nst, k, list(*), lptr(*), lend(k), lnew, ier
      real(STRIPACK_REAL_KIND) :: x(k), y(k), z(k)
    end subroutine

    ! Deletes a node from a triangulation.
    ! Nodes K+1..N become K..N-1 in all arrays, coordinates included; N and LNEW decrease. The columns of IWK
    ! hold the end points, in the new numbers, of the optimised arcs that replace those of K.
    ! A node with m neighbours needs m-3 columns of IWK, m-2 on the boundary. With fewer, IER = 2 and LWK
    ! returns the number.
    ! IER  0 done; 1 K outside 1..N, N < 4, or LWK < 0; 2 LWK is too small; 3 K has fewer than 3 neighbours,
    !      or a neighbour does not list it: not a triangulation; 4 arcs of an interior node cannot be swapped
    !      away although there is a boundary; 5 OPTIM failed; a message on standard output; 6 OPTIM reached
    !      its limit of iterations; -13 not the lists of a triangulation (new).
    subroutine delnod(k, n, x, y, z, list, lptr, lend, lnew, lwk, iwk, ier)
      integer :: k, n, list(*), lptr(*), lend(n), lnew, lwk, iwk(2, *), ier
      real(STRIPACK_REAL_KIND) :: x(n), y(n), z(n)
    end subroutine

    ! Removes a boundary arc.
    ! Removes the triangle on the arc; the node opposite becomes a boundary node. The result may not be
    ! convex: TRFIND, NEARND, ADDNOD, DELNOD and EDGE are then unreliable.
    ! IER  0 done; 1 N < 4, a node outside 1..N, or IO1 = IO2; 2 IO1-IO2 is not a boundary arc; 3 the node
    !      opposite is already a boundary node; 4 the nodes do not list each other: not a triangulation;
    !      -13 not the lists of a triangulation (new).
    subroutine delarc(n, io1, io2, list, lptr, lend, lnew, ier)
      integer :: n, io1, io2, list(*), lptr(*), lend(n), lnew, ier
    end subroutine

    ! Forces an arc between two nodes.
    ! Swaps arcs that cross IN1-IN2 until this arc exists, then optimises the new arcs beside it. This makes
    ! boundaries of regions arcs. Later calls of ADDNOD, DELNOD or OPTIM may swap the arc away.
    ! On success IWK has the new arcs left of IN1-IN2, then a column (0,0), then the new arcs right of
    ! IN1-IN2. Left and right are exchanged if the search had to start from IN2. N columns suffice unless
    ! nodes are collinear.
    ! EDGE is told neither N nor the lengths of the arrays. With broken lists it reads outside LIST and LPTR
    ! if LEND or LPTR is above 6N-12. It reads outside X, Y, Z and LEND if the list of IN1 or IN2 holds a
    ! neighbour above N. It uses a number above N from another list only if two lists agree on it.
    ! IER  0 the arc exists; 1 IN1 < 1, IN2 < 1, IN1 = IN2 or LWK < 0; 2 more than LWK arcs cross IN1-IN2;
    !      3 no crossing arc is found: null triangles or a broken triangulation; a message on standard output;
    !      4 OPTIM failed, also with -13; a message on standard output; 5 OPTIM reached its limit of
    !      iterations; -13 not the lists of a triangulation (new); -16 the arcs cannot be swapped away: nodes
    !      lie on IN1-IN2, up to rounding, or triangles overlap (new).
    subroutine edge(in1, in2, x, y, z, lwk, iwk, list, lptr, lend, ier)
      integer :: in1, in2, lwk, iwk(2, *), list(*), lptr(*), lend(*), ier
      real(STRIPACK_REAL_KIND) :: x(*), y(*), z(*)
    end subroutine

    ! Optimises a set of arcs.
    ! Replaces arcs in IWK by the other diagonal of their quadrilateral where the circumcircle test requires
    ! it, and updates IWK. Passes follow each other until one makes no swap. Boundary arcs are skipped.
    ! OPTIM is told neither N nor the lengths of the arrays. With broken lists it reads outside LIST and LPTR
    ! if LEND or LPTR is above 6N-12. It uses a node number larger than any in IWK only if the lists of both
    ! ends of an arc agree on it. If both are wrong, it also reads outside X, Y, Z and LEND.
    ! IER  0 done: the last pass made no swap; 1 NIT passes did not suffice; 2 NA < 0 or NIT < 1; 3 a column
    !      is not an arc of the triangulation; 4 the other diagonal of a quadrilateral is already an arc: not
    !      a triangulation; -13 not the lists of a triangulation (new).
    subroutine optim(x, y, z, na, list, lptr, lend, nit, iwk, ier)
      integer :: na, list(*), lptr(*), lend(*), nit, iwk(2, *), ier
      real(STRIPACK_REAL_KIND) :: x(*), y(*), z(*)
    end subroutine

    ! Inserts a node into a triangle.
    ! Connects node KK to the corners of triangle (I1,I2,I3), without testing that it contains KK and without
    ! optimising arcs: ADDNOD does both. The six new slots are LNEW..LNEW+5.
    subroutine intadd(kk, i1, i2, i3, list, lptr, lend, lnew)
      integer :: kk, i1, i2, i3, list(*), lptr(*), lend(kk), lnew
    end subroutine

    ! Inserts a node outside the triangles from which part of the boundary is visible.
    ! Connects node KK to the boundary nodes visible from it, clockwise from I1 to I2; those between I1 and I2
    ! become interior. It does not optimise arcs; ADDNOD does.
    subroutine bdyadd(kk, i1, i2, list, lptr, lend, lnew)
      integer :: kk, i1, i2, list(*), lptr(*), lend(kk), lnew
    end subroutine

    ! Inserts a node outside the triangles from which the whole boundary is visible.
    ! Connects node KK to all boundary nodes; the triangles then cover the sphere. It does not optimise arcs;
    ! ADDNOD does.
    subroutine covsph(kk, n0, list, lptr, lend, lnew)
      integer :: kk, n0, list(*), lptr(*), lend(kk), lnew
    end subroutine

    ! Inserts a neighbour into a list.
    ! K, in slot LNEW, becomes the neighbour after the one in slot LP; after a node's last neighbour it
    ! becomes the first.
    subroutine insert(k, lp, list, lptr, lnew)
      integer :: k, lp, list(*), lptr(*), lnew
    end subroutine

    ! Deletes a neighbour from a list.
    ! Removes NB from the list of N0, not N0 from the list of NB. If NB is a boundary node, N0 becomes one.
    ! The entry in the last slot, LNEW-1, moves into the free slot, so that slots 1..LNEW-1 stay in use.
    ! LPH  > 0 done; -1 N < 3, or N0 or NB outside 1..N; -2 NB is not a neighbour of N0; -13 not the lists of
    !      a triangulation (new).
    subroutine delnb(n0, nb, n, list, lptr, lend, lnew, lph)
      integer :: n0, nb, n, list(*), lptr(*), lend(n), lnew, lph
    end subroutine

    ! Exchanges the diagonal of a quadrilateral.
    ! Replaces arc IO1-IO2, between triangles (IO1,IO2,IN1) and (IO2,IO1,IN2), by IN1-IN2, whatever the
    ! coordinates. The lists of all four nodes must contain both triangles. The number of slots does not
    ! change.
    ! SWAP is told neither N nor the lengths of the arrays. Given a node above N, or LEND or LPTR above 6N-12,
    ! it reads outside the arrays. It writes only to slots in which it has read one of the four nodes, and to
    ! LEND of IO1 and IO2.
    ! LP21  > 0 done; 0 IN1 and IN2 are already neighbours; -13 the lists do not contain these two triangles;
    !      or IO1 and IO2 are exchanged (new).
    subroutine swap(in1, in2, io1, io2, list, lptr, lend, lp21)
      integer :: in1, in2, io1, io2, list(*), lptr(*), lend(*), lp21
    end subroutine

    ! Tests whether a diagonal should be exchanged.
    ! For triangles (N3,N4,N1) and (N4,N3,N2): true if N2 lies strictly above the plane of N3, N4, N1, that
    ! is, inside their circumcircle. Arc N1-N2 should then replace N3-N4. Exact ties and NaN give false. The
    ! determinant is rounded as in the original.
    ! Result  true: exchange.
    logical function swptst(n1, n2, n3, n4, x, y, z)
      integer :: n1, n2, n3, n4
      real(STRIPACK_REAL_KIND) :: x(*), y(*), z(*)
    end function

    ! Builds the Voronoi diagram of a triangulation.
    ! Voronoi vertex t is the circumcentre of triangle t: a unit vector XC, YC, ZC, with radius RC. There are
    ! always 2N-4. If there is a boundary, NB-2 triangles of boundary nodes close the sphere on the far side.
    ! They come first, and their centres lie more than 90 degrees from their corners.
    ! LISTC holds vertex numbers by the slots of LIST. From LPL = LEND(k), following LPTR back to LPL,
    ! LISTC(LP) are the vertices of the cell of node k, counterclockwise. The slot of b in the list of a holds
    ! the triangle left of the arc from a to b.
    ! With a boundary LPTR and LNEW change to describe the Voronoi diagram and no longer fit LIST: keep copies
    ! if you still need the triangulation. TRLIST numbers triangles differently.
    ! IER  0 done; 1 N < 3; 2 NCOL < NB-2; 3 corners of a triangle coincide; -5 a coordinate is not finite
    !      (new); -6 out of memory (new); -13 not the lists of a triangulation (new).
    subroutine crlist(n, ncol, x, y, z, list, lend, lptr, lnew, ltri, listc, nb, xc, yc, zc, rc, ier)
      integer :: n, ncol, list(*), lend(n), lptr(*), lnew, ltri(6, *), listc(*), nb, ier
      real(STRIPACK_REAL_KIND) :: x(n), y(n), z(n), xc(*), yc(*), zc(*), rc(*)
    end subroutine

    ! Circumcentre of a spherical triangle.
    ! C is equidistant from all corners, on their counterclockwise side; clockwise corners give its antipode.
    ! IER  0 done; 1 two corners coincide, or nearly: the normal of their plane is 0 as rounded; -5 a
    !      coordinate is not finite (new).
    subroutine circum(v1, v2, v3, c, ier)
      integer :: ier
      real(STRIPACK_REAL_KIND) :: v1(3), v2(3), v3(3), c(3)
    end subroutine

    ! Prints the number of Voronoi cells by their number of edges.
    ! Prints on standard output faces, vertices, edges, the Euler defect F+V-E-2, and the numbers of cells
    ! with 1 to 19, and 20 or more, edges. Pass the arguments as CRLIST returns them.
    subroutine voronoi_poly_count(n, lend, lptr, listc)
      integer :: n, lend(n), lptr(*), listc(*)
    end subroutine

    ! Prints the adjacency lists.
    ! Prints for each node its number, coordinates as IFLAG says, and neighbours, counterclockwise, followed
    ! by 0 for a boundary node. Then the numbers of boundary nodes, arcs and triangles. Pages have 58 lines.
    subroutine trprnt(n, x, y, z, iflag, list, lptr, lend, lout)
      integer :: n, iflag, list(*), lptr(*), lend(n)
      real(STRIPACK_REAL_KIND) :: x(*), y(*), z(*)
      integer, optional :: lout
    end subroutine

    ! Prints the triangles.
    ! Prints nodes and coordinates as IFLAG says; the triangles of TRLIST: corners, neighbours and, with NROW
    ! = 9, arcs; the numbers of boundary nodes, arcs and triangles. Pages have 58 lines.
    subroutine trlprt(n, x, y, z, iflag, nrow, nt, ltri, lout)
      integer :: n, iflag, nrow, nt, ltri(nrow, *)
      real(STRIPACK_REAL_KIND) :: x(*), y(*), z(*)
      integer, optional :: lout
    end subroutine

    ! Draws a triangulation as an Encapsulated PostScript file.
    ! An orthographic view of the cap of angle A around (ELAT,ELON): a circle in a square of PLTSIZ inches,
    ! the bounding box, on a page of 8.5 by 11 inches. Title and captions lie outside the square: programs
    ! that embed the picture cut them off, `gs mesh.eps` shows them. Arcs are straight segments; those with
    ! both ends outside the cap are omitted.
    ! Open the unit with a number of your own: those of NEWUNIT are negative and give IER = 1. TITLE is a
    ! PostScript string. If its parentheses do not match, it is shown as plain text. The whole text is
    ! composed in memory before the first record is written. examples/plots draws a triangulation and a
    ! Voronoi diagram; `sh examples/plots/make-plots` builds it and makes PNG by Ghostscript.
    ! IER  0 done; 1 LUN, PLTSIZ or N out of range; 2 ELAT, ELON or A out of range; 3 the unit cannot be
    !      written; gfortran does not report a full disk; -5 a node is not finite, or its length is not within
    !      0.001..1000 (new); -6 out of memory (new); -13 not the lists of a triangulation (new).
    subroutine trplot(lun, pltsiz, elat, elon, a, n, x, y, z, list, lptr, lend, title, numbr, ier)
      integer :: lun, n, list(*), lptr(*), lend(n), ier
      real(STRIPACK_REAL_KIND) :: pltsiz, elat, elon, a, x(n), y(n), z(n)
      logical :: numbr
      character(len=*) :: title
    end subroutine

    ! Draws a Voronoi diagram as an Encapsulated PostScript file.
    ! The view is that of TRPLOT.
    ! IER  0 done; 1 LUN, PLTSIZ or N out of range, or NT is not 2N-4; 2 ELAT, ELON or A out of range; 3 the
    !      unit cannot be written; gfortran does not report a full disk; -5 a node is not finite, or its
    !      length is not within 0.001..1000 (new); -6 out of memory (new); -13 not the lists of a
    !      triangulation (new).
    subroutine vrplot(lun, pltsiz, elat, elon, a, n, x, y, z, nt, listc, lptr, lend, xc, yc, zc, title, &
        numbr, ier)
      integer :: lun, n, nt, listc(*), lptr(*), lend(n), ier
      real(STRIPACK_REAL_KIND) :: pltsiz, elat, elon, a, x(n), y(n), z(n), xc(*), yc(*), zc(*)
      logical :: numbr
      character(len=*) :: title
    end subroutine

    ! Converts latitudes and longitudes to Cartesian coordinates.
    ! X = cos(RLAT)*cos(RLON), Y = cos(RLAT)*sin(RLON), Z = sin(RLAT).
    subroutine trans(n, rlat, rlon, x, y, z)
      integer :: n
      real(STRIPACK_REAL_KIND) :: rlat(n), rlon(n), x(n), y(n), z(n)
    end subroutine

    ! Converts Cartesian coordinates to latitude, longitude and length.
    ! The zero vector has latitude and longitude 0; a point on the axis has longitude 0.
    subroutine scoord(px, py, pz, plat, plon, pnrm)
      real(STRIPACK_REAL_KIND) :: px, py, pz, plat, plon, pnrm
    end subroutine

    ! Area of a spherical triangle.
    ! Returns the sum of the angles minus pi, 0..2*pi. Vectors may have any length but 0 and either
    ! orientation; null triangles have area 0.
    ! Result  area, steradians.
    function areas(v1, v2, v3)
      real(STRIPACK_REAL_KIND) :: v1(3), v2(3), v3(3), areas
    end function

    ! Areas of listed triangles.
    ! Computes AREAS of each triangle; NaN where a corner is outside 1..N.
    subroutine triareas(n, x, y, z, nt, triangles, triarea)
      integer :: n, nt, triangles(3, *)
      real(STRIPACK_REAL_KIND) :: x(n), y(n), z(n), triarea(*)
    end subroutine

    ! Tests on which side of a great circle a point lies.
    ! True if point 0 lies left of, or on, the great circle from point 1 to point 2, seen from outside the
    ! sphere. The determinant of the three points, rounded in the original's order, is then >= 0. NaN gives
    ! false.
    ! Result  true: left or on.
    logical function left(x1, y1, z1, x2, y2, z2, x0, y0, z0)
      real(STRIPACK_REAL_KIND) :: x1, y1, z1, x2, y2, z2, x0, y0, z0
    end function

    ! Tests whether a point lies inside a spherical polygon.
    ! The inside is left of the edges LISTV(1) to LISTV(2), ..., LISTV(NV) to LISTV(1): clockwise vertices
    ! describe the complement. Exact for polygons that do not cross themselves; a point on the boundary is
    ! inside.
    ! Result  true: inside; false if IER /= 0.
    ! IER  0 done; 1 NV < 3 or NV > LV; 2 an index in LISTV is outside 1..LV; 3 the polygon crosses itself;
    !      4 no edge gives a point of reference: degenerate polygon, or P is zero; -5 a coordinate of P or of
    !      a vertex is not finite (new); -6 out of memory, only where the original says 3 or 4 (new).
    logical function inside(p, lv, xv, yv, zv, nv, listv, ier)
      integer :: lv, nv, listv(*), ier
      real(STRIPACK_REAL_KIND) :: p(3), xv(*), yv(*), zv(*)
    end function

    ! Intersects an arc with a great circle.
    ! The great circle through P1 and P2 meets the one with normal CN in two points. P is the one on the side
    ! of the arc, not necessarily between P1 and P2.
    ! IER  0 done; 1 P1 and P2 have the same distance from the plane of the circle: P1 = P2, CN = 0, or
    !      several points are equally near; 2 P1 and P2 are antipodes; -5 an argument is not finite (new).
    subroutine intrsc(p1, p2, cn, p, ier)
      integer :: ier
      real(STRIPACK_REAL_KIND) :: p1(3), p2(3), cn(3), p(3)
    end subroutine

    ! Random integer in 1..N.
    ! The Wichmann-Hill generator, with three seeds that the call advances; set each once to 1..30000. TRFIND
    ! draws start nodes with it.
    ! Result  uniformly distributed in 1..N.
    integer function jrand(n, ix, iy, iz)
      integer :: n, ix, iy, iz
    end function

    ! Returns its argument, rounded to the working precision.
    ! The original forces the value through memory on machines with wider registers. With IEEE arithmetic it
    ! is X.
    ! Result  X.
    function store(x)
      real(STRIPACK_REAL_KIND) :: x, store
    end function

  end interface

end module
