#!/bin/sh
# Builds for another processor by Debian's cross compilers and runs under qemu-user. May be repeated. Parts, all if none is
# named:
#   bits      every routine must return the bits of REFERENCE, the program fingerprint_plain of a trusted build
#   cases     predicates, directions, meshes, flips, validators, floating-point environments: with fewer random cases
#   fortran   each ABI and calling habit
# Without MPI, tools, the original, CGAL and MPFR, whose packages are not installed for that processor.
# Usage: tests/arm.sh REFERENCE [PROCESSOR [PART...]]     aarch64 (default), riscv64, ppc64le, s390x; i686: must be refused
set -eu
[ $# -ge 1 ] || { sed -n '2,8s/^# //p' "$0" >&2; exit 2; }
reference=$(realpath "$1") processor=${2:-aarch64}
shift
[ $# -eq 0 ] || shift
[ $# -gt 0 ] || set -- bits cases fortran
cd "$(dirname "$0")/.."
gnu=$processor
if [ "$processor" = ppc64le ]; then gnu=powerpc64le; fi
sh cmake/install-packages.sh "g++-$gnu-linux-gnu" "gfortran-$gnu-linux-gnu" qemu-user-static googletest
if [ "$processor" = i686 ]; then
  folder=$(mktemp -d)
  trap 'rm -rf "$folder"' EXIT
  if cmake -S . -B "$folder" -DCMAKE_SYSTEM_NAME=Linux -DCMAKE_C_COMPILER=i686-linux-gnu-gcc \
       -DCMAKE_CXX_COMPILER=i686-linux-gnu-g++ -DCMAKE_Fortran_COMPILER=i686-linux-gnu-gfortran 2>"$folder/errors"; then
    echo "configured for $processor" >&2
    exit 1
  fi
  grep "PSTRIPACK needs a 64-bit target" "$folder/errors"
  exit
fi
cmake --preset "$processor"
build=build-$processor
build() { cmake --build "$build" --parallel "$(nproc)" --target "$@"; }
emulate() { "qemu-$processor-static" -L "/usr/$gnu-linux-gnu" "$@"; }

# run PROGRAM CASES FILTER: CASES times as many random cases as usual. A filter that selects nothing is an error.
run() {
  PSTRIPACK_CASES=$2 emulate "$build/tests/$1" --gtest_filter="$3" >"$build/log" 2>&1 || { cat "$build/log"; exit 1; }
  grep -qE '^\[  PASSED  \] [1-9]' "$build/log" || { echo "arm.sh: $1 has no case $3" >&2; exit 1; }
  echo "$processor: $1: $(sed -n 's/^\[  PASSED  \] \([0-9]*\).*/\1/p' "$build/log") cases passed"
}

for part; do
  case $part in
    bits)
      build fingerprint_plain
      "$reference" >"$build/expected" 2>/dev/null
      emulate "$build/tests/numerics/fingerprint_plain" >"$build/got" 2>/dev/null
      diff "$build/expected" "$build/got" ;;
    cases)  # the largest meshes and all routines in all environments would take an hour
      build stripack_environment_test predicates_test delaunay_test flips_test validator_test
      run cxx/predicates_test 0.1 '*'
      run cxx/flips_test 0.2 '*'
      run cxx/validator_test 0.02 '*'
      run cxx/delaunay_test 0.02 'Small/Delaunay*:Of/HardNodes*_12:Memory*'
      run numerics/stripack_environment_test 0.02 '*AllAtOnce:*Upward' ;;
    fortran)
      build tests/fortran/all
      ctest --test-dir "$build" --output-on-failure --parallel "$(nproc)" --label-regex '^fortran$' \
        --exclude-regex 'fortran.calling_conventions_call' ;;
    *) echo "arm.sh: no part is called $part" >&2; exit 2 ;;
  esac
  echo "arm.sh: $processor: $part passed"
done
