! The arc cosine of c; that of -1 or 1 where rounding has carried c beyond.
recursive double precision function arc_cosine(c)
  implicit none
  double precision :: c
  arc_cosine = acos(merge(sign(1d0, c), c, abs(c) > 1))
end function
