! Cases in which the original never returns, is quadratic or overruns arrays. Also: any number of threads gives the same
! bytes. Runs under a time limit.
program hard_cases
  use omp_lib, only: omp_get_max_threads, omp_set_num_threads
  use expectations
  use random_points
  implicit none
  integer, parameter :: rk = real64, mark = -7777
  external :: trmesh, trlist, trlist2, crlist, trfind
  integer, external :: nearnd

  type mesh
    integer :: n, lnew
    real(rk), allocatable :: x(:), y(:), z(:)
    integer, allocatable :: list(:), lptr(:), lend(:)
  end type
  type diagram
    integer :: nb, lnew, ier
    integer, allocatable :: lptr(:), ltri(:, :), listc(:)
    real(rk), allocatable :: c(:, :)
  end type

  call far_side_that_circles
  call cocircular_boundaries
  call search_near_a_sliver
  call search_on_a_great_circle
  call search_for_nodes_of_a_grid
  call hub
  call broken_lists
  call any_number_of_threads

contains

  function triangulated(p) result(m)
    real(rk), intent(in) :: p(:, :)
    type(mesh) :: m
    integer :: near(1), next(1), ier
    real(rk) :: dist(1)
    m%n = size(p, 2)
    allocate (m%x, source=p(1, :))
    allocate (m%y, source=p(2, :))
    allocate (m%z, source=p(3, :))
    allocate (m%list(6*m%n - 12), m%lptr(6*m%n - 12), m%lend(m%n), source=mark)
    call trmesh(m%n, m%x, m%y, m%z, m%list, m%lptr, m%lend, m%lnew, near, next, dist, ier)
    call expect(ier == 0, "TRMESH")
  end function

  recursive function voronoi(m) result(d)
    type(mesh), intent(in) :: m
    type(diagram) :: d
    allocate (d%lptr, source=m%lptr)
    d%lnew = m%lnew
    allocate (d%ltri(6, m%n), d%listc(6*m%n - 12), source=mark)
    allocate (d%c(2*m%n - 4, 4), source=-1.0_rk)
    call crlist(m%n, m%n, m%x, m%y, m%z, m%list, m%lend, d%lptr, d%lnew, d%ltri, d%listc, d%nb, &
                d%c(:, 1), d%c(:, 2), d%c(:, 3), d%c(:, 4), d%ier)
  end function

  !> Every triangle occurs at three nodes, and the distances of each node from the centres around it are their radii.
  subroutine expect_valid(m, d, what)
    type(mesh), intent(in) :: m
    type(diagram), intent(in) :: d
    character(len=*), intent(in) :: what
    integer :: met(2*m%n - 4), node, slot, t
    real(rk) :: cosine
    call expect(d%ier == 0, what//": IER")
    call expect(d%lnew == merge(m%lnew, 6*m%n - 11, d%nb == 0), what//": LNEW")
    met = 0
    ! No texts composed in the loops: flang-new keeps each on the stack until the procedure returns.
    do node = 1, m%n
      slot = m%lend(node)
      do
        t = d%listc(slot)
        if (t < 1 .or. t > 2*m%n - 4) call expect(.false., what//": LISTC holds triangle numbers")
        met(t) = met(t) + 1
        cosine = d%c(t, 1)*m%x(node) + d%c(t, 2)*m%y(node) + d%c(t, 3)*m%z(node)
        if (.not. abs(acos(max(-1.0_rk, min(1.0_rk, cosine))) - d%c(t, 4)) < 1e-6) call expect(.false., what//": radius")
        slot = d%lptr(slot)
        if (slot == m%lend(node)) exit
      end do
    end do
    call expect(all(met == 3), what//": every triangle has three corners")
    do t = 1, d%nb - 2
      if (any(d%ltri(1:3, t) < 1) .or. any(d%ltri(4:6, t) > d%nb - 2)) call expect(.false., what//": far side")
    end do
  end subroutine

  !> Four nodes for which the rounded swap tests of the original's CRLIST never end.
  subroutine far_side_that_circles
    type(mesh) :: m
    m = triangulated(reshape([ &
      -0.47685613077941658_rk, 0.11123049037700214_rk, 0.87191513838708845_rk, &
      -0.83257100181898913_rk, 0.37940748626865584_rk, -0.40357835211198373_rk, &
      0.062295641749798597_rk, -0.53161973279928965_rk, -0.84468912193622592_rk, &
      0.41801051278937118_rk, -0.79979672869094331_rk, 0.43080436856284593_rk], [3, 4]))
    call expect_valid(m, voronoi(m), "four cocircular nodes")
  end subroutine

  subroutine cocircular_boundaries
    integer, parameter :: sizes(6) = [4, 5, 12, 40, 200, 3000]
    integer :: i, k, n, trial
    real(rk), allocatable :: p(:, :)
    real(rk) :: axis(3), u(3), v(3), radius, angle
    type(mesh) :: m
    do i = 1, size(sizes)
      n = sizes(i)
      do trial = 1, 2000/n + 1
        call seed(1000*i + trial)
        axis = direction()
        call basis(axis, u, v)
        radius = 0.1_rk + 1.3_rk*uniform()
        p = reshape([(0.0_rk, k=1, 3*n)], [3, n])
        do k = 1, n
          angle = 8*atan(1.0_rk)*k/n
          p(:, k) = cos(radius)*axis + sin(radius)*(cos(angle)*u + sin(angle)*v)
        end do
        m = triangulated(p)
        call expect_valid(m, voronoi(m), "cocircular boundary")
      end do
    end do
  end subroutine

  !> Nodes of one meridian, rounded: the first triangle is a sliver of area 1e-18.
  subroutine search_near_a_sliver
    real(rk), parameter :: p(3, 4) = reshape([ &
      0.452695204446832_rk, 0.5590320207484465_rk, 0.6946583704589973_rk, &
      0.4602557974987226_rk, 0.5683685756099448_rk, 0.6819983600624985_rk, &
      0.467676192176097_rk, 0.5775319998974023_rk, 0.6691306063588582_rk, &
      0.47495412815485366_rk, 0.5865195023430131_rk, 0.6560590289905072_rk], [3, 4])
    type(mesh) :: m
    integer :: start, i(3)
    real(rk) :: b(3)
    m = triangulated(p(:, 1:3))
    do start = 0, 3
      call trfind(start, p(:, 4), 3, m%x, m%y, m%z, m%list, m%lptr, m%lend, b(1), b(2), b(3), i(1), i(2), i(3))
      call expect(i(3) == 0 .and. all(i(1:2) >= 1) .and. all(i(1:2) <= 3), "a point in line with a sliver is outside it")
    end do
  end subroutine

  !> Half of the nodes on a great circle up to rounding, the others on one side of it: the triangles on the other side are
  !> slivers or adjoin slivers. For points on the circle the triangle that is found must contain the point. Points beyond
  !> the circle must see the boundary arc that is found, or lie in the triangle.
  subroutine search_on_a_great_circle
    integer, parameter :: n = 60
    real(rk) :: p(3, n), axis(3), u(3), v(3), c(3), b(3), angle, corner(3, 3)
    type(mesh) :: m
    integer :: trial, k, i(3)
    do trial = 1, 300
      call seed(9000 + trial)
      axis = direction()
      call basis(axis, u, v)
      do k = 1, n
        p(:, k) = direction()
        if (dot_product(p(:, k), axis) < 0) p(:, k) = -p(:, k)
        if (mod(k, 2) == 0) then
          angle = 8*atan(1.0_rk)*uniform()
          p(:, k) = cos(angle)*u + sin(angle)*v
        end if
      end do
      m = triangulated(p)
      do k = 1, 200
        angle = 8*atan(1.0_rk)*uniform()
        c = cos(angle)*u + sin(angle)*v
        call trfind(mod(k, n + 1), c, n, m%x, m%y, m%z, m%list, m%lptr, m%lend, b(1), b(2), b(3), i(1), i(2), i(3))
        call expect(all(i(1:2) >= 1) .and. all(i <= n), "a point on a great circle of nodes is found")
        corner(:, 1) = p(:, i(1))
        corner(:, 2) = p(:, i(2))
        if (i(3) == 0) cycle
        corner(:, 3) = p(:, i(3))
        call expect(all(b >= 0) .and. side(corner(:, 1), corner(:, 2), c) > -1e-13_rk .and. &
                    side(corner(:, 2), corner(:, 3), c) > -1e-13_rk .and. &
                    side(corner(:, 3), corner(:, 1), c) > -1e-13_rk, "in the triangle that holds it")
      end do
    end do
  end subroutine

  real(rk) function side(a, b, c)
    real(rk), intent(in) :: a(3), b(3), c(3)
    side = c(1)*(a(2)*b(3) - b(2)*a(3)) - c(2)*(a(1)*b(3) - b(1)*a(3)) + c(3)*(a(1)*b(2) - b(1)*a(2))
  end function

  !> A global grid with poles, full of exact and rounded collinearity.
  subroutine search_for_nodes_of_a_grid
    integer, parameter :: rows = 17, columns = 36, n = rows*columns + 2
    real(rk) :: p(3, n), b(3), al
    type(mesh) :: m
    integer :: row, column, k, i(3)
    real(rk) :: latitude, longitude
    k = 0
    do column = 1, columns
      do row = 1, rows
        k = k + 1
        latitude = atan(1.0_rk)*4*(row - 9)/18
        longitude = atan(1.0_rk)*8*column/columns
        p(:, k) = [cos(latitude)*cos(longitude), cos(latitude)*sin(longitude), sin(latitude)]
      end do
    end do
    p(:, n - 1) = [0, 0, 1]
    p(:, n) = [0, 0, -1]
    m = triangulated(p)
    do k = 1, n
      call trfind(mod(7*k, n), p(:, k), n, m%x, m%y, m%z, m%list, m%lptr, m%lend, b(1), b(2), b(3), i(1), i(2), i(3))
      call expect(any(i == k) .and. all(b >= 0), "a node is a corner of the triangle that is found")
      call expect(nearnd(p(:, k), mod(7*k, n), n, m%x, m%y, m%z, m%list, m%lptr, m%lend, al) == k .and. al < 1e-7, &
                  "a node is nearest to itself")
    end do
  end subroutine

  !> A ring of nodes and its centre, the centre first or last: the original needs N*N steps, here hours.
  subroutine hub
    integer, parameter :: n = 200001
    real(rk) :: angle
    real(rk), allocatable :: p(:, :)
    type(mesh) :: m
    integer :: k, nt, ier
    integer, allocatable :: ltri(:, :)
    allocate (p(3, n), ltri(9, 2*n))
    do k = 1, n - 1
      angle = 8*atan(1.0_rk)*k/(n - 1)
      p(:, k) = [cos(angle)*sin(1.0_rk), sin(angle)*sin(1.0_rk), cos(1.0_rk)]
    end do
    p(:, n) = [0, 0, 1]
    do k = 1, 2
      m = triangulated(p)
      call trlist(n, m%list, m%lptr, m%lend, 9, nt, ltri, ier)
      call expect(ier == 0 .and. nt >= n - 1, "TRLIST of a ring and its centre")
      call expect(maxval(ltri(7:9, 1:nt)) == nt + n - 1, "all arcs have numbers")
      call expect_valid(m, voronoi(m), "a ring and its centre")
      p = cshift(p, -1, 2)  ! the centre first
    end do
  end subroutine

  !> Broken lists: an error, and no access outside the arrays.
  subroutine broken_lists
    type(mesh) :: m, broken
    type(diagram) :: d
    integer :: ltri(9, 2*60 + 1), nt, ier, k, at
    real(rk) :: p(3, 60)
    call seed(5)
    do k = 1, 60
      p(:, k) = direction()
    end do
    m = triangulated(p)
    do k = 1, 50
      broken = m
      at = 1 + int(uniform()*size(m%list))
      select case (mod(k, 5))
        case (0); broken%list(at) = 0
        case (1); broken%list(at) = 61
        case (2); broken%lptr(at) = huge(at)
        case (3); broken%lptr(at) = -huge(at)
        case (4); broken%lend(1 + mod(at, 60)) = -huge(at)
      end select
      ltri(:, 2*60 - 3:) = mark
      call trlist(60, broken%list, broken%lptr, broken%lend, 9, nt, ltri, ier)
      call expect(ier == 2 .and. nt == 0, "TRLIST of broken lists")
      call expect(all(ltri(:, 2*60 - 3:) == mark), "TRLIST writes 2N-4 columns at most")
      d = voronoi(broken)
      call expect(d%ier == -13 .and. d%lnew == m%lnew .and. all(d%lptr == broken%lptr), "CRLIST of broken lists")
    end do
    broken = m
    where (broken%list == 7) broken%list = 8  ! a neighbour that does not list the node
    call trlist2(60, broken%list, broken%lptr, broken%lend, nt, ltri, ier)
    call expect(ier == 2 .and. nt == 0, "TRLIST2 of broken lists")
  end subroutine

  subroutine any_number_of_threads
    integer, parameter :: n = 60000
    real(rk), allocatable :: p(:, :)
    type(mesh) :: m
    type(diagram) :: one, more
    integer, allocatable :: ltri(:, :), ltri_more(:, :)
    integer :: k, threads, nt, ier, shape, most
    most = omp_get_max_threads()
    allocate (p(3, n), ltri(9, 2*n), ltri_more(9, 2*n))
    do shape = 1, 2  ! the sphere, a hemisphere
      call seed(shape)
      do k = 1, n
        p(:, k) = direction()
        if (shape == 2) p(3, k) = abs(p(3, k))
      end do
      m = triangulated(p)
      ltri = mark
      ltri_more = mark
      call omp_set_num_threads(1)
      call trlist(n, m%list, m%lptr, m%lend, 9, nt, ltri, ier)
      call expect(ier == 0, "TRLIST, one thread")
      one = voronoi(m)
      call expect_valid(m, one, "CRLIST, one thread")
      do threads = 2, 5
        call omp_set_num_threads(threads)
        call trlist(n, m%list, m%lptr, m%lend, 9, nt, ltri_more, ier)
        call expect(ier == 0 .and. all(ltri_more == ltri), "TRLIST: the same for any number of threads")
        call expect_same(one, voronoi(m))
      end do
      !$omp parallel num_threads(2) private(more)
      more = voronoi(m)
      !$omp critical
      call expect_same(one, more)
      !$omp end critical
      !$omp end parallel
    end do
    call omp_set_num_threads(most)
  end subroutine

  subroutine expect_same(one, other)
    type(diagram), intent(in) :: one, other
    call expect(other%ier == one%ier .and. other%nb == one%nb .and. other%lnew == one%lnew, "CRLIST: scalars")
    call expect(all(other%lptr == one%lptr), "CRLIST: the same LPTR for any number of threads")
    call expect(all(other%listc == one%listc), "CRLIST: the same LISTC")
    call expect(all(other%ltri == one%ltri), "CRLIST: the same LTRI")
    call expect(all(other%c == one%c), "CRLIST: the same centres and radii")
  end subroutine
end program
