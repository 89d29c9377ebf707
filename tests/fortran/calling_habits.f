C     Calls as in Fortran 77 codes: implicit interfaces, default REAL and INTEGER, LIST and LPTR of exactly
C     6N-12 elements inside one array, NEAR and NEXT inside one work array, columns of a larger array as
C     X, Y, Z. Compiled with default REAL for libstripack_r4, with -fdefault-real-8 and with
C     -fsecond-underscore for libstripack.
      PROGRAM HABITS
      INTEGER N, M, LONG
      PARAMETER (N = 50, M = 6*N - 12, LONG = 2*M + 40)
      REAL XYZ(3,N), COL(0:N+1,3), RLAT(N), RLON(N), DS(N), A
      REAL XC(2*N), YC(2*N), ZC(2*N), RC(2*N), TOTAL, R, PLAT, PLON
      INTEGER IARR(LONG), IWK(2*N), LEND(N), LNEW, IER, NT, NB, NA
      INTEGER LTRI(9*2*N), LISTC(M), NODES(N), LPL, I, K, NBCNT
      INTEGER NCELL(1,1)
      LOGICAL LEFT, L
      REAL AREAS
      EXTERNAL LEFT, AREAS, NBCNT
C     A spiral over the sphere, by latitude and longitude; TRANS in place.
      DO 10 I = 1, N
        RLAT(I) = ASIN(2.0*REAL(I)/REAL(N + 1) - 1.0)
        RLON(I) = 2.4*REAL(I)
   10 CONTINUE
      DO 20 K = 1, 3
        COL(0,K) = 99.0
        COL(N+1,K) = 99.0
   20 CONTINUE
      CALL TRANS (N, RLAT, RLON, RLAT, RLON, COL(1,3))
      DO 30 I = 1, N
        COL(I,1) = RLAT(I)
        COL(I,2) = RLON(I)
        CALL SCOORD (COL(I,1), COL(I,2), COL(I,3), PLAT, PLON, R)
        IF (ABS(R - 1.0) .GT. 1E-5) STOP 11
        IF (ABS(SIN(PLAT) - COL(I,3)) .GT. 1E-5) STOP 12
        IF (ABS(COS(PLON)*COS(PLAT) - COL(I,1)) .GT. 1E-5) STOP 13
   30 CONTINUE
C     LIST is IARR(11..), LPTR is IARR(M+21..), with marked elements around both.
      DO 40 I = 1, LONG
        IARR(I) = -12345
   40 CONTINUE
      CALL TRMESH (N, COL(1,1), COL(1,2), COL(1,3), IARR(11),
     .             IARR(M+21), LEND, LNEW, IWK, IWK(N+1), DS, IER)
      IF (IER .NE. 0) STOP 21
      IF (LNEW .NE. M + 1) STOP 22
      DO 50 I = 1, 10
        IF (IARR(I) .NE. -12345) STOP 23
        IF (IARR(M+10+I) .NE. -12345) STOP 24
        IF (IARR(2*M+20+I) .NE. -12345) STOP 25
   50 CONTINUE
      DO 60 K = 1, 3
        IF (COL(0,K) .NE. 99.0 .OR. COL(N+1,K) .NE. 99.0) STOP 26
   60 CONTINUE
C     NEAR and NEXT are the same array.
      CALL TRMESH (N, COL(1,1), COL(1,2), COL(1,3), IARR(11),
     .             IARR(M+21), LEND, LNEW, IWK, IWK, DS, IER)
      IF (IER .NE. 0) STOP 27
C     Triangles: the areas add up to that of the sphere.
      CALL TRLIST (N, IARR(11), IARR(M+21), LEND, 9, NT, LTRI, IER)
      IF (IER .NE. 0 .OR. NT .NE. 2*N - 4) STOP 31
      DO 80 I = 1, N
        DO 70 K = 1, 3
          XYZ(K,I) = COL(I,K)
   70   CONTINUE
   80 CONTINUE
      TOTAL = 0.0
      DO 90 I = 0, NT - 1
        A = AREAS(XYZ(1,LTRI(9*I+1)), XYZ(1,LTRI(9*I+2)),
     .            XYZ(1,LTRI(9*I+3)))
        IF (A .LE. 0.0) STOP 32
        TOTAL = TOTAL + A
        L = LEFT(XYZ(1,LTRI(9*I+1)), XYZ(2,LTRI(9*I+1)),
     .           XYZ(3,LTRI(9*I+1)), XYZ(1,LTRI(9*I+2)),
     .           XYZ(2,LTRI(9*I+2)), XYZ(3,LTRI(9*I+2)),
     .           XYZ(1,LTRI(9*I+3)), XYZ(2,LTRI(9*I+3)),
     .           XYZ(3,LTRI(9*I+3)))
        IF (.NOT. L) STOP 33
   90 CONTINUE
      IF (ABS(TOTAL - 16.0*ATAN(1.0)) .GT. 1E-4) STOP 34
C     Voronoi cells, with NCOL = 0.
      CALL CRLIST (N, 0, COL(1,1), COL(1,2), COL(1,3), IARR(11), LEND,
     .             IARR(M+21), LNEW, NCELL, LISTC, NB, XC, YC, ZC, RC,
     .             IER)
      IF (IER .NE. 0 .OR. NB .NE. 0) STOP 41
      CALL BNODES (N, IARR(11), IARR(M+21), LEND, NODES, NB, NA, NT)
      IF (NB .NE. 0 .OR. NA .NE. 3*N - 6) STOP 42
      K = 0
      DO 100 I = 1, N
        LPL = LEND(I)
        K = K + NBCNT(LPL, IARR(M+21))
  100 CONTINUE
      IF (K .NE. M) STOP 43
      END
