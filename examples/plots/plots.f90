! PLOTS: pictures of a triangulation and of its Voronoi diagram, as Encapsulated PostScript.
!
!   plots
!
! Writes trplot.eps, half the sphere, and vrplot.eps, a part of it with the nodes numbered. make-plots turns them
! into the pictures of docs/api/trplot.md.

      program plots
      implicit none
      integer, parameter :: dp = selected_real_kind(15), n = 400, lun = 8
      real(dp), parameter :: pi = acos(-1.0_dp)
      real(dp) :: x(n), y(n), z(n), dist(n), latitude(n), longitude(n)
      real(dp) :: xc(2*n-4), yc(2*n-4), zc(2*n-4), rc(2*n-4)
      integer :: list(6*n-12), lptr(6*n-12), lend(n), listc(6*n-12), ltri(6,n), work(2*n), lnew, nb, ier, k
      external trans, trmesh, crlist, trplot, vrplot

! Nodes all over the sphere: multiples of two irrational numbers, modulo 1, fill a square evenly.
      do k = 1, n
        latitude(k) = asin(2*fraction_of(0.7548776662466927_dp*k) - 1)
        longitude(k) = 2*pi*fraction_of(0.5698402909980532_dp*k)
      end do
      call trans(n, latitude, longitude, x, y, z)

      call trmesh(n, x, y, z, list, lptr, lend, lnew, work, work(n+1), dist, ier)
      if (ier /= 0) stop 'trmesh'
      open (lun, file='trplot.eps', status='replace')
      call trplot(lun, 7.5_dp, 40.0_dp, -100.0_dp, 90.0_dp, n, x, y, z, list, lptr, lend, &
                  '(Delaunay triangulation of 400 nodes)', .false., ier)
      if (ier /= 0) stop 'trplot'
      close (lun)

! CRLIST may change LPTR: give it a copy if the triangulation is still needed.
      call crlist(n, n, x, y, z, list, lend, lptr, lnew, ltri, listc, nb, xc, yc, zc, rc, ier)
      if (ier /= 0) stop 'crlist'
      open (lun, file='vrplot.eps', status='replace')
      call vrplot(lun, 7.5_dp, 40.0_dp, -100.0_dp, 30.0_dp, n, x, y, z, 2*n-4, listc, lptr, lend, xc, yc, zc, &
                  '(Voronoi cells, with the numbers of their nodes)', .true., ier)
      if (ier /= 0) stop 'vrplot'
      close (lun)

      contains
      pure function fraction_of(a)
      real(dp), intent(in) :: a
      real(dp) :: fraction_of
      fraction_of = a - int(a)
      end function
      end program
