!> PSTRIPACK for Fortran: the C API of libpstripack (pstripack.h).
!>
!> Nodes count from 1. No procedure is collective, except trmesh in comm mode (pstripack_mpi). Any number of threads may
!> call them at once.
module pstripack
  use, intrinsic :: iso_c_binding, only: c_char, c_double, c_f_pointer, c_float, c_funloc, c_funptr, c_int32_t, &
    c_int64_t, c_loc, c_null_char, c_null_funptr, c_null_ptr, c_ptr, c_size_t, c_sizeof
  implicit none
  private
  public :: pstripack_version, pstripack_strerror, pstripack_trmesh, pstripack_delaunay, pstripack_validate
  public :: pstripack_fingerprint, pstripack_release_memory
  public :: pstripack_ok, pstripack_too_few_nodes, pstripack_collinear, pstripack_too_many_nodes, &
            pstripack_bad_coordinate, pstripack_out_of_memory, pstripack_bad_size
  ! Centroidal tessellations.
  public :: pstripack_scvt, pstripack_scvt_widths, pstripack_scvt_cells, pstripack_scvt_step, pstripack_density, pstripack_progress
  public :: pstripack_scvt_options, pstripack_scvt_result, pstripack_scvt_progress
  public :: pstripack_scvt_by_number, pstripack_scvt_random, pstripack_scvt_given, pstripack_scvt_levels, &
            pstripack_scvt_front, pstripack_scvt_newton, pstripack_scvt_lloyd, &
            pstripack_scvt_converged, pstripack_scvt_evaluations, pstripack_scvt_stopped, &
            pstripack_scvt_stalled, pstripack_scvt_not_well_centred
  public :: pstripack_scvt_coincident, pstripack_bad_density, pstripack_hemisphere, pstripack_bad_lists, &
            pstripack_bad_option

  !> Results of pstripack_trmesh; in comm mode also -7. Any other is L > 0: nodes L and M > L coincide; M is the smallest
  !> such number.
  integer(c_int32_t), parameter :: pstripack_ok = 0, &
    pstripack_too_few_nodes = -1, &   !< fewer than 3 nodes
    pstripack_collinear = -2, &       !< the first three nodes lie on one great circle
    pstripack_too_many_nodes = -4, &  !< 6n-11 does not fit 32 bits
    pstripack_bad_coordinate = -5, &  !< a coordinate is not finite, or a vector is zero
    pstripack_out_of_memory = -6, &
    pstripack_bad_size = -100         !< arrays whose sizes do not fit; of the Fortran modules and of distributed meshes

  !> Further results of pstripack_scvt and pstripack_scvt_step.
  integer(c_int32_t), parameter :: &
    pstripack_scvt_coincident = -9, &  !< two generators in the same direction, or a cell is too small
    pstripack_bad_density = -11, &     !< the density is not positive and finite, varies too much, or a result overflows
    pstripack_hemisphere = -12, &      !< the generators lie in one hemisphere
    pstripack_bad_lists = -13, &       !< not the lists of a triangulation of the sphere by the generators
    pstripack_bad_option = -14         !< an option has a value that is not allowed

  !> Values of the components start and method of pstripack_scvt_options, and reason of pstripack_scvt_result.
  integer(c_int32_t), parameter :: &
    pstripack_scvt_by_number = 0, &    !< start: the front from 3000 generators on, else levels
    pstripack_scvt_random = 1, &       !< start: size(x) random generators
    pstripack_scvt_given = 2, &        !< start: the generators passed in
    pstripack_scvt_levels = 3, &       !< start: few random generators, refined level by level
    pstripack_scvt_front = 4, &        !< start: an advancing front, which is nearly centroidal already; uses no seed
    pstripack_scvt_newton = 0, &       !< method: quasi-Newton (L-BFGS)
    pstripack_scvt_lloyd = 1, &        !< method: each generator moves to the centroid of its cell
    pstripack_scvt_converged = 0, &    !< reason: the gradient is at most the tolerance
    pstripack_scvt_evaluations = 1, &  !< reason: most_evaluations were made
    pstripack_scvt_stopped = 2, &      !< reason: the progress procedure stopped the run
    pstripack_scvt_stalled = 3, &      !< reason: the energy falls no further: rounding, or a density with jumps
    pstripack_scvt_not_well_centred = 4 !< reason: with well_centred: triangles are left that do not hold their circumcentre

  !> Options of pstripack_scvt.
  type :: pstripack_scvt_options
    integer(c_int32_t) :: start = pstripack_scvt_by_number
    integer(c_int32_t) :: method = pstripack_scvt_newton
    real(c_double) :: tolerance = 1e-5_c_double        !< largest gradient of a converged run
    integer(c_int64_t) :: most_evaluations = 100000    !< on each level
    integer(c_int64_t) :: seed = 1                     !< of the random generators
    !> False: only the thread that called the library calls the density, and does the integrals alone. True: any
    !> number of the library's threads call it at once.
    logical :: density_on_threads = .false.
    logical :: widths = .false.  !< the density procedure returns widths of cells, in any unit
    !> In the end a few generators move, until all triangles hold their circumcentre strictly.
    logical :: well_centred = .false.
  end type

  type, bind(c) :: pstripack_scvt_result
    real(c_double) :: energy
    real(c_double) :: gradient        !< as in pstripack_scvt_progress
    real(c_double) :: evaluations     !< of all levels, each weighted by its share of the generators
    integer(c_int32_t) :: generators  !< size(x); fewer if the run was stopped before the last level
    integer(c_int32_t) :: reason      !< why the run ended: pstripack_scvt_converged, ...
  end type

  !> The progress of a run.
  type, bind(c) :: pstripack_scvt_progress
    integer(c_int64_t) :: generators   !< number of generators of the level
    integer(c_int64_t) :: evaluations  !< number of triangulations with integrals, on this level
    !> Root mean square over generators of the distance to the centroid of the cell, in units of
    !> sqrt(4 pi/generators).
    real(c_double) :: gradient
    real(c_double) :: energy
  end type

  abstract interface
    !> Sets values(i) to the density at the unit vector xyz(:, i), i = 1..n, n <= 65536. The density must be positive
    !> and finite, and depend on the place alone. Preferably a module procedure: an internal procedure can use the
    !> data of its host, but some compilers then need an executable stack.
    subroutine pstripack_density(n, xyz, values)
      import :: c_double, c_int32_t
      integer(c_int32_t), intent(in) :: n
      real(c_double), intent(in) :: xyz(3, n)
      real(c_double), intent(out) :: values(n)
    end subroutine

    !> Called after each step, by the thread that called the library. stop is .false. on entry; .true. ends the run.
    subroutine pstripack_progress(progress, stop)
      import :: pstripack_scvt_progress
      type(pstripack_scvt_progress), intent(in) :: progress
      logical, intent(inout) :: stop
    end subroutine
  end interface

  include "scvt_types.inc"

  !> call pstripack_trmesh(x, y, z, list, lptr, lend, lnew, ier)
  !>
  !> The Delaunay triangulation of n = size(x) nodes, as STRIPACK's lists in canonical form.
  !>   x, y, z     (n), in: real32 or real64; vectors from the centre of the sphere to the nodes, of any length
  !>   list, lptr  (at least 6n-12), out: neighbours, and the slot of the next neighbour
  !>   lend        (at least n), out: slot of each node's last neighbour
  !>   lnew        out: one past the last slot in use
  !>   ier         out: pstripack_ok, an error code above, or L > 0 (the lists are then those of nodes 1..M-1)
  !> If ier is negative nothing else is written.
  interface pstripack_trmesh
    module procedure trmesh_real32, trmesh_real64
  end interface

  abstract interface
    ! int32_t pstripack_trmesh(int32_t n, const double* x, const double* y, const double* z, int32_t* list,
    !                          int32_t* lptr, int32_t* lend, int32_t* lnew);
    function trmesh_in_c(n, x, y, z, list, lptr, lend, lnew) result(ier) bind(c)
      import :: c_double, c_int32_t
      integer(c_int32_t), value, intent(in) :: n
      real(c_double), intent(in) :: x(*), y(*), z(*)
      integer(c_int32_t), intent(inout) :: list(*), lptr(*), lend(*), lnew
      integer(c_int32_t) :: ier
    end function
  end interface
  procedure(trmesh_in_c), bind(c, name="pstripack_trmesh") :: c_trmesh
  procedure(trmesh_in_c), bind(c, name="pstripack_delaunay") :: c_delaunay

  interface
    ! int32_t pstripack_trmesh_r4(int32_t n, const float* x, const float* y, const float* z, int32_t* list,
    !                             int32_t* lptr, int32_t* lend, int32_t* lnew);
    function c_trmesh_r4(n, x, y, z, list, lptr, lend, lnew) result(ier) bind(c, name="pstripack_trmesh_r4")
      import :: c_float, c_int32_t
      integer(c_int32_t), value, intent(in) :: n
      real(c_float), intent(in) :: x(*), y(*), z(*)
      integer(c_int32_t), intent(inout) :: list(*), lptr(*), lend(*), lnew
      integer(c_int32_t) :: ier
    end function

    ! int32_t pstripack_validate(int32_t n, const double* x, const double* y, const double* z,
    !                            const int32_t* list, const int32_t* lptr, const int32_t* lend, int32_t lnew,
    !                            char* message, int32_t length);
    function c_validate(n, x, y, z, list, lptr, lend, lnew, message, length) result(defect) &
        bind(c, name="pstripack_validate")
      import :: c_char, c_double, c_int32_t
      integer(c_int32_t), value, intent(in) :: n, lnew, length
      real(c_double), intent(in) :: x(*), y(*), z(*)
      integer(c_int32_t), intent(in) :: list(*), lptr(*), lend(*)
      character(kind=c_char), intent(inout) :: message(*)
      integer(c_int32_t) :: defect
    end function

    ! uint64_t pstripack_fingerprint(int32_t n, const int32_t* list, const int32_t* lptr, const int32_t* lend);
    function c_fingerprint(n, list, lptr, lend) result(bits) bind(c, name="pstripack_fingerprint")
      import :: c_int32_t, c_int64_t
      integer(c_int32_t), value, intent(in) :: n
      integer(c_int32_t), intent(in) :: list(*), lptr(*), lend(*)
      integer(c_int64_t) :: bits
    end function

    ! int32_t pstripack_scvt(int32_t n, double* x, double* y, double* z, const pstripack_density* density,
    !                        const pstripack_scvt_options* options, pstripack_scvt_result* result,
    !                        char* message, int32_t length);
    function c_scvt(n, x, y, z, density, options, result, message, length) result(ier) bind(c, name="pstripack_scvt")
      import :: c_char, c_density, c_double, c_int32_t, c_options, pstripack_scvt_result
      integer(c_int32_t), value, intent(in) :: n, length
      real(c_double), intent(inout) :: x(*), y(*), z(*)
      type(c_density), intent(in) :: density
      type(c_options), intent(in) :: options
      type(pstripack_scvt_result), intent(inout) :: result
      character(kind=c_char), intent(inout) :: message(*)
      integer(c_int32_t) :: ier
    end function

    ! int32_t pstripack_scvt_cells(const pstripack_density* width, double radius, double* cells, char* message,
    !                              int32_t length);
    function c_scvt_cells(width, radius, cells, message, length) result(ier) bind(c, name="pstripack_scvt_cells")
      import :: c_char, c_density, c_double, c_int32_t
      type(c_density), intent(in) :: width
      real(c_double), value, intent(in) :: radius
      real(c_double), intent(inout) :: cells
      character(kind=c_char), intent(inout) :: message(*)
      integer(c_int32_t), value, intent(in) :: length
      integer(c_int32_t) :: ier
    end function

    ! int32_t pstripack_scvt_step(int32_t n, const double* x, const double* y, const double* z,
    !                             const int32_t* list, const int32_t* lptr, const int32_t* lend,
    !                             const pstripack_density* density, double* xc, double* yc, double* zc,
    !                             double* mass, double* energy, char* message, int32_t length);
    function c_scvt_step(n, x, y, z, list, lptr, lend, density, xc, yc, zc, mass, energy, message, length) &
        result(ier) bind(c, name="pstripack_scvt_step")
      import :: c_char, c_density, c_double, c_int32_t
      integer(c_int32_t), value, intent(in) :: n, length
      real(c_double), intent(in) :: x(*), y(*), z(*)
      integer(c_int32_t), intent(in) :: list(*), lptr(*), lend(*)
      type(c_density), intent(in) :: density
      real(c_double), intent(inout) :: xc(*), yc(*), zc(*), mass(*), energy
      character(kind=c_char), intent(inout) :: message(*)
      integer(c_int32_t) :: ier
    end function

    !> Frees the memory that the library keeps in this process for the next call; PSTRIPACK_KEEP bounds it. Meshes and
    !> communicators that the program holds stay.
    subroutine pstripack_release_memory() bind(c)
    end subroutine

    ! const char* pstripack_version(void);
    pure function c_version() result(text) bind(c, name="pstripack_version")
      import :: c_ptr
      type(c_ptr) :: text
    end function

    ! const char* pstripack_strerror(int ier);
    pure function c_strerror(ier) result(text) bind(c, name="pstripack_strerror")
      import :: c_int32_t, c_ptr
      integer(c_int32_t), value, intent(in) :: ier
      type(c_ptr) :: text
    end function

    ! size_t strlen(const char*);
    pure function c_strlen(text) result(length) bind(c, name="strlen")
      import :: c_ptr, c_size_t
      type(c_ptr), value, intent(in) :: text
      integer(c_size_t) :: length
    end function
  end interface

contains

  !> The version "major.minor.patch" of the library that is loaded.
  recursive function pstripack_version() result(text)
    character(len=length_of_version()) :: text  ! gfortran keeps a deferred length where all threads share it
    call copy_text(c_version(), text)
  end function

  !> One line for an error code.
  recursive function pstripack_strerror(ier) result(text)
    integer(c_int32_t), intent(in) :: ier
    character(len=length_of_strerror(ier)) :: text
    call copy_text(c_strerror(ier), text)
  end function

  !> 0 if the lists are a correct triangulation of the n = size(x) nodes, by exact signs; else the number (> 0) of the
  !> violated property, or an error code (< 0).
  !>   list, lptr, lend  (at least 6n-12, 6n-12, n), in: the lists
  !>   lnew              in: as from TRMESH, or 0 if not known
  !>   message           out: the defect and the nodes; blank if there is none
  recursive function pstripack_validate(x, y, z, list, lptr, lend, lnew, message) result(defect)
    real(c_double), intent(in), contiguous :: x(:), y(:), z(:)
    integer(c_int32_t), intent(in), contiguous :: list(:), lptr(:), lend(:)
    integer(c_int32_t), intent(in) :: lnew
    character(len=*), intent(out), optional :: message
    integer(c_int32_t) :: defect
    character(kind=c_char) :: line(400)
    line = c_null_char
    if (sizes_fit(x, y, z, list, lptr, lend)) then
      defect = c_validate(count_of(x), x, y, z, list, lptr, lend, lnew, line, size(line, kind=c_int32_t))
    else
      defect = pstripack_bad_size
    end if
    call tell(line, message)
  end function

  !> A hash of 64 bits that depends on the set of triangles alone; 0 if the lists are not well formed. The number n of
  !> nodes is size(lend); 0 if list or lptr has less than 6n-12 entries.
  recursive function pstripack_fingerprint(list, lptr, lend) result(bits)
    integer(c_int32_t), intent(in), contiguous :: list(:), lptr(:), lend(:)
    integer(c_int64_t) :: bits
    bits = 0
    if (sizes_fit(lend, lend, lend, list, lptr, lend)) bits = c_fingerprint(count_of(lend), list, lptr, lend)
  end function

  !> A centroidal Voronoi tessellation: finds n = size(x) generators for the density.
  !>   x, y, z   (n), out: the generators, unit vectors; in, only with options%start = pstripack_scvt_given: the
  !>             generators to start from, vectors of any length
  !>   result    out: energy, gradient, evaluations, and why the run ended
  !>   ier       out: pstripack_ok, whatever the reason to end, or a negative code above
  !>   density   default: 1 everywhere
  !>   options   default: the values in the declaration of pstripack_scvt_options
  !>   progress  default: none
  !>   message   out: on an error, what is wrong, where, and what to do
  !> On an error nothing else is written. The result has the same bits for any number of threads.
  recursive subroutine pstripack_scvt(x, y, z, result, ier, density, options, progress, message)
    real(c_double), intent(inout), contiguous :: x(:), y(:), z(:)
    type(pstripack_scvt_result), intent(inout) :: result
    integer(c_int32_t), intent(out) :: ier
    procedure(pstripack_density), optional :: density
    type(pstripack_scvt_options), intent(in), optional :: options
    procedure(pstripack_progress), optional :: progress
    character(len=*), intent(out), optional :: message
    type(callbacks), target :: caller
    type(c_density) :: rho
    type(c_options) :: options_c

    call pass_on(caller, rho, options_c, density, options, progress)
    call run_scvt(x, y, z, rho, options_c, result, ier, message)
  end subroutine

  !> The same for widths of cells in place of a density.
  !>   width         widths of cells, in any unit, since n is size(x); pstripack_scvt_cells tells a good n
  !>   well_centred  as the component of pstripack_scvt_options
  recursive subroutine pstripack_scvt_widths(x, y, z, result, ier, width, options, progress, well_centred, message)
    real(c_double), intent(inout), contiguous :: x(:), y(:), z(:)
    type(pstripack_scvt_result), intent(inout) :: result
    integer(c_int32_t), intent(out) :: ier
    procedure(pstripack_density) :: width
    type(pstripack_scvt_options), intent(in), optional :: options
    procedure(pstripack_progress), optional :: progress
    logical, intent(in), optional :: well_centred
    character(len=*), intent(out), optional :: message
    type(callbacks), target :: caller
    type(c_density) :: rho
    type(c_options) :: options_c

    call pass_on(caller, rho, options_c, width, options, progress)
    options_c%widths = 1
    if (present(well_centred)) options_c%well_centred = merge(1_c_int32_t, 0_c_int32_t, well_centred)
    call run_scvt(x, y, z, rho, options_c, result, ier, message)
  end subroutine

  !> Calls the engine. The options say whether rho is a density or widths.
  recursive subroutine run_scvt(x, y, z, rho, options, result, ier, message)
    real(c_double), intent(inout), contiguous :: x(:), y(:), z(:)
    type(c_density), intent(in) :: rho
    type(c_options), intent(in) :: options
    type(pstripack_scvt_result), intent(inout) :: result
    integer(c_int32_t), intent(out) :: ier
    character(len=*), intent(out), optional :: message
    character(kind=c_char) :: line(400)

    line = c_null_char
    ier = pstripack_bad_size
    if (all([size(y, kind=c_int64_t), size(z, kind=c_int64_t)] == size(x, kind=c_int64_t))) &
      ier = c_scvt(count_of(x), x, y, z, rho, options, result, line, size(line, kind=c_int32_t))
    call tell(line, message)
    if (present(message) .and. ier == pstripack_bad_size) message = pstripack_strerror(ier)
  end subroutine

  !> How many cells have these widths on a sphere of this radius, in the unit of the widths.
  !>   width    widths of cells
  !>   cells    out: the integral of 1/(sqrt(3)/2 width**2), to about 1e-5 of itself; 1e-4 where widths jump
  !>   ier      out: pstripack_ok or a negative code above
  !>   message  as of pstripack_scvt
  recursive subroutine pstripack_scvt_cells(width, radius, cells, ier, message)
    procedure(pstripack_density) :: width
    real(c_double), intent(in) :: radius
    real(c_double), intent(inout) :: cells
    integer(c_int32_t), intent(out) :: ier
    character(len=*), intent(out), optional :: message
    type(callbacks), target :: caller
    type(c_density) :: rho
    character(kind=c_char) :: line(400)

    line = c_null_char
    caller%density => width
    rho = c_density(c_funloc(call_density), c_loc(caller), 0_c_int32_t)
    ier = c_scvt_cells(rho, radius, cells, line, size(line, kind=c_int32_t))
    call tell(line, message)
  end subroutine

  !> One step, for programs with a loop of their own: integrals over the cells of n = size(x) generators.
  !>   x, y, z             (n), in: generators, vectors of any length
  !>   list, lptr, lend    (at least 6n-12, 6n-12, n), in: their triangulation, from TRMESH
  !>   xc, yc, zc          (n), out: centroids of the cells, unit vectors, to which Lloyd's method moves the generators
  !>   mass                (n), out: integral of the density over each cell
  !>   energy              out: the energy of all cells
  !>   ier                 out: pstripack_ok or a negative code above
  !>   density             default: 1 everywhere
  !>   density_on_threads  as the component of pstripack_scvt_options
  !>   message             as of pstripack_scvt
  !> On an error nothing else is written. The result has the same bits for any number of threads.
  recursive subroutine pstripack_scvt_step(x, y, z, list, lptr, lend, xc, yc, zc, mass, energy, ier, density, &
                                 density_on_threads, message)
    real(c_double), intent(in), contiguous :: x(:), y(:), z(:)
    integer(c_int32_t), intent(in), contiguous :: list(:), lptr(:), lend(:)
    real(c_double), intent(inout), contiguous :: xc(:), yc(:), zc(:), mass(:)
    real(c_double), intent(inout) :: energy
    integer(c_int32_t), intent(out) :: ier
    procedure(pstripack_density), optional :: density
    logical, intent(in), optional :: density_on_threads
    character(len=*), intent(out), optional :: message
    type(callbacks), target :: caller
    type(c_density) :: rho
    character(kind=c_char) :: line(400)
    logical :: fit

    line = c_null_char
    if (present(density)) then
      caller%density => density
      rho%at = c_funloc(call_density)
      rho%user = c_loc(caller)
      if (present(density_on_threads)) rho%any_thread = merge(1_c_int32_t, 0_c_int32_t, density_on_threads)
    end if
    ier = pstripack_bad_size
    fit = sizes_fit(x, y, z, list, lptr, lend)
    fit = fit .and. all([size(xc, kind=c_int64_t), size(yc, kind=c_int64_t), size(zc, kind=c_int64_t), &
                         size(mass, kind=c_int64_t)] == size(x, kind=c_int64_t))
    if (fit) &
      ier = c_scvt_step(count_of(x), x, y, z, list, lptr, lend, rho, xc, yc, zc, mass, energy, line, &
                        size(line, kind=c_int32_t))
    call tell(line, message)
    if (present(message) .and. ier == pstripack_bad_size) message = pstripack_strerror(ier)
  end subroutine

  include "scvt_procedures.inc"

  recursive subroutine trmesh_real64(x, y, z, list, lptr, lend, lnew, ier)
    real(c_double), intent(in), contiguous :: x(:), y(:), z(:)
    integer(c_int32_t), intent(inout), contiguous :: list(:), lptr(:), lend(:)
    integer(c_int32_t), intent(inout) :: lnew
    integer(c_int32_t), intent(out) :: ier
    ier = pstripack_bad_size
    if (sizes_fit(x, y, z, list, lptr, lend)) &
      ier = c_trmesh(count_of(x), x, y, z, list, lptr, lend, lnew)
  end subroutine

  !> The Delaunay triangulation of the directions of the nodes: arguments as of pstripack_trmesh, which takes
  !> coordinates as given where all lengths are 1 up to 1e-6. The two differ only where nodes are so close, or so nearly
  !> on one circle, that the rounding of lengths matters. Never collective.
  recursive subroutine pstripack_delaunay(x, y, z, list, lptr, lend, lnew, ier)
    real(c_double), intent(in), contiguous :: x(:), y(:), z(:)
    integer(c_int32_t), intent(inout), contiguous :: list(:), lptr(:), lend(:)
    integer(c_int32_t), intent(inout) :: lnew
    integer(c_int32_t), intent(out) :: ier
    ier = pstripack_bad_size
    if (sizes_fit(x, y, z, list, lptr, lend)) &
      ier = c_delaunay(count_of(x), x, y, z, list, lptr, lend, lnew)
  end subroutine

  recursive subroutine trmesh_real32(x, y, z, list, lptr, lend, lnew, ier)
    real(c_float), intent(in), contiguous :: x(:), y(:), z(:)
    integer(c_int32_t), intent(inout), contiguous :: list(:), lptr(:), lend(:)
    integer(c_int32_t), intent(inout) :: lnew
    integer(c_int32_t), intent(out) :: ier
    ier = pstripack_bad_size
    if (sizes_fit(x, y, z, list, lptr, lend)) &
      ier = c_trmesh_r4(count_of(x), x, y, z, list, lptr, lend, lnew)
  end subroutine

  recursive logical function sizes_fit(x, y, z, list, lptr, lend)
    type(*), intent(in) :: x(:), y(:), z(:), list(:), lptr(:), lend(:)
    integer(c_int64_t) :: n
    n = size(x, kind=c_int64_t)
    sizes_fit = size(y, kind=c_int64_t) == n .and. size(z, kind=c_int64_t) == n .and. &
                size(lend, kind=c_int64_t) >= n .and. &
                min(size(list, kind=c_int64_t), size(lptr, kind=c_int64_t)) >= 6*n - 12
  end function

  !> The number of nodes for the C API, where the largest integer is as good as any count above: too many.
  recursive integer(c_int32_t) function count_of(x)
    type(*), intent(in) :: x(:)
    count_of = int(min(size(x, kind=c_int64_t), int(huge(count_of), c_int64_t)), c_int32_t)
  end function

  pure integer function length_of_version()
    length_of_version = int(c_strlen(c_version()))
  end function

  pure integer function length_of_strerror(ier)
    integer(c_int32_t), intent(in) :: ier
    length_of_strerror = int(c_strlen(c_strerror(ier)))
  end function

  recursive subroutine copy_text(from, text)
    type(c_ptr), intent(in) :: from
    character(len=*), intent(out) :: text
    character(kind=c_char), pointer :: bytes(:)
    integer :: i
    call c_f_pointer(from, bytes, [len(text)])
    do i = 1, len(text)
      text(i:i) = bytes(i)
    end do
  end subroutine

end module
