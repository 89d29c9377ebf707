#!/bin/sh
# Builds and runs the tests that have no MPI under AddressSanitizer, LeakSanitizer and UndefinedBehaviorSanitizer,
# and those with threads under ThreadSanitizer: presets `sanitize` and `threads`. May be run again and again.
# Usage: tests/sanitizers.sh [ctest options]
set -eu
cd "$(dirname "$0")/.."
sh cmake/install-packages.sh clang libclang-rt-dev libomp-dev
for preset in sanitize threads; do
  cmake --preset $preset
  cmake --build --preset $preset --parallel "$(nproc)"
  ctest --preset $preset --parallel "$(nproc)" "$@"
done
