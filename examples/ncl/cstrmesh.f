C     CSTRMESH of NCAR Graphics by PSTRIPACK. A program that is linked
C     with libngmath, CSTRMESH here before it:
C
C     $ gfortran model.f cstrmesh.f -o model $(pkg-config --libs stripack) -lngmath
C
C     and ncl, or any program that loads libNGmath.so, as it is:
C
C     $ gfortran -shared -fPIC cstrmesh.f -o cstrmesh.so $(pkg-config --libs stripack)
C     $ LD_PRELOAD=./cstrmesh.so ncl script.ncl
C
      SUBROUTINE CSTRMESH (N, X, Y, Z, LIST, LPTR, LEND, LNEW, NEAR,
     +                     NEXT, DIST, IER)
      INTEGER N, LIST(*), LPTR(*), LEND(*), LNEW, NEAR(*), NEXT(*), IER
      DOUBLE PRECISION X(*), Y(*), Z(*), DIST(*)
      CALL TRMESH (N, X, Y, Z, LIST, LPTR, LEND, LNEW, NEAR, NEXT, DIST,
     +             IER)
      END
