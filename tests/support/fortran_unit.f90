! Fortran units, for tests in C++.
module fortran_unit
  use, intrinsic :: iso_c_binding
  implicit none
contains

  ! Opens `unit` for the file `path`. access: "write", "read", "unformatted". IOSTAT.
  integer(c_int) function open_unit(unit, path, path_length, access, access_length) bind(c)
    integer(c_int), value :: unit, path_length, access_length
    character(kind=c_char) :: path(path_length), access(access_length)
    select case (text(access))
    case ("write")
      open (unit, file=text(path), action="write", iostat=open_unit)
    case ("read")
      open (unit, file=text(path), action="read", iostat=open_unit)
    case ("unformatted")
      open (unit, file=text(path), action="write", form="unformatted", iostat=open_unit)
    case default
      error stop "open_unit"
    end select
  end function

  subroutine close_unit(unit) bind(c)
    integer(c_int), value :: unit
    integer :: status
    close (unit, iostat=status)  ! fails where the disk is full
  end subroutine

  ! What was printed, out of the buffer.
  subroutine flush_standard_output() bind(c)
    flush (6)
  end subroutine

  pure function text(characters)
    character(kind=c_char), intent(in) :: characters(:)
    character(len=size(characters)) :: text
    integer :: i
    do i = 1, size(characters)
      text(i:i) = characters(i)
    end do
  end function

end module
