#!/bin/sh
# Searches for inputs that make a routine fail, with libFuzzer, SECONDS per target: run.sh [SECONDS]
#
# Inputs that reach new code are kept in build-fuzz/corpus. A failing input is written to build-fuzz/TARGET-crash-... or
# -timeout-..., and run.sh ends with code 1. To reproduce the failure:
#   build-fuzz/tests/fuzz/fuzz_TARGET FILE
# To add the inputs found to the tests:
#   build-fuzz/tests/fuzz/fuzz_TARGET -merge=1 tests/fuzz/corpus/TARGET build-fuzz/corpus/TARGET
set -eu
cd "$(dirname "$0")/../.."
seconds=${1:-60}

sh cmake/install-packages.sh clang libclang-rt-dev
cmake --preset fuzz
cmake --build --preset fuzz --parallel "$(nproc)"

code=0
for target in predicates kernel moves queries file_readers; do
  echo "== $target"
  mkdir -p build-fuzz/corpus/$target
  # stderr is closed for the routines, which print a line for each code that the original does not have.
  build-fuzz/tests/fuzz/fuzz_$target -max_total_time="$seconds" -max_len=1024 -timeout=60 -rss_limit_mb=4096 \
    -close_fd_mask=2 -print_final_stats=1 -artifact_prefix=build-fuzz/$target- \
    build-fuzz/corpus/$target tests/fuzz/corpus/$target || code=1
done
exit $code
