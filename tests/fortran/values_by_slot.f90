! Programs keep a value for each arc in an array parallel to LIST, as SSRFPACK does with its tension factors. They write
! it for both directions, finding the other one with LSTPTR, and later read all slots 1..LNEW-1. So every slot below
! LNEW must belong to an arc, also after ADDNOD and DELNOD.
program values_by_slot
  use stripack
  use expectations
  implicit none
  integer, parameter :: most = 150, slots = 6*most - 12
  real(8) :: x(most), y(most), z(most), dist(most), sigma(slots)
  integer :: list(slots), lptr(slots), lend(most), lnew, near(most), next(most), iwk(2, most), lwk, ier, n, i

  call spiral
  n = 100
  call trmesh(n, x, y, z, list, lptr, lend, lnew, near, next, dist, ier)
  call expect(ier == 0, "TRMESH")
  call fill_and_read
  do i = 1, 50
    call addnod(0, n + 1, x, y, z, list, lptr, lend, lnew, ier)
    call expect(ier == 0, "ADDNOD")
    n = n + 1
    call fill_and_read
  end do
  do i = 1, 120
    lwk = most
    call delnod(1 + mod(7*i, n), n, x, y, z, list, lptr, lend, lnew, lwk, iwk, ier)
    call expect(ier == 0, "DELNOD")
    call fill_and_read
  end do
  call expect(n == 30, "N")

contains

  ! In an order that does not follow the spiral.
  subroutine spiral
    integer :: k, turn
    real(8) :: height
    do k = 1, most
      turn = mod(37*k, most)
      height = 2*(turn + 0.5d0)/most - 1
      x(k) = sqrt(1 - height**2)*cos(2.4d0*turn)
      y(k) = sqrt(1 - height**2)*sin(2.4d0*turn)
      z(k) = height
    end do
  end subroutine

  subroutine fill_and_read
    integer :: node, slot, other, back, arcs
    real(8) :: total
    sigma = -1
    total = 0
    arcs = 0
    do node = 1, n
      slot = lend(node)
      do
        slot = lptr(slot)
        other = abs(list(slot))
        if (other > node) then
          back = lstptr(lend(other), node, list, lptr)
          call expect(abs(list(back)) == node, "LSTPTR finds the arc's other direction")
          call expect(sigma(slot) < 0 .and. sigma(back) < 0, "each arc once")
          sigma(slot) = node + 1000d0*other
          sigma(back) = sigma(slot)
          total = total + 2*sigma(slot)
          arcs = arcs + 1
        end if
        if (slot == lend(node)) exit
      end do
    end do
    call expect(lnew == 2*arcs + 1, "LNEW")
    call expect(all(sigma(:lnew - 1) > 0) .and. all(sigma(lnew:) < 0), "slots 1..LNEW-1 and no others have a value")
    call expect(sum(sigma(:lnew - 1)) == total, "a flat sum")
    call expect(all(abs(list(:lnew - 1)) >= 1) .and. all(abs(list(:lnew - 1)) <= n), "neighbours are nodes")
  end subroutine
end program
