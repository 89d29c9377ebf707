#!/bin/sh
# Builds all but MPI with LLVM's compilers, flang-new and Clang 19, and tests it. May be repeated. Parts, all if none is named:
#   libraries   the libraries: the tests of Fortran and of symbols; programs of gcc and gfortran link them. Every routine
#               must return the bits of REFERENCE, the program fingerprint_plain of a trusted build
#   routines    each routine against the original, in other floating-point environments; what is printed and plotted
#   tools       the rest is compiled
# Installs libomp-19, which takes the place of another libomp: of Clang 14's, which sanitizers.sh installs again.
# Usage: tests/llvm.sh REFERENCE [PART...]
set -eu
[ $# -ge 1 ] || { sed -n '2,9s/^# //p' "$0" >&2; exit 2; }
reference=$(realpath "$1")
shift
[ $# -gt 0 ] || set -- libraries routines tools
cd "$(dirname "$0")/.."
sh cmake/install-packages.sh clang-19 flang-19 libomp-19-dev
cmake --preset llvm
build=build-llvm
build() { cmake --build $build --parallel "$(nproc)" --target "$@"; }
run_labels() { ctest --test-dir $build --output-on-failure --parallel "$(nproc)" --label-regex "^($1)\$"; }

link_from_others() {
  rm -rf $build/prefix
  for component in runtime development; do cmake --install $build --prefix $build/prefix --component $component; done >$build/install.log
  consumer=tests/install/consumer
  libdir=$(dirname "$(find $build/prefix -name libstripack.a)")
  for kind in "" --static; do
    # shellcheck disable=SC2046,SC2086  # lists of words on purpose
    gcc $($build/prefix/bin/pstripack-config --cflags) $consumer/legacy.c -o $build/from_c $($build/prefix/bin/pstripack-config $kind --libs)
    # shellcheck disable=SC2046,SC2086
    gfortran -J $build $build/prefix/share/pstripack/stripack_module.F90 $consumer/legacy.F90 -o $build/from_gfortran \
      $(PKG_CONFIG_PATH=$libdir/pkgconfig pkg-config $kind --libs stripack)
    for program in from_c from_gfortran; do LD_LIBRARY_PATH=$libdir $build/$program | grep '^legacy: 8 triangles$'; done
  done
}

for part; do
  case $part in
    libraries)
      build src/cxx/all src/fortran/all tests/fortran/all fingerprint_plain
      "$reference" >$build/expected 2>/dev/null
      $build/tests/numerics/fingerprint_plain >$build/got 2>/dev/null
      diff $build/expected $build/got
      run_labels 'fortran|abi|api'
      link_from_others ;;
    routines)
      build tests/differential/all tests/numerics/all listing_test lout_test_stripack lout_test_stripack_r4 lout_test_stripack_i8 plot_test
      run_labels 'differential|listing|plot|numerics' ;;
    tools) build all ;;
    *) echo "llvm.sh: no part is called $part" >&2; exit 2 ;;
  esac
  echo "llvm.sh: $part passed"
done
