#!/bin/sh
# Builds and runs the tests that have no MPI under AddressSanitizer, LeakSanitizer and UndefinedBehaviorSanitizer,
# and those with threads under ThreadSanitizer: presets `sanitize` and `threads`. May be run again and again.
# Usage: tests/sanitizers.sh [short]      short: of the former a choice, preset `sanitize-short`
set -eu
cd "$(dirname "$0")/.."
case ${1:-} in
  "") choice=sanitize ;;
  short) choice=sanitize-short ;;
  *) sed -n '2,4s/^# //p' "$0" >&2; exit 2 ;;
esac
sh cmake/install-packages.sh clang libclang-rt-dev libomp-dev
run() {  # configure preset, build and test preset
  cmake --preset "$1"
  cmake --build --preset "$2" --parallel "$(nproc)"
  ctest --preset "$2" --parallel "$(nproc)"
}
run sanitize $choice
run threads threads
