! Ends the program by `how`: stop, stop3, error_stop, exit5, abort. Returns from any other text.
subroutine end_by(how)
  use, intrinsic :: iso_c_binding, only: c_int
  implicit none
  character(len=*), intent(in) :: how
  interface
    subroutine c_abort() bind(c, name='abort')
    end subroutine
    subroutine c_exit(code) bind(c, name='exit')
      import :: c_int
      integer(c_int), value :: code
    end subroutine
  end interface
  select case (how)
  case ('stop')
    stop
  case ('stop3')
    stop 3
  case ('error_stop')
    error stop 2
  case ('exit5')
    call c_exit(5_c_int)
  case ('abort')
    call c_abort
  end select
end subroutine
