! What the libraries assume of a Fortran compiler: 0 is .false., 1 is .true., the compiler's own .true. has its lowest bit
! set, in four bytes and in eight; and a procedure without characters is its name in lower case and an underscore, and
! takes addresses alone. Compiled at configure, and linked with calls.c.
program fortran
  implicit none
  integer, parameter :: true4 = merge(4, -1, iand(transfer(.true._4, 0_4), 1_4) == 1 .and. transfer(1_4, .true._4))
  integer, parameter :: false4 = merge(4, -1, transfer(.false._4, 1_4) == 0 .and. .not. transfer(0_4, .true._4))
  integer, parameter :: true8 = merge(8, -1, iand(transfer(.true._8, 0_8), 1_8) == 1 .and. transfer(1_8, .true._8))
  integer, parameter :: false8 = merge(8, -1, transfer(.false._8, 1_8) == 0 .and. .not. transfer(0_8, .true._8))
  integer(true4) :: n  ! kind -1 does not compile
  integer(false4) :: m
  integer(true8) :: n8
  integer(false8) :: m8
  logical :: c_adds
  external :: c_adds
  n = 1
  m = 2
  n8 = 3
  m8 = 4
  if (.not. c_adds(n, m, n8, m8)) error stop "a call of C"
end program
