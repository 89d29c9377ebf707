! The symbols of libstripack*: STRIPACK's external procedures, as calls of libpstripack.
!
! One source for all libraries, of the routines that need Fortran; plain_forwarders.h, generated from the table in
! docs/api/routines, has those that only call their C function, in C++. Each is compiled once for each routine of each
! library, so that a static archive has one object per public routine. CMakeLists.txt generates the source files, which
! define
!   STRIPACK_<NAME>          the routine to compile, e.g. STRIPACK_TRLIST
! and include this file; the library's compile definitions are
!   STRIPACK_REAL_BYTES      4 or 8
!   STRIPACK_INTEGER_BYTES   4, or 8 with reals of 8
!   STRIPACK_8_ARGUMENTS     if TRMESH has the arguments N,X,Y,Z,LIST,LPTR,LEND,IER
!
! Rules of this file:
! - Arrays are assumed-size, so that none is ever copied.
! - A routine calls only functions of libpstripack, never a public symbol, since programs define a SWAP, INSERT, LEFT or
!   STORE of their own.
! - There is no STOP and no saved variable except IDENT. There is no output except by routines that print, and the
!   messages on standard output that EDGE and DELNOD have in the original.
! - All routines are recursive, since threads may call them at once.
! The routines are described in the headers in src/cxx/stripack and the interfaces in stripack_module.F90.

#if STRIPACK_INTEGER_BYTES == 8
#define INTEGER_KIND c_int64_t
#define LOGICAL_KIND 8
#define REAL_KIND c_double
#define OF_INTEGER "_i8"
#define OF_REAL "_i8"
#define OF_TRMESH "_i8"
#else
#define INTEGER_KIND c_int32_t
#define LOGICAL_KIND 4
#define OF_INTEGER "_i4"
#if STRIPACK_REAL_BYTES == 8
#define REAL_KIND c_double
#define OF_REAL "_r8"
#define OF_TRMESH ""
#elif STRIPACK_REAL_BYTES == 4
#define REAL_KIND c_float
#define OF_REAL "_r4"
#define OF_TRMESH "_r4"
#endif
#endif

! By this text in a program or library, stripped or not, `pstripack-config --check` distinguishes our routines from
! others of the same names. It is volatile and decides a branch, so that no compiler or linker removes it.
#define IDENT(ROUTINE) character(len=40), save, volatile :: ident = "@(#)PSTRIPACK "//STRIPACK_LIBRARY//" "//ROUTINE
#define KEEP_IDENT if (ident(1:1) /= "@") return

#ifdef STRIPACK_TRMESH
#ifdef STRIPACK_8_ARGUMENTS
recursive subroutine trmesh(n, x, y, z, list, lptr, lend, ier)
  use, intrinsic :: iso_c_binding
  implicit none
  integer(INTEGER_KIND) :: n, list(*), lptr(*), lend(*), ier
  real(REAL_KIND) :: x(*), y(*), z(*)
  integer(INTEGER_KIND) :: lnew
#else
recursive subroutine trmesh(n, x, y, z, list, lptr, lend, lnew, near, next, dist, ier)
  use, intrinsic :: iso_c_binding
  implicit none
  integer(INTEGER_KIND) :: n, list(*), lptr(*), lend(*), lnew, near(*), next(*), ier
  real(REAL_KIND) :: x(*), y(*), z(*), dist(*)
#endif
  IDENT("TRMESH")
  interface
    function c_trmesh(n, x, y, z, list, lptr, lend, lnew) bind(c, name="pstripack_trmesh"//OF_TRMESH)
      import
      integer(INTEGER_KIND), value :: n
      real(REAL_KIND) :: x(*), y(*), z(*)
      integer(INTEGER_KIND) :: list(*), lptr(*), lend(*), lnew, c_trmesh
    end function
  end interface
  KEEP_IDENT
  ier = c_trmesh(n, x, y, z, list, lptr, lend, lnew)
end subroutine
#endif

#ifdef STRIPACK_EDGE
recursive subroutine edge(in1, in2, x, y, z, lwk, iwk, list, lptr, lend, ier)
  use, intrinsic :: iso_c_binding
  implicit none
  integer(INTEGER_KIND) :: in1, in2, lwk, iwk(*), list(*), lptr(*), lend(*), ier
  real(REAL_KIND) :: x(*), y(*), z(*)
  integer(INTEGER_KIND) :: nit, optim_ier
  interface
    subroutine c_edge(in1, in2, x, y, z, lwk, iwk, list, lptr, lend, ier, nit, optim_ier) &
        bind(c, name="pstripack_edge"//OF_REAL)
      import
      integer(INTEGER_KIND), value :: in1, in2
      integer(INTEGER_KIND) :: lwk, iwk(*), list(*), lptr(*), lend(*), ier, nit, optim_ier
      real(REAL_KIND) :: x(*), y(*), z(*)
    end subroutine
  end interface
  call c_edge(in1, in2, x, y, z, lwk, iwk, list, lptr, lend, ier, nit, optim_ier)
  if (ier == 3) write (*, '(//5x,a,/5x,2(a,i0),/)') "EDGE: invalid triangulation, or null triangles on its boundary:", &
      "no way from IN1 = ", in1, " to IN2 = ", in2
  if (ier == 4) write (*, '(//5x,2(a,i0),/)') "EDGE: OPTIM failed: NIT = ", nit, ", IER = ", optim_ier
end subroutine
#endif

#ifdef STRIPACK_DELNOD
recursive subroutine delnod(k, n, x, y, z, list, lptr, lend, lnew, lwk, iwk, ier)
  use, intrinsic :: iso_c_binding
  implicit none
  integer(INTEGER_KIND) :: k, n, list(*), lptr(*), lend(*), lnew, lwk, iwk(*), ier
  real(REAL_KIND) :: x(*), y(*), z(*)
  integer(INTEGER_KIND) :: nit, optim_ier
  interface
    subroutine c_delnod(k, n, x, y, z, list, lptr, lend, lnew, lwk, iwk, ier, nit, optim_ier) &
        bind(c, name="pstripack_delnod"//OF_REAL)
      import
      integer(INTEGER_KIND), value :: k
      integer(INTEGER_KIND) :: n, list(*), lptr(*), lend(*), lnew, lwk, iwk(*), ier, nit, optim_ier
      real(REAL_KIND) :: x(*), y(*), z(*)
    end subroutine
  end interface
  call c_delnod(k, n, x, y, z, list, lptr, lend, lnew, lwk, iwk, ier, nit, optim_ier)
  if (ier == 5) write (*, '(//5x,2(a,i0),/)') "DELNOD: OPTIM failed: NIT = ", nit, ", IER = ", optim_ier
end subroutine
#endif

#ifdef STRIPACK_STORE
! The original stores X in a common block, to round it to its kind on processors with wider registers. That is not
! needed here, because an argument is read from memory anyway.
recursive real(REAL_KIND) function store(x)
  use, intrinsic :: iso_c_binding
  implicit none
  real(REAL_KIND) :: x
  store = x
end function
#endif

! The routines that print: libpstripack composes the text, write_records.inc writes it.
! TRPRNT, TRLPRT: Algorithm 772 has a last argument LOUT; the Fortran 90 texts, which are REAL*8, have none and print on
! standard output in a layout of their own. listing_unit.inc decides whether LOUT was passed.
#if STRIPACK_REAL_BYTES == 8 && STRIPACK_INTEGER_BYTES == 4
#define IS_F90_LISTING int(merge(1, 0, unit == 6), INTEGER_KIND)
#else
#define IS_F90_LISTING int(0, INTEGER_KIND)
#endif

#ifdef STRIPACK_TRPRNT
recursive subroutine trprnt(n, x, y, z, iflag, list, lptr, lend, lout)
  use, intrinsic :: iso_c_binding
  use, intrinsic :: iso_fortran_env, only: error_unit
  implicit none
  integer(INTEGER_KIND) :: n, iflag, list(*), lptr(*), lend(*)
  real(REAL_KIND) :: x(*), y(*), z(*)
  integer(INTEGER_KIND), optional :: lout
  integer(INTEGER_KIND) :: unit
  integer :: status
  interface
    function c_trprnt(n, x, y, z, iflag, list, lptr, lend, f90) bind(c, name="pstripack_trprnt"//OF_REAL)
      import
      integer(INTEGER_KIND), value :: n, iflag, f90
      integer(INTEGER_KIND) :: list(*), lptr(*), lend(*)
      real(REAL_KIND) :: x(*), y(*), z(*)
      type(c_ptr) :: c_trprnt
    end function
  end interface
  unit = listing_unit(lout, n, iflag, list(1), lptr(1), lend(1))
  call write_records(c_trprnt(n, x, y, z, iflag, list, lptr, lend, IS_F90_LISTING), unit, status)
  if (status /= 0) write (error_unit, '(a,i0)') "pstripack: TRPRNT: cannot write, IOSTAT = ", status
contains
#include "listing_unit.inc"
#include "write_records.inc"
end subroutine
#endif

#ifdef STRIPACK_TRLPRT
recursive subroutine trlprt(n, x, y, z, iflag, nrow, nt, ltri, lout)
  use, intrinsic :: iso_c_binding
  use, intrinsic :: iso_fortran_env, only: error_unit
  implicit none
  integer(INTEGER_KIND) :: n, iflag, nrow, nt, ltri(*)
  real(REAL_KIND) :: x(*), y(*), z(*)
  integer(INTEGER_KIND), optional :: lout
  integer(INTEGER_KIND) :: unit
  integer :: status
  interface
    function c_trlprt(n, x, y, z, iflag, nrow, nt, ltri, f90) bind(c, name="pstripack_trlprt"//OF_REAL)
      import
      integer(INTEGER_KIND), value :: n, iflag, nrow, nt, f90
      integer(INTEGER_KIND) :: ltri(*)
      real(REAL_KIND) :: x(*), y(*), z(*)
      type(c_ptr) :: c_trlprt
    end function
  end interface
  unit = listing_unit(lout, n, iflag, nrow, nt, ltri(1))
  call write_records(c_trlprt(n, x, y, z, iflag, nrow, nt, ltri, IS_F90_LISTING), unit, status)
  if (status /= 0) write (error_unit, '(a,i0)') "pstripack: TRLPRT: cannot write, IOSTAT = ", status
contains
#include "listing_unit.inc"
#include "write_records.inc"
end subroutine
#endif

#ifdef STRIPACK_TRPLOT
recursive subroutine trplot(lun, pltsiz, elat, elon, a, n, x, y, z, list, lptr, lend, title, numbr, ier)
  use, intrinsic :: iso_c_binding
  implicit none
  integer(INTEGER_KIND) :: lun, n, list(*), lptr(*), lend(*), ier
  real(REAL_KIND) :: pltsiz, elat, elon, a, x(*), y(*), z(*)
  character(len=*, kind=c_char) :: title
  logical(LOGICAL_KIND) :: numbr
  type(c_ptr) :: text
  integer :: status
  interface
    function c_trplot(lun, pltsiz, elat, elon, a, n, x, y, z, list, lptr, lend, title, title_length, numbr, ier) &
        bind(c, name="pstripack_trplot"//OF_REAL)
      import
      integer(INTEGER_KIND), value :: lun, n, title_length, numbr
      integer(INTEGER_KIND) :: list(*), lptr(*), lend(*), ier
      real(REAL_KIND), value :: pltsiz, elat, elon, a
      real(REAL_KIND) :: x(*), y(*), z(*)
      character(kind=c_char) :: title(*)
      type(c_ptr) :: c_trplot
    end function
  end interface
  text = c_trplot(lun, pltsiz, elat, elon, a, n, x, y, z, list, lptr, lend, title, len(title, INTEGER_KIND), &
                  merge(int(1, INTEGER_KIND), int(0, INTEGER_KIND), numbr), ier)
  if (ier /= 0) return
  call write_records(text, lun, status)
  if (status /= 0) ier = 3
contains
#include "write_records.inc"
end subroutine
#endif

#ifdef STRIPACK_VRPLOT
recursive subroutine vrplot(lun, pltsiz, elat, elon, a, n, x, y, z, nt, listc, lptr, lend, xc, yc, zc, title, numbr, &
                            ier)
  use, intrinsic :: iso_c_binding
  implicit none
  integer(INTEGER_KIND) :: lun, n, nt, listc(*), lptr(*), lend(*), ier
  real(REAL_KIND) :: pltsiz, elat, elon, a, x(*), y(*), z(*), xc(*), yc(*), zc(*)
  character(len=*, kind=c_char) :: title
  logical(LOGICAL_KIND) :: numbr
  type(c_ptr) :: text
  integer :: status
  interface
    function c_vrplot(lun, pltsiz, elat, elon, a, n, x, y, z, nt, listc, lptr, lend, xc, yc, zc, title, &
                      title_length, numbr, ier) bind(c, name="pstripack_vrplot"//OF_REAL)
      import
      integer(INTEGER_KIND), value :: lun, n, nt, title_length, numbr
      integer(INTEGER_KIND) :: listc(*), lptr(*), lend(*), ier
      real(REAL_KIND), value :: pltsiz, elat, elon, a
      real(REAL_KIND) :: x(*), y(*), z(*), xc(*), yc(*), zc(*)
      character(kind=c_char) :: title(*)
      type(c_ptr) :: c_vrplot
    end function
  end interface
  text = c_vrplot(lun, pltsiz, elat, elon, a, n, x, y, z, nt, listc, lptr, lend, xc, yc, zc, title, &
                  len(title, INTEGER_KIND), merge(int(1, INTEGER_KIND), int(0, INTEGER_KIND), numbr), ier)
  if (ier /= 0) return
  call write_records(text, lun, status)
  if (status /= 0) ier = 3
contains
#include "write_records.inc"
end subroutine
#endif

#ifdef STRIPACK_VORONOI_POLY_COUNT
recursive subroutine voronoi_poly_count(n, lend, lptr, listc)
  use, intrinsic :: iso_c_binding
  use, intrinsic :: iso_fortran_env, only: error_unit
  implicit none
  integer(INTEGER_KIND) :: n, lend(*), lptr(*), listc(*)
  integer :: status
  interface
    function c_voronoi_poly_count(n, lend, lptr, listc) bind(c, name="pstripack_voronoi_poly_count"//OF_INTEGER)
      import
      integer(INTEGER_KIND), value :: n
      integer(INTEGER_KIND) :: lend(*), lptr(*), listc(*)
      type(c_ptr) :: c_voronoi_poly_count
    end function
  end interface
  call write_records(c_voronoi_poly_count(n, lend, lptr, listc), int(6, INTEGER_KIND), status)
  if (status /= 0) write (error_unit, '(a,i0)') "pstripack: VORONOI_POLY_COUNT: cannot write, IOSTAT = ", status
contains
#include "write_records.inc"
end subroutine
#endif
