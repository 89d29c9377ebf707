#!/bin/sh
# Sets up, builds and passes all tests. May be run again and again. Usage: ./test.sh [ctest options]
set -eu
cd "$(dirname "$0")"
build=build

sh cmake/install-packages.sh

[ -f $build/CMakeCache.txt ] || generator="-G Ninja"
# shellcheck disable=SC2086  # two words on purpose
cmake -S . -B $build ${generator:-} -DCMAKE_BUILD_TYPE=Release
cmake --build $build --parallel "$(nproc)"
ctest --test-dir $build --output-on-failure --parallel "$(nproc)" "$@"
