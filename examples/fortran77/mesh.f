C     Triangulates 1000 nodes on the unit sphere and adds up the areas
C     of the triangles, in FORTRAN 77 with the calls of STRIPACK.
C
C     $ gfortran mesh.f -o mesh $(pkg-config --libs stripack)
C     $ ./mesh
      PROGRAM MESH
      INTEGER N, NROW
      PARAMETER (N = 1000, NROW = 6)
      DOUBLE PRECISION RLAT(N), RLON(N), X(N), Y(N), Z(N), DIST(N)
      DOUBLE PRECISION A(3), B(3), C(3), AREA, TURN, AREAS
      INTEGER LIST(6*N-12), LPTR(6*N-12), LEND(N), NEAR(N), NEXT(N)
      INTEGER LTRI(NROW,2*N-4), LNEW, NT, IER, K
      EXTERNAL TRANS, TRMESH, TRLIST, AREAS

C     A spiral from pole to pole, a golden angle from node to node.
      TURN = 4*ATAN(1.D0)*(3 - SQRT(5.D0))
      DO 10 K = 1, N
        RLAT(K) = ASIN(1 - (2*K - 1.D0)/N)
        RLON(K) = K*TURN
   10 CONTINUE
      CALL TRANS(N, RLAT, RLON, X, Y, Z)

      CALL TRMESH(N, X, Y, Z, LIST, LPTR, LEND, LNEW, NEAR, NEXT, DIST,
     .            IER)
      IF (IER .NE. 0) STOP 'TRMESH'
      CALL TRLIST(N, LIST, LPTR, LEND, NROW, NT, LTRI, IER)
      IF (IER .NE. 0) STOP 'TRLIST'

      AREA = 0
      DO 20 K = 1, NT
        CALL NODE(LTRI(1,K), X, Y, Z, A)
        CALL NODE(LTRI(2,K), X, Y, Z, B)
        CALL NODE(LTRI(3,K), X, Y, Z, C)
        AREA = AREA + AREAS(A, B, C)
   20 CONTINUE
      WRITE (*,30) N, NT, AREA
   30 FORMAT (I4, ' nodes, ', I4, ' triangles, area ', F9.6)
      END

      SUBROUTINE NODE(I, X, Y, Z, P)
      INTEGER I
      DOUBLE PRECISION X(*), Y(*), Z(*), P(3)
      P(1) = X(I)
      P(2) = Y(I)
      P(3) = Z(I)
      END
