#!/bin/sh
# Runs tests of a build under valgrind's memcheck: every routine of every library, the exact stages, warm
# starts, changes of triangulations, printing routines, and the fuzzing corpus. Fails on any error or memory leak.
# Usage: tests/valgrind.sh [BUILD]      BUILD: default build. Takes some 15 minutes.
set -eu
cd "$(dirname "$0")/.."
sh cmake/install-packages.sh valgrind
tests=$(cd "${1:-build}" && pwd)/tests
failed=0

memcheck() {
  echo "== $*"
  OMP_NUM_THREADS=2 valgrind --quiet --error-exitcode=9 --leak-check=full --errors-for-leak-kinds=definite \
    --show-leak-kinds=definite "$@" >/dev/null || { echo "FAILED: $*"; failed=1; }
}

for library in stripack stripack_r4 stripack_8arg stripack_i8; do
  memcheck "$tests/numerics/${library}_environment_test" --gtest_filter='Memory*'
done
memcheck "$tests/cxx/edit_test"
memcheck "$tests/cxx/listing_test"
memcheck "$tests/cxx/plot_test" --gtest_filter='-*Ier_6*'  # runs out of memory, which ends a program under valgrind
memcheck "$tests/cxx/mesh_test"
memcheck "$tests/cxx/warm_start_test" --gtest_filter='*GoesOnWithEveryCall:*OthersInTurn'
memcheck "$tests/cxx/delaunay_test" --gtest_filter='Memory*'
for target in predicates kernel queries; do
  memcheck "$tests/fuzz/fuzz_$target" tests/fuzz/corpus/$target
done
exit $failed
