#!/bin/sh
# Branch coverage of src/ by the tests that need neither MPI nor the tools:
#
#   tests/coverage/measure.sh [BUILD [CTEST OPTIONS...]]      BUILD: default build-coverage
#
# Builds (preset coverage: g++ -O0 --coverage) and runs a choice of tests, or those of the given ctest options, with a
# fiftieth of the random cases. Prints the table of branches per file, and fails if a branch of the predicates, of the
# validators or of an error path is neither taken nor excused in untested.txt (required.py). Some 25 minutes on two
# processors.
set -eu
here=$(cd "$(dirname "$0")" && pwd)
source=$(cd "$here/../.." && pwd)
build=${1:-$source/build-coverage}
[ $# -eq 0 ] || shift

if [ $# -eq 0 ]; then
  tests='predicates_test|validator_test|mesh_test|edit_(broken_lists_)?test|(listing|plot|check|report|memory)_test'
  tests="$tests|catalogue_(numbers|callers|duplicates|beyond)|fuzz_corpus|faults"
  tests="$tests|fortran\\.|privileges|point_files|dlopen"
  tests="$tests|search_test|triangle_list_test|measures_test|inside_test|scvt_(calls_|ranks_)?test"
  tests="$tests|flips_test|warm_start_test"
  set -- -R "$tests"
fi

cd "$source"
sh cmake/install-packages.sh gcovr
cmake --preset coverage -B "$build"
cmake --build "$build" -j "$(nproc)"
find "$build" -name '*.gcda' -delete
export PSTRIPACK_CASES=0.02
few='*FewNodes*:Agreement*:*Nasty*:*Coincident*:*GivingUp*:*/np1_*:*/np3_*'
for program in catalogue_small delaunay parallel; do
  PSTRIPACK_WARM_START=0 "$build/tests/cxx/${program}_test" --gtest_filter="$few"
done
PSTRIPACK_WARM_START=0 PSTRIPACK_CASES=1 "$build/tests/cxx/moving_stars_test"  # fewer cases have no flips across ranks
ctest --test-dir "$build" --output-on-failure -j "$(nproc)" "$@"
gcovr --root "$source" --filter src/cxx/ --exclude-throw-branches --exclude-unreachable-branches \
  --txt --branches "$build/src/cxx" "$build/tests"
python3 "$here/required.py" "$build"
