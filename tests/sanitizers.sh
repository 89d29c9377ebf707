#!/bin/sh
# Builds and runs the tests that have no MPI under AddressSanitizer, LeakSanitizer and UndefinedBehaviorSanitizer,
# and those with threads under ThreadSanitizer: presets `sanitize` and `threads`. May be repeated.
# Usage: tests/sanitizers.sh [short]      short: a choice, presets `sanitize-short` and `threads-short`
set -eu
cd "$(dirname "$0")/.."
case ${1:-} in
  "") short= ;;
  short) short=-short ;;
  *) sed -n '2,4s/^# //p' "$0" >&2; exit 2 ;;
esac
. tests/stages.sh
run_tests() {  # test preset, build folder
  code=0
  ctest --preset "$1" --parallel "$(nproc)" --output-junit tests.xml || code=$?
  slowest "$2/tests.xml"
  return $code
}
run() {  # presets: configure, which is in the name of the build folder; build; test
  stage "$1: configure" cmake --preset "$1"
  stage "$1: build" cmake --build --preset "$2" --parallel "$(nproc)"
  stage "$1: tests" run_tests "$3" "build-$1"
}
stage "install packages of sanitizers" sh cmake/install-packages.sh clang libclang-rt-dev libomp-dev
run sanitize$short sanitize$short sanitize$short
run threads threads threads$short
