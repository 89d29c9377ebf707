#!/bin/sh
# pstripack-config of an installed prefix: its flags build programs that run, for every ABI, shared and static, also after
# the prefix has moved and through a link. Wrong options are refused.
# Usage: config.sh PREFIX CONSUMER_DIR WORK_DIR VERSION [MPIEXEC]
# shellcheck disable=SC2046,SC2086  # lists of words on purpose
set -eu
prefix=$1 consumer=$2 work=$3 version=$4 mpiexec=${5:-}
rm -rf "$work"
mkdir -p "$work"
cp -a "$prefix" "$work/moved"
ln -s moved/bin/pstripack-config "$work/config"
prefix=$(cd "$work/moved" && pwd)
config() { "$work/config" "$@"; }
fail() { echo "$*" >&2; exit 1; }

[ "$(config --prefix)" = "$prefix" ] || fail "--prefix: $(config --prefix)"
[ "$(config --version)" = "$version" ] || fail "--version: $(config --version)"
switch=$(config --switch-dir)
export LD_LIBRARY_PATH="${switch%/pstripack/switch/r8}"

# run ABI shared|--static COMMAND...: builds $work/program by COMMAND and runs it
run() {
  abi=$1 kind=$2
  shift 2
  "$@" -o "$work/program" $(config --abi "$abi" ${kind#shared} --libs)
  case $abi in
    *mpi*) "$mpiexec" -n 2 "$work/program" | grep -qx 'mpi: 2 ranks, 24 slots' || fail "$abi $kind: ranks" ;;
    *) "$work/program" | grep -qE '^(legacy: 8 triangles|c_api: .* 24 slots|version .*)$' || fail "$abi $kind: wrong mesh" ;;
  esac
  needs=$(ldd "$work/program" | grep -cE '^[[:blank:]]*lib[a-z]*stripack' || true)
  case $kind:$needs in
    shared:0) fail "$abi: the program needs no shared library of ours" ;;
    --static:[1-9]*) fail "$abi --static: the program needs a shared library of ours" ;;
  esac
  echo "$abi ${kind#--}: ran"
}
cat > "$work/modern.f90" << 'END'
use pstripack, only: pstripack_version
print '(2a)', 'version ', pstripack_version()
end
END
for kind in shared --static; do
  run r8 $kind gfortran $(config --fflags) "$consumer/legacy.F90"
  run r4 $kind gfortran -DSINGLE_PRECISION $(config --abi r4 --fflags) "$consumer/legacy.F90"
  run 8arg $kind gfortran -DEIGHT_ARGUMENTS $(config --fflags --abi=8arg) "$consumer/legacy.F90"
  run i8 $kind gfortran -fdefault-integer-8 $(config --fflags --abi i8) "$consumer/legacy.F90"
  run pstripack $kind gfortran $(config --abi pstripack --fflags) "$work/modern.f90"
  "$work/program" | grep -qx "version $version" || fail "pstripack_version() is not $version"
  run r8 $kind cc $(config --cflags) "$consumer/legacy.c"
  run c $kind cc $(config --abi c --cflags) "$consumer/c_api.c"
  if [ -n "$mpiexec" ]; then
    run r8,mpi $kind mpifort $(config --abi r8,mpi --fflags) "$consumer/mpi_fortran.f90"
    run mpi-c $kind cc $(config --abi mpi-c --cflags) "$consumer/mpi.c"
  fi
done

# All ABIs are listed, and each one of libstripack has a folder to switch to.
[ "$(config --abi | wc -l)" -eq 9 ] || fail "--abi lists $(config --abi | wc -l)"
for abi in r8 r4 8arg i8; do
  [ -e "$(config --abi $abi --switch-dir)/libstripack.so" ] || fail "$abi: no libstripack.so to switch to"
done

# refused TEXT ARGUMENT...
refused() {
  text=$1
  shift
  if config "$@" > "$work/out" 2> "$work/error"; then fail "accepted: $*"; fi
  if [ -s "$work/out" ]; then fail "an answer with the refusal: $*"; fi
  grep -qF -e "$text" "$work/error" || { cat "$work/error"; fail "refused, but not because '$text': $*"; }
}
refused "Usage: pstripack-config"
refused "unknown option --flibs" --flibs
refused "no ABI is called r16" --abi r16 --libs
refused "nothing asked for" --abi r4
refused "c has no Fortran module" --abi c --fflags
refused "f90 has no Fortran module" --abi f90 --fflags
refused "not for pstripack" --abi pstripack --switch-dir
refused "not for r8,r4" --abi r8,r4 --switch-dir
rm -f "$prefix/include/pstripack_mpi.h"
refused "no MPI part in $prefix" --abi r8,mpi --libs
echo "pstripack-config: all programs ran"
