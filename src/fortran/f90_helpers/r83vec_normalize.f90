recursive subroutine r83vec_normalize(n, x, y, z)
  include "normalize.inc"
end subroutine
