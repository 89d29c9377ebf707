#!/bin/sh
# Tests docs/clients with programs built as those clients are: runs the commands of its pages word for word and checks
# messages of the linker and of nm. Without libngmath NCAR's page is not tested.
# Usage: clients.sh SOURCE_DIR BUILD_DIR FORTRAN_LIBRARIES_DIR STRIPACK_COMPARE WORK_DIR
set -eu
pages=$1/docs/clients source=$1 build=$2 libraries=$3 compare=$4 work=$5
rm -rf "$work"
mkdir -p "$work/bin" "$work/switch/8arg"
cd "$work"
fail() {
  echo "FAILED: $*" >&2
  for file in out err; do [ ! -s $file ] || cat $file >&2; done
  exit 1
}

# Stand-ins for the installed commands.
cat > bin/pkg-config << EOF
#!/bin/sh
for word in "\$@"; do
  case \$word in
    --cflags) echo "-I$build/modules/stripack" ;;
    stripack_f90) echo "-L$libraries/f90_helpers -lstripack_f90" ;;
    stripack*) [ "\$1" != --libs ] || echo "-L$libraries -l\$word -Wl,-rpath,$libraries" ;;
  esac
done
EOF
cat > bin/pstripack-config << EOF
#!/bin/sh
case \$* in
  --switch-dir) echo "$libraries" ;;
  "--abi 8arg --switch-dir") echo "$work/switch/8arg" ;;
  *) exit 1 ;;
esac
EOF
chmod +x bin/*
ln -s "$libraries/libstripack_8arg.so" switch/8arg/libstripack.so
ln -s "$compare" bin/stripack-compare
export PATH="$work/bin:$PATH"

# page PAGE TEXT: prints the block of commands of the page that contains TEXT
page() {
  awk -v text="$2" '/^```/ { if (inside && index(block, text)) { printf "%s", block; found = 1 }
                             inside = /^```[a-z]/; block = ""; next }
                    inside { block = block $0 "\n" } END { exit !found }' "$pages/$1" || fail "$1 has no $2"
}
# run PAGE TEXT: runs that block
run() {
  page "$1" "$2" > commands
  sh -eu commands > out 2> err || fail "$1: $(cat commands)"
}
# has FILE TEXT: fails unless the file contains TEXT
has() { grep -qF -e "$2" "$1" || fail "$1 lacks: $2"; }

cat > main.f90 << 'EOF'
  integer, parameter :: n = 6
  real(8) :: x(n) = [1,0,0,-1,0,0], y(n) = [0,1,0,0,-1,0], z(n) = [0,0,1,0,0,-1], dist(n)
  integer :: list(6*n-12), lptr(6*n-12), lend(n), lnew, near(n), next(n), ier
  call trmesh(n, x, y, z, list, lptr, lend, lnew, near, next, dist, ier)
  print '(a, i0)', 'IER ', ier
  call another
end
EOF
cat > both.f90 << 'EOF'
subroutine trmesh(n, x, y, z, list, lptr, lend, lnew, near, next, dist, ier)
  integer :: n, list(*), lptr(*), lend(*), lnew, near(*), next(*), ier
  real(8) :: x(*), y(*), z(*), dist(*)
  ier = 99
end subroutine
subroutine another
  print '(a)', 'another routine'
end subroutine
EOF

cat > swap.f90 << 'EOF'
subroutine swap
  print '(a)', 'own swap'
end subroutine
EOF
cat > swaps.f90 << 'EOF'
subroutine swaps
  call swap
end subroutine
EOF

echo "== one file with both"
gfortran -c main.f90 both.f90
nm -A ./*.o | grep -i trmesh > out
has out 'U trmesh_'
has out 'T trmesh_'
gfortran main.o both.o -o model && ./model > out
has out 'IER 99'
gfortran -c swap.f90 swaps.f90
ar rc libgeo.a both.o swap.o swaps.o
run ../relink.md 'nm -A --defined-only libgeo_rest.a'
has out 'both.o:'
has out 'swap.o:'
run ../relink.md 'objcopy --localize-symbols'
sed 's/call another/call another; call swaps/' main.f90 > model.f90
# shellcheck disable=SC2046  # several words
gfortran model.f90 libgeo_rest.a -o model $(pkg-config --libs stripack)
PSTRIPACK_REPORT=1 ./model > out 2> err
has out 'IER 0'
has out 'another routine'
has out 'own swap'
has err 'pstripack: threads n=6 '

echo "== helpers of the Fortran 90 text"
sed 's/call another/call timestamp/' main.f90 > sphere_delaunay.f90
run burkardt.md 'gfortran sphere_delaunay.f90'
PSTRIPACK_REPORT=1 ./sphere_delaunay > out 2> err
has out 'IER 0'
has err 'pstripack: threads n=6 '

echo "== a stale module file"
{ echo 'module stripack; contains'; sed '/^subroutine another/,$d' both.f90; echo 'end module'; } > STRIPACK.f90
{ echo 'use stripack'; sed '/another/d' main.f90; } > caller.f90
gfortran -c STRIPACK.f90
build_caller() {
  # shellcheck disable=SC2046  # lists of words on purpose
  gfortran caller.f90 -o caller $(pkg-config --cflags stripack) $(pkg-config --libs stripack) 2> err
}
if build_caller; then fail "a stale module file does no harm"; fi
has err "undefined reference to \`__stripack_MOD_trmesh'"
has "$pages/README.md" "undefined reference to \`__stripack_MOD_trmesh'"
rm -f stripack.mod STRIPACK.o
build_caller || fail "without the stale module file"
./caller > out
has out 'IER 0'

echo "== an extension of Python"
cat > extension.c << 'EOF'
void trmesh_(int *n, double *x, double *y, double *z, int *list, int *lptr, int *lend, int *ier) { *ier = 99; }
int triangulate(void) {
  int n = 6, list[24], lptr[24], lend[6], ier;
  double x[] = {1, 0, 0, -1, 0, 0}, y[] = {0, 1, 0, 0, -1, 0}, z[] = {0, 0, 1, 0, 0, -1};
  trmesh_(&n, x, y, z, list, lptr, lend, &ier);
  return ier;
}
EOF
cc -shared -fPIC -w extension.c -o _stripack.so
echo "import ctypes; print('IER', ctypes.CDLL('./_stripack.so').triangulate())" > script.py
python3 script.py > out
has out 'IER 99'
run stripy.md LD_PRELOAD
has out 'IER 0'
has err 'pstripack: threads n=6 '
cc -shared -fPIC -w extension.c -o _stripack.so -Wl,--no-as-needed -L"$libraries" -lstripack_8arg -Wl,-rpath,"$libraries"
python3 script.py > out
has out 'IER 99'  # a library that the module needs does not replace its own routine

echo "== an extension of Python beside a planar module with routines of the same names"
mkdir stripy
cc -shared -fPIC -w extension.c -o stripy/_stripack.so
cat > planar.c << 'EOF'
void trmesh_(int *n) { *n = 77; }
void addcst_(void) {}
int triangulate(void) { int n = 3; trmesh_(&n); return n; }
EOF
cc -shared -fPIC -w planar.c -o stripy/_tripack.so
cat > stripy/__init__.py << 'EOF'
import ctypes
print("sphere", ctypes.CDLL(__path__[0] + "/_stripack.so").triangulate(), flush=True)
print("plane", ctypes.CDLL(__path__[0] + "/_tripack.so").triangulate(), flush=True)
EOF
page stripy.md 'import stripy' > script.py
PSTRIPACK_REPORT=1 python3 script.py > out 2> err || fail "the lines of stripy.md"
has out 'sphere 0'
has out 'plane 77'
has err 'pstripack: threads n=6 '
# The trap: the planar module passes one argument to our TRMESH.
if LD_PRELOAD=$PWD/switch/8arg/libstripack.so python3 -c 'import stripy' > out 2> err && grep -q 'plane 77' out; then
  fail "LD_PRELOAD does no harm to a planar module"
fi

echo "== changed copies"
mkdir changed
echo 'static void trmesh_(long *n) { *n = 55; } static void another_(long *n) { trmesh_(n); }' > changed/copy.c
cat > changed/program.c << 'EOF'
int main(void) {
  int64_t n = 6, list[24], lptr[24], lend[6], lnew, near[6], next[6], ier = 99, copy;
  double x[] = {1, 0, 0, -1, 0, 0}, y[] = {0, 1, 0, 0, -1, 0}, z[] = {0, 0, 1, 0, 0, -1}, dist[6];
  trmesh_(&n, x, y, z, list, lptr, lend, &lnew, near, next, dist, &ier);
  another_(&copy);
  return printf("IER %d, another %d\n", (int)ier, (int)copy) < 0;
}
EOF
{ printf '#include <stdint.h>\n#include <stdio.h>\n'; page changed.md 'copy.c'; cat changed/program.c; } > changed/gmt.c
# shellcheck disable=SC2046  # lists of words on purpose
cc changed/gmt.c -o gmt $(pkg-config --libs stripack_i8) && ./gmt > out
has out 'IER 0, another 55'
{
  cat << 'EOF'
module mpl_of_fork
  type mpl_type
  contains
    procedure :: abort => abort_with
  end type
contains
  subroutine abort_with(mpl, name, ier)
    class(mpl_type), intent(inout) :: mpl
    character(*), intent(in) :: name
    integer, intent(in) :: ier
    print '(2a, i0)', name, ' ', ier
  end subroutine
end module
module fork
  use mpl_of_fork
  implicit none
contains
EOF
  page changed.md 'exact_trmesh'
  cat << 'EOF'
end module
  use fork
  type(mpl_type) :: mpl
  integer, parameter :: n = 6
  real(8) :: x(n) = [1,0,0,-1,0,0], y(n) = [0,1,0,0,-1,0], z(n) = [0,0,1,0,0,-1], dist(n)
  integer :: list(6*n-12), lptr(6*n-12), lend(n), lnew, near(n), next(n)
  call trmesh(mpl, n, x, y, z, list, lptr, lend, lnew, near, next, dist)
  print '(a, i0)', 'LNEW ', lnew
  x = 1; y = 0; z = 0
  call trmesh(mpl, n, x, y, z, list, lptr, lend, lnew, near, next, dist)
end
EOF
} > changed/fork.f90
# shellcheck disable=SC2046  # lists of words on purpose
gfortran changed/fork.f90 -J changed -o forked $(pkg-config --cflags stripack) $(pkg-config --libs stripack)
./forked > out
has out 'LNEW 25'
has out 'trmesh -2'

if ! echo 'end' | gfortran -x f95 - -lngmath -o empty 2> /dev/null; then
  echo "== NCAR Graphics: no libngmath, not tried"
  exit
fi
echo "== NCAR Graphics"
cp "$source/examples/ncl/cstrmesh.f" .
cat > model.f << 'EOF'
      INTEGER N, NT, LTRI(3,20), IWK(27*6), IER
      PARAMETER (N = 6)
      DOUBLE PRECISION LAT(N), LON(N), RWK(13*N)
      DATA LAT /0, 0, 90, 0, 0, -90/, LON /0, 90, 0, 180, -90, 0/
      CALL CSSTRID (N, LAT, LON, NT, LTRI, IWK, RWK, IER)
      PRINT '(A,I0)', 'triangles ', NT
      END
EOF
run ncl.md 'gfortran model.f cstrmesh.f'
PSTRIPACK_REPORT=1 ./model > out 2> err
has out 'triangles 8'
has err 'pstripack: threads n=6 '
for seed in 1 2 3 4 5 6 7 8; do echo "$((seed * 37)) $((seed * 11 - 50))"; done > nodes.txt
run ncl.md stripack-compare
has out 'ngmath.so (r8: REAL*8, INTEGER*4, TRMESH with 12 arguments)'
has out 'verdict    equal'
if command -v ncl > /dev/null; then
  printf 'begin\n  print(dimsizes(csstri((/0.,0.,90.,0.,0.,-90./), (/0.,90.,0.,180.,-90.,0./))))\nend\n' > script.ncl
  run ncl.md 'LD_PRELOAD=./cstrmesh.so'
  has out '(0)	8'
  has err 'pstripack: threads n=6 '
fi
# The page must have every name of the library; names of double versions, of C and of splines are covered by patterns.
library=$(gfortran -print-file-name=libngmath.a)
nm -g --defined-only "$library" 2> /dev/null | awk '$2 == "T" && /cs/ { print $3 }' | sed -n 's/_$//; /^cs/p' | sort -u |
  grep -vE '^csa[123]' | sed -E 's/^(csstri|cssgrid|csvoro|css2c|csc2s)d$/\1/' | sort -u > names
grep -oE '\bcs[a-z0-9]+' "$pages/ncl.md" | sort -u > told
comm -23 names told > missing
[ ! -s missing ] || fail "names that ncl.md does not tell: $(cat missing)"
