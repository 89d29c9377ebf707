! Prints the current date and time on standard output, as in "31 May 2001   9:45:54.872 AM".
recursive subroutine timestamp
  implicit none
  character(len=9), parameter :: months(12) = [character(len=9) :: "January", "February", "March", "April", "May", &
    "June", "July", "August", "September", "October", "November", "December"]
  integer :: now(8), hour
  character(len=8) :: half
  call date_and_time(values=now)
  associate (year => now(1), month => now(2), day => now(3), hour_of_day => now(5), minute => now(6), second => now(7), &
             millisecond => now(8))
    half = merge("AM", "PM", hour_of_day < 12)
    if (minute == 0 .and. second == 0) then
      if (hour_of_day == 0) half = "Midnight"
      if (hour_of_day == 12) half = "Noon"
    end if
    hour = modulo(hour_of_day - 1, 12) + 1
    write (*, "(i2,1x,a,1x,i4,2x,i2,2(':',i2.2),'.',i3.3,1x,a)") day, trim(months(month)), year, hour, minute, second, &
      millisecond, trim(half)
  end associate
end subroutine
