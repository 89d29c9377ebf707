!> PSTRIPACK for Fortran: the C API of libpstripack (pstripack.h).
!>
!> Nodes count from 1. Nothing here is collective; any number of threads may call at once.
module pstripack
  use, intrinsic :: iso_c_binding, only: c_char, c_double, c_float, c_int32_t, c_int64_t, c_null_char, c_ptr, c_size_t
  implicit none
  private
  public :: pstripack_version, pstripack_strerror, pstripack_trmesh, pstripack_validate, pstripack_fingerprint
  public :: pstripack_ok, pstripack_too_few_nodes, pstripack_collinear, pstripack_too_many_nodes, &
            pstripack_bad_coordinate, pstripack_out_of_memory, pstripack_bad_size

  ! !> Results of pstripack_trmesh. Any other is L > 0: nodes L and M > L coincide, M the smallest such.
  integer(c_int32_t), parameter :: pstripack_ok = 0, &
    pstripack_too_few_nodes = -1, &   !< fewer than 3 nodes
    pstripack_collinear = -2, &       !< the first three nodes lie on one great circle
    pstripack_too_many_nodes = -4, &  !< 6n-11 does not fit 32 bits
    pstripack_bad_coordinate = -5, &  !< a coordinate is not finite, or a vector is zero
    pstripack_out_of_memory = -6, &
    pstripack_bad_size = -100         !< arrays of different sizes, or too short; of this module alone

  !> call pstripack_trmesh(x, y, z, list, lptr, lend, lnew, ier)
  !>
  !> The Delaunay triangulation of n = size(x) nodes, as STRIPACK's lists in canonical form.
  !>   x, y, z     (n) real32 or real64: vectors from the centre of the sphere to the nodes, unit length
  !>   list, lptr  (at least 6n-12) neighbours, and the slot of the next neighbour
  !>   lend        (at least n) slot of each node's last neighbour
  !>   lnew        one past the last slot used
  !>   ier         pstripack_ok, an error code above, or L > 0 (the lists then hold nodes 1..M-1)
  !> On a negative ier nothing else is written.
  interface pstripack_trmesh
    module procedure trmesh_real32, trmesh_real64
  end interface

  interface
    ! int32_t pstripack_trmesh(int32_t n, const double* x, const double* y, const double* z, int32_t* list,
    !                          int32_t* lptr, int32_t* lend, int32_t* lnew);
    function c_trmesh(n, x, y, z, list, lptr, lend, lnew) result(ier) bind(c, name="pstripack_trmesh")
      import :: c_double, c_int32_t
      integer(c_int32_t), value, intent(in) :: n
      real(c_double), intent(in) :: x(*), y(*), z(*)
      integer(c_int32_t), intent(inout) :: list(*), lptr(*), lend(*), lnew
      integer(c_int32_t) :: ier
    end function

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

    ! const char* pstripack_version(void);
    function c_version() result(text) bind(c, name="pstripack_version")
      import :: c_ptr
      type(c_ptr) :: text
    end function

    ! const char* pstripack_strerror(int ier);
    function c_strerror(ier) result(text) bind(c, name="pstripack_strerror")
      import :: c_int32_t, c_ptr
      integer(c_int32_t), value, intent(in) :: ier
      type(c_ptr) :: text
    end function

    ! size_t strlen(const char*);
    function c_strlen(text) result(length) bind(c, name="strlen")
      import :: c_ptr, c_size_t
      type(c_ptr), value, intent(in) :: text
      integer(c_size_t) :: length
    end function
  end interface

contains

  !> "major.minor.patch" of the library that is loaded.
  function pstripack_version() result(text)
    character(len=:), allocatable :: text
    text = fortran_text(c_version())
  end function

  !> One line for an error code.
  function pstripack_strerror(ier) result(text)
    integer(c_int32_t), intent(in) :: ier
    character(len=:), allocatable :: text
    if (ier == pstripack_bad_size) then
      text = "arrays of different sizes, or too short"
    else
      text = fortran_text(c_strerror(ier))
    end if
  end function

  ! !> The number of the violated property if the lists are not a correct triangulation of the n = size(x)
  ! nodes (exact signs), 0 if they are, an error code if this could not be determined; `message` names the
  ! nodes. list, lptr (at least 6n-12), lend (at least n); lnew from TRMESH, or 0.
  function pstripack_validate(x, y, z, list, lptr, lend, lnew, message) result(defect)
    real(c_double), intent(in), contiguous :: x(:), y(:), z(:)
    integer(c_int32_t), intent(in), contiguous :: list(:), lptr(:), lend(:)
    integer(c_int32_t), intent(in) :: lnew
    character(len=*), intent(out), optional :: message
    integer(c_int32_t) :: defect
    character(kind=c_char) :: line(400)
    integer :: i
    line = c_null_char
    if (sizes_fit(size(x), size(y), size(z), size(list), size(lptr), size(lend))) then
      defect = c_validate(size(x, kind=c_int32_t), x, y, z, list, lptr, lend, lnew, line, size(line, kind=c_int32_t))
    else
      defect = pstripack_bad_size
    end if
    if (.not. present(message)) return
    message = ""
    do i = 1, min(len(message), size(line))
      if (line(i) == c_null_char) exit
      message(i:i) = line(i)
    end do
  end function

  !> 64 bits that depend on the set of triangles alone. n = size(lend); the lists must be well formed.
  function pstripack_fingerprint(list, lptr, lend) result(bits)
    integer(c_int32_t), intent(in), contiguous :: list(:), lptr(:), lend(:)
    integer(c_int64_t) :: bits
    bits = c_fingerprint(size(lend, kind=c_int32_t), list, lptr, lend)
  end function

  subroutine trmesh_real64(x, y, z, list, lptr, lend, lnew, ier)
    real(c_double), intent(in), contiguous :: x(:), y(:), z(:)
    integer(c_int32_t), intent(inout), contiguous :: list(:), lptr(:), lend(:)
    integer(c_int32_t), intent(inout) :: lnew
    integer(c_int32_t), intent(out) :: ier
    ier = pstripack_bad_size
    if (sizes_fit(size(x), size(y), size(z), size(list), size(lptr), size(lend))) &
      ier = c_trmesh(size(x, kind=c_int32_t), x, y, z, list, lptr, lend, lnew)
  end subroutine

  subroutine trmesh_real32(x, y, z, list, lptr, lend, lnew, ier)
    real(c_float), intent(in), contiguous :: x(:), y(:), z(:)
    integer(c_int32_t), intent(inout), contiguous :: list(:), lptr(:), lend(:)
    integer(c_int32_t), intent(inout) :: lnew
    integer(c_int32_t), intent(out) :: ier
    ier = pstripack_bad_size
    if (sizes_fit(size(x), size(y), size(z), size(list), size(lptr), size(lend))) &
      ier = c_trmesh_r4(size(x, kind=c_int32_t), x, y, z, list, lptr, lend, lnew)
  end subroutine

  logical function sizes_fit(n, ny, nz, nlist, nlptr, nlend)
    integer, intent(in) :: n, ny, nz, nlist, nlptr, nlend
    sizes_fit = ny == n .and. nz == n .and. nlend >= n .and. min(nlist, nlptr) >= 6*int(n, c_int64_t) - 12
  end function

  function fortran_text(text) result(copy)
    use, intrinsic :: iso_c_binding, only: c_f_pointer
    type(c_ptr), intent(in) :: text
    character(len=:), allocatable :: copy
    character(kind=c_char), pointer :: bytes(:)
    integer :: i
    call c_f_pointer(text, bytes, [c_strlen(text)])
    allocate (character(len=size(bytes)) :: copy)
    do i = 1, size(bytes)
      copy(i:i) = bytes(i)
    end do
  end function

end module
