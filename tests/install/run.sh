#!/bin/sh
# Installs a build into an empty prefix and builds programs of other projects with it, by CMake, by pkg-config and by
# hand, shared and static; with MPIEXEC also programs with MPI.
# Usage: run.sh BUILD_DIR SOURCE_DIR WORK_DIR CMAKE_GENERATOR VERSION [MPIEXEC]
# shellcheck disable=SC2046  # lists of words on purpose
set -eu
build=$1 source=$2 work=$3 generator=$4 version=$5 mpiexec=${6:-}
prefix=$work/prefix consumer=$source/tests/install/consumer
rm -rf "$work"
mkdir -p "$work"

# Keep the user's list of installed files in the build folder.
manifest=$build/install_manifest.txt
if [ -e "$manifest" ]; then cp -p "$manifest" "$work"; fi
cmake --install "$build" --prefix "$prefix" > "$work/install.log"
rm "$manifest"
if [ -e "$work/install_manifest.txt" ]; then mv "$work/install_manifest.txt" "$manifest"; fi
libdir=$(dirname "$(find "$prefix" -name stripack.pc)")/..
export PKG_CONFIG_PATH="$libdir/pkgconfig"

echo "== CMake package"
cmake -G "$generator" -S "$consumer" -B "$work/cmake" -DCMAKE_PREFIX_PATH="$prefix" -DCMAKE_BUILD_TYPE=Release \
  -DMPI="${mpiexec:+ON}" > "$work/cmake.log"
cmake --build "$work/cmake" >> "$work/cmake.log"
for program in legacy_stripack legacy_stripack_static legacy_stripack_8arg legacy_stripack_r4 legacy_stripack_i8 fortran90 c_pstripack c_pstripack_archive; do
  "$work/cmake/$program"
done

echo "== pkg-config"
export LD_LIBRARY_PATH="$libdir"
# built_with PACKAGES COMMAND...: builds a program by the command, and runs it
built_with() {
  packages=$1
  shift
  # shellcheck disable=SC2086  # a list of words on purpose
  "$@" $(pkg-config --cflags $packages) -o "$work/by_pkg_config" $(pkg-config --libs $packages)
  "$work/by_pkg_config"
}
built_with stripack gfortran "$consumer/legacy.F90"
built_with stripack_r4 gfortran -DSINGLE_PRECISION "$consumer/legacy.F90"
built_with stripack_8arg gfortran -DEIGHT_ARGUMENTS "$consumer/legacy.F90"
built_with stripack_i8 gfortran -fdefault-integer-8 "$consumer/legacy.F90"
built_with pstripack cc "$consumer/c_api.c" | grep "^c_api: pstripack $version,"
for library in stripack stripack_r4 stripack_i8; do
  built_with $library cc -Wall -Werror "$consumer/legacy.c" | grep -x 'legacy: 8 triangles'
done
built_with stripack g++ -x c++ -Wall -Werror "$consumer/legacy.c"
# As docs/python.md says.
if /usr/bin/python3 -c 'import numpy.f2py, distutils' 2> "$work/no_f2py.log"; then
  echo "== f2py"
  cd "$work"
  CFLAGS=-O0 /usr/bin/python3 -m numpy.f2py --noopt -c "$prefix/share/pstripack/stripack.pyf" $(pkg-config --libs stripack) \
    > f2py.log 2>&1 || { tail -n 20 f2py.log; exit 1; }
  /usr/bin/python3 -c '
import numpy as np, stripack
x, y, z = stripack.trans(np.radians([0, 0, 90, 0, 0, -90]), np.radians([0, 90, 0, 180, -90, 0]))
list, lptr, lend, lnew, ier = stripack.trmesh(x, y, z)
nt, triangles, ier = stripack.trlist2(list, lptr, lend)
print("f2py:", nt, "triangles, area", sum(stripack.areas(*np.c_[x, y, z][t - 1]) for t in triangles.T[:nt]) / np.pi)' |
    grep -x 'f2py: 8 triangles, area 4.0'
fi
# The command of docs/api/trplot.md needs no build folder.
if command -v gs > /dev/null; then (cd "$work" && sh "$prefix/share/doc/pstripack/examples/plots/make-plots" && head -c 8 trplot.png vrplot.png | grep -c PNG | grep -x 2); fi
for package in stripack stripack_r4 stripack_8arg stripack_i8 stripack_f90 pstripack pstripack_fortran; do
  pkg-config --exact-version="$version" $package
done
unset LD_LIBRARY_PATH

if [ -n "$mpiexec" ]; then
  echo "== MPI: CMake package, pkg-config"
  export LD_LIBRARY_PATH="$libdir"
  cc $(pkg-config --cflags pstripack_mpi) "$consumer/mpi.c" -o "$work/pc_mpi" $(pkg-config --libs pstripack_mpi)
  mpifort $(pkg-config --cflags stripack pstripack_mpi_fortran) "$consumer/mpi_fortran.f90" -o "$work/pc_mpi_fortran" \
    $(pkg-config --libs stripack pstripack_mpi_fortran)
  for program in "$work/pc_mpi" "$work/pc_mpi_fortran" "$work/cmake/mpi_pstripack_mpi" \
    "$work/cmake/mpi_pstripack_mpi_archive" "$work/cmake/mpi_pstripack_mpi_fortran" \
    "$work/cmake/mpi_pstripack_mpi_fortran_static"; do
    PSTRIPACK_REPORT=1 "$mpiexec" -n 2 "$program" > "$work/mpi.log" 2>&1 || { cat "$work/mpi.log"; exit 1; }
    grep -x 'mpi: 2 ranks, 24 slots' "$work/mpi.log"
    grep -o 'pstripack: comm n=6 ranks=2' "$work/mpi.log"
  done
  pkg-config --exact-version="$version" pstripack_mpi pstripack_mpi_fortran
  unset LD_LIBRARY_PATH
fi

if [ -x "$prefix/bin/stripack-compare" ]; then
  echo "== stripack-compare, by itself and beside a program"
  if "$prefix/bin/stripack-compare" run --points random --n 1000 --abi r8,8arg,i8 > "$work/compare.log" 2>&1; then
    grep '^verdict *equal' "$work/compare.log"
    PSTRIPACK_CHECK="lib:,log=$work/check.log" "$work/cmake/legacy_stripack"
    grep ' equal$' "$work/check.log"
  else
    grep 'no original to compare with' "$work/compare.log"
  fi
fi

if [ -x "$prefix/bin/pstripack" ]; then
  echo "== pstripack"
  "$prefix/bin/pstripack" -q points random 100 | "$prefix/bin/pstripack" -q info - | grep '^triangles *196$'
fi

echo "== man pages"
pages="trmesh.3 crlist.3 swap.3 pstripack.3"
for tool in "$prefix"/bin/*; do pages="$pages $(basename "$tool").1"; done
for page in $pages; do
  find "$prefix" -path "*/man?/$page" | grep -q . || { echo "no man page $page" >&2; exit 1; }
done

echo "== what the libraries need at run time"
for library in libpstripack.so libstripack.so libstripack_r4.so libstripack_8arg.so libstripack_i8.so; do
  needs=$(ldd "$libdir/$library" | awk '{ print $1 }' | tr '\n' ' ')
  echo "$library: $needs"
  if echo "$needs" | grep -qiE 'mpi|boost|fmt|netcdf|ngmath'; then echo "$library needs too much" >&2; exit 1; fi
done
echo "installed package: all programs ran"
