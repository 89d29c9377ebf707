! A serial model that calls TRMESH and does not use MPI.
!
!   model lists FILE   triangulates sets of nodes of all kinds and writes the results of TRMESH bytewise; ends with
!                      code 9 if the calls should have gone to the pool and did not
!   model END          one call, a line on stdout, then END: stop, stop3, error_stop, exit5, abort
!   model never END    the same without the call

program model
  use iso_c_binding, only: c_int
  implicit none
  interface
    ! 1 if this process has shared its arrays with a pool.
    function pool_was_used() bind(c)
      import :: c_int
      integer(c_int) :: pool_was_used
    end function
  end interface
  external :: end_by
  integer, parameter :: rk = REAL_KIND
  character(len=256) :: action, argument
  integer :: lun

  call get_command_argument(1, action)
  call get_command_argument(2, argument)
  select case (action)
  case ('lists')
    open (newunit=lun, file=argument, access='stream', form='unformatted', status='replace')
    call all_sets
    close (lun)
    call get_environment_variable('PSTRIPACK_POOL', argument)
    if (argument /= ' ' .and. pool_was_used() == 0) stop 9
  case ('never')
    call end_model_by(argument)
  case default
    lun = 0
    call random_set(5000, 2.0_rk, 0)
    call end_model_by(action)
  end select

contains

  subroutine all_sets
    integer, parameter :: sizes(6) = [3, 4, 17, 1000, 20011, 60000]
    integer :: i
    do i = 1, size(sizes)
      call random_set(sizes(i), 2.0_rk, 0)
    end do
    call random_set(5000, 0.01_rk, 0)   ! a cap: boundary nodes
    call random_set(5000, 2.0_rk, 1)    ! node 4000 is node 100 again
    call random_set(5000, 2.0_rk, 2)    ! the first three nodes on one great circle
    call random_set(5000, 2.0_rk, 3)    ! a coordinate that is not finite
    call random_set(5000, 2.0_rk, 0)    ! and all is well again
  end subroutine

  ! The result is written if a file is open.
  subroutine random_set(n, depth, fault)
    integer, intent(in) :: n, fault
    real(rk), intent(in) :: depth
    real(rk), allocatable :: x(:), y(:), z(:), dist(:)
    integer, allocatable :: list(:), lptr(:), lend(:), near(:), next(:)
    integer, parameter :: long = selected_int_kind(18)
    integer(long) :: seed
    integer :: k, lnew, ier
    real(rk) :: longitude, r
    external trmesh
    allocate (x(n), y(n), z(n), list(6*n-12), lptr(6*n-12), lend(n), near(n), next(n), dist(n))
    seed = 42
    do k = 1, n
      z(k) = 1 - depth * uniform(seed)
      longitude = 2 * acos(-1.0_rk) * uniform(seed)
      r = sqrt((1 - z(k)) * (1 + z(k)))
      x(k) = r * cos(longitude)
      y(k) = r * sin(longitude)
    end do
    if (fault == 1) then
      x(4000) = x(100)
      y(4000) = y(100)
      z(4000) = z(100)
    else if (fault == 2) then
      z(1:3) = 0
    else if (fault == 3) then
      y(77) = huge(y)
      y(77) = 2 * y(77)
    end if
    list = -77
    lptr = -77
    lend = -77
    lnew = -77
    call trmesh(n, x, y, z, list, lptr, lend, lnew, near, next, dist, ier)
    if (lun /= 0) then
      write (lun) n, ier, lnew, lend, list, lptr
    else if (ier /= 0) then
      stop 8
    end if
  end subroutine

  function uniform(seed) result(u)
    integer(selected_int_kind(18)), intent(inout) :: seed
    real(rk) :: u
    seed = mod(16807 * seed, 2147483647_8)
    u = real(real(seed, kind(1d0)) / 2147483647d0, rk)
  end function

  subroutine end_model_by(how)
    character(len=*), intent(in) :: how
    print '(a)', 'the model ends by ' // trim(how)
    flush (6)
    call end_by(how)
    stop 7
  end subroutine

end program model
