#!/bin/sh
# Builds the libraries with other compilers and options. All routines must return the bits of REFERENCE, the program
# fingerprint_plain of a trusted build, also in an unusual floating-point environment.
# Usage: tests/numerics/builds.sh REFERENCE [BUILD]      BUILD: checks this build folder alone
# Takes some 20 minutes on two cores. Needs clang++ (clang, libclang-rt-dev, libomp-dev); leaves nothing behind.
set -eu
[ $# -ge 1 ] || { sed -n '2,7s/^# //p' "$0" >&2; exit 2; }
source=$(cd "$(dirname "$0")/../.." && pwd)
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
"$1" >"$folder/expected" 2>/dev/null
failed=0

# verdict BUILD: sets `result`; what is wrong is in the log
verdict() {
  result=same
  if ! "$1/tests/numerics/fingerprint_plain" >"$folder/got" 2>"$folder/log"; then
    result="DOES NOT RUN"
  elif grep 'MXCSR = [^1]' "$folder/log"; then
    result="CHANGES THE PROGRAM'S ENVIRONMENT WHERE IT IS LOADED"
  elif ! diff "$folder/expected" "$folder/got" >"$folder/log"; then
    result=DIFFERENT
  elif ! "$1/tests/numerics/stripack_environment_test" --gtest_filter='*AllAtOnce' >"$folder/log" 2>&1; then
    result="DIFFERENT IN ANOTHER ENVIRONMENT"
  fi
}

# tell NAME: prints `result`
tell() {
  echo "$1: $result"
  [ "$result" = same ] && return
  failed=1
  tail -n 20 "$folder/log"
}

# check COMPILER FLAGS [CMake options]
check() {
  compiler=$1 flags=$2
  shift 2
  rm -rf "$folder/build"
  result="DOES NOT BUILD"
  if { cmake -S "$source" -B "$folder/build" -G Ninja -DCMAKE_BUILD_TYPE=None -DCMAKE_CXX_COMPILER="$compiler" \
           -DCMAKE_CXX_FLAGS="$flags" -DCMAKE_Fortran_FLAGS="$flags" -DPSTRIPACK_WITH_MPI=OFF \
           -DPSTRIPACK_TOOLS=OFF -DPSTRIPACK_EXAMPLES=OFF -DPSTRIPACK_PYTHON=OFF "$@" &&
         cmake --build "$folder/build" --parallel "$(nproc)" \
           --target fingerprint_plain stripack_environment_test; } >"$folder/log" 2>&1; then
    verdict "$folder/build"
  fi
  tell "$compiler $flags $*"
}

if [ $# -gt 1 ]; then
  verdict "$2"
  tell "$2"
  exit $failed
fi

wide=""
if grep -qw fma /proc/cpuinfo; then wide="-march=native -mfma"; fi
for compiler in g++ clang++; do
  for level in -O0 -O1 -O2 -O3; do check "$compiler" $level; done
  for level in -O1 -O3; do check "$compiler" "$level $wide"; done
  check "$compiler" "-O3 $wide -ffast-math"  # a packager might add this; our own options must override it
  check "$compiler" "-Ofast $wide" -DCMAKE_SHARED_LINKER_FLAGS=-Ofast
  check "$compiler" "-O2 $wide -funsafe-math-optimizations"
done
check g++ "-O2 $wide" -DCMAKE_INTERPROCEDURAL_OPTIMIZATION=ON
exit $failed
