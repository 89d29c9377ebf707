#!/bin/sh
# Branch coverage of src/ by the tests that need neither MPI nor the tools:
#
#   tests/coverage/measure.sh [BUILD [CTEST OPTIONS...]]      BUILD: default build-coverage
#
# Builds (preset coverage: g++ -O0 --coverage), runs the tests with a fiftieth of the random cases, prints the
# table of branches per file, and fails where a branch of the predicates, of the validators or of an error path
# is neither taken nor in left-out.txt (required.py). Needs gcovr.
set -eu
here=$(cd "$(dirname "$0")" && pwd)
source=$(cd "$here/../.." && pwd)
build=${1:-$source/build-coverage}
[ $# -eq 0 ] || shift

cd "$source"
cmake --preset coverage -B "$build"
cmake --build "$build" -j "$(nproc)"
find "$build" -name '*.gcda' -delete
PSTRIPACK_CASES=0.02 ctest --test-dir "$build" --output-on-failure -j "$(nproc)" "$@"
gcovr --root "$source" --filter src/ --exclude-throw-branches --exclude-unreachable-branches \
  --branches --txt --json "$build/coverage.json" "$build"
python3 "$here/required.py" "$build/coverage.json"
