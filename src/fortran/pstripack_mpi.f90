!> PSTRIPACK over MPI for Fortran: the C API of libpstripack_mpi. pstripack_mpi.h has more details.
!>
!> comm mode:    call pstripack_set_comm(comm) makes every TRMESH of the program collective over comm.
!> distributed:  a type(pstripack_mesh): each rank brings its own points and gets their stars.
!>
!> "Collective": every rank of the communicator must call it, in the same order. Communicators may be integers
!> (mpif.h, module mpi) or of type(MPI_Comm) (module mpi_f08).
module pstripack_mpi
  use, intrinsic :: iso_c_binding, only: c_associated, c_char, c_double, c_f_pointer, c_funloc, c_funptr, c_int, &
    c_int32_t, c_int64_t, c_loc, c_null_char, c_null_funptr, c_null_ptr, c_ptr, c_sizeof
  use mpi_f08, only: MPI_Comm
  use pstripack, only: pstripack_density, pstripack_progress, pstripack_scvt_options, pstripack_scvt_progress, &
    pstripack_scvt_result
  implicit none
  private
  public :: pstripack_set_comm, pstripack_mesh
  public :: pstripack_ranks_disagree, pstripack_bad_comm, pstripack_coincident, pstripack_bad_number, &
            pstripack_empty_mesh, pstripack_every_rank

  !> Results in addition to those of module pstripack.
  integer(c_int32_t), parameter :: &
    pstripack_empty_mesh = -3, &      !< the mesh has no triangulation or was not created; no exchange is under way
    pstripack_ranks_disagree = -7, &  !< ranks disagree in N, data, PSTRIPACK_ORDER, root, width, or the call
    pstripack_bad_comm = -8, &        !< null, freed, an inter-communicator; no such rank; MPI must not be called here
    pstripack_coincident = -9, &      !< two points in the same direction
    pstripack_bad_number = -10        !< a global number is below 1, occurs twice, or is not one of 1..N

  integer(c_int32_t), parameter :: pstripack_every_rank = -1

  !> call pstripack_set_comm(comm [, ier])
  !>
  !> Starts comm mode. Collective over comm. From then on TRMESH, in all its forms, is collective over a duplicate of
  !> comm, with the same arguments on every rank. MPI_COMM_NULL ends comm mode. ier: 0, -6, pstripack_ranks_disagree or
  !> pstripack_bad_comm; errors also print a line on stderr.
  interface pstripack_set_comm
    module procedure set_comm_integer, set_comm_f08
  end interface

  !> A distributed mesh. It cannot be copied by assignment. The end of its scope frees it.
  !> Collective are create, triangulate, gather, exchange, exchange_begin, check, scvt, free, and the end of its scope.
  type :: pstripack_mesh
    private
    type(c_ptr) :: handle = c_null_ptr
  contains
    !> create(comm, ier): makes an empty mesh over a duplicate of comm. ier: 0, -6 or pstripack_bad_comm.
    generic, public :: create => create_integer, create_f08
    procedure, private :: create_integer, create_f08
    procedure, public :: triangulate
    procedure, public :: error_points
    procedure, public :: home
    procedure, public :: sizes
    procedure, public :: stars
    procedure, public :: triangles
    procedure, public :: halo
    procedure, public :: halo_owners
    procedure, public :: local_stars
    procedure, public :: gather
    generic, public :: exchange => exchange_real_1, exchange_real_2, exchange_integer_1, exchange_integer_2
    generic, public :: exchange_begin => exchange_begin_real_1, exchange_begin_real_2, exchange_begin_integer_1, &
      exchange_begin_integer_2
    generic, public :: exchange_end => exchange_end_real_1, exchange_end_real_2, exchange_end_integer_1, &
      exchange_end_integer_2
    procedure, private :: exchange_real_1, exchange_real_2, exchange_integer_1, exchange_integer_2
    procedure, private :: exchange_begin_real_1, exchange_begin_real_2, exchange_begin_integer_1, exchange_begin_integer_2
    procedure, private :: exchange_end_real_1, exchange_end_real_2, exchange_end_integer_1, exchange_end_integer_2
    procedure, public :: check
    procedure, public :: scvt
    procedure, public :: free => free_mesh
    generic, public :: assignment(=) => do_not_copy
    procedure, private :: do_not_copy
    final :: finalise
  end type

  include "scvt_types.inc"

  interface
    ! int32_t pstripack_set_comm_f(MPI_Fint comm);
    function c_set_comm(comm) result(ier) bind(c, name="pstripack_set_comm_f")
      import :: c_int, c_int32_t
      integer(c_int), value, intent(in) :: comm
      integer(c_int32_t) :: ier
    end function

    ! int32_t pstripack_mesh_create_f(MPI_Fint comm, pstripack_mesh** mesh);
    function c_create(comm, mesh) result(ier) bind(c, name="pstripack_mesh_create_f")
      import :: c_int, c_int32_t, c_ptr
      integer(c_int), value, intent(in) :: comm
      type(c_ptr), intent(out) :: mesh
      integer(c_int32_t) :: ier
    end function

    ! void pstripack_mesh_free(pstripack_mesh* mesh);
    subroutine c_free(mesh) bind(c, name="pstripack_mesh_free")
      import :: c_ptr
      type(c_ptr), value, intent(in) :: mesh
    end subroutine

    ! int32_t pstripack_mesh_triangulate(pstripack_mesh* mesh, int64_t n, const double* xyz,
    !                                    const int64_t* number);
    function c_triangulate(mesh, n, xyz, number) result(ier) bind(c, name="pstripack_mesh_triangulate")
      import :: c_double, c_int32_t, c_int64_t, c_ptr
      type(c_ptr), value, intent(in) :: mesh
      integer(c_int64_t), value, intent(in) :: n
      real(c_double), intent(in) :: xyz(*)
      integer(c_int64_t), intent(in) :: number(*)
      integer(c_int32_t) :: ier
    end function

    ! void pstripack_mesh_error_points(const pstripack_mesh* mesh, int64_t* first, int64_t* second);
    subroutine c_error_points(mesh, first, second) bind(c, name="pstripack_mesh_error_points")
      import :: c_int64_t, c_ptr
      type(c_ptr), value, intent(in) :: mesh
      integer(c_int64_t), intent(out) :: first, second
    end subroutine

    ! void pstripack_mesh_sizes(const pstripack_mesh* mesh, int64_t* points, int64_t* arcs, int64_t* triangles,
    !                           int64_t* halo);
    subroutine c_sizes(mesh, points, arcs, triangles, halo) bind(c, name="pstripack_mesh_sizes")
      import :: c_int64_t, c_ptr
      type(c_ptr), value, intent(in) :: mesh
      integer(c_int64_t), intent(out) :: points, arcs, triangles, halo
    end subroutine

    ! void pstripack_mesh_stars(const pstripack_mesh* mesh, int64_t* begin, int64_t* neighbour);
    subroutine c_stars(mesh, begin, neighbour) bind(c, name="pstripack_mesh_stars")
      import :: c_int64_t, c_ptr
      type(c_ptr), value, intent(in) :: mesh
      integer(c_int64_t), intent(inout) :: begin(*), neighbour(*)
    end subroutine

    ! void pstripack_mesh_triangles(const pstripack_mesh* mesh, int64_t* corner);
    subroutine c_triangles(mesh, corner) bind(c, name="pstripack_mesh_triangles")
      import :: c_int64_t, c_ptr
      type(c_ptr), value, intent(in) :: mesh
      integer(c_int64_t), intent(inout) :: corner(*)
    end subroutine

    ! void pstripack_mesh_halo(const pstripack_mesh* mesh, int64_t* number, double* xyz);
    subroutine c_halo(mesh, number, xyz) bind(c, name="pstripack_mesh_halo")
      import :: c_double, c_int64_t, c_ptr
      type(c_ptr), value, intent(in) :: mesh
      integer(c_int64_t), intent(inout) :: number(*)
      real(c_double), intent(inout) :: xyz(*)
    end subroutine

    ! void pstripack_mesh_halo_owners(const pstripack_mesh* mesh, int32_t* rank, int32_t* local);
    subroutine c_halo_owners(mesh, rank, local) bind(c, name="pstripack_mesh_halo_owners")
      import :: c_int32_t, c_ptr
      type(c_ptr), value, intent(in) :: mesh
      integer(c_int32_t), intent(inout) :: rank(*), local(*)
    end subroutine

    ! int32_t pstripack_mesh_home(const pstripack_mesh* mesh, int64_t n, const double* xyz, int32_t* rank);
    function c_home(mesh, n, xyz, rank) result(ier) bind(c, name="pstripack_mesh_home")
      import :: c_double, c_int32_t, c_int64_t, c_ptr
      type(c_ptr), value, intent(in) :: mesh
      integer(c_int64_t), value, intent(in) :: n
      real(c_double), intent(in) :: xyz(*)
      integer(c_int32_t), intent(inout) :: rank(*)
      integer(c_int32_t) :: ier
    end function

    ! int32_t pstripack_mesh_local_stars(const pstripack_mesh* mesh, int64_t* begin, int32_t* neighbour);
    function c_local_stars(mesh, begin, neighbour) result(ier) bind(c, name="pstripack_mesh_local_stars")
      import :: c_int32_t, c_int64_t, c_ptr
      type(c_ptr), value, intent(in) :: mesh
      integer(c_int64_t), intent(inout) :: begin(*)
      integer(c_int32_t), intent(inout) :: neighbour(*)
      integer(c_int32_t) :: ier
    end function

    ! int32_t pstripack_mesh_gather(pstripack_mesh* mesh, int32_t root, int32_t* list, int32_t* lptr,
    !                               int32_t* lend, int32_t* lnew);
    function c_gather(mesh, root, list, lptr, lend, lnew) result(ier) bind(c, name="pstripack_mesh_gather")
      import :: c_int32_t, c_ptr
      type(c_ptr), value, intent(in) :: mesh
      integer(c_int32_t), value, intent(in) :: root
      integer(c_int32_t), intent(inout) :: list(*), lptr(*), lend(*), lnew
      integer(c_int32_t) :: ier
    end function

    ! int32_t pstripack_mesh_exchange(pstripack_mesh* mesh, const void* values, int64_t width, void* halo_values);
    function c_exchange(mesh, values, width, halo_values) result(ier) bind(c, name="pstripack_mesh_exchange")
      import :: c_int32_t, c_int64_t, c_ptr
      type(c_ptr), value, intent(in) :: mesh
      type(*), intent(in) :: values(*)
      integer(c_int64_t), value, intent(in) :: width
      type(*), intent(inout) :: halo_values(*)
      integer(c_int32_t) :: ier
    end function

    ! int32_t pstripack_mesh_exchange_begin(pstripack_mesh* mesh, const void* values, int64_t width);
    function c_exchange_begin(mesh, values, width) result(ier) bind(c, name="pstripack_mesh_exchange_begin")
      import :: c_int32_t, c_int64_t, c_ptr
      type(c_ptr), value, intent(in) :: mesh
      type(*), intent(in) :: values(*)
      integer(c_int64_t), value, intent(in) :: width
      integer(c_int32_t) :: ier
    end function

    ! int32_t pstripack_mesh_exchange_end(pstripack_mesh* mesh, int64_t width, void* halo_values);
    function c_exchange_end(mesh, width, halo_values) result(ier) bind(c, name="pstripack_mesh_exchange_end")
      import :: c_int32_t, c_int64_t, c_ptr
      type(c_ptr), value, intent(in) :: mesh
      integer(c_int64_t), value, intent(in) :: width
      type(*), intent(inout) :: halo_values(*)
      integer(c_int32_t) :: ier
    end function

    ! int32_t pstripack_mesh_check(pstripack_mesh* mesh, uint64_t* fingerprint);
    function c_check(mesh, fingerprint) result(ier) bind(c, name="pstripack_mesh_check")
      import :: c_int32_t, c_int64_t, c_ptr
      type(c_ptr), value, intent(in) :: mesh
      integer(c_int64_t), intent(inout) :: fingerprint
      integer(c_int32_t) :: ier
    end function

    ! int32_t pstripack_mesh_scvt(pstripack_mesh* mesh, int64_t n, double* xyz, const int64_t* number,
    !                             const pstripack_density* density, const pstripack_scvt_options* options,
    !                             pstripack_scvt_result* result, char* message, int32_t length);
    function c_scvt(mesh, n, xyz, number, density, options, result, message, length) result(ier) &
        bind(c, name="pstripack_mesh_scvt")
      import :: c_char, c_density, c_double, c_int32_t, c_int64_t, c_options, c_ptr, pstripack_scvt_result
      type(c_ptr), value, intent(in) :: mesh
      integer(c_int64_t), value, intent(in) :: n
      real(c_double), intent(inout) :: xyz(*)
      integer(c_int64_t), intent(in) :: number(*)
      type(c_density), intent(in) :: density
      type(c_options), intent(in) :: options
      type(pstripack_scvt_result), intent(inout) :: result
      character(kind=c_char), intent(inout) :: message(*)
      integer(c_int32_t), value, intent(in) :: length
      integer(c_int32_t) :: ier
    end function
  end interface

contains

  recursive subroutine set_comm_integer(comm, ier)
    integer, intent(in) :: comm
    integer(c_int32_t), intent(out), optional :: ier
    integer(c_int32_t) :: code
    code = c_set_comm(comm)
    if (present(ier)) ier = code
  end subroutine

  recursive subroutine set_comm_f08(comm, ier)
    type(MPI_Comm), intent(in) :: comm
    integer(c_int32_t), intent(out), optional :: ier
    call set_comm_integer(comm%MPI_VAL, ier)
  end subroutine

  recursive subroutine create_integer(mesh, comm, ier)
    class(pstripack_mesh), intent(inout) :: mesh
    integer, intent(in) :: comm
    integer(c_int32_t), intent(out) :: ier
    call mesh%free()
    ier = c_create(comm, mesh%handle)
  end subroutine

  recursive subroutine create_f08(mesh, comm, ier)
    class(pstripack_mesh), intent(inout) :: mesh
    type(MPI_Comm), intent(in) :: comm
    integer(c_int32_t), intent(out) :: ier
    call mesh%create_integer(comm%MPI_VAL, ier)
  end subroutine

  !> Triangulates the points of all ranks together. Collective.
  !>   xyz     (3, n), in: vectors from the centre of the sphere to the points of this rank
  !>   number  (n), in: their global numbers, at least 1, each once over all ranks, in any order
  !>   ier     out: 0, -1 (fewer than three points in all), -2 (all on one great circle), -4 (too many), -5 (not
  !>           finite, or zero), -6 (out of memory), pstripack_coincident, pstripack_bad_number, pstripack_bad_comm (MPI
  !>           must not be called here), pstripack_empty_mesh (not created), or pstripack_bad_size of module pstripack
  !>           (xyz is not (3, n); xyz(n, 3) with n = 3 cannot be recognised)
  !> After an error the mesh is empty.
  recursive subroutine triangulate(mesh, xyz, number, ier)
    class(pstripack_mesh), intent(inout) :: mesh
    real(c_double), intent(in), contiguous :: xyz(:, :)
    integer(c_int64_t), intent(in), contiguous :: number(:)
    integer(c_int32_t), intent(out) :: ier
    ier = pstripack_empty_mesh
    if (c_associated(mesh%handle)) &
      ier = c_triangulate(mesh%handle, count_or_shape(xyz, size(number, kind=c_int64_t)), xyz, number)
  end subroutine

  !> After ier = -5, -9, -10, -13: the global numbers of the points that the error is about; 0 for none. Not collective.
  recursive subroutine error_points(mesh, first, second)
    class(pstripack_mesh), intent(in) :: mesh
    integer(c_int64_t), intent(out) :: first, second
    first = 0
    second = 0
    if (c_associated(mesh%handle)) call c_error_points(mesh%handle, first, second)
  end subroutine

  !> The numbers, on this rank, of own points, entries of all stars, triangles whose smallest corner is an own point,
  !> and points of other ranks that are neighbours of own points. Not collective.
  recursive subroutine sizes(mesh, points, arcs, triangles, halo)
    class(pstripack_mesh), intent(in) :: mesh
    integer(c_int64_t), intent(out) :: points, arcs, triangles, halo
    points = 0
    arcs = 0
    triangles = 0
    halo = 0
    if (c_associated(mesh%handle)) call c_sizes(mesh%handle, points, arcs, triangles, halo)
  end subroutine

  !> The stars in global numbers: the neighbours of own point i are neighbour(begin(i) : begin(i+1)-1),
  !> counterclockwise, as in LIST. begin(points+1), neighbour(arcs). Not collective. Stops the program if an array is
  !> too short or the mesh was not created.
  recursive subroutine stars(mesh, begin, neighbour)
    class(pstripack_mesh), intent(in) :: mesh
    integer(c_int64_t), intent(inout), contiguous :: begin(:), neighbour(:)
    integer(c_int64_t) :: points
    points = points_if_room(mesh, size(begin, kind=c_int64_t), size(neighbour, kind=c_int64_t))
    call c_stars(mesh%handle, begin, neighbour)
    begin(:points + 1) = begin(:points + 1) + 1
  end subroutine

  !> Sets rank(i) to the rank (from 0) that should own the point xyz(:, i), so that each rank's points lie close
  !> together and all ranks have about the same number. Points that have been moved to these ranks keep them in later
  !> calls, until a rank has an eighth more points than when the patches were cut. ier: 0, pstripack_empty_mesh, -5 or
  !> pstripack_bad_size. Not collective.
  recursive subroutine home(mesh, xyz, rank, ier)
    class(pstripack_mesh), intent(in) :: mesh
    real(c_double), intent(in), contiguous :: xyz(:, :)
    integer(c_int32_t), intent(inout), contiguous :: rank(:)
    integer(c_int32_t), intent(out) :: ier
    integer(c_int64_t) :: n
    n = min(size(xyz, 2, kind=c_int64_t), size(rank, kind=c_int64_t))
    ier = pstripack_empty_mesh
    if (c_associated(mesh%handle)) ier = c_home(mesh%handle, count_or_shape(xyz, n), xyz, rank)
  end subroutine

  !> The stars in local numbers: own points 1..points, then the points of the halo. Else as `stars`. ier: 0.
  recursive subroutine local_stars(mesh, begin, neighbour, ier)
    class(pstripack_mesh), intent(in) :: mesh
    integer(c_int64_t), intent(inout), contiguous :: begin(:)
    integer(c_int32_t), intent(inout), contiguous :: neighbour(:)
    integer(c_int32_t), intent(out) :: ier
    integer(c_int64_t) :: points
    points = points_if_room(mesh, size(begin, kind=c_int64_t), size(neighbour, kind=c_int64_t))
    ier = c_local_stars(mesh%handle, begin, neighbour)
    if (ier == 0) begin(:points + 1) = begin(:points + 1) + 1
  end subroutine

  !> The triangles whose smallest corner is a point of this rank: corner(3, triangles), global numbers,
  !> counterclockwise, the smallest first. Not collective. Stops the program if the array is too short.
  recursive subroutine triangles(mesh, corner)
    class(pstripack_mesh), intent(in) :: mesh
    integer(c_int64_t), intent(inout), contiguous :: corner(:, :)
    integer(c_int64_t) :: points, arcs, count, halo
    call mesh%sizes(points, arcs, count, halo)
    if (size(corner, kind=c_int64_t) < 3*count) error stop "pstripack_mesh: triangles: the array is too short"
    if (c_associated(mesh%handle)) call c_triangles(mesh%handle, corner)
  end subroutine

  !> The halo: points of other ranks that are neighbours of own points, by increasing number: number(halo),
  !> xyz(3, halo). Not collective. Stops the program if an array is too short.
  recursive subroutine halo(mesh, number, xyz)
    class(pstripack_mesh), intent(in) :: mesh
    integer(c_int64_t), intent(inout), contiguous :: number(:)
    real(c_double), intent(inout), contiguous :: xyz(:, :)
    integer(c_int64_t) :: points, arcs, triangles, count
    call mesh%sizes(points, arcs, triangles, count)
    if (size(number, kind=c_int64_t) < count .or. size(xyz, kind=c_int64_t) < 3*count) &
      error stop "pstripack_mesh: halo: an array is too short"
    if (c_associated(mesh%handle)) call c_halo(mesh%handle, number, xyz)
  end subroutine

  !> Who has each halo point, in the order of `halo`: rank(halo), from 0, has it as its own point local(halo), from 1,
  !> as passed in there. So ranks exchange values of their points without a search. Not collective. Stops the program
  !> if an array is too short.
  recursive subroutine halo_owners(mesh, rank, local)
    class(pstripack_mesh), intent(in) :: mesh
    integer(c_int32_t), intent(inout), contiguous :: rank(:), local(:)
    integer(c_int64_t) :: points, arcs, triangles, count
    call mesh%sizes(points, arcs, triangles, count)
    if (size(rank, kind=c_int64_t) < count .or. size(local, kind=c_int64_t) < count) &
      error stop "pstripack_mesh: halo_owners: an array is too short"
    if (c_associated(mesh%handle)) call c_halo_owners(mesh%handle, rank, local)
  end subroutine

  !> Gathers the lists of the whole mesh, as TRMESH returns them, on rank `root` (from 0), or on all ranks if root is
  !> pstripack_every_rank. The global numbers must be 1..N, N the number of all points. list, lptr (6N-12), lend (N)
  !> and lnew are written on these ranks only; their sizes are not checked. ier: 0, pstripack_empty_mesh, -4 (6N-11
  !> does not fit 32 bits), -6, pstripack_ranks_disagree (in root), pstripack_bad_comm (no such rank) or
  !> pstripack_bad_number. Collective.
  recursive subroutine gather(mesh, root, list, lptr, lend, lnew, ier)
    class(pstripack_mesh), intent(inout) :: mesh
    integer(c_int32_t), intent(in) :: root
    integer(c_int32_t), intent(inout), contiguous :: list(:), lptr(:), lend(:)
    integer(c_int32_t), intent(inout) :: lnew
    integer(c_int32_t), intent(out) :: ier
    ier = pstripack_empty_mesh
    if (c_associated(mesh%handle)) ier = c_gather(mesh%handle, root, list, lptr, lend, lnew)
  end subroutine

  ! exchange(values, halo_values, ier) sends values of own points, values(points) or values(width, points), to the ranks
  ! that have them in their halo: halo_values(halo) or (width, halo), in the order of `halo`; real(c_double) or
  ! integer(c_int64_t). exchange_begin(values, ier) and exchange_end(halo_values, ier) do the same with other work between
  ! them; several may be under way, and end in the order in which they began. exchange and exchange_begin are collective.
  ! ier: 0, pstripack_empty_mesh (or no exchange is under way), -6, pstripack_ranks_disagree (in width),
  ! pstripack_bad_comm or pstripack_bad_size (width below 1; another than in exchange_begin). They stop the program if an
  ! array is too short.

  recursive subroutine exchange_real_1(mesh, values, halo_values, ier)
    class(pstripack_mesh), intent(inout) :: mesh
    real(c_double), intent(in), contiguous :: values(:)
    real(c_double), intent(inout), contiguous :: halo_values(:)
    integer(c_int32_t), intent(out) :: ier
    ier = fits(mesh, size(values, 1, kind=c_int64_t), size(halo_values, 1, kind=c_int64_t))
    if (ier == 0) ier = c_exchange(mesh%handle, values, 1_c_int64_t, halo_values)
  end subroutine

  recursive subroutine exchange_real_2(mesh, values, halo_values, ier)
    class(pstripack_mesh), intent(inout) :: mesh
    real(c_double), intent(in), contiguous :: values(:, :)
    real(c_double), intent(inout), contiguous :: halo_values(:, :)
    integer(c_int32_t), intent(out) :: ier
    ier = fits(mesh, size(values, 2, kind=c_int64_t), size(halo_values, 2, kind=c_int64_t))
    if (ier == 0) ier = c_exchange(mesh%handle, values, size(values, 1, kind=c_int64_t), halo_values)
  end subroutine

  recursive subroutine exchange_integer_1(mesh, values, halo_values, ier)
    class(pstripack_mesh), intent(inout) :: mesh
    integer(c_int64_t), intent(in), contiguous :: values(:)
    integer(c_int64_t), intent(inout), contiguous :: halo_values(:)
    integer(c_int32_t), intent(out) :: ier
    ier = fits(mesh, size(values, 1, kind=c_int64_t), size(halo_values, 1, kind=c_int64_t))
    if (ier == 0) ier = c_exchange(mesh%handle, values, 1_c_int64_t, halo_values)
  end subroutine

  recursive subroutine exchange_integer_2(mesh, values, halo_values, ier)
    class(pstripack_mesh), intent(inout) :: mesh
    integer(c_int64_t), intent(in), contiguous :: values(:, :)
    integer(c_int64_t), intent(inout), contiguous :: halo_values(:, :)
    integer(c_int32_t), intent(out) :: ier
    ier = fits(mesh, size(values, 2, kind=c_int64_t), size(halo_values, 2, kind=c_int64_t))
    if (ier == 0) ier = c_exchange(mesh%handle, values, size(values, 1, kind=c_int64_t), halo_values)
  end subroutine

  recursive subroutine exchange_begin_real_1(mesh, values, ier)
    class(pstripack_mesh), intent(inout) :: mesh
    real(c_double), intent(in), contiguous :: values(:)
    integer(c_int32_t), intent(out) :: ier
    ier = fits(mesh, size(values, 1, kind=c_int64_t))
    if (ier == 0) ier = c_exchange_begin(mesh%handle, values, 1_c_int64_t)
  end subroutine

  recursive subroutine exchange_begin_real_2(mesh, values, ier)
    class(pstripack_mesh), intent(inout) :: mesh
    real(c_double), intent(in), contiguous :: values(:, :)
    integer(c_int32_t), intent(out) :: ier
    ier = fits(mesh, size(values, 2, kind=c_int64_t))
    if (ier == 0) ier = c_exchange_begin(mesh%handle, values, size(values, 1, kind=c_int64_t))
  end subroutine

  recursive subroutine exchange_begin_integer_1(mesh, values, ier)
    class(pstripack_mesh), intent(inout) :: mesh
    integer(c_int64_t), intent(in), contiguous :: values(:)
    integer(c_int32_t), intent(out) :: ier
    ier = fits(mesh, size(values, 1, kind=c_int64_t))
    if (ier == 0) ier = c_exchange_begin(mesh%handle, values, 1_c_int64_t)
  end subroutine

  recursive subroutine exchange_begin_integer_2(mesh, values, ier)
    class(pstripack_mesh), intent(inout) :: mesh
    integer(c_int64_t), intent(in), contiguous :: values(:, :)
    integer(c_int32_t), intent(out) :: ier
    ier = fits(mesh, size(values, 2, kind=c_int64_t))
    if (ier == 0) ier = c_exchange_begin(mesh%handle, values, size(values, 1, kind=c_int64_t))
  end subroutine

  recursive subroutine exchange_end_real_1(mesh, halo_values, ier)
    class(pstripack_mesh), intent(inout) :: mesh
    real(c_double), intent(inout), contiguous :: halo_values(:)
    integer(c_int32_t), intent(out) :: ier
    ier = fits(mesh, halo_given=size(halo_values, 1, kind=c_int64_t))
    if (ier == 0) ier = c_exchange_end(mesh%handle, 1_c_int64_t, halo_values)
  end subroutine

  recursive subroutine exchange_end_real_2(mesh, halo_values, ier)
    class(pstripack_mesh), intent(inout) :: mesh
    real(c_double), intent(inout), contiguous :: halo_values(:, :)
    integer(c_int32_t), intent(out) :: ier
    ier = fits(mesh, halo_given=size(halo_values, 2, kind=c_int64_t))
    if (ier == 0) ier = c_exchange_end(mesh%handle, size(halo_values, 1, kind=c_int64_t), halo_values)
  end subroutine

  recursive subroutine exchange_end_integer_1(mesh, halo_values, ier)
    class(pstripack_mesh), intent(inout) :: mesh
    integer(c_int64_t), intent(inout), contiguous :: halo_values(:)
    integer(c_int32_t), intent(out) :: ier
    ier = fits(mesh, halo_given=size(halo_values, 1, kind=c_int64_t))
    if (ier == 0) ier = c_exchange_end(mesh%handle, 1_c_int64_t, halo_values)
  end subroutine

  recursive subroutine exchange_end_integer_2(mesh, halo_values, ier)
    class(pstripack_mesh), intent(inout) :: mesh
    integer(c_int64_t), intent(inout), contiguous :: halo_values(:, :)
    integer(c_int32_t), intent(out) :: ier
    ier = fits(mesh, halo_given=size(halo_values, 2, kind=c_int64_t))
    if (ier == 0) ier = c_exchange_end(mesh%handle, size(halo_values, 1, kind=c_int64_t), halo_values)
  end subroutine

  !> Compares the stars of all ranks with each other: every star is a cycle, every triangle stands in the stars of its
  !> three corners, and all triangles cover one sphere or disc. Collective.
  !>   fingerprint  out: a hash that depends on the set of triangles alone
  !>   ier          out: 0, pstripack_empty_mesh, -6, pstripack_bad_comm, or -13: then error_points tells a point with a
  !>                wrong star, 0 if only Euler's formula fails
  recursive subroutine check(mesh, fingerprint, ier)
    class(pstripack_mesh), intent(inout) :: mesh
    integer(c_int64_t), intent(inout) :: fingerprint
    integer(c_int32_t), intent(out) :: ier
    ier = pstripack_empty_mesh
    if (c_associated(mesh%handle)) ier = c_check(mesh%handle, fingerprint)
  end subroutine

  !> A centroidal tessellation of the generators of all ranks, which stay on their ranks. The types are those of module
  !> pstripack; see also pstripack_scvt there. Collective.
  !>   xyz, number  as in triangulate; xyz in: the generators to start from, vectors of any length; out: the generators
  !>                found, unit vectors
  !>   result       out: the same on every rank, except generators, which is size(number)
  !>   ier          out: 0, whatever the reason to end; -1 (fewer than four generators in all), -4 (too many), -5, -6,
  !>                pstripack_coincident, pstripack_bad_number, pstripack_bad_comm, or a code of pstripack_scvt; the same
  !>                on every rank, as is the message. After an error nothing else is written
  !>   density      the same on every rank, called for places near the rank's generators; default: 1 everywhere
  !>   options      those of rank 0 are used on all ranks, except density_on_threads; start and seed have no effect
  !>   progress     called on rank 0 only
  !> Afterwards the mesh is that of the generators; after an error it is empty.
  recursive subroutine scvt(mesh, xyz, number, result, ier, density, options, progress, message)
    class(pstripack_mesh), intent(inout) :: mesh
    real(c_double), intent(inout), contiguous :: xyz(:, :)
    integer(c_int64_t), intent(in), contiguous :: number(:)
    type(pstripack_scvt_result), intent(inout) :: result
    integer(c_int32_t), intent(out) :: ier
    procedure(pstripack_density), optional :: density
    type(pstripack_scvt_options), intent(in), optional :: options
    procedure(pstripack_progress), optional :: progress
    character(len=*), intent(out), optional :: message
    type(callbacks), target :: caller
    type(c_density) :: rho
    type(c_options) :: options_c
    character(kind=c_char) :: line(400)

    line = c_null_char
    ier = pstripack_empty_mesh
    if (c_associated(mesh%handle)) then
      call pass_on(caller, rho, options_c, density, options, progress)
      ier = c_scvt(mesh%handle, count_or_shape(xyz, size(number, kind=c_int64_t)), xyz, number, rho, options_c, result, &
                   line, size(line, kind=c_int32_t))
    end if
    call tell(line, message)
  end subroutine

  !> Frees the mesh. Collective, unless MPI is finalised already. May be called again.
  recursive subroutine free_mesh(mesh)
    class(pstripack_mesh), intent(inout) :: mesh
    if (c_associated(mesh%handle)) call c_free(mesh%handle)
    mesh%handle = c_null_ptr
  end subroutine

  impure elemental subroutine finalise(mesh)
    type(pstripack_mesh), intent(inout) :: mesh
    call mesh%free()
  end subroutine

  recursive subroutine do_not_copy(to, from)
    class(pstripack_mesh), intent(inout) :: to
    class(pstripack_mesh), intent(in) :: from
    if (c_associated(to%handle, from%handle)) return
    error stop "pstripack_mesh: a mesh cannot be copied"
  end subroutine

  !> n, if xyz is xyz(3, n); else a number below 0 by which the C API knows the shape of xyz, rejects it on all ranks,
  !> and tells it (text_of_count in pstripack_mpi.cpp).
  recursive integer(c_int64_t) function count_or_shape(xyz, n)
    real(c_double), intent(in) :: xyz(:, :)
    integer(c_int64_t), intent(in) :: n
    integer(c_int64_t), parameter :: most = huge(1_c_int32_t)
    count_or_shape = n
    if (size(xyz, 2, kind=c_int64_t) /= n .or. (n > 0 .and. size(xyz, 1) /= 3)) &
      count_or_shape = -1 - (min(size(xyz, 1, kind=c_int64_t) + 1, most)*(most + 1) + &
                             min(size(xyz, 2, kind=c_int64_t), most))
  end function

  !> 0 if arrays of so many points and halo points are long enough for the mesh.
  recursive integer(c_int32_t) function fits(mesh, points_given, halo_given)
    class(pstripack_mesh), intent(in) :: mesh
    integer(c_int64_t), intent(in), optional :: points_given, halo_given
    integer(c_int64_t) :: points, arcs, triangles, halo
    logical :: is_short
    call mesh%sizes(points, arcs, triangles, halo)
    is_short = .false.
    if (present(points_given)) is_short = points_given < points
    if (present(halo_given)) is_short = is_short .or. halo_given < halo
    if (is_short) error stop "pstripack_mesh: exchange: an array is too short"
    fits = merge(0_c_int32_t, pstripack_empty_mesh, c_associated(mesh%handle))
  end function

  !> The number of own points, if arrays of these sizes have room for the stars.
  recursive integer(c_int64_t) function points_if_room(mesh, begin, neighbour) result(points)
    class(pstripack_mesh), intent(in) :: mesh
    integer(c_int64_t), intent(in) :: begin, neighbour
    integer(c_int64_t) :: arcs, triangles, halo
    if (.not. c_associated(mesh%handle)) error stop "pstripack_mesh: stars of a mesh that was not created"
    call mesh%sizes(points, arcs, triangles, halo)
    if (begin < points + 1 .or. neighbour < arcs) error stop "pstripack_mesh: stars: an array is too short"
  end function

  include "scvt_procedures.inc"

end module
