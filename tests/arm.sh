#!/bin/sh
# Builds for another processor by Debian's cross compilers and runs under qemu-user: every routine must return the bits
# of REFERENCE, the program fingerprint_plain of a trusted build; then predicates, meshes, flips, validators, floating-
# point environments and Fortran, with fewer random cases. Without MPI, tools, the original, CGAL and MPFR, whose
# packages are not installed for that processor. May be repeated.
# Usage: tests/arm.sh REFERENCE [PROCESSOR]     aarch64 (default), riscv64, ppc64le, s390x; i686: must be refused
set -eu
[ $# -ge 1 ] || { sed -n '2,6s/^# //p' "$0" >&2; exit 2; }
reference=$(realpath "$1") processor=${2:-aarch64}
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
cmake --build "$build" --parallel "$(nproc)" --target fingerprint_plain stripack_environment_test predicates_test \
  delaunay_test flips_test validator_test tests/fortran/all
"$reference" >"$build/expected" 2>/dev/null
"qemu-$processor-static" -L "/usr/$gnu-linux-gnu" "$build/tests/numerics/fingerprint_plain" >"$build/got" 2>/dev/null
diff "$build/expected" "$build/got"
# The largest meshes and whatever tries all triples or all routines again would take an hour under qemu.
PSTRIPACK_CASES=0.02 ctest --test-dir "$build" --output-on-failure --parallel "$(nproc)" --timeout 600 --tests-regex \
  '^(predicates_test|flips_test|validator_test|fortran)\.|^delaunay_test\.(Small/Delaunay|Of/HardNodes.*_12$|Memory)|^numerics_stripack\..*(AllAtOnce|Upward)' \
  --exclude-regex 'fortran.(hard_cases|calling_conventions_call)'
