! The arc cosine of c; arguments beyond -1 and 1, from rounding, count as -1 and 1.
recursive double precision function arc_cosine(c)
  implicit none
  double precision :: c
  arc_cosine = acos(merge(sign(1d0, c), c, abs(c) > 1))
end function
