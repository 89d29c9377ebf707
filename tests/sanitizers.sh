#!/bin/sh
# Builds and runs the tests that have no MPI under AddressSanitizer, LeakSanitizer and UndefinedBehaviorSanitizer,
# and those with threads under ThreadSanitizer: presets `sanitize` and `threads`. May be repeated.
# Usage: tests/sanitizers.sh [short]      short: a choice, presets `sanitize-short`, with FMA where the processor has it,
# and `threads-short`
set -eu
cd "$(dirname "$0")/.."
case ${1:-} in
  "") short= ;;
  short) short=-short ;;
  *) sed -n '2,5s/^# //p' "$0" >&2; exit 2 ;;
esac
. tests/stages.sh
run() {  # preset, option of cmake
  stage "$1: configure" cmake --preset "$@"
  stage "$1: build" cmake --build --preset "$1" --parallel "$(nproc)"
  stage "$1: tests" run_ctest "build-$1" --preset "$1" --parallel "$(nproc)"
}
debug_flags=-g1
if [ "$short" ] && grep -qw fma /proc/cpuinfo; then debug_flags="-g1 -march=native -mfma"; fi
stage "install packages of sanitizers" sh cmake/install-packages.sh clang libclang-rt-dev libomp-dev
run sanitize$short -DCMAKE_CXX_FLAGS_DEBUG="$debug_flags"
run threads$short
