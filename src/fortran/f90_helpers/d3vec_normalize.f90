recursive subroutine d3vec_normalize(n, x, y, z)
  include "normalize.inc"
end subroutine
