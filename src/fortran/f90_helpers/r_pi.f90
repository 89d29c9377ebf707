! Pi in single precision.
recursive real function r_pi()
  implicit none
  r_pi = acos(-1.0)
end function
