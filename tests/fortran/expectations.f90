! !> Shared by all tests here: a failed expectation is named and ends the program with an error.
module expectations
  implicit none
contains
  subroutine expect(holds, what)
    logical, intent(in) :: holds
    character(len=*), intent(in) :: what
    if (holds) return
    print "(2a)", "NOT TRUE: ", what
    error stop 1
  end subroutine
end module
