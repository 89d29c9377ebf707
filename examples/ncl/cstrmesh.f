C     CSTRMESH of NCAR Graphics by PSTRIPACK. For a program linked with
C     libngmath, put this file before the library:
C
C     $ gfortran model.f cstrmesh.f -o model $(pkg-config --libs stripack) -lngmath
C
C     For ncl, or any program that loads libNGmath.so, preload it:
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
