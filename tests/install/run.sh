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
gfortran $(pkg-config --cflags stripack) "$consumer/legacy.F90" -o "$work/pc_r8" $(pkg-config --libs stripack)
gfortran -DSINGLE_PRECISION $(pkg-config --cflags stripack_r4) "$consumer/legacy.F90" -o "$work/pc_r4" $(pkg-config --libs stripack_r4)
gfortran -DEIGHT_ARGUMENTS $(pkg-config --cflags stripack_8arg) "$consumer/legacy.F90" -o "$work/pc_8arg" $(pkg-config --libs stripack_8arg)
gfortran -fdefault-integer-8 $(pkg-config --cflags stripack_i8) "$consumer/legacy.F90" -o "$work/pc_i8" $(pkg-config --libs stripack_i8)
cc $(pkg-config --cflags pstripack) "$consumer/c_api.c" -o "$work/pc_c" $(pkg-config --libs pstripack)
for program in pc_r8 pc_r4 pc_8arg pc_i8 pc_c; do "$work/$program"; done
"$work/pc_c" | grep "^c_api: pstripack $version,"
# The command of docs/plots.md needs no build folder.
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

echo "== the static archives alone, from Fortran and C"
archives=$(pkg-config --libs --static stripack | sed "s|-lstripack|$libdir/libstripack.a|; s|-lpstripack|$libdir/libpstripack.a|")
# shellcheck disable=SC2086
gfortran -I "$prefix/include/pstripack/stripack" "$consumer/legacy.F90" -o "$work/static" $archives
# shellcheck disable=SC2086
cc "$consumer/legacy.c" -o "$work/static_c" $archives
for program in static static_c; do
  "$work/$program"
  if ldd "$work/$program" | grep -q pstripack; then echo "$program needs a shared pstripack" >&2; exit 1; fi
done

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
