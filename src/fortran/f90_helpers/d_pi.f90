! Pi in double precision.
recursive double precision function d_pi()
  implicit none
  d_pi = acos(-1d0)
end function
