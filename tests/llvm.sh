#!/bin/sh
# Builds all but MPI with LLVM's compilers, flang-new and Clang 19, and runs the tests of Fortran, of the libraries'
# symbols, of each routine against the original, and of all routines in other floating-point environments. Every routine
# must return the bits of REFERENCE, the program fingerprint_plain of a trusted build. May be repeated.
# Usage: tests/llvm.sh REFERENCE
set -eu
[ $# -eq 1 ] || { sed -n '2,5s/^# //p' "$0" >&2; exit 2; }
reference=$(realpath "$1")
cd "$(dirname "$0")/.."
sh cmake/install-packages.sh clang-19 flang-19 libomp-19-dev
cmake --preset llvm
cmake --build build-llvm --parallel "$(nproc)"
"$reference" >build-llvm/expected 2>/dev/null
build-llvm/tests/numerics/fingerprint_plain >build-llvm/got 2>/dev/null
diff build-llvm/expected build-llvm/got
ctest --test-dir build-llvm --output-on-failure --parallel "$(nproc)" --label-regex '^(fortran|abi|api|differential|listing|plot|numerics)$'
