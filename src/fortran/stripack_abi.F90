! The symbols of libstripack*: STRIPACK's external procedures, as calls of libpstripack.
!
! One source for all libraries and all routines. It is compiled once for each routine of each library, so that a static
! archive has one object per public routine. CMakeLists.txt generates the source files, which define
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

#ifdef STRIPACK_TRANS
recursive subroutine trans(n, rlat, rlon, x, y, z)
  use, intrinsic :: iso_c_binding
  implicit none
  integer(INTEGER_KIND) :: n
  real(REAL_KIND) :: rlat(*), rlon(*), x(*), y(*), z(*)
  interface
    subroutine c_trans(n, rlat, rlon, x, y, z) bind(c, name="pstripack_trans"//OF_REAL)
      import
      integer(INTEGER_KIND), value :: n
      real(REAL_KIND) :: rlat(*), rlon(*), x(*), y(*), z(*)
    end subroutine
  end interface
  call c_trans(n, rlat, rlon, x, y, z)
end subroutine
#endif

#ifdef STRIPACK_SCOORD
recursive subroutine scoord(px, py, pz, plat, plon, pnrm)
  use, intrinsic :: iso_c_binding
  implicit none
  real(REAL_KIND) :: px, py, pz, plat, plon, pnrm
  interface
    subroutine c_scoord(px, py, pz, plat, plon, pnrm) bind(c, name="pstripack_scoord"//OF_REAL)
      import
      real(REAL_KIND), value :: px, py, pz
      real(REAL_KIND) :: plat, plon, pnrm
    end subroutine
  end interface
  call c_scoord(px, py, pz, plat, plon, pnrm)
end subroutine
#endif

#ifdef STRIPACK_LEFT
recursive logical(LOGICAL_KIND) function left(x1, y1, z1, x2, y2, z2, x0, y0, z0)
  use, intrinsic :: iso_c_binding
  implicit none
  real(REAL_KIND) :: x1, y1, z1, x2, y2, z2, x0, y0, z0
  interface
    function c_left(x1, y1, z1, x2, y2, z2, x0, y0, z0) bind(c, name="pstripack_left"//OF_REAL)
      import
      real(REAL_KIND), value :: x1, y1, z1, x2, y2, z2, x0, y0, z0
      integer(INTEGER_KIND) :: c_left
    end function
  end interface
  left = c_left(x1, y1, z1, x2, y2, z2, x0, y0, z0) /= 0
end function
#endif

#ifdef STRIPACK_AREAS
recursive real(REAL_KIND) function areas(v1, v2, v3)
  use, intrinsic :: iso_c_binding
  implicit none
  real(REAL_KIND) :: v1(3), v2(3), v3(3)
  interface
    function c_areas(v1, v2, v3) bind(c, name="pstripack_areas"//OF_REAL)
      import
      real(REAL_KIND) :: v1(*), v2(*), v3(*), c_areas
    end function
  end interface
  areas = c_areas(v1, v2, v3)
end function
#endif

#ifdef STRIPACK_CIRCUM
recursive subroutine circum(v1, v2, v3, c, ier)
  use, intrinsic :: iso_c_binding
  implicit none
  real(REAL_KIND) :: v1(3), v2(3), v3(3), c(3)
  integer(INTEGER_KIND) :: ier
  interface
    subroutine c_circum(v1, v2, v3, c, ier) bind(c, name="pstripack_circum"//OF_REAL)
      import
      real(REAL_KIND) :: v1(*), v2(*), v3(*), c(*)
      integer(INTEGER_KIND) :: ier
    end subroutine
  end interface
  call c_circum(v1, v2, v3, c, ier)
end subroutine
#endif

#ifdef STRIPACK_LSTPTR
recursive integer(INTEGER_KIND) function lstptr(lpl, nb, list, lptr)
  use, intrinsic :: iso_c_binding
  implicit none
  integer(INTEGER_KIND) :: lpl, nb, list(*), lptr(*)
  interface
    function c_lstptr(lpl, nb, list, lptr) bind(c, name="pstripack_lstptr"//OF_INTEGER)
      import
      integer(INTEGER_KIND), value :: lpl, nb
      integer(INTEGER_KIND) :: list(*), lptr(*), c_lstptr
    end function
  end interface
  lstptr = c_lstptr(lpl, nb, list, lptr)
end function
#endif

#ifdef STRIPACK_NBCNT
recursive integer(INTEGER_KIND) function nbcnt(lpl, lptr)
  use, intrinsic :: iso_c_binding
  implicit none
  integer(INTEGER_KIND) :: lpl, lptr(*)
  interface
    function c_nbcnt(lpl, lptr) bind(c, name="pstripack_nbcnt"//OF_INTEGER)
      import
      integer(INTEGER_KIND), value :: lpl
      integer(INTEGER_KIND) :: lptr(*), c_nbcnt
    end function
  end interface
  nbcnt = c_nbcnt(lpl, lptr)
end function
#endif

#ifdef STRIPACK_BNODES
recursive subroutine bnodes(n, list, lptr, lend, nodes, nb, na, nt)
  use, intrinsic :: iso_c_binding
  implicit none
  integer(INTEGER_KIND) :: n, list(*), lptr(*), lend(*), nodes(*), nb, na, nt
  interface
    subroutine c_bnodes(n, list, lptr, lend, nodes, nb, na, nt) bind(c, name="pstripack_bnodes"//OF_INTEGER)
      import
      integer(INTEGER_KIND), value :: n
      integer(INTEGER_KIND) :: list(*), lptr(*), lend(*), nodes(*), nb, na, nt
    end subroutine
  end interface
  call c_bnodes(n, list, lptr, lend, nodes, nb, na, nt)
end subroutine
#endif

#ifdef STRIPACK_TRLIST
recursive subroutine trlist(n, list, lptr, lend, nrow, nt, ltri, ier)
  use, intrinsic :: iso_c_binding
  implicit none
  integer(INTEGER_KIND) :: n, list(*), lptr(*), lend(*), nrow, nt, ltri(*), ier
  IDENT("TRLIST")
  interface
    subroutine c_trlist(n, list, lptr, lend, nrow, nt, ltri, ier) bind(c, name="pstripack_trlist"//OF_INTEGER)
      import
      integer(INTEGER_KIND), value :: n, nrow
      integer(INTEGER_KIND) :: list(*), lptr(*), lend(*), nt, ltri(*), ier
    end subroutine
  end interface
  KEEP_IDENT
  call c_trlist(n, list, lptr, lend, nrow, nt, ltri, ier)
end subroutine
#endif

#ifdef STRIPACK_TRLIST2
recursive subroutine trlist2(n, list, lptr, lend, nt, ltri, ier)
  use, intrinsic :: iso_c_binding
  implicit none
  integer(INTEGER_KIND) :: n, list(*), lptr(*), lend(*), nt, ltri(*), ier
  interface
    subroutine c_trlist2(n, list, lptr, lend, nt, ltri, ier) bind(c, name="pstripack_trlist2"//OF_INTEGER)
      import
      integer(INTEGER_KIND), value :: n
      integer(INTEGER_KIND) :: list(*), lptr(*), lend(*), nt, ltri(*), ier
    end subroutine
  end interface
  call c_trlist2(n, list, lptr, lend, nt, ltri, ier)
end subroutine
#endif

#ifdef STRIPACK_CRLIST
recursive subroutine crlist(n, ncol, x, y, z, list, lend, lptr, lnew, ltri, listc, nb, xc, yc, zc, rc, ier)
  use, intrinsic :: iso_c_binding
  implicit none
  integer(INTEGER_KIND) :: n, ncol, list(*), lend(*), lptr(*), lnew, ltri(*), listc(*), nb, ier
  real(REAL_KIND) :: x(*), y(*), z(*), xc(*), yc(*), zc(*), rc(*)
  IDENT("CRLIST")
  interface
    subroutine c_crlist(n, ncol, x, y, z, list, lend, lptr, lnew, ltri, listc, nb, xc, yc, zc, rc, ier) &
        bind(c, name="pstripack_crlist"//OF_REAL)
      import
      integer(INTEGER_KIND), value :: n, ncol
      integer(INTEGER_KIND) :: list(*), lend(*), lptr(*), lnew, ltri(*), listc(*), nb, ier
      real(REAL_KIND) :: x(*), y(*), z(*), xc(*), yc(*), zc(*), rc(*)
    end subroutine
  end interface
  KEEP_IDENT
  call c_crlist(n, ncol, x, y, z, list, lend, lptr, lnew, ltri, listc, nb, xc, yc, zc, rc, ier)
end subroutine
#endif

#ifdef STRIPACK_TRFIND
recursive subroutine trfind(nst, p, n, x, y, z, list, lptr, lend, b1, b2, b3, i1, i2, i3)
  use, intrinsic :: iso_c_binding
  implicit none
  integer(INTEGER_KIND) :: nst, n, list(*), lptr(*), lend(*), i1, i2, i3
  real(REAL_KIND) :: p(3), x(*), y(*), z(*), b1, b2, b3
  IDENT("TRFIND")
  interface
    subroutine c_trfind(nst, p, n, x, y, z, list, lptr, lend, b1, b2, b3, i1, i2, i3) &
        bind(c, name="pstripack_trfind"//OF_REAL)
      import
      integer(INTEGER_KIND), value :: nst, n
      integer(INTEGER_KIND) :: list(*), lptr(*), lend(*), i1, i2, i3
      real(REAL_KIND) :: p(*), x(*), y(*), z(*), b1, b2, b3
    end subroutine
  end interface
  KEEP_IDENT
  call c_trfind(nst, p, n, x, y, z, list, lptr, lend, b1, b2, b3, i1, i2, i3)
end subroutine
#endif

#ifdef STRIPACK_NEARND
recursive integer(INTEGER_KIND) function nearnd(p, ist, n, x, y, z, list, lptr, lend, al)
  use, intrinsic :: iso_c_binding
  implicit none
  integer(INTEGER_KIND) :: ist, n, list(*), lptr(*), lend(*)
  real(REAL_KIND) :: p(3), x(*), y(*), z(*), al
  interface
    function c_nearnd(p, ist, n, x, y, z, list, lptr, lend, al) bind(c, name="pstripack_nearnd"//OF_REAL)
      import
      integer(INTEGER_KIND), value :: ist, n
      integer(INTEGER_KIND) :: list(*), lptr(*), lend(*), c_nearnd
      real(REAL_KIND) :: p(*), x(*), y(*), z(*), al
    end function
  end interface
  nearnd = c_nearnd(p, ist, n, x, y, z, list, lptr, lend, al)
end function
#endif

#ifdef STRIPACK_INSERT
recursive subroutine insert(k, lp, list, lptr, lnew)
  use, intrinsic :: iso_c_binding
  implicit none
  integer(INTEGER_KIND) :: k, lp, list(*), lptr(*), lnew
  interface
    subroutine c_insert(k, lp, list, lptr, lnew) bind(c, name="pstripack_insert"//OF_INTEGER)
      import
      integer(INTEGER_KIND), value :: k, lp
      integer(INTEGER_KIND) :: list(*), lptr(*), lnew
    end subroutine
  end interface
  call c_insert(k, lp, list, lptr, lnew)
end subroutine
#endif

#ifdef STRIPACK_INTADD
recursive subroutine intadd(kk, i1, i2, i3, list, lptr, lend, lnew)
  use, intrinsic :: iso_c_binding
  implicit none
  integer(INTEGER_KIND) :: kk, i1, i2, i3, list(*), lptr(*), lend(*), lnew
  interface
    subroutine c_intadd(kk, i1, i2, i3, list, lptr, lend, lnew) bind(c, name="pstripack_intadd"//OF_INTEGER)
      import
      integer(INTEGER_KIND), value :: kk, i1, i2, i3
      integer(INTEGER_KIND) :: list(*), lptr(*), lend(*), lnew
    end subroutine
  end interface
  call c_intadd(kk, i1, i2, i3, list, lptr, lend, lnew)
end subroutine
#endif

#ifdef STRIPACK_BDYADD
recursive subroutine bdyadd(kk, i1, i2, list, lptr, lend, lnew)
  use, intrinsic :: iso_c_binding
  implicit none
  integer(INTEGER_KIND) :: kk, i1, i2, list(*), lptr(*), lend(*), lnew
  interface
    subroutine c_bdyadd(kk, i1, i2, list, lptr, lend, lnew) bind(c, name="pstripack_bdyadd"//OF_INTEGER)
      import
      integer(INTEGER_KIND), value :: kk, i1, i2
      integer(INTEGER_KIND) :: list(*), lptr(*), lend(*), lnew
    end subroutine
  end interface
  call c_bdyadd(kk, i1, i2, list, lptr, lend, lnew)
end subroutine
#endif

#ifdef STRIPACK_COVSPH
recursive subroutine covsph(kk, n0, list, lptr, lend, lnew)
  use, intrinsic :: iso_c_binding
  implicit none
  integer(INTEGER_KIND) :: kk, n0, list(*), lptr(*), lend(*), lnew
  interface
    subroutine c_covsph(kk, n0, list, lptr, lend, lnew) bind(c, name="pstripack_covsph"//OF_INTEGER)
      import
      integer(INTEGER_KIND), value :: kk, n0
      integer(INTEGER_KIND) :: list(*), lptr(*), lend(*), lnew
    end subroutine
  end interface
  call c_covsph(kk, n0, list, lptr, lend, lnew)
end subroutine
#endif

#ifdef STRIPACK_SWAP
recursive subroutine swap(in1, in2, io1, io2, list, lptr, lend, lp21)
  use, intrinsic :: iso_c_binding
  implicit none
  integer(INTEGER_KIND) :: in1, in2, io1, io2, list(*), lptr(*), lend(*), lp21
  interface
    subroutine c_swap(in1, in2, io1, io2, list, lptr, lend, lp21) bind(c, name="pstripack_swap"//OF_INTEGER)
      import
      integer(INTEGER_KIND), value :: in1, in2, io1, io2
      integer(INTEGER_KIND) :: list(*), lptr(*), lend(*), lp21
    end subroutine
  end interface
  call c_swap(in1, in2, io1, io2, list, lptr, lend, lp21)
end subroutine
#endif

#ifdef STRIPACK_DELNB
recursive subroutine delnb(n0, nb, n, list, lptr, lend, lnew, lph)
  use, intrinsic :: iso_c_binding
  implicit none
  integer(INTEGER_KIND) :: n0, nb, n, list(*), lptr(*), lend(*), lnew, lph
  interface
    subroutine c_delnb(n0, nb, n, list, lptr, lend, lnew, lph) bind(c, name="pstripack_delnb"//OF_INTEGER)
      import
      integer(INTEGER_KIND), value :: n0, nb, n
      integer(INTEGER_KIND) :: list(*), lptr(*), lend(*), lnew, lph
    end subroutine
  end interface
  call c_delnb(n0, nb, n, list, lptr, lend, lnew, lph)
end subroutine
#endif

#ifdef STRIPACK_DELARC
recursive subroutine delarc(n, io1, io2, list, lptr, lend, lnew, ier)
  use, intrinsic :: iso_c_binding
  implicit none
  integer(INTEGER_KIND) :: n, io1, io2, list(*), lptr(*), lend(*), lnew, ier
  interface
    subroutine c_delarc(n, io1, io2, list, lptr, lend, lnew, ier) bind(c, name="pstripack_delarc"//OF_INTEGER)
      import
      integer(INTEGER_KIND), value :: n, io1, io2
      integer(INTEGER_KIND) :: list(*), lptr(*), lend(*), lnew, ier
    end subroutine
  end interface
  call c_delarc(n, io1, io2, list, lptr, lend, lnew, ier)
end subroutine
#endif

#ifdef STRIPACK_SWPTST
recursive logical(LOGICAL_KIND) function swptst(n1, n2, n3, n4, x, y, z)
  use, intrinsic :: iso_c_binding
  implicit none
  integer(INTEGER_KIND) :: n1, n2, n3, n4
  real(REAL_KIND) :: x(*), y(*), z(*)
  interface
    function c_swptst(n1, n2, n3, n4, x, y, z) bind(c, name="pstripack_swptst"//OF_REAL)
      import
      integer(INTEGER_KIND), value :: n1, n2, n3, n4
      real(REAL_KIND) :: x(*), y(*), z(*)
      integer(INTEGER_KIND) :: c_swptst
    end function
  end interface
  swptst = c_swptst(n1, n2, n3, n4, x, y, z) /= 0
end function
#endif

#ifdef STRIPACK_OPTIM
recursive subroutine optim(x, y, z, na, list, lptr, lend, nit, iwk, ier)
  use, intrinsic :: iso_c_binding
  implicit none
  integer(INTEGER_KIND) :: na, list(*), lptr(*), lend(*), nit, iwk(*), ier
  real(REAL_KIND) :: x(*), y(*), z(*)
  interface
    subroutine c_optim(x, y, z, na, list, lptr, lend, nit, iwk, ier) bind(c, name="pstripack_optim"//OF_REAL)
      import
      integer(INTEGER_KIND), value :: na
      integer(INTEGER_KIND) :: list(*), lptr(*), lend(*), nit, iwk(*), ier
      real(REAL_KIND) :: x(*), y(*), z(*)
    end subroutine
  end interface
  call c_optim(x, y, z, na, list, lptr, lend, nit, iwk, ier)
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

#ifdef STRIPACK_ADDNOD
recursive subroutine addnod(nst, k, x, y, z, list, lptr, lend, lnew, ier)
  use, intrinsic :: iso_c_binding
  implicit none
  integer(INTEGER_KIND) :: nst, k, list(*), lptr(*), lend(*), lnew, ier
  real(REAL_KIND) :: x(*), y(*), z(*)
  interface
    subroutine c_addnod(nst, k, x, y, z, list, lptr, lend, lnew, ier) &
        bind(c, name="pstripack_addnod"//OF_REAL)
      import
      integer(INTEGER_KIND), value :: nst, k
      integer(INTEGER_KIND) :: list(*), lptr(*), lend(*), lnew, ier
      real(REAL_KIND) :: x(*), y(*), z(*)
    end subroutine
  end interface
  call c_addnod(nst, k, x, y, z, list, lptr, lend, lnew, ier)
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

#ifdef STRIPACK_GETNP
recursive subroutine getnp(x, y, z, list, lptr, lend, l, npts, df, ier)
  use, intrinsic :: iso_c_binding
  implicit none
  real(REAL_KIND) :: x(*), y(*), z(*), df
  integer(INTEGER_KIND) :: list(*), lptr(*), lend(*), l, npts(*), ier
  IDENT("GETNP")
  interface
    subroutine c_getnp(x, y, z, list, lptr, lend, l, npts, df, ier) bind(c, name="pstripack_getnp"//OF_REAL)
      import
      integer(INTEGER_KIND), value :: l
      real(REAL_KIND) :: x(*), y(*), z(*), df
      integer(INTEGER_KIND) :: list(*), lptr(*), lend(*), npts(*), ier
    end subroutine
  end interface
  KEEP_IDENT
  call c_getnp(x, y, z, list, lptr, lend, l, npts, df, ier)
end subroutine
#endif

#ifdef STRIPACK_INSIDE
recursive logical(LOGICAL_KIND) function inside(p, lv, xv, yv, zv, nv, listv, ier)
  use, intrinsic :: iso_c_binding
  implicit none
  integer(INTEGER_KIND) :: lv, nv, listv(*), ier
  real(REAL_KIND) :: p(3), xv(*), yv(*), zv(*)
  interface
    function c_inside(p, lv, xv, yv, zv, nv, listv, ier) bind(c, name="pstripack_inside"//OF_REAL)
      import
      integer(INTEGER_KIND), value :: lv, nv
      integer(INTEGER_KIND) :: listv(*), ier, c_inside
      real(REAL_KIND) :: p(*), xv(*), yv(*), zv(*)
    end function
  end interface
  inside = c_inside(p, lv, xv, yv, zv, nv, listv, ier) /= 0
end function
#endif

#ifdef STRIPACK_INTRSC
recursive subroutine intrsc(p1, p2, cn, p, ier)
  use, intrinsic :: iso_c_binding
  implicit none
  real(REAL_KIND) :: p1(3), p2(3), cn(3), p(3)
  integer(INTEGER_KIND) :: ier
  interface
    subroutine c_intrsc(p1, p2, cn, p, ier) bind(c, name="pstripack_intrsc"//OF_REAL)
      import
      real(REAL_KIND) :: p1(*), p2(*), cn(*), p(*)
      integer(INTEGER_KIND) :: ier
    end subroutine
  end interface
  call c_intrsc(p1, p2, cn, p, ier)
end subroutine
#endif

#ifdef STRIPACK_JRAND
recursive integer(INTEGER_KIND) function jrand(n, ix, iy, iz)
  use, intrinsic :: iso_c_binding
  implicit none
  integer(INTEGER_KIND) :: n, ix, iy, iz
  interface
    function c_jrand(n, ix, iy, iz) bind(c, name="pstripack_jrand"//OF_REAL)
      import
      integer(INTEGER_KIND), value :: n
      integer(INTEGER_KIND) :: ix, iy, iz, c_jrand
    end function
  end interface
  jrand = c_jrand(n, ix, iy, iz)
end function
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

#ifdef STRIPACK_TRIAREAS
recursive subroutine triareas(n, x, y, z, nt, triangles, triarea)
  use, intrinsic :: iso_c_binding
  implicit none
  integer(INTEGER_KIND) :: n, nt, triangles(*)
  real(REAL_KIND) :: x(*), y(*), z(*), triarea(*)
  interface
    subroutine c_triareas(n, x, y, z, nt, triangles, triarea) bind(c, name="pstripack_triareas"//OF_REAL)
      import
      integer(INTEGER_KIND), value :: n, nt
      integer(INTEGER_KIND) :: triangles(*)
      real(REAL_KIND) :: x(*), y(*), z(*), triarea(*)
    end subroutine
  end interface
  call c_triareas(n, x, y, z, nt, triangles, triarea)
end subroutine
#endif

! The routines that print: libpstripack composes the text, write_records.inc writes it.
! TRPRNT, TRLPRT: Algorithm 772 has a last argument LOUT. The Fortran 90 texts, which are REAL*8, have none and print on
! standard output, so libstripack and libstripack_8arg never read LOUT. Most callers of the other two libraries pass it:
! listing_unit.inc decides whether it is used.
#if STRIPACK_REAL_BYTES == 8 && STRIPACK_INTEGER_BYTES == 4
#define F90_LISTING 1
#define AND_LOUT
#define DECLARE_LOUT
#define LISTING_UNIT(fifth, sixth, seventh, eighth) int(6, INTEGER_KIND)
#else
#define STRIPACK_WITH_LOUT
#define F90_LISTING 0
#define AND_LOUT , lout
#define DECLARE_LOUT integer(INTEGER_KIND), optional :: lout
#define LISTING_UNIT(fifth, sixth, seventh, eighth) listing_unit(lout, n, fifth, sixth, seventh, eighth)
#endif

#ifdef STRIPACK_TRPRNT
recursive subroutine trprnt(n, x, y, z, iflag, list, lptr, lend AND_LOUT)
  use, intrinsic :: iso_c_binding
  use, intrinsic :: iso_fortran_env, only: error_unit
  implicit none
  integer(INTEGER_KIND) :: n, iflag, list(*), lptr(*), lend(*)
  real(REAL_KIND) :: x(*), y(*), z(*)
  DECLARE_LOUT
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
  call write_records(c_trprnt(n, x, y, z, iflag, list, lptr, lend, int(F90_LISTING, INTEGER_KIND)), &
                     LISTING_UNIT(iflag, list(1), lptr(1), lend(1)), status)
  if (status /= 0) write (error_unit, '(a,i0)') "pstripack: TRPRNT: cannot write, IOSTAT = ", status
contains
#include "listing_unit.inc"
#include "write_records.inc"
end subroutine
#endif

#ifdef STRIPACK_TRLPRT
recursive subroutine trlprt(n, x, y, z, iflag, nrow, nt, ltri AND_LOUT)
  use, intrinsic :: iso_c_binding
  use, intrinsic :: iso_fortran_env, only: error_unit
  implicit none
  integer(INTEGER_KIND) :: n, iflag, nrow, nt, ltri(*)
  real(REAL_KIND) :: x(*), y(*), z(*)
  DECLARE_LOUT
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
  call write_records(c_trlprt(n, x, y, z, iflag, nrow, nt, ltri, int(F90_LISTING, INTEGER_KIND)), &
                     LISTING_UNIT(iflag, nrow, nt, ltri(1)), status)
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
